// Sorts the particles by tile and, within a tile, by the cell of the nodes they see; stable, so that the order is a
// function of the state alone. Every particle array moves, the ids with it.
#pragma once
#include "core/exec/space.hpp"
#include "core/state/state.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// True when some particle may have drifted further from its sorted cell than the tiles' margin allows, or so far that
/// a sort pays.
template <class Real>
bool sort_due(const Plan&, const State<Real, 2>&);

/// Finds the places of the particles of each id, where loads go by them.
void find_loaded(const exec::Space&, const exec::Array<int>& ids, Loads&);

/// Lists the tiles that hold particles, and those of one colour together: colour = (x parity) + 2 (y parity).
void list_tiles(const Lattice&, Tiles&);

/// Throws Error (unstable) naming a particle that is outside of the grid's walls.
template <class Real>
void sort_particles(const exec::Space&, const Plan&, State<Real, 2>&);

}  // namespace RIVEN_SIDE

}  // namespace riven
