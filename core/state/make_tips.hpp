// Which ends of a scene's cracks are tips.
#pragma once
#include <vector>

#include "core/scene/scene.hpp"
#include "core/state/tips.hpp"

namespace riven {

/// The body that holds a point at the start, index into Scene::bodies, or -1.
int body_at(const Scene& scene, Vec2 x);

/// A tip on the border of two bodies belongs to the weaker one: that of the lesser toughness, of the lesser stiffness
/// where this is the same.
bool weaker(const Scene& scene, int body, int than);

/// Parts of a particle up to which a tip is on a border.
inline constexpr double border_width = 0.1;

/// Nearer than this (m) to another crack, the end of a crack in this body belongs to a junction.
double junction_reach(const Scene& scene, int body);

/// What an end of a crack is: outside of all bodies; a mouth, in a body but with part of the circle around it of half a
/// particle outside of all; in a junction, as near to another crack or to another part of its own; or else a tip.
enum class CrackEnd { outside, mouth, junction, tip };
CrackEnd end_of(const Scene& scene, size_t crack, bool last);

/// Both ends of every crack that are tips.
std::vector<Tip> make_tips(const Scene& scene);

/// The rule by which a crack grows: its own, else the scene's; null if it does not grow.
const GrowthRule* growth_rule(const Scene& scene, int crack);

/// That by which a tip grows, whose crack must: with the toughness of its material where the rule itself has none.
GrowthRule growth_rule_at(const Scene& scene, const Tip& tip);

}  // namespace riven
