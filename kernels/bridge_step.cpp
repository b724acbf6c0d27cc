#include "kernels/bridge_step.hpp"

#include "kernels/bridge_tips.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

template <class Real>
void bridge_before_update(SimulationOf<Real>& m) {
  list_bridges(m.space, m.state, m.bridges);
  bridge_tips(m.space, m.state, m.bridges, ContactStage::before, m.impulses);
}
template <class Real>
void bridge_after_update(SimulationOf<Real>& m) {
  bridge_tips(m.space, m.state, m.bridges, ContactStage::after, m.impulses);
}
template <class Real>
void bridge_term(SimulationOf<Real>& m, bool last) {
  bridge_tips(m.space, m.state, m.bridges, ContactStage::term, m.impulses, last);
}
template <class Real>
void bridge_after_extrapolation(SimulationOf<Real>& m) {
  bridge_tips(m.space, m.state, m.bridges, ContactStage::again, m.impulses);
}

#define RIVEN_TASKS(Real)                                  \
  template void bridge_before_update(SimulationOf<Real>&); \
  template void bridge_after_update(SimulationOf<Real>&);  \
  template void bridge_term(SimulationOf<Real>&, bool);    \
  template void bridge_after_extrapolation(SimulationOf<Real>&);
RIVEN_EACH_REAL(RIVEN_TASKS)
#undef RIVEN_TASKS

}  // namespace RIVEN_SIDE

}  // namespace riven
