// Where the scene's bodies are about the cracks, as they lie at first.
#pragma once
#include "core/scene/scene.hpp"
#include "core/state/cracks.hpp"

namespace riven {

/// Fills Cracks::density where the scene's bodies differ in density. Of points with no body on a
/// side: that of the nearest point along the crack that has one; 0 where none has.
void lay_densities(const Scene& scene, Cracks& cracks);

/// The same of the point that has been added at an end of a crack.
void lay_density_at_end(const Scene& scene, int crack, bool last, Cracks& cracks);

/// Does point k of a crack lie in a body, along the border of one or across a gap between two, as these lie at first?
bool has_solid_beside(const Scene& scene, const Cracks& cracks, int k);

/// Fills Cracks::in_solid if some crack has an interface law: what of it lies outside of the bodies bears nothing.
void lay_in_solid(const Scene& scene, Cracks& cracks);

}  // namespace riven
