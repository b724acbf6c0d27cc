#include "kernels/make_derived.hpp"

#include "core/state/make_state.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/hash_cracks.hpp"
#include "kernels/sort_particles.hpp"

namespace riven {

template <class Real>
void make_derived(SimulationOf<Real>& m) {
  State<Real, 2>& s = m.state;
  list_tiles(s.grid.lattice, s.particles.tiles);
  find_loaded(m.space, s.particles.id, s.loads);
  if (m.plan.cracks && s.fields.hashed.size() == s.cracks.points())  // else they are to be hashed first
    with_shape(m.plan.shape, [&](auto shape) {
      list_segments<typename decltype(shape)::type>(m.space, s.grid.lattice, s.cracks, s.fields);
    });
  size_grid(m.plan, s);
  s.clock.limiter = s.clock.stable_limiter = "as before the restart";
}

#define RIVEN_MAKE_DERIVED(Real) template void make_derived(SimulationOf<Real>&);
RIVEN_EACH_REAL(RIVEN_MAKE_DERIVED)
#undef RIVEN_MAKE_DERIVED

}  // namespace riven
