#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "perf/commands.hpp"
#include "perf/device_copy.hpp"
#include "perf/machine.hpp"
#include "perf/throughput.hpp"

namespace riven::perf {

namespace {

struct Options {
  std::vector<int> threads = core_counts();
  std::vector<std::string> only;
  bool quick = false, json = false;
};

/// A few steps of each: shows that all of it works, not how fast.
void hurry(Group& g) {
  g.warm_up = 2;
  g.steps = 3;
  g.turns = 3;
}

std::vector<Group> chosen(const Options& o) {
  std::vector<Group> list = throughput_groups();
  std::erase_if(list, [&](const Group& g) {
    return o.only.empty() ? g.asked_for || (o.quick && g.name == "large")
                          : std::find(o.only.begin(), o.only.end(), g.name) == o.only.end();
  });
  if (o.quick)
    std::for_each(list.begin(), list.end(), hurry);
  return list;
}

nlohmann::json to_json(const std::vector<TaskTime>& times) {
  nlohmann::json list = nlohmann::json::array();
  for (const TaskTime& t : times)
    list.push_back({{"label", t.label}, {"effect", t.effect}, {"nanoseconds_per_particle_step", t.nanoseconds}});
  return list;
}

nlohmann::json to_json(const Result& r, const std::vector<Result>& all, const std::vector<MachineRates>& rates) {
  const Shares share = bound_shares(r, rates);
  nlohmann::json j = {{"name", r.name},
                      {"threads", r.threads},
                      {"particles", r.particles},
                      {"steps", r.steps},
                      {"seconds_per_step", r.seconds},
                      {"particle_steps_per_second", {{"best", r.best_rate()}, {"median", r.median_rate()}}},
                      {"fma_share", share.arithmetic},
                      {"memory_share", share.memory},
                      {"bound_share", share.bound},
                      {"particle_bytes", r.particle_bytes},
                      {"other_bytes", r.other_bytes},
                      {"contacts", r.contacts},
                      {"grown", r.grown},
                      {"momentum_error", r.momentum_error},
                      {"energy_error", r.energy_error},
                      {"achieved_bytes_per_second", achieved_bandwidth(r)},
                      {"tasks", to_json(r.tasks)},
                      {"kernels", to_json(r.kernels)}};
  if (!r.without_cracks.empty()) {
    const Overhead o = crack_overhead(r, all);
    j["crack_overhead"] = {{"without_cracks", r.without_cracks}, {"median", o.median}, {"best", o.best}};
  }
  return j;
}

void print_group(const Group& g, const std::vector<Result>& results, const std::vector<MachineRates>& rates,
                 double copy) {
  fmt::print("\n{}: {}; {} turns of {} steps\n", g.name, g.title, g.turns, g.steps);
  if (g.on_device) {
    fmt::print("copy on the device: {:.1f} GB/s\n{}\n{}\n{}\n", 1e-9 * copy, device_table(results, copy),
               task_table(results, results.front().threads), kernel_table(results));
  } else {
    fmt::print("{}\n", rate_table(results, rates));
    for (const MachineRates& r : rates)
      fmt::print("{}\n", task_table(results, r.threads));
  }
  std::fflush(stdout);
}

void throughput(const Options& o) {
  std::vector<MachineRates> rates;
  for (const int n : o.threads)
    rates.push_back(measure_machine(n));
  nlohmann::json out = {{"machine", machine_name()},
                        {"flops_per_particle_step", flops_per_particle_step},
                        {"bytes_per_particle_step", bytes_per_particle_step}};
  for (const MachineRates& r : rates)
    out["rates"].push_back(
        {{"threads", r.threads}, {"triad_bytes_per_second", r.triad}, {"fma_flops_per_second", r.fma}});
  if (!o.json)
    fmt::print(
        "{}\n{}\n"
        "Bounds of a step, with the {} flops per particle of FLIP and USL and, where the arrays do not fit into the\n"
        "caches, its {} bytes. FMA %, mem. %: shares of them that the best turn reaches; bound %: of the lower "
        "one.\n{}",
        machine_name(), table(rates), flops_per_particle_step, bytes_per_particle_step, bound_table(rates));
  for (const Group& g : chosen(o)) {
    const std::vector<Result> results = measure(g, g.on_device ? std::vector{o.threads.back()} : o.threads);
    const double copy = g.on_device ? device_copy_bandwidth() : 0;
    if (!o.json)
      print_group(g, results, rates, copy);
    nlohmann::json runs = nlohmann::json::array();
    for (const Result& r : results)
      runs.push_back(to_json(r, results, rates));
    out["groups"].push_back({{"name", g.name}, {"title", g.title}, {"runs", runs}});
    if (g.on_device)
      out["groups"].back()["device_copy_bytes_per_second"] = copy;
  }
  if (o.json)
    fmt::print("{}\n", out.dump(2));
}

}  // namespace

void add_throughput(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("throughput",
                                         "Particle-steps per second of whole steps, beside the machine's "
                                         "bounds, and what cracks cost");
  std::vector<std::string> names;
  for (const Group& g : throughput_groups())
    names.push_back(g.name);
  command->add_option("--only", o->only, "Groups to run; all unless said")->delimiter(',')->check(CLI::IsMember(names));
  command->add_option("--threads", o->threads, "Thread counts to measure; the first is what speed-ups refer to")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--quick", o->quick, "A few steps each, without the large block: a trial, not a measurement");
  command->add_flag("--json", o->json, "Print JSON instead of tables");
  command->callback([o] { throughput(*o); });
}

}  // namespace riven::perf
