#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/commands.hpp"
#include "core/error.hpp"
#include "core/scene/names.hpp"
#include "io/check_scene.hpp"
#include "io/checkpoint_store.hpp"
#include "io/compare_scenes.hpp"
#include "io/doubts.hpp"
#include "io/duration.hpp"
#include "io/format_length.hpp"
#include "io/progress.hpp"
#include "io/require_memory.hpp"
#include "io/run_scene.hpp"
#include "kernels/dispatch.hpp"

namespace riven {

namespace {

template <class Real>
void print_header(const SimulationOf<Real>& m) {
  fmt::print("{}\n", m.scene.title);
  fmt::print("{} particles in {}, {} on {} thread{}, {} scatter; effects: {}\n", m.state.particles.count(),
             name_of(m.scene.precision), exec::name(m.space.kind()), m.space.threads(),
             m.space.threads() == 1 ? "" : "s", name_of(m.plan.scatter),
             m.plan.effects().empty() ? "none" : fmt::to_string(fmt::join(m.plan.effects(), ", ")));
  if (!m.scene.defaults.empty())
    fmt::print("defaults: {}\n", fmt::join(m.scene.defaults, ", "));
}

void print_tasks(const Summary& s) {
  double total = 0;
  for (const Summary::Task& t : s.tasks)
    total += t.seconds;
  fmt::print("\n{:<38} {:>10} {:>10} {:>7}\n", "task", "seconds", "calls", "share");
  for (const Summary::Task& t : s.tasks)
    fmt::print("{:<38} {:>10.3f} {:>10} {:>6.1f}%\n", t.label, t.seconds, t.calls, 100 * t.seconds / total);
  fmt::print("\n{:<38} {:>10} {:>10} {:>7}\n", "between steps", "seconds", "calls", "of them");
  for (const Summary::Task& t : s.between_steps)
    fmt::print("{:<38} {:>10.3f} {:>10} {:>6.1f}%\n", t.label, t.seconds, t.calls, 100 * t.seconds / total);
}

/// "9 of 10 cracks grew; 2 fragments, with 54.4, 45.6 % of the mass"
void print_growth(const Summary& s) {
  constexpr size_t most = 12;
  const auto grew =
      std::count_if(s.cracks.begin(), s.cracks.end(), [](const Summary::Crack& c) { return c.grown > 0; });
  double mass = 0;
  std::vector<std::string> shares;
  for (const Fragment& f : s.fragments)
    mass += f.mass;
  for (size_t i = 0; i < std::min(most, s.fragments.size()); ++i)
    shares.push_back(fmt::format("{:.3g}", 100 * s.fragments[i].mass / mass));
  fmt::print("{} of {} cracks grew; {} fragment{}, with {}{} % of the mass\n", grew, s.cracks.size(),
             s.fragments.size(), s.fragments.size() == 1 ? "" : "s", fmt::join(shares, ", "),
             s.fragments.size() > most ? ", ..." : "");
}

constexpr size_t most_lines = 20;  // of cracks, and of tips

void print_cracks(const std::vector<Summary::Crack>& cracks) {
  for (size_t i = 0; i < std::min(most_lines, cracks.size()); ++i)
    fmt::print("crack {:<18} opening {}, length {}{}\n", cracks[i].name, format_length(cracks[i].max_opening, 4),
               format_length(cracks[i].length, 4),
               cracks[i].grown > 0 ? ", grown by " + format_length(cracks[i].grown, 4) : "");
  if (cracks.size() > most_lines)
    fmt::print("... and {} more cracks in summary.json\n", cracks.size() - most_lines);
}

/// J and K where they were last found, at the tips that there still are.
void print_tips(const std::vector<Summary::Tip>& tips) {
  size_t found = 0;
  for (const Summary::Tip& t : tips) {
    if (t.contour.empty() || t.state == "closed" || ++found > most_lines)
      continue;
    fmt::print("tip {:<20} J {:.4g} J/m^2, K_I {:.4g}, K_II {:.4g} MPa m^0.5{}\n", t.crack + " " + t.end, t.J,
               1e-6 * t.K_I, 1e-6 * t.K_II, t.speed > 0 ? fmt::format(", running at {:.4g} m/s", t.speed) : "");
  }
  if (found > most_lines)
    fmt::print("... and {} more tips in summary.json\n", found - most_lines);
}

void print_summary(const Summary& s, const std::filesystem::path& folder) {
  fmt::print("\n{} steps to {} in {}: {:.2f} million particle-steps/s\n", s.steps, format_time(s.time),
             format_duration(s.wall_seconds), 1e-6 * s.particle_steps_per_second);
  fmt::print("peak memory {}, {:.0f} bytes per particle\n", format_bytes(s.peak_memory_bytes),
             static_cast<double>(s.peak_memory_bytes) / static_cast<double>(s.particles));
  fmt::print("energy error {:.2e} of the largest energy, momentum error {:.1e}, angular momentum error {:.1e}\n",
             s.energy.relative_error, s.momentum_error, s.angular_momentum_error);
  if (s.energy.transfer != 0)
    fmt::print("the transfer from grid to particles took {:.3g} % of the largest energy\n",
               100 * s.energy.transfer / s.energy.largest);
  if (std::abs(s.energy.anchoring) > 1e-3 * s.energy.largest)
    fmt::print("holding strains to where particles are took {:.3g} % of the largest energy\n",
               100 * s.energy.anchoring / s.energy.largest);
  for (const Summary::Value& p : s.probes)
    fmt::print("{:<24} {:.6g} {}\n", p.name, p.value, p.unit);
  print_cracks(s.cracks);
  print_tips(s.tips);
  if (!s.fragments.empty())
    print_growth(s);
  for (const Summary::Warning& w : s.warnings) {
    fmt::print("warning: {} ({} times{})\n", w.kind, w.count,
               std::isnan(w.first_place.x)
                   ? ""
                   : fmt::format(", first at ({:.4g}, {:.4g}) m", w.first_place.x, w.first_place.y));
    if (!w.advice.empty())
      fmt::print("  try:   {}\n", w.advice);
  }
  for (const Retry& r : s.retries)
    fmt::print("went back from step {} to step {}, to go on with a CFL number of {:.4g}\n", r.step, r.back_to, r.cfl);
  fmt::print("results in {0}; a picture of them: riven picture {0}\n", folder.string());
}

template <class Real>
void print_cost_of_j(const SimulationOf<Real>& m) {
  const auto task =
      std::find_if(m.tasks.begin(), m.tasks.end(), [](const TaskOf<Real>& t) { return t.label == "J and K"; });
  if (task != m.tasks.end() && m.fracture.evaluations > 0)
    fmt::print("{} evaluations of J and K, {} of them crossed by other cracks, {:.2f} us each\n",
               m.fracture.evaluations, m.fracture.crossed,
               1e6 * task->seconds / static_cast<double>(m.fracture.evaluations));
}

struct RunArguments {
  SceneOptions scene;
  std::string folder, restart, wall_limit;
  bool quiet = false, profile = false, overwrite = false;
};

template <class Real>
void run(const RunArguments& o, const Scene& scene, const CheckpointFile* from) {
  RunOptions options{.folder = o.folder, .quiet = o.quiet, .restart = from};
  if (o.folder.empty())
    options.folder = from ? from->path().parent_path() : std::filesystem::path("results") / scene.name;
  if (options.folder.empty())
    options.folder = ".";
  if (!o.wall_limit.empty())
    options.wall_limit = parse_duration(o.wall_limit, "--wall-limit");
  if (!from && !o.overwrite)
    refuse_to_remove_results(options.folder, scene.name);
  const exec::Space space(scene.exec, threads_of(scene));
  SimulationOf<Real> simulation(scene, space);
  if (!o.quiet)
    print_header(simulation);
  const Summary s = run_scene(simulation, options);
  if (o.profile) {
    print_tasks(s);
    print_cost_of_j(simulation);
  }
  if (!o.quiet)
    print_summary(s, options.folder);
}

/// The scene to run, and where it goes on from.
Scene choose_scene(const SceneOptions& o, const CheckpointFile* from) {
  if (!from) {
    if (o.scene.empty())
      fail({Exit::bad_input, "there is no scene to run", "riven run", "",
            "a scene file, the name of a shipped scene, or --restart", "riven run --help"});
    return o.read();
  }
  Scene scene = o.scene.empty() ? o.with_choices(from->scene(o.set)) : o.read();
  require_same_scene(from->scene(), scene);
  check_scene(scene);
  return scene;
}

}  // namespace

void add_run(CLI::App& app) {
  auto o = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand("run", "runs a scene");
  o->scene.add_to(*command, false);
  command->add_option("-o,--output", o->folder, "folder for the results; results/NAME unless said");
  command->add_option("--restart", o->restart, "go on from a checkpoint, or the newest one in a folder of results");
  command->add_flag("--overwrite", o->overwrite,
                    "begin anew where an interrupted run could go on, or remove the results of another scene");
  command->add_option("--wall-limit", o->wall_limit, "interrupt the run after this time, \"30 min\" or 1:30:00");
  command->add_flag("--quiet", o->quiet, "print nothing but errors");
  command->add_flag("--profile", o->profile, "print the time of each task");
  command->callback([o] {
    std::optional<CheckpointFile> from;
    if (!o->restart.empty())
      from.emplace(find_checkpoint(o->restart));
    const CheckpointFile* restart = from ? &*from : nullptr;
    const Scene scene = choose_scene(o->scene, restart);
    require_memory(scene);
    if (!o->quiet && !restart)
      print_doubts(scene);
    with_precision(scene.precision, [&](auto real) { run<typename decltype(real)::type>(*o, scene, restart); });
  });
}

}  // namespace riven
