#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>

#include "cases/commands.hpp"
#include "core/scene/names.hpp"
#include "core/state/make_state.hpp"
#include "io/progress.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/simulation.hpp"
#include "kernels/time_step.hpp"

namespace riven {

namespace {

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
}

template <class Real>
void plan(const Scene& scene) {
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
  fmt::print("effects     {}\n", fmt::join(m.plan.effects(), ", "));
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
  options->add_to(*command);
  command->callback([options] {
    const Scene scene = options->read();
    with_precision(scene.precision, [&](auto real) { plan<typename decltype(real)::type>(scene); });
  });
}

}  // namespace riven
