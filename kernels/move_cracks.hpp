// Moves the surfaces and the plane of all cracks with the advanced grid (Nairn et al., section 2.1.2).
//
// Velocity and acceleration at a surface point x_s are mass-weighted and renormalised over the nodes that have mass in
// the field v(s,i), with the ordinary functions of the grid N_i, as these points have no domain (eqs. 3-6), and carried
// on to x_s by the gradient around it (surface_velocity.hpp): the acceleration only where a face bears a cohesive law.
// With v before and v~ = v + a dt after the forces, a surface moves by
//   flip   (v + v~) dt / 2                      (second order)
//   xpic   (v + (v~ - v_s) / 2) dt, v_s := v~   (XPIC(1); v_s starts as v)
//   pic    v~ dt                                (first order)
// and the plane by the mean of both surfaces' moves, or with the centre of mass: the same sums over all fields of each
// node, moved as in flip. Across a gap (Cracks::gap) the surfaces stand for the faces of the solids, moves are looked
// up there, and the plane keeps its place between them, so that it lies where they meet. A surface that finds no mass
// moves with the plane; a point where none is found moves as if it were fixed to the nearest point of its crack that
// finds some, so that the part of a crack outside of its body stays in line with it and never cuts it elsewhere.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/grid.hpp"
#include "kernels/move_points.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Grid::q holds [vx vy ax ay], or Grid::again [v w] where the rules go by it, `fields` what determine_fields made in
/// this step. Shape: that of the particles.
template <class Shape, class Real>
void move_cracks(const exec::Space& space, const Grid<Real>& grid, const CrackFields& fields, CrackRules rules,
                 double dt, Cracks& cracks);

}  // namespace RIVEN_SIDE

}  // namespace riven
