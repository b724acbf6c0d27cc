// Points added at the ends of cracks, up to other cracks.
#pragma once
#include <optional>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/state/cracks.hpp"

namespace riven {

/// Adds a point beyond an end of a crack and returns its number; points behind it move up by one. Its surfaces start
/// together on the plane, with the mean velocity of those at the end before. `plane0`: where that point of the material
/// was at first.
int extend_crack(Cracks& cracks, int crack, bool last, Vec2 plane, Vec2 plane0);

/// The segment at an end of a crack lies outside of the solid, and bears neither tractions nor an interface.
void end_bears_nothing(Cracks& cracks, int crack, bool last);

/// What a crack runs into.
struct Obstacle {
  Junction on;
  Vec2 place;           ///< m
  double distance = 0;  ///< m, along the way of the crack
  bool end = false;     ///< it is an end of the crack that was hit; which one tells `end_last`
  bool end_last = false;
};

/// Do other cracks end on this one? Not where its faces never part.
bool stops_growth(const Cracks& cracks, int crack);

/// The least rectangle around a crack.
Rectangle box_of(const Cracks& cracks, int crack);

/// The first crack in the way of the end of one that goes straight on for `reach` (m) along the unit vector `way`: one
/// that it crosses, or one whose end lies within `beside` of the way. The crack itself counts, too, but for the segment
/// at the end; others that stop none do not. `boxes`: around each crack, where they are known; cracks that lie
/// elsewhere are not looked at.
std::optional<Obstacle> first_obstacle(const Cracks& cracks, int crack, bool last, Vec2 way, double reach,
                                       double beside, const std::vector<Rectangle>& boxes = {});

/// Extends a crack up to an obstacle and ties its end to it.
void join_crack(Cracks& cracks, const Obstacle& obstacle, Vec2 plane0, double h);

}  // namespace riven
