// Which ends of a scene's cracks are tips.
#pragma once
#include <vector>

#include "core/scene/scene.hpp"
#include "core/state/tips.hpp"

namespace riven {

/// The body that holds a point at the start, index into Scene::bodies, or -1.
int body_at(const Scene& scene, Vec2 x);

/// Nearer than this (m) to another crack, the end of a crack in this body belongs to a junction.
double junction_reach(const Scene& scene, int body);

/// Both ends of every crack that lie inside a body: in no hole, and no part of the circle around it of half a particle
/// outside of all bodies (there it is a mouth). An end that is as near to another crack, or to another part of its own,
/// belongs to a junction and is no tip.
std::vector<Tip> make_tips(const Scene& scene);

/// The rule by which a crack grows: its own, else the scene's; null if it does not grow.
const GrowthRule* growth_rule(const Scene& scene, int crack);

}  // namespace riven
