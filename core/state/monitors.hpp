// Figures by which a run is judged while it goes on.
#pragma once
#include <array>
#include <limits>

#include "core/math/vec.hpp"
#include "core/scene/scene.hpp"

namespace riven {

inline constexpr Vec2 nowhere{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// One of them: what it was when stock was taken last.
struct Monitor {
  double value = 0;
  double worst = 0;            ///< so far
  Vec2 place = nowhere;        ///< where it was worst, m; of figures that have a place
  long beyond = 0;             ///< how often stock was taken with it beyond its warning limit
  long first = -1;             ///< Clock::step at which it was first
  Vec2 first_place = nowhere;  ///< and where, m; of figures without a place, that of the fastest particle
};

using Monitors = std::array<Monitor, watched_figures>;

inline const Monitor& monitor(const Monitors& m, Watched which) {
  return m[static_cast<size_t>(which)];
}

/// What it means for a figure to be beyond its limit, and what helps.
struct WatchedText {
  const char *what, *unit, *advice;
};

/// In the order of Watched.
inline constexpr WatchedText watched_texts[watched_figures] = {
    {"energy comes or goes, and nothing accounts for it, or contact makes it", "of the largest energy",
     "a smaller solver.cfl; solver.stress_update = \"usavg\"; contact.law = \"ignored\" where faces stay open"},
    {"momentum comes or goes", "of the largest momentum",
     "nothing in a scene should do this: report it, with the scene"},
    {"angular momentum comes or goes", "of the largest",
     "solver.transfer = \"flip\": PIC, XPIC and FMPM wear off how a body spins; smaller cells"},
    {"a particle is compressed far (1 / det F)", "",
     "smaller cells or a smaller solver.cfl; law = \"neo_hookean\" for large strains"},
    {"a particle is stretched far (det F)", "", "growth or a crack where the body tears; smaller cells"},
    {"a particle is stretched far: shape functions do not stretch with it, and a whole body may tear", "",
     "solver.transfer = \"fmpm\" or \"xpic\"; a larger particles_per_cell"},
    {"the faces of a crack overlap", "cells",
     "a contact.law that keeps faces apart; contact.detection = \"displacement\"; a smaller solver.cfl; smaller cells"},
    {"a particle's velocity is far from the grid's", "m/s", "solver.transfer = \"fmpm\" or \"xpic\"; smaller cells"}};

inline constexpr const WatchedText& text_of(Watched which) {
  return watched_texts[static_cast<size_t>(which)];
}

}  // namespace riven
