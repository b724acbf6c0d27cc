// The part of apply_tractions.hpp that is done on the host, where the laws of the cracks are: forces on the faces, and
// what became of them.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/cracks.hpp"
#include "core/state/ledger.hpp"

namespace riven {

/// On the upper surface of each point, N, with the pressures of `time`.
exec::Array<Vec2> face_forces(const exec::Space&, double time, Cracks&);

/// Books the work that pressures did in a step of dt by `power`, W of each point, and lets damage follow the openings.
void book_tractions(const exec::Array<double>& power, double dt, Cracks&, Energy&);

}  // namespace riven
