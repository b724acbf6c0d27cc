// The scenes that riven-perf runs: a block without cracks, and plates with cracks beside the same plates without them.
// All of them move from the first step on, so that nothing is measured at rest.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace riven::perf {

/// One scene, and what it is read against.
struct Entrant {
  std::string name;
  Scene scene;
  std::function<Vec2(Vec2)> velocity;  ///< first velocity (m/s) at a place (m), written over the scene's
  std::string without_cracks;          ///< entrant of the group that is the same scene without its cracks; empty: none
};

/// A free square of `cells` x `cells` cells, 4 particles in each: uGIMP, FLIP, USL, neo-Hookean, plane strain. It
/// turns, and stretches and shears in waves as long as its edge; its edges turn at 5 % of the dilatational wave: as
/// fast as in a hard impact, so that particles are sorted again about every 45 steps. `change` makes the variant of the
/// method.
Entrant swirling(const std::string& name, int cells, const std::function<void(Scene&)>& change = {});

/// A scene whose body stretches along y from the first step on, as its grips pull.
Entrant pulled(const std::string& name, const Scene& plate);

/// SENT plate of Nairn and Aimene, "Modeling multiple crack propagation in the material point method by J-integral
/// methods accounting for other cracks intersecting the J contour" (section 3.2) between grips of rigid particles: a
/// horizontal edge crack of 25 mm, and a vertical one of twice 25 mm that crosses it at b/w = 0.3, where the faces
/// would overlap without contact.
Scene sent_plate(double cell);

/// The lower left corner, of `edge` x `edge`, of the shipped plate with 200 cracks, with the cracks that lie in it; its
/// own cells unless said.
Scene many_plate(double edge, double cell = 0.5e-3);

/// The shipped plate with ten cracks, pulled so fast that all of them grow a few hundred steps later, or at another
/// velocity of its ends (m/s).
Scene growing_plate(double cell, double velocity = 20);

/// The shipped plate with 1,000 cracks, of so little toughness that they begin to grow some sixty steps after it is
/// pulled.
Scene thousand_plate();

}  // namespace riven::perf
