// The time step, assembled once from the plan. Order of work: CRAMP (Nairn 2003, appendix) with the velocity
// fields of several cracks at a node (after Nairn and Aimene, section 2.1).
#include <cmath>

#include "core/exec/parallel.hpp"
#include "core/scene/schedule.hpp"
#include "kernels/advance_grid.hpp"
#include "kernels/anchor_cracks.hpp"
#include "kernels/anchor_strains.hpp"
#include "kernels/apply_loads.hpp"
#include "kernels/bridge_step.hpp"
#include "kernels/contact_step.hpp"
#include "kernels/crack_step.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/grid_to_particle.hpp"
#include "kernels/grow_cracks.hpp"
#include "kernels/higher_orders.hpp"
#include "kernels/list_constraints.hpp"
#include "kernels/particle_to_grid.hpp"
#include "kernels/prescribe_velocities.hpp"
#include "kernels/simulation.hpp"
#include "kernels/sort_particles.hpp"
#include "kernels/tally.hpp"
#include "kernels/time_step.hpp"
#include "kernels/update_stress.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Steps between two measurements of the fastest wave and particle, unless particles speed up sooner.
constexpr long speed_interval = 20;

template <class Real>
void set_time_step(SimulationOf<Real>& m) {
  Clock& c = m.state.clock;
  const bool faster = m.state.watch.largest_move > 1.2 * c.measured_speed * c.dt;
  if (c.step % speed_interval == 0 || faster) {
    const Speeds v = measure_speeds(m.space, m.plan, m.state);
    choose_time_step(m.scene, v, m.state);
    c.measured_speed = v.particle + 1e-3 * v.wave;
    c.stable_dt = c.dt;
    c.stable_limiter = c.limiter;
  }
  c.dt = c.stable_dt;
  c.limiter = c.stable_limiter;
  const double left = m.scene.end_time - c.time;
  if (c.dt > left) {
    c.dt = left;
    c.limiter = "end of the run";
  }
}

template <class Real>
void sort_if_due(SimulationOf<Real>& m) {
  if (sort_due(m.plan, m.state))
    sort_particles(m.space, m.plan, m.state);
}

template <class Real>
void book_fields(SimulationOf<Real>& m) {
  const double dt = m.state.clock.dt, damping = m.grid_damping();
  const GridSums sums = grid_sums(m.space, m.state, damping);
  Ledger& l = m.state.ledger;
  const Vec2 g = m.gravity();
  l.energy.external_work += dt * dot(sums.momentum, g);
  l.momentum.impulse += dt * sums.mass * g + sums.damping_impulse;
  l.momentum.turn(dt * cross(sums.moment, g));
  l.momentum.turn(sums.damping_torque);
  l.energy.damping += sums.damping_work;
}

template <class Real>
TransferRule rule(const SimulationOf<Real>& m) {
  return transfer_rule(m.plan, m.scene.pic_fraction, m.particle_damping(), m.state.clock.dt);
}

template <class Real>
void book_impulses(SimulationOf<Real>& m) {
  const ImpulseRule r{m.early_impulse(), m.plan.update, rule(m).high_gradient && m.plan.update == StressUpdate::usl};
  const ImpulseEnergy e = impulse_energy(m.space, m.state.grid, m.state.fields, m.impulses, r, m.state.clock.dt);
  m.state.ledger.energy.contact -= e.work;
  m.state.ledger.energy.transfer += e.early;
}

}  // namespace

