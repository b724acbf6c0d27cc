// Small vectors for geometry on the host side and in kernels.
#pragma once
#include <cmath>

#include "core/exec/config.hpp"

namespace riven {

struct Vec2 {
  double x = 0, y = 0;
  RIVEN_INLINE Vec2& operator+=(Vec2 b) { return x += b.x, y += b.y, *this; }
  RIVEN_INLINE Vec2& operator-=(Vec2 b) { return x -= b.x, y -= b.y, *this; }
  RIVEN_INLINE Vec2& operator*=(double s) { return x *= s, y *= s, *this; }
  friend RIVEN_INLINE Vec2 operator+(Vec2 a, Vec2 b) { return a += b; }
  friend RIVEN_INLINE Vec2 operator-(Vec2 a, Vec2 b) { return a -= b; }
  friend RIVEN_INLINE Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
  friend RIVEN_INLINE Vec2 operator*(Vec2 a, double s) { return a *= s; }
  friend RIVEN_INLINE Vec2 operator*(double s, Vec2 a) { return a *= s; }
  friend RIVEN_INLINE bool operator==(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }
};

RIVEN_INLINE double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
/// z component of a x b.
RIVEN_INLINE double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}
RIVEN_INLINE double norm(Vec2 a) {
  return std::sqrt(dot(a, a));
}
/// a turned by +90 degrees.
RIVEN_INLINE Vec2 turned(Vec2 a) {
  return {-a.y, a.x};
}

}  // namespace riven
