// What regions and bodies cover.
#pragma once
#include "core/scene/scene.hpp"

namespace riven {

/// m^2.
double area_of(const Region& region);
/// Without its holes, which lie within it, m^2.
double area_of(const Body& body);

}  // namespace riven
