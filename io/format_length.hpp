// Lengths for people: 12.5 mm, 3 um, 2.4 km.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/math/vec.hpp"

namespace riven {

struct LengthUnit {
  const char* name;
  double metres;
};

/// Millimetres from 10 um to 10 m, and for none; beyond them the unit in which a size is 1 to 1000, where there is one.
inline LengthUnit unit_for(double size) {
  const double s = std::abs(size);
  if (s == 0 || (s >= 10e-6 && s < 10) || !std::isfinite(s))
    return {"mm", 1e-3};
  if (s < 10e-6)
    return s < 1e-6 ? LengthUnit{"nm", 1e-9} : LengthUnit{"um", 1e-6};
  return s < 1e3 ? LengthUnit{"m", 1} : LengthUnit{"km", 1e3};
}

inline std::string format_length(double metres, int digits = 6) {
  const LengthUnit u = unit_for(metres);
  return fmt::format("{:.{}g} {}", metres / u.metres, digits, u.name);
}

/// Both in one unit: "(3, -2) mm".
inline std::string format_place(Vec2 x, int digits = 6) {
  const LengthUnit u = unit_for(std::max(std::abs(x.x), std::abs(x.y)));
  return fmt::format("({:.{}g}, {:.{}g}) {}", x.x / u.metres, digits, x.y / u.metres, digits, u.name);
}

/// "3 x 2 mm".
inline std::string format_size(Vec2 size, int digits = 6) {
  const LengthUnit u = unit_for(std::max(size.x, size.y));
  return fmt::format("{:.{}g} x {:.{}g} {}", size.x / u.metres, digits, size.y / u.metres, digits, u.name);
}

}  // namespace riven
