// Moves the points of cracks by what the grid says of their surfaces: the part of move_cracks.hpp that is done on the
// host.
#pragma once
#include "core/exec/space.hpp"
#include "core/scene/scene.hpp"
#include "core/state/cracks.hpp"
#include "kernels/surface_velocity.hpp"

namespace riven {

struct CrackRules {
  CrackMotion motion = CrackMotion::surfaces;
  SurfaceUpdate update = SurfaceUpdate::xpic;
  double least_mass = 0;  ///< kg; a surface that finds less of it finds nothing
  bool again = false;     ///< by the motion of Grid::again (Plan::cracks_move_again)
  bool cohesive = false;  ///< some faces pull by how far they have opened
};

/// What the grid says of crack points; mass 0 where that is nothing.
struct FoundMotions {
  exec::Array<PointMotion> surfaces;  ///< [2 points] of the upper and the lower surface of each
  exec::Array<PointMotion> all;       ///< [points] of all fields (motion with the centre of mass), or empty

  /// Of the upper (0) or the lower surface of point k.
  const PointMotion& surface(long k, int side) const { return surfaces[2 * k + side]; }
  PointMotion of_all(long k) const { return all.empty() ? PointMotion{} : all[k]; }
};

void move_points(const exec::Space& space, const FoundMotions& found, const CrackRules& rules, double dt,
                 Cracks& cracks);

}  // namespace riven
