#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "cases/commands.hpp"
#include "cases/plan_costs.hpp"
#include "core/plan/explain.hpp"
#include "core/plan/predict_memory.hpp"
#include "core/scene/names.hpp"
#include "core/state/make_state.hpp"
#include "io/progress.hpp"
#include "io/require_memory.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/simulation.hpp"
#include "kernels/time_step.hpp"

namespace riven {

namespace {

using Costs = std::map<std::string, double>;

void print_effects(const Scene& scene, const Plan& plan, const std::optional<Costs>& costs) {
  const auto cost = [&](const std::string& effect) {
    const auto found = costs->find(effect);
    return found == costs->end() ? "" : fmt::format("{:+.0f} %", 100 * found->second);
  };
  fmt::print("\neffects ({})\n",
             costs ? "time of a step with each over that without it, measured over the first steps"
                   : "--costs: what each costs, or would; what it does to the answer: riven study with [[leave_out]]");
  for (const EffectNote& e : explain(scene, plan))
    fmt::print("  {:<24} {:<4} {}{}\n", e.name, e.on ? "on" : "-", costs ? fmt::format("{:>7}  ", cost(e.name)) : "",
               e.why);
}

template <class Real>
void print_arrays(const SimulationOf<Real>& m) {
  long total = 0;
  fmt::print("\narrays\n");
  for (const ArrayReport& a : list_arrays(m.state)) {
    fmt::print("  {:<34} {:>12} items {:>10.2f} MiB\n", a.name, a.items, static_cast<double>(a.bytes) / (1 << 20));
    total += a.bytes;
  }
  fmt::print("  {:<34} {:>12}       {:>10.2f} MiB, {:.0f} bytes per particle\n", "in all", "",
             static_cast<double>(total) / (1 << 20),
             static_cast<double>(total) / static_cast<double>(m.state.particles.count()));
  const double working = predict_memory(m.scene, m.plan).working;
  fmt::print("  {:<34} {:>12}       {:>10.2f} MiB, and more where cracks grow\n", "at its peak, as it sorts and writes",
             "", (static_cast<double>(total) + working) / (1 << 20));
}

template <class Real>
void plan(const Scene& scene, const std::optional<Costs>& costs) {
  const exec::Space space(scene.exec, threads_of(scene));
  SimulationOf<Real> m(scene, space);
  const Lattice& l = m.state.grid.lattice;
  choose_time_step(scene, measure_speeds(space, m.plan, m.state), m.state);
  fmt::print("{}\n\n", scene.title);
  fmt::print("particles   {}\n", m.state.particles.count());
  fmt::print("grid        {} x {} cells of {:.6g} m\n", l.wall_upper[0] - l.wall_lower[0],
             l.wall_upper[1] - l.wall_lower[1], l.h);
  fmt::print("method      {}, {} order {}, {}, plane {}, {} scatter\n", name_of(scene.shape), name_of(scene.transfer),
             m.plan.order, name_of(scene.stress_update), name_of(scene.plane), name_of(m.plan.scatter));
  fmt::print("precision   {}\n", name_of(scene.precision));
  fmt::print("time step   {} at first, limited by {}\n", format_time(m.state.clock.dt), m.state.clock.limiter);
  fmt::print("steps       about {:.0f} to {}\n", std::ceil(scene.end_time / m.state.clock.dt),
             format_time(scene.end_time));
  print_effects(scene, m.plan, costs);
  fmt::print("\ntasks of a step\n");
  for (const TaskOf<Real>& t : m.tasks)
    fmt::print("  {:<36} {}\n", t.label, t.effect.empty() ? "" : "[" + t.effect + "]");
  print_arrays(m);
  fmt::print("\ndefaults for what the scene does not say\n");
  for (const std::string& d : scene.defaults)
    fmt::print("  {}\n", d);
}

}  // namespace

void add_plan(CLI::App& app) {
  auto options = std::make_shared<SceneOptions>();
  CLI::App* command = app.add_subcommand("plan", "shows the effects, tasks, arrays and steps that a scene asks for");
  auto ask_costs = std::make_shared<bool>(false);
  options->add_to(*command);
  command->add_flag("--costs", *ask_costs, "run some steps with and without each effect, and show what it costs");
  command->callback([options, ask_costs] {
    const Scene scene = options->read();
    require_memory(scene);
    const std::optional<Costs> costs = *ask_costs ? std::optional(measure_costs(*options)) : std::nullopt;
    with_precision(scene.precision, [&](auto real) { plan<typename decltype(real)::type>(scene, costs); });
  });
}

}  // namespace riven
