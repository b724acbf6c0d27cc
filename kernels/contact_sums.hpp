// What the detection of contact needs to know at each node that holds cracks, besides mass and momentum: per field the
// area in the plane (the nodal volume of two dimensions) and the mean positions of its particles,
//   A_i,j = sum_p A_p S_ip,    m_i,j x_i,j = sum_p m_p S_ip x_p,    m_i,j X_i,j = sum_p m_p S_ip X_p   (X first
//   position)
// (A: J.A. Nairn, CMES 4 (2003), eqs. 8, 9 and 27; positions: J.A. Nairn, CMES 92 (2013) 271-299, who extrapolates
// displacements; the pair of positions stays exact when the body turns), and per crack the length times thickness and
// the opening that belong to the node,
//   A_i = sum_s t L_s S*_is,    A_i opening_i = sum_s t L_s S*_is jump_s
// over the crack's segments s, with the weights of interface_segments.hpp; the areas add up to the crack's where it
// lies in matter. For the jump see interface_jumps.hpp.
//
// Only nodes that a crack passes, and particles in marked tiles, take part. Tiles go colour by colour, each node in
// the order of its particles: the same bits on any number of threads.
#pragma once
#include "core/exec/parallel.hpp"
#include "core/scene/scene.hpp"
#include "core/state/bodies.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "core/state/particles.hpp"

namespace riven {

/// The part of a crack that belongs to a node.
struct ContactArea {
  double area = 0;  ///< m^2
  Vec2 opening;     ///< m, displacement of the lower face minus that of the upper one
};

/// Sums over particles stand in the slots of the grid, and mean something where the node holds cracks.
struct ContactSums {
  exec::Array<double> place;      ///< [4 slots] kg m, current and first positions from the node, times mass: [x y X Y];
                                  ///< empty: not asked for
  exec::Array<double> volume;     ///< [slots] m^2 in the plane; empty: not asked for
  exec::Array<ContactArea> area;  ///< [2 flagged] entry 2 i + k: crack k of CrackFields::nodes[i]; empty: no interface
                                  ///< law
};

/// What to sum.
struct ContactSumsChoice {
  bool volume = false;    ///< detection by volume, and the count of contacts among separated faces
  bool position = false;  ///< detection by displacement
  bool area = false;      ///< an interface law
};

/// Adds up particles and crack segments at the flagged nodes.
/// `domains` [bodies] sizes of particles, `specific_area` [bodies] first area of a body's particles in m^2 per kg
/// (1 / (density thickness)), `thickness` of the plane, m. Needs F or J of the particles for volumes, x0 for positions,
/// the grid's masses for interfaces.
template <class Real>
void contact_sums(const exec::Space& space, ShapeFunction shape, const ContactSumsChoice& choice,
                  const Particles<Real, 2>& particles, const exec::Array<DomainSetting<Real, 2>>& domains,
                  const exec::Array<double>& specific_area, const Grid<Real>& grid, const CrackFields& fields,
                  const Cracks& cracks, double thickness, ContactSums& sums);

}  // namespace riven
