#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "perf/kernels.hpp"

namespace riven::perf {

namespace {

using Run = benchmark::BenchmarkReporter::Run;

/// Without what Google Benchmark appends to the name of a benchmark whose iterations and times are set.
Run plainly_named(Run run) {
  run.run_name.iterations.clear();
  run.run_name.time_type.clear();
  run.cpu_accumulated_time = 0;  // that of handing over the times
  return run;
}

class JsonReporter : public benchmark::JSONReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> plain;
    std::transform(runs.begin(), runs.end(), std::back_inserter(plain), plainly_named);
    JSONReporter::ReportRuns(plain);
  }
};

class TableReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    const Run* shown = &runs.front();
    if (shown->run_type == Run::RT_Iteration && shown->repetitions > 1)
      return;  // what they amount to comes next
    double scatter = 0;
    for (const Run& r : runs)
      if (r.aggregate_name == "median")
        shown = &r;
      else if (r.aggregate_name == "cv")
        scatter = r.real_accumulated_time;
    const std::string& name = shown->run_name.function_name;
    const size_t slash = name.find('/');
    if (name.substr(0, slash) != scene_)
      print_head(name.substr(0, slash));
    fmt::print("  {:<34} {:>8.3f} {:>5.1f}", name.substr(slash + 1), shown->GetAdjustedRealTime(), 100 * scatter);
    print_operations(shown->counters);
    std::fflush(stdout);
  }

 private:
  void print_head(const std::string& scene) {
    scene_ = scene;
    fmt::print("\n{:<36} {:>8} {:>5} {:>8} {:>8} {:>8} {:>8} {:>8} {:>7}  {}\n", scene_, "ns", "+- %", "instr.",
               "flops", "moved B", "memory B", "flops/B", "roof %", "bound by");
  }
  static void print_operations(const benchmark::UserCounters& counters) {
    const auto of = [&](const char* key) {
      const auto c = counters.find(key);
      return c == counters.end() ? 0 : c->second.value;
    };
    if (of("instructions") == 0) {
      fmt::print("\n");
      return;
    }
    const std::string intensity = of("flops_per_byte") > 0 ? fmt::format("{:.3g}", of("flops_per_byte")) : "-";
    const char* bound = of("memory_bound_ns") > of("arithmetic_bound_ns") ? "memory" : "arithmetic";
    fmt::print(" {:>8.2f} {:>8.2f} {:>8.1f} {:>8.1f} {:>8} {:>7.1f}  {}\n", of("instructions"), of("flops"),
               of("moved_bytes"), of("memory_bytes"), intensity, 100 * of("roofline_share"),
               of("roofline_share") > 0 ? bound : "neither");
  }

  std::string scene_;
};

}  // namespace

std::unique_ptr<benchmark::BenchmarkReporter> table_of_kernels() {
  return std::make_unique<TableReporter>();
}

std::unique_ptr<benchmark::BenchmarkReporter> json_of_kernels() {
  return std::make_unique<JsonReporter>();
}

}  // namespace riven::perf
