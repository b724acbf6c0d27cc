#include "kernels/contact_step.hpp"

#include "kernels/interface_jumps.hpp"

namespace riven {

namespace {

ContactParticles<double> particles(const Simulation& m) {
  return {m.plan.shape, m.state.particles, m.state.domains, m.state.specific_area, m.state.watch.drift};
}

/// One stage; `reaches_particles` is the part of its change in energy that the particles take over.
void stage(Simulation& m, ContactStage at, ContactReport& report, double reaches_particles) {
  ContactReport now;
  contact(m.space, m.state.grid, m.state.fields, m.state.cracks, m.scene.contact_rules, at, m.state.clock.dt,
          particles(m), m.contact_sums, now);
  m.state.ledger.energy.contact -= reaches_particles * now.work;
  report += now;
}

}  // namespace

void sum_for_contact(Simulation& m) {
  const Plan& p = m.plan;
  contact_sums(m.space, {p.contact_volume, p.contact_position, p.contact_area}, particles(m), m.state.grid,
               m.state.fields, m.state.cracks, m.scene.thickness, m.contact_sums);
}

void contact_before_update(Simulation& m) {
  stage(m, ContactStage::before, m.contact_before, m.early_impulse());
}
void contact_after_update(Simulation& m) {
  stage(m, ContactStage::after, m.contact_after, 1);
  if (m.plan.contact_area)
    advance_jumps(m.space, m.plan.shape, m.state.domains, m.state.grid, m.state.fields, m.state.clock.dt,
                  m.state.cracks);
}
void contact_on_high(Simulation& m) {
  stage(m, ContactStage::higher, m.contact_after, 1);
}
void contact_after_extrapolation(Simulation& m) {
  stage(m, ContactStage::again, m.contact_again, 0);
}

}  // namespace riven
