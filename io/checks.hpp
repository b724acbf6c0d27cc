// What the checks of a scene share; check_scene.hpp is for those who call them.
#pragma once
#include <fmt/format.h>
#include <unistd.h>

#include <string>

#include "core/error.hpp"
#include "core/scene/scene.hpp"
#include "io/check_scene.hpp"
#include "io/format_length.hpp"

namespace riven::checks {

constexpr double on_line = 1e-6;  ///< of a cell: as near to a grid line as decimal input gets

/// Fails as bad input at the place of `key` or of a named part ("crack left").
[[noreturn]] inline void refuse(const Scene& s, const std::string& key, std::string what, std::string value,
                                std::string limit, std::string hint = {}) {
  fail({Exit::bad_input, std::move(what), place(s, key), std::move(value), std::move(limit), std::move(hint)});
}

inline std::string text(Vec2 p) {
  return format_place(p);
}
inline std::string text(const Rectangle& r) {
  return text(r.lower) + " to " + text(r.upper);
}

inline bool overlap(const Rectangle& a, const Rectangle& b) {
  return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y;
}

/// Memory of this machine, bytes.
inline double memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Of a crack as it is written, m.
double length(const CrackLine& c);
/// Where the velocity of a grip takes it from where it is at first, over the run, m.
Rectangle travel(const Scene& s, const Grip& g);

/// Bodies and grips: in the grid, on the solid side of symmetry planes, large enough, and each in a place of its own.
void check_solids(const Scene& s);
/// Cracks and contact.
void check_cracks(const Scene& s);

}  // namespace riven::checks
