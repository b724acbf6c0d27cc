#include "kernels/simulation.hpp"

#include "core/error.hpp"
#include "core/exec/timers.hpp"
#include "core/state/draw_mouths.hpp"
#include "core/state/make_state.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/make_constraints.hpp"
#include "kernels/make_loads.hpp"
#include "kernels/report_trouble.hpp"
#include "kernels/sort_particles.hpp"
#include "kernels/tally.hpp"
#include "kernels/watch_figures.hpp"

namespace riven {

#if defined(RIVEN_DEVICE)
namespace on_device {
template <class Real>
std::vector<TaskOf<Real>> assemble_step(const Scene&, const Plan&);
template <class Real>
void tally(const exec::Space&, const Plan&, State<Real, 2>&);
}  // namespace on_device
#endif

namespace {

/// The tasks of the side that the space is on.
template <class Real>
std::vector<TaskOf<Real>> tasks_for(const Scene& scene, const Plan& plan, [[maybe_unused]] const exec::Space& space) {
#if defined(RIVEN_DEVICE)
  if (space.on_device())
    return on_device::assemble_step<Real>(scene, plan);
#endif
  return assemble_step<Real>(scene, plan);
}

/// tally() on the side that the space is on.
template <class Real>
void tally_there(const exec::Space& space, const Plan& plan, State<Real, 2>& s) {
#if defined(RIVEN_DEVICE)
  if (space.on_device())
    return on_device::tally(space, plan, s);
#endif
  tally(space, plan, s);
}

}  // namespace

template <class Real>
SimulationOf<Real>::SimulationOf(const Scene& s, const exec::Space& where)
    : scene(s), space(where), plan(make_plan(s)), tasks(tasks_for<Real>(s, plan, where)) {
  if (scene.precision != precision_of<Real>)
    fail({Exit::internal, "the simulation has not the precision of its scene", s.name});
  begin();
}

template <class Real>
void SimulationOf<Real>::begin() {
  state = {};
  contact_sums = {};
  contact_before = contact_after = contact_again = {};
  contact_watch = {};
  impulses = {};
  fracture = {};
  bridges = {};
  point_forces.clear();
  for (Task& t : tasks) {
    t.calls = 0;
    t.seconds = 0;
  }
  make_state(draw_mouths(scene), plan, state);
  if (plan.constraints)
    make_constraints(scene, state);
  if (plan.loads)
    make_loads(scene, state);
  contact_sums.keep_touched = plan.contact && (plan.fracture || plan.contact_waits);
  contact_sums.keep_links = plan.contact && plan.higher_order() && plan.order > 1;
  sort_particles(space, plan, state);
  tally_there(space, plan, state);
  watch_figures(*this);
}

template <class Real>
void SimulationOf<Real>::step() {
  exec::Clock clock(space.on_device());
  const double work_before = state.ledger.energy.external_work;
  for (Task& t : tasks) {
    if (t.due && !t.due(*this))
      continue;
    const exec::Lap timed(clock, t.seconds);
    t.run(*this);
    ++t.calls;
  }
  clock.settle();
  state.watch.step_work = state.ledger.energy.external_work - work_before;
  state.clock.time += state.clock.dt;
  ++state.clock.step;
  check_particles(state);
}

template <class Real>
void SimulationOf<Real>::take_stock() {
  tally_there(space, plan, state);
  watch_figures(*this);
  check_energy(plan, state);
}

template <class Real>
Vec2 SimulationOf<Real>::gravity() const {
  const auto part = [&](int axis) {
    return scene.body_force[axis] ? (*scene.body_force[axis])(state.clock.middle()) : 0.0;
  };
  return {part(0), part(1)};
}
template <class Real>
double SimulationOf<Real>::grid_damping() const {
  return scene.grid_damping ? (*scene.grid_damping)(state.clock.time) : 0;
}
template <class Real>
double SimulationOf<Real>::particle_damping() const {
  return scene.particle_damping ? (*scene.particle_damping)(state.clock.time) : 0;
}
template <class Real>
double SimulationOf<Real>::early_impulse() const {
  return plan.transfer == Transfer::flip ? 0 : plan.transfer == Transfer::pic ? scene.pic_fraction : 1;
}

#define RIVEN_SIMULATION(Real) template class SimulationOf<Real>;
RIVEN_EACH_REAL(RIVEN_SIMULATION)
#undef RIVEN_SIMULATION

}  // namespace riven
