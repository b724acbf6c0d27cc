// Faces that press on each other and what they keep together in the stages without forces.
//
// A field moves as the mean position of its particles does, some 0.4 cells off the face. In a solid that goes on across
// shut faces the velocities of a node's two fields so differ by
//   w = v_above - v_below = -s (n.grad) v,   s = n.(x_below - x_above),   n from above to below,
// with x the mean positions: where pressed solid expands they part although the faces do not. The momentum update finds
// that out, by the forces. In the other stages nothing tells it from faces that open, and to let go there strains the
// cells along the crack by their full share under a rising pressure and by 0.6 of it under a falling one: contact makes
// energy, 1 to 12 % of that of a wave that passes. So there faces that pressed on each other in the last update lose of
// their relative velocity what goes along with w, for no more impulse than they pressed with; along the crack, too, if
// their law is to stick or friction has long held them (friction_around.hpp):
//   impulse = m (u.d) d, u.d brought within [0, w.d]      along d = n, where faces part, and d = t, where they stick
// (across, those that stick lose all of it, see below).
// The slope of v is that between the nodes on either side of the crack,
//   (n.grad) v = sum_axes n_axis (v(x + h e_axis) - v(x - h e_axis)) / 2h,
// each the velocity of the field on that side of the crack. To keep faces that rub together altogether would not do:
// with FLIP noise takes sliding faces apart for a step at a time, and what is held then is pushed on and on. Those that
// stick stay together across altogether, for no more impulse than they pressed with: as faces that approach each other
// are stopped whatever w is, those that part would be pumped apart. At rest under 10, 4 and 3 MPa the tip of a crack at
// 70 degrees so made 0.8 % of the energy of a plate with FMPM(4) in 1000 us. Nor would it do to keep along the crack
// what friction held but once: where faces slide noise lets some nodes stick for a step, and what they lose there no
// friction has taken. At a node that sees several cracks faces that pressed in the last update stay together across,
// whatever w is, and go on as one field where they stick. Let go there, three shut cracks through one point gained 1 to
// 6 % of the energy of their plate in 3000 steps at rest. With FLIP faces without friction do stay together altogether
// across the crack, for no more impulse than they pressed with. Let go, they part at some nodes behind the front of a
// sharp impact; forces then close them, and the impulse that stops them as they meet does work on what was parting: 5 %
// of the energy where the crack lies between grid lines. So they do with FMPM from the third order on, which keeps more
// of what the grid does not see: in 4000 steps at rest a bar with a shut crack across gained 3.5 % of its energy with
// FMPM(4) and 7 % with FMPM(6).
#pragma once
#include <algorithm>
#include <cmath>

#include "core/exec/parallel.hpp"
#include "core/laws/contact.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/grid.hpp"
#include "kernels/field_motion.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Slopes of v across the crack of a node, from the fields of the nodes beside them.
template <class Real, ContactStage stage>
struct SlopesAcross {
  FieldMotion<Real, stage> motion;
  Lattice lattice;
  const int* node_index;
  const NodeCracks* nodes;
  const std::uint8_t* held;

  /// The field of a node on one side of a crack; -1 where it sees more cracks.
  RIVEN_INLINE long slot_of(int node, int crack, Side side) const {
    const int i = node_index[node];
    if (i < 0 || held[i] == 0)
      return node;
    if (held[i] > 1)
      return -1;
    const NodeCracks& n = nodes[i];
    return n.crack[0] == crack && n.side[0] == side ? long{lattice.nodes()} + n.extra : long{node};
  }

  /// (n.grad) v at a node that sees one crack of normal `normal`, 1/s; 0 where there is little solid beside it.
  RIVEN_INLINE Vec2 at(const NodeCracks& n, Vec2 normal) const {
    constexpr double aside = 0.02;   // of a normal, which is not worth a look
    constexpr double little = 0.01;  // of the mass of the node itself
    const int place[2] = {n.node % lattice.nx, n.node / lattice.nx}, last[2] = {lattice.nx - 1, lattice.ny - 1},
              step[2] = {1, lattice.nx};
    const double least = little * (double(motion.mass[n.node]) + motion.mass[long{lattice.nodes()} + n.extra]),
                 along[2] = {normal.x, normal.y};
    Vec2 slope;
    for (int axis = 0; axis < 2; ++axis) {
      if (std::abs(along[axis]) < aside)
        continue;
      if (place[axis] == 0 || place[axis] == last[axis])
        return {};
      const bool down = along[axis] > 0;  // from above to below
      const long high = slot_of(n.node + step[axis], n.crack[0], down ? Side::below : Side::above);
      const long low = slot_of(n.node - step[axis], n.crack[0], down ? Side::above : Side::below);
      if (high < 0 || low < 0 || !(motion.mass[high] > least) || !(motion.mass[low] > least))
        return {};
      slope += (along[axis] / (2 * lattice.h)) * (motion.velocity_of(high) - motion.velocity_of(low));
    }
    return slope;
  }
};

/// (n.grad) v of all nodes that see one crack and whose faces pressed; 0 for others. Asked for before any impulse of
/// the stage.
template <class Real, ContactStage stage>
void find_slopes(const exec::Space& space, const FieldMotion<Real, stage>& motion, const Lattice& lattice,
                 const CrackFields& fields, exec::Array<Vec2>& slopes) {
  slopes.renew(fields.nodes.size());
  const SlopesAcross<Real, stage> across{motion, lattice, exec::data(fields.node_index), exec::data(fields.nodes),
                                         exec::data(fields.held)};
  const NodeNormals* normals = exec::data(fields.normals);
  const double* pressed = exec::data(fields.pressed);
  Vec2* out = exec::data(slopes);
  exec::parallel_for(space, "slopes at pressed faces", fields.nodes.size(), [=] RIVEN_KERNEL(long i) {
    const NodeCracks& n = across.nodes[i];
    const bool asks = across.held[i] == 1 && pressed[n.node] > 0;
    out[i] = asks ? across.at(n, normals[i].now[0]) : Vec2{};
  });
}

/// Share of a relative velocity u that goes along with w: u brought within [0, w].
RIVEN_INLINE double along_with(double u, double w) {
  return std::clamp(u, std::min(0., w), std::max(0., w));
}

/// The impulse of a pair that pressed by `pressed` (N s) in the last update, from its own law's, by which it sticks or
/// not; with `whole` nothing is let go across; masses, u and w: components across and along.
RIVEN_INLINE PairImpulse hold(PairImpulse by_law, double pressed, bool sticks, bool whole, Vec2 reduced_mass, Vec2 u,
                              Vec2 w) {
  PairImpulse r = by_law;
  if (u.x < 0)
    r.lambda = std::max(-pressed, reduced_mass.x * (whole ? u.x : along_with(u.x, std::min(0., w.x))));
  if (sticks)
    r.tau = std::clamp(reduced_mass.y * along_with(u.y, w.y), -pressed, pressed);
  return r;
}

}  // namespace RIVEN_SIDE

}  // namespace riven
