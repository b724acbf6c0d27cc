// The part of apply_tractions.hpp that is done on the host, where the laws of the cracks are: forces on the faces, and
// what became of them.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/cracks.hpp"
#include "core/state/ledger.hpp"

namespace riven {

/// What the tractions of a point do to its upper surface.
struct FaceForce {
  static constexpr double whole = -1;
  Vec2 force;             ///< N
  double before = whole;  ///< share of it that acts before the point, or `whole`: all of it acts at the point
};

/// Of each point, with the pressures of `time`. Pressures act between points, where another crack may part the faces;
/// cohesive laws go by the opening of their points, and act where that is.
exec::Array<FaceForce> face_forces(const exec::Space&, double time, Cracks&);

/// Books the work that pressures did in a step of dt by `power`, W of each point, and lets damage follow the openings.
void book_tractions(const exec::Array<double>& power, double dt, Cracks&, Energy&);

}  // namespace riven
