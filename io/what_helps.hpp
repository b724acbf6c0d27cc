// What to try against trouble, for the scene at hand.
#pragma once
#include <string>
#include <string_view>

#include "core/scene/scene.hpp"

namespace riven {

/// `advice` lists remedies, separated by "; ": those that are settings of the scene already are left out.
std::string what_helps(std::string_view advice, const Scene& scene);

}  // namespace riven
