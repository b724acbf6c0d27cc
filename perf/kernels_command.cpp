#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <regex>

#include "core/error.hpp"
#include "io/suggest.hpp"
#include "perf/commands.hpp"
#include "perf/count.hpp"
#include "perf/kernels.hpp"

namespace riven::perf {

namespace {

std::regex filter_of(const std::string& text) {
  try {
    return std::regex(text);
  } catch (const std::regex_error& e) {
    fail({Exit::bad_input, std::string("this is no regular expression: ") + e.what(), "--filter", text});
  }
}

/// The benchmark of a task. It has an iteration for each turn, so that the tasks of a scene share the turns of each
/// repetition.
class TaskBenchmark : public benchmark::internal::Benchmark {
 public:
  TaskBenchmark(std::shared_ptr<SceneKernels> scene, size_t task)
      : Benchmark(scene->name(task).c_str()), scene_(std::move(scene)), task_(task) {
    UseManualTime();
    Unit(benchmark::kNanosecond);
    Iterations(scene_->turns());
  }
  void Run(benchmark::State& state) override {  // a repetition
    double sum = 0;
    for (auto _ : state) {
      const double seconds = scene_->seconds(task_, next_turn_++);
      state.SetIterationTime(seconds);
      sum += seconds;
    }
    state.counters = scene_->counters(task_, sum / scene_->turns());
  }

 private:
  std::shared_ptr<SceneKernels> scene_;
  size_t task_, next_turn_ = 0;
};

/// Throws Error (bad input) where the filter leaves none.
void add_benchmarks(const KernelOptions& o, const MachineRates& rates) {
  const std::regex filter = filter_of(o.filter);
  std::vector<std::string> scenes;
  bool any = false;
  for (GateScene& g : kernel_scenes(o.quick)) {
    scenes.push_back("'" + g.timed.name + "'");
    const auto scene = std::make_shared<SceneKernels>(std::move(g), o, rates);
    for (size_t task = 0; task < scene->labels().size(); ++task)
      if (std::regex_search(scene->name(task), filter)) {
        // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks): it is Google Benchmark's from now on
        benchmark::internal::RegisterBenchmarkInternal(new TaskBenchmark(scene, task));
        any = true;
      }
  }
  if (!any)
    fail({Exit::bad_input, "no benchmark has a name like this", "--filter", o.filter,
          "SCENE/TASK, with the labels of `riven plan`", "scenes are: " + listed(scenes)});
}

void kernels(const KernelOptions& o) {
  MachineRates rates;
  add_benchmarks(o, rates);
  rates = measure_machine(o.threads);
  std::string program = "riven-perf", repetitions = fmt::format("--benchmark_repetitions={}", o.repetitions);
  std::array<char*, 3> arguments{program.data(), repetitions.data(), nullptr};
  int count = arguments.size() - 1;
  benchmark::Initialize(&count, arguments.data());
  benchmark::AddCustomContext("machine", machine_name());
  benchmark::AddCustomContext("threads", fmt::format("{}", o.threads));
  benchmark::AddCustomContext("triad_bytes_per_second", fmt::format("{}", rates.triad));
  benchmark::AddCustomContext("fma_flops_per_second", fmt::format("{}", rates.fma));
  if (!o.json)
    fmt::print("{}\n{}", machine_name(), table({rates}));
  const auto reporter = o.json ? json_of_kernels() : table_of_kernels();
  benchmark::RunSpecifiedBenchmarks(reporter.get());
}

}  // namespace

void add_kernels(CLI::App& app) {
  auto o = std::make_shared<KernelOptions>();
  o->program = counted_program();
  CLI::App* command = app.add_subcommand(
      "kernels",
      "Nanoseconds per particle of each task, with Google Benchmark, and what share of the "
      "machine's roofline it reaches; instructions, flops and bytes are counted by callgrind, which takes minutes");
  command->add_option("--filter", o->filter, "Regular expression; runs the SCENE/TASK that it is found in");
  command->add_option("--threads", o->threads, "Threads")->check(CLI::PositiveNumber)->capture_default_str();
  command->add_option("--repetitions", o->repetitions, "Repetitions, of which the table shows the median")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--program", o->program, "riven-perf built for valgrind, which is counted")
      ->capture_default_str();
  command->add_flag("!--no-counts", o->count, "Only times");
  command->add_flag("--quick", o->quick, "The scenes at the gate's small size and a few steps: a trial");
  command->add_flag("--json", o->json, "Print Google Benchmark's JSON instead of tables");
  command->callback([o] { kernels(*o); });

  struct Stepping {
    std::string scene;
    bool quick = false;
  };
  auto s = std::make_shared<Stepping>();
  CLI::App* stepping = app.add_subcommand("step-for-operations", "What kernels runs under callgrind")->group("");
  stepping->add_option("--scene", s->scene)->required();
  stepping->add_flag("--quick", s->quick);
  stepping->callback([s] { step_for_operations(s->scene, s->quick); });
}

}  // namespace riven::perf
