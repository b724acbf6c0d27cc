// Fills a region with particle positions: a regular lattice of points in the grid's cells.
#pragma once
#include <vector>

#include "core/scene/scene.hpp"
#include "core/state/grid.hpp"

namespace riven {

/// Points at the centres of per_cell x per_cell equal parts of each grid cell, where they lie in the region and in no
/// hole; row by row from below. Of the points on straight edges a region has those at its left and below.
std::vector<Vec2> lay_points(const Region& region, const std::vector<Region>& holes, const Lattice& lattice,
                             int per_cell);

/// Between neighbouring particles of the finest body, m.
double least_particle_distance(const Scene& scene);

}  // namespace riven