template <class Real>
std::vector<TaskOf<Real>> assemble_step(const Scene&, const Plan& p) {
  using Simulation = SimulationOf<Real>;  // that of the tasks
  std::vector<TaskOf<Real>> list;
  const auto add = [&](bool wanted, const char* label, const char* effect, std::function<void(Simulation&)> run) {
    if (wanted)
      list.push_back({label, effect, std::move(run)});
  };
  const auto add_contact = [&](bool wanted, const char* label, const char* effect, void (*run)(Simulation&)) {
    add(p.contact && wanted, label, effect, run);
    if (p.contact_waits && wanted)
      list.back().due = [](const Simulation& m) { return m.contact_watch.on; };
  };
  const bool before = p.stress_before(), again = p.extrapolate_again();
  const bool impulses = p.contact || p.fracture;
  const auto add_impulses = [&](const char* label, std::function<void(Simulation&)> run) {
    add(impulses, label, p.contact ? "contact" : "J", std::move(run));
    if (p.contact_waits && !p.fracture)
      list.back().due = [](const Simulation& m) { return m.contact_watch.on; };
  };
  const bool fields = p.body_force || p.grid_damping;

  add(p.watch_energy, "watch energy", "watched energy", [](Simulation& m) { m.take_stock(); });
  add(true, "time step", "", set_time_step<Real>);
  add(true, "sort particles", "", sort_if_due<Real>);
  add(p.cracks, "hash cracks", "cracks", hash_if_due<Real>);
  add(p.cracks, "determine fields", "cracks", find_fields<Real>);
  add(p.anchors_strains(), "anchor strains", "J", [](Simulation& m) { anchor_strains(m.space, m.plan, m.state); });
  if (p.anchors_strains())
    list.back().due = [](const Simulation& m) { return anchors_due(m.state); };
  add(true, "clear grid", "", [before](Simulation& m) { clear_grid(m.space, m.state, !before); });
  add(true, "particle to grid", "",
      [before](Simulation& m) { particle_to_grid(m.space, m.plan, m.state, !before, m.gravity()); });
  add(p.anchors(), "anchor cracks", "cracks", [](Simulation& m) { anchor_cracks(m.space, m.plan.shape, m.state); });
  if (p.anchors())
    list.back().due = [](const Simulation& m) { return anchors_due(m.state); };
  add_impulses("forget impulses", [](Simulation& m) { clear_impulses(m.state.fields, m.impulses); });
  add_contact(p.needs_contact_sums(), "contact sums", "contact", sum_for_contact<Real>);
  add(p.constraints, "boundary before", "boundary", [](Simulation& m) {
    list_constraints(m.scene, m.plan, m.state);
    if (m.plan.contact)
      mark_prescribed(m.state.constraints, m.state.fields, m.state.grid.slots(), m.early_impulse(), m.contact_sums);
    prescribe_velocities(m.space, m.state, Stage::before, m.early_impulse());
  });
  add_contact(true, "contact before", "contact", contact_before_update<Real>);
  add(p.fracture, "bridge tips before", "J", bridge_before_update<Real>);
  add(before, "velocities", "", [](Simulation& m) { momenta_to_velocities(m.space, m.state); });
  add(before, "stress before, forces", "",
      [](Simulation& m) { update_stress_and_forces(m.space, m.plan, m.state, m.gravity()); });
  add(p.loads, "loads", "loads", [](Simulation& m) { apply_loads(m.space, m.plan, m.state); });
  add(p.tractions, "tractions", "tractions", load_faces<Real>);
  add(true, "advance grid", "", [before](Simulation& m) { advance_grid(m.space, m.state, before, m.grid_damping()); });
  add(p.constraints, "boundary after", "boundary",
      [](Simulation& m) { prescribe_velocities(m.space, m.state, Stage::after); });
  add_contact(true, "contact after", "contact", contact_after_update<Real>);
  add(p.fracture, "bridge tips after", "J", bridge_after_update<Real>);
  add(p.fracture, "J and K", "J", find_j_and_k<Real>);
  add(fields, "body force and damping sums", p.body_force ? "body force" : "grid damping", book_fields<Real>);
  add(p.particle_damping, "particle damping sums", "particle damping",
      [](Simulation& m) { book_particle_damping(m.space, m.plan, m.particle_damping(), m.state); });
  add(p.higher_order() && p.order > 1, "higher orders", "higher orders", [](Simulation& m) {
    higher_orders(m.space, m.plan, m.state, [&](bool last) {
      if (m.plan.contact && (!m.plan.contact_waits || m.contact_watch.on))
        link_term(m, last);
      if (m.plan.fracture)
        bridge_term(m, last);
    });
  });
  add_contact(p.higher_order() && p.order > 1, "contact on higher orders", "higher orders", contact_on_high<Real>);
  add(!again, "grid to particle", "",
      [before](Simulation& m) { grid_to_particle(m.space, m.plan, m.state, rule(m), !before); });
  add(again, "grid to particle, extrapolate again", "", [](Simulation& m) {
    exec::parallel_zero(m.space, "clear grid again", m.state.grid.again);
    grid_to_particle_again(m.space, m.plan, m.state, rule(m));
  });
  add(again && p.constraints, "boundary again", "boundary",
      [](Simulation& m) { prescribe_velocities(m.space, m.state, Stage::again); });
  add_contact(again, "contact again", "contact", contact_after_extrapolation<Real>);
  add(again && p.fracture, "bridge tips again", "J", bridge_after_extrapolation<Real>);
  add(again, "velocities again", "",
      [](Simulation& m) { velocities_again(m.space, m.plan, m.particle_damping(), m.state); });
  add_impulses("energy of impulses", book_impulses<Real>);
  add(again, "stress after, move", "", [](Simulation& m) { update_stress_and_move(m.space, m.plan, m.state); });
  add(p.contact_waits, "watch contact", "contact", watch_contact<Real>);
  add(p.cracks, "move cracks", "cracks", move_with_grid<Real>);
  add(p.tractions, "tractions: work and damage", "tractions",
      [](Simulation& m) { settle_tractions(m.space, m.point_forces, m.plan.extrapolate_again(), m.state); });
  add(p.growth, "grow cracks", "growth", grow_cracks<Real>);
  add(p.loads, "loads: work", "loads", [](Simulation& m) { settle_loads(m.space, m.plan, m.state); });
  add(p.constraints, "boundary: reactions", "boundary", [](Simulation& m) {
    const Clock& c = m.state.clock;
    settle_constraints(m.space, m.plan, m.early_impulse(), m.contact_sums.resisted, m.state);
    if (report_due(m.scene, c.time, c.time + c.dt))
      for (ConstraintOwner& o : m.state.constraints.owners)
        o.mean.take(0.5 * row_interval(m.scene));
  });
  return list;
}

#define RIVEN_STEP(Real) template std::vector<TaskOf<Real>> assemble_step(const Scene&, const Plan&);
RIVEN_EACH_REAL(RIVEN_STEP)
#undef RIVEN_STEP

}  // namespace RIVEN_SIDE

}  // namespace riven
