// What the detection of contact needs to know at each node that holds cracks, besides mass and momentum: per field the
// area in the plane (the nodal volume of two dimensions) and the mean positions of its particles,
//   A_i,j = sum_p A_p S_ip,    m_i,j x_i,j = sum_p m_p S_ip x_p,    m_i,j X_i,j = sum_p m_p S_ip X_p   (X first
//   position, with first gaps closed)
// (A: J.A. Nairn, CMES 4 (2003), eqs. 8, 9 and 27; positions: J.A. Nairn, CMES 92 (2013) 271-299, who extrapolates
// displacements; the pair of positions stays exact when the body turns), and per crack the length times thickness and
// the opening that belong to the node,
//   A_i = sum_s t L_s S*_is,    A_i opening_i = sum_s t L_s S*_is jump_s
// over the crack's segments s, with the weights of interface_segments.hpp; the areas add up to the crack's where it
// lies in matter. For the jump see interface_jumps.hpp.
//
// Areas of cracks are summed at once, the sums over particles node by node, when contact first asks a node for them.
#pragma once
#include "core/exec/parallel.hpp"
#include "core/scene/scene.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "kernels/field_links.hpp"
#include "kernels/node_sums.hpp"

namespace riven {

/// The part of a crack that belongs to a node.
struct ContactArea {
  double area = 0;  ///< m^2
  Vec2 opening;     ///< m, displacement of the lower face minus that of the upper one
};

/// Sums over particles stand in the slots of the grid, and mean something where they are known.
struct ContactSums {
  exec::Array<double> place;   ///< [4 slots] kg m, current and first positions from the node, times mass: [x y X Y];
                               ///< empty: not asked for
  exec::Array<double> volume;  ///< [slots] m^2 in the plane; empty: not asked for
  exec::Array<std::uint8_t> known;    ///< [flagged] 1 where those of the node have been summed in this step
  exec::Array<ContactArea> area;      ///< [entries_of()] empty: no interface law
  exec::Array<std::uint8_t> touched;  ///< [flagged] 1 where faces acted on each other in the momentum update, by more
                                      ///< than rounding; empty: not asked for
  bool keep_touched = false;          ///< asks for it
  exec::Array<FieldLinks> links;      ///< [flagged] of fields that touched in the momentum update; empty: not asked for
  bool keep_links = false;            ///< asks for it
  exec::Array<std::uint8_t> prescribed;  ///< [slots] bit 0: x, bit 1: y of a field's motion is prescribed; empty:
                                         ///< nowhere beside cracks
  exec::Array<Vec2> resisted;            ///< [slots] N s, what such fields resisted in this step of what contact gave
                                         ///< them, as far as particles of the others felt it; holds for those alone
  bool noise = true;                     ///< particles keep much that the grid does not see of their velocities
  double early_impulse = 0;              ///< how much of an impulse before the update particles feel (0: FLIP, 1: PIC)
  exec::Array<Vec2> slopes;              ///< [flagged] 1/s, of one stage; see pressed_faces.hpp
  exec::Array<Vec2> asked;               ///< [entries_of()] N s, of one update; see friction_around.hpp
};

/// Room for what holds for each crack of each node.
inline long entries_of(const CrackFields& fields) {
  return 2 * fields.nodes.size() + fields.third_normals.size();
}

/// Where crack k of n = CrackFields::nodes[i] stands in it.
RIVEN_INLINE long entry_of(const NodeCracks& n, long i, int k, long flagged) {
  return k < 2 ? 2 * i + k : 2 * flagged + n.third;
}

/// What to sum.
struct ContactSumsChoice {
  bool volume = false;    ///< detection by volume, and the count of contacts among separated faces
  bool position = false;  ///< detection by displacement
  bool area = false;      ///< an interface law
};

inline namespace RIVEN_SIDE {

/// Forgets the sums over particles of the last step, and adds up crack segments at the flagged nodes. `thickness` of
/// the plane, m. Needs F or J of the particles for volumes, x0 for positions, Tiles::cell_start for both, and the
/// grid's masses for interfaces.
template <class Real>
void contact_sums(const exec::Space& space, const ContactSumsChoice& choice, const ContactParticles<Real>& of,
                  const Grid<Real>& grid, const CrackFields& fields, const Cracks& cracks, double thickness,
                  ContactSums& sums);

/// The way to the sums over particles that were asked for, of which none is read before it is written.
template <class Real>
NodeSums<Real> node_sums(const ContactParticles<Real>& of, const Lattice& lattice, const CrackFields& fields,
                         ContactSums& sums) {
  const Particles<Real, 2>& p = of.particles;
  const bool asked = !sums.place.empty() || !sums.volume.empty();
  const auto first = [&](int axis) -> const exec::Array<double>& {
    return p.closed[axis].empty() ? p.x0[axis] : p.closed[axis];
  };
  return {of.shape,
          lattice,
          {exec::data(p.x[0]),
           exec::data(p.x[1]),
           lattice.origin.x,
           lattice.origin.y,
           1 / lattice.h,
           {exec::data(of.domains), exec::data(p.body), of.domains.size() == 1}},
          exec::data(first(0)),
          exec::data(first(1)),
          exec::data(p.mass),
          p.J.empty() ? nullptr : exec::data(p.J),
          {exec::data(p.F[0]), exec::data(p.F[1]), exec::data(p.F[2]), exec::data(p.F[3])},
          exec::data(p.body),
          exec::data(of.specific_area),
          exec::data(p.tiles.cell_start),
          exec::data(fields.fields),
          cells_seen(of.shape, of.domains) + of.drift / lattice.h + 1e-6,
          sums.place.empty() ? nullptr : exec::data_to_fill(sums.place),
          sums.volume.empty() ? nullptr : exec::data_to_fill(sums.volume),
          asked ? exec::data(sums.known) : nullptr};
}

}  // namespace RIVEN_SIDE

}  // namespace riven
