#include "kernels/contact_step.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/interface_jumps.hpp"
#include "kernels/link_fields.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

template <class Real>
ContactParticles<Real> particles(const SimulationOf<Real>& m) {
  return {m.plan.shape, m.state.particles, m.state.domains, m.state.specific_area, m.state.watch.drift};
}

template <class Real>
void stage(SimulationOf<Real>& m, ContactStage at, ContactReport& report) {
  contact(m.space, m.state.grid, m.state.fields, m.state.cracks, m.scene.contact_rules, at, m.state.clock.dt,
          particles(m), m.contact_sums, m.impulses, report);
}

}  // namespace

template <class Real>
void sum_for_contact(SimulationOf<Real>& m) {
  const Plan& p = m.plan;
  contact_sums(m.space, {p.contact_volume, p.contact_position, p.contact_area}, particles(m), m.state.grid,
               m.state.fields, m.state.cracks, m.scene.thickness, m.contact_sums);
  m.contact_sums.noise = m.early_impulse() < 1 || (p.transfer == Transfer::fmpm && p.order > 2);
}

template <class Real>
void contact_before_update(SimulationOf<Real>& m) {
  stage(m, ContactStage::before, m.contact_before);
}
template <class Real>
void contact_after_update(SimulationOf<Real>& m) {
  stage(m, ContactStage::after, m.contact_after);
  if (m.plan.contact_area)
    advance_jumps(m.space, m.plan.shape, m.state.domains, m.state.grid, m.state.fields, m.state.clock.dt,
                  m.state.cracks);
}
template <class Real>
void link_term(SimulationOf<Real>& m, bool last) {
  link_fields(m.space, m.state.grid, m.state.fields, m.state.clock.dt, last, m.contact_sums, m.impulses);
}
template <class Real>
void contact_on_high(SimulationOf<Real>& m) {
  stage(m, ContactStage::higher, m.contact_after);
}
template <class Real>
void contact_after_extrapolation(SimulationOf<Real>& m) {
  stage(m, ContactStage::again, m.contact_again);
}

template <class Real>
void watch_contact(SimulationOf<Real>& m) {
  constexpr double cells = 2;       // that a wave runs between two tries
  constexpr long quiet_tries = 10;  // before contact waits again
  ContactWatch& w = m.contact_watch;
  const Clock& c = m.state.clock;
  const long between = std::max(1L, std::lround(cells / m.scene.cfl));
  const auto log = [&](CrackEvent::Kind kind) {
    m.state.events.push_back({.kind = kind, .step = c.step, .time = c.time + c.dt, .crack = w.crack, .place = w.place});
  };
  if (w.on) {
    const auto& touched = m.contact_sums.touched;
    const auto hit = std::find(touched.begin(), touched.end(), std::uint8_t{1});
    if (hit != touched.end()) {
      const NodeCracks& n = m.state.fields.nodes[hit - touched.begin()];
      w.last = c.step;
      w.place = m.state.grid.lattice.position(n.node);
      w.crack = n.crack[0];
      if (!w.closed)
        log(CrackEvent::Kind::close);
      w.closed = true;
    } else if (w.closed && c.step - w.last >= quiet_tries * between) {
      log(CrackEvent::Kind::open);
      w.closed = false;
    }
  }
  w.on = w.closed || (c.step + 1) % between == 0;
}

#define RIVEN_TASKS(Real)                                         \
  template void sum_for_contact(SimulationOf<Real>&);             \
  template void contact_before_update(SimulationOf<Real>&);       \
  template void contact_after_update(SimulationOf<Real>&);        \
  template void link_term(SimulationOf<Real>&, bool);             \
  template void contact_on_high(SimulationOf<Real>&);             \
  template void contact_after_extrapolation(SimulationOf<Real>&); \
  template void watch_contact(SimulationOf<Real>&);
RIVEN_EACH_REAL(RIVEN_TASKS)
#undef RIVEN_TASKS

}  // namespace RIVEN_SIDE

}  // namespace riven
