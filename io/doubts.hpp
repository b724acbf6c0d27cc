// What a scene says that can be simulated as written and yet is seldom meant.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace riven {

struct Doubt {
  std::string place;  ///< file and line, or the part of the scene
  std::string what, hint;
};

/// Cracks too short to open, tips beside another material or the end of the solid, contours too small for J, cohesive
/// zones too short for the cells, bodies and holes that particles do not make up, notches that the grid does not see,
/// bodies faster than their waves or that spin, grips away from all bodies or just past a crack, cracks between bodies
/// that do not lie along their borders, to their ends and alone, tractions on oblique edges and in holes, loads that do
/// not balance where nothing holds, and materials whose density or wave speed no solid has. `s`: a scene that passes
/// check_scene.
std::vector<Doubt> doubts(const Scene& s);
/// Of these, those of narrow gaps within a body.
void doubt_gaps(const Scene& s, std::vector<Doubt>& list);
/// Those of grips.
void doubt_grips(const Scene& s, std::vector<Doubt>& list);
/// Those of cracks between bodies.
void doubt_borders(const Scene& s, std::vector<Doubt>& list);
/// Those of how bodies move.
void doubt_motion(const Scene& s, std::vector<Doubt>& list);
/// And those of loads.
void doubt_loads(const Scene& s, std::vector<Doubt>& list);

/// Prints them to stderr, a note each, and says how many there are.
std::size_t print_doubts(const Scene& s);

}  // namespace riven
