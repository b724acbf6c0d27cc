// Cells that a scene could have in place of its own.
#pragma once
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace riven::study {

struct Rung {
  double cell = 0;               ///< m
  std::vector<std::string> set;  ///< the cell, and the grid's corners where they must move
  double work = 0;               ///< particles times steps, about
};

/// Cells from eight times the scene's down to an eighth of it, large ones first, with which rectangular bodies and
/// grips keep their edges: on the lattice of particles, else they would lose or gain part of one. The grid is moved and
/// enlarged by less than a cell for it. Empty where nothing fits, not even the scene's own cell.
std::vector<Rung> rungs(const Scene& scene);

/// About how many steps times particles a scene takes. Throws Error as make_plan does.
double work_of(const Scene& scene);

}  // namespace riven::study
