#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "perf/commands.hpp"
#include "perf/machine.hpp"

namespace riven::perf {

namespace {

nlohmann::json to_json(const std::vector<MachineRates>& rates) {
  nlohmann::json rows = nlohmann::json::array();
  for (const MachineRates& r : rates)
    rows.push_back({{"threads", r.threads},
                    {"triad_bytes_per_second", r.triad},
                    {"update_bytes_per_second", r.update},
                    {"fma_flops_per_second", r.fma},
                    {"atomic_adds_per_second", r.atomic}});
  return {{"machine", machine_name()}, {"rates", rows}};
}

}  // namespace

void add_machine(CLI::App& app) {
  struct Options {
    std::vector<int> threads = core_counts();
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("machine", "Bandwidths and rates of this machine for each core count");
  command->add_option("--threads", options->threads, "Thread counts to measure")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print JSON instead of a table");
  command->callback([options] {
    std::vector<MachineRates> rates;
    for (int threads : options->threads)
      rates.push_back(measure_machine(threads));
    if (options->json)
      fmt::print("{}\n", to_json(rates).dump(2));
    else
      fmt::print("{}\n{}", machine_name(), table(rates));
  });
}

}  // namespace riven::perf
