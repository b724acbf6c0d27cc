#include "kernels/crack_step.hpp"

#include "core/state/junctions.hpp"
#include "core/state/make_state.hpp"
#include "kernels/assign_fields.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/hash_cracks.hpp"
#include "kernels/move_cracks.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Mass over a particle's below which a crack's surface has no body around it.
constexpr double least_surface = 1e-6;

}  // namespace

template <class Real>
void hash_if_due(SimulationOf<Real>& m) {
  auto& s = m.state;
  if (!hash_due(m.space, s.grid.lattice, s.cracks, s.fields))
    return;
  with_shape(m.plan.shape, [&](auto shape) {
    hash_cracks<typename decltype(shape)::type>(m.space, s.grid.lattice, s.cracks, s.fields);
  });
  size_grid(m.plan, s);
}

template <class Real>
void find_fields(SimulationOf<Real>& m) {
  auto& s = m.state;
  with_shape(m.plan.shape, [&](auto shape) {
    determine_fields<typename decltype(shape)::type>(m.space, s.particles, exec::data(std::as_const(s.domains)),
                                                     s.grid.lattice, s.cracks, s.fields,
                                                     exec::data(std::as_const(s.watch.tile_move)));
  });
}

template <class Real>
void load_faces(SimulationOf<Real>& m) {
  with_shape(m.plan.shape, [&](auto shape) {
    apply_tractions<typename decltype(shape)::type>(m.space, m.plan.scatter, m.state, m.point_forces);
  });
}

template <class Real>
void move_with_grid(SimulationOf<Real>& m) {
  auto& s = m.state;
  with_shape(m.plan.shape, [&](auto shape) {
    move_cracks<typename decltype(shape)::type>(
        m.space, s.grid, s.fields,
        {m.scene.crack_motion, m.scene.surface_update, least_surface * s.particle_mass, m.plan.cracks_move_again(),
         m.plan.cohesive},
        s.clock.dt, s.cracks);
  });
  tie_junctions(s.cracks, m.scene.cell);
}

#define RIVEN_TASKS(Real)                         \
  template void hash_if_due(SimulationOf<Real>&); \
  template void find_fields(SimulationOf<Real>&); \
  template void load_faces(SimulationOf<Real>&);  \
  template void move_with_grid(SimulationOf<Real>&);
RIVEN_EACH_REAL(RIVEN_TASKS)
#undef RIVEN_TASKS

}  // namespace RIVEN_SIDE

}  // namespace riven
