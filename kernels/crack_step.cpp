#include "kernels/crack_step.hpp"

#include "core/state/make_state.hpp"
#include "kernels/assign_fields.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/hash_cracks.hpp"
#include "kernels/move_cracks.hpp"

namespace riven {

void hash_if_due(Simulation& m) {
  auto& s = m.state;
  if (!hash_due(m.space, s.grid.lattice, s.cracks, s.fields))
    return;
  with_shape(m.plan.shape, [&](auto shape) {
    hash_cracks<typename decltype(shape)::type>(m.space, s.grid.lattice, s.cracks, s.fields);
  });
  size_grid(m.plan, s);
}

void find_fields(Simulation& m) {
  auto& s = m.state;
  with_shape(m.plan.shape, [&](auto shape) {
    determine_fields<typename decltype(shape)::type>(m.space, s.particles, s.domains.data(), s.grid.lattice, s.cracks,
                                                     s.fields, s.watch.tile_move.data());
  });
}

void load_faces(Simulation& m) {
  with_shape(m.plan.shape,
             [&](auto shape) { apply_tractions<typename decltype(shape)::type>(m.space, m.state, m.point_forces); });
}

void move_with_grid(Simulation& m) {
  auto& s = m.state;
  with_shape(m.plan.shape, [&](auto shape) {
    move_cracks<typename decltype(shape)::type>(m.space, s.grid, s.fields,
                                                {m.scene.crack_motion, m.scene.surface_update}, s.clock.dt, s.cracks);
  });
}

}  // namespace riven
