#include "kernels/contact_step.hpp"

#include "kernels/interface_jumps.hpp"

namespace riven {

namespace {

template <class Real>
ContactParticles<Real> particles(const SimulationOf<Real>& m) {
  return {m.plan.shape, m.state.particles, m.state.domains, m.state.specific_area, m.state.watch.drift};
}

/// One stage; `reaches_particles` is the part of its change in energy that the particles take over.
template <class Real>
void stage(SimulationOf<Real>& m, ContactStage at, ContactReport& report, double reaches_particles) {
  ContactReport now;
  contact(m.space, m.state.grid, m.state.fields, m.state.cracks, m.scene.contact_rules, at, m.state.clock.dt,
          particles(m), m.contact_sums, now);
  m.state.ledger.energy.contact -= reaches_particles * now.work;
  report += now;
}

}  // namespace

template <class Real>
void sum_for_contact(SimulationOf<Real>& m) {
  const Plan& p = m.plan;
  contact_sums(m.space, {p.contact_volume, p.contact_position, p.contact_area}, particles(m), m.state.grid,
               m.state.fields, m.state.cracks, m.scene.thickness, m.contact_sums);
}

template <class Real>
void contact_before_update(SimulationOf<Real>& m) {
  stage(m, ContactStage::before, m.contact_before, m.early_impulse());
}
template <class Real>
void contact_after_update(SimulationOf<Real>& m) {
  stage(m, ContactStage::after, m.contact_after, 1);
  if (m.plan.contact_area)
    advance_jumps(m.space, m.plan.shape, m.state.domains, m.state.grid, m.state.fields, m.state.clock.dt,
                  m.state.cracks);
}
template <class Real>
void contact_on_high(SimulationOf<Real>& m) {
  stage(m, ContactStage::higher, m.contact_after, 1);
}
template <class Real>
void contact_after_extrapolation(SimulationOf<Real>& m) {
  stage(m, ContactStage::again, m.contact_again, 0);
}

#define RIVEN_TASKS(Real)                                   \
  template void sum_for_contact(SimulationOf<Real>&);       \
  template void contact_before_update(SimulationOf<Real>&); \
  template void contact_after_update(SimulationOf<Real>&);  \
  template void contact_on_high(SimulationOf<Real>&);       \
  template void contact_after_extrapolation(SimulationOf<Real>&);
RIVEN_TASKS(double)
RIVEN_TASKS(float)
#undef RIVEN_TASKS

}  // namespace riven
