#include <fmt/format.h>

#include <algorithm>

#include "perf/throughput.hpp"

namespace riven::perf {

namespace {

const Result& of(const std::vector<Result>& results, const std::string& name, int threads) {
  return *std::find_if(results.begin(), results.end(),
                       [&](const Result& r) { return r.name == name && r.threads == threads; });
}

using Times = std::vector<TaskTime> Result::*;  ///< of tasks, or of kernels

double nanoseconds(const std::vector<TaskTime>& times, const std::string& label) {
  const auto t = std::find_if(times.begin(), times.end(), [&](const TaskTime& x) { return x.label == label; });
  return t == times.end() ? -1 : t->nanoseconds;
}

/// Labels of all results, each where the first that has it does it.
std::vector<std::string> labels_of(const std::vector<const Result*>& results, Times which) {
  std::vector<std::string> labels;
  for (const Result* r : results) {
    auto place = labels.begin();
    for (const TaskTime& t : r->*which) {
      const auto known = std::find(labels.begin(), labels.end(), t.label);
      place = (known != labels.end() ? known : labels.insert(place, t.label)) + 1;
    }
  }
  return labels;
}

/// A row for each label, a column for each result.
std::string table_of(const std::string& title, const std::vector<const Result*>& columns, Times which) {
  std::string text = fmt::format("{:<34}", title);
  std::vector<int> width;
  for (const Result* r : columns) {
    width.push_back(std::max(14, static_cast<int>(r->name.size())));
    text += fmt::format(" {:>{}}", r->name, width.back());
  }
  text += '\n';
  for (const std::string& label : labels_of(columns, which)) {
    text += fmt::format("{:<34}", label);
    for (size_t c = 0; c < columns.size(); ++c) {
      const double t = nanoseconds(columns[c]->*which, label), share = 100e-9 * t * columns[c]->median_rate();
      text += fmt::format(" {:>{}}", t < 0 ? "-" : fmt::format("{:.3f} {:>4.1f}%", t, share), width[c]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string bound_table(const std::vector<MachineRates>& rates) {
  std::string text = fmt::format("{:>7} {:>15} {:>15}\n", "threads", "arithmetic M/s", "memory M/s");
  for (const MachineRates& r : rates) {
    const Bounds b = bounds_of(flops_per_particle_step, bytes_per_particle_step, r);
    text += fmt::format("{:>7} {:>15.1f} {:>15.1f}\n", r.threads, 1e-6 / b.arithmetic, 1e-6 / b.memory);
  }
  return text;
}

std::string rate_table(const std::vector<Result>& results, const std::vector<MachineRates>& rates) {
  std::string text = fmt::format("{:<16} {:>7} {:>9} {:>9} {:>9} {:>7} {:>7} {:>7} {:>9} {:>9} {:>9} {:>15}\n", "",
                                 "threads", "best M/s", "median", "ns/step", "FMA %", "mem. %", "bound %", "speed-up",
                                 "B/part.", "momentum", "crack cost %");
  for (const Result& r : results) {
    const Shares share = bound_shares(r, rates);
    const std::string memory = share.memory > 0 ? fmt::format("{:.1f}", 100 * share.memory) : "-";
    const double speed_up = r.best_rate() / of(results, r.name, rates.front().threads).best_rate();
    std::string cost;
    if (!r.without_cracks.empty()) {
      const Overhead o = crack_overhead(r, results);
      cost = fmt::format("{:.1f} (best {:.1f})", 100 * o.median, 100 * o.best);
    }
    text += fmt::format(
        "{:<16} {:>7} {:>9.2f} {:>9.2f} {:>9.1f} {:>7.1f} {:>7} {:>7.1f} {:>9.2f} {:>9.0f} {:>9.0e} {:>15}\n", r.name,
        r.threads, 1e-6 * r.best_rate(), 1e-6 * r.median_rate(), 1e9 / r.median_rate(), 100 * share.arithmetic, memory,
        100 * share.bound, speed_up,
        static_cast<double>(r.particle_bytes + r.other_bytes) / static_cast<double>(r.particles), r.momentum_error,
        cost);
  }
  return text;
}

std::string device_table(const std::vector<Result>& results, double copy) {
  std::string text = fmt::format("{:<28} {:>10} {:>10} {:>10} {:>8} {:>7} {:>8} {:>9} {:>15}\n", "", "particles",
                                 "best M/s", "median", "GB/s", "copy %", "B/part.", "momentum", "crack cost %");
  for (const Result& r : results) {
    std::string cost;
    if (!r.without_cracks.empty())
      cost = fmt::format("{:.1f}", 100 * crack_overhead(r, results).median);
    text += fmt::format("{:<28} {:>10} {:>10.1f} {:>10.1f} {:>8.1f} {:>7.1f} {:>8.0f} {:>9.0e} {:>15}\n", r.name,
                        r.particles, 1e-6 * r.best_rate(), 1e-6 * r.median_rate(), 1e-9 * achieved_bandwidth(r),
                        100 * achieved_bandwidth(r) / copy,
                        static_cast<double>(r.particle_bytes + r.other_bytes) / static_cast<double>(r.particles),
                        r.momentum_error, cost);
  }
  return text;
}

std::string task_table(const std::vector<Result>& results, int threads) {
  std::vector<const Result*> columns;
  for (const Result& r : results)
    if (r.threads == threads)
      columns.push_back(&r);
  return table_of(fmt::format("ns per particle, {} thread{}", threads, threads == 1 ? "" : "s"), columns,
                  &Result::tasks);
}

std::string kernel_table(const std::vector<Result>& results) {
  std::vector<const Result*> columns;
  for (const Result& r : results)
    columns.push_back(&r);
  return table_of("kernels, ns per particle", columns, &Result::kernels);
}

}  // namespace riven::perf
