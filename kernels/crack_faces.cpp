#include "kernels/crack_faces.hpp"

namespace riven {

void FieldFit::evaluate(Vec2 r, double weight, size_t count, FaceValues& to) const {
  // about the particles' centre; directions in which they do not spread have no slope
  constexpr double ridge = 1e-3;
  const double inv = 1 / area, cx = x * inv, cy = y * inv;
  const double Cxx = xx * inv - cx * cx + ridge, Cxy = xy * inv - cx * cy, Cyy = yy * inv - cy * cy + ridge;
  const double det = Cxx * Cyy - Cxy * Cxy, dx = r.x - cx, dy = r.y - cy;
  const double ax = (Cyy * dx - Cxy * dy) / det, ay = (Cxx * dy - Cxy * dx) / det;
  for (size_t k = 0; k < count; ++k) {
    const double mean = f[k] * inv;
    to[k] += weight * (mean + ax * (fx[k] * inv - cx * mean) + ay * (fy[k] * inv - cy * mean));
  }
}

}  // namespace riven
