// Particles around a place, and what they say of the solid there.
#pragma once
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "core/state/state.hpp"

namespace riven {

/// f(particle) for all particles within `radius` of x.
template <class Real, class F>
void each_particle_near(const State<Real, 2>& s, Vec2 x, double radius, const F& f) {
  const Lattice& l = s.grid.lattice;
  const auto& p = s.particles;
  // since the last sort particles have moved by less than a cell, and were sorted by the cell or the node next to them
  const double reach = radius / l.h + 2;
  const Vec2 X = (x - l.origin) * (1 / l.h);
  const auto tile = [&](double at, int tiles) {
    return std::clamp(static_cast<int>(std::floor(at / Lattice::tile)), 0, tiles - 1);
  };
  for (int j = tile(X.y - reach, l.tiles_y()); j <= tile(X.y + reach, l.tiles_y()); ++j)
    for (int i = tile(X.x - reach, l.tiles_x()); i <= tile(X.x + reach, l.tiles_x()); ++i) {
      const int t = j * l.tiles_x() + i;
      for (int k = p.tiles.start[t]; k < p.tiles.start[t + 1]; ++k) {
        const double dx = p.x[0][k] - x.x, dy = p.x[1][k] - x.y;
        if (dx * dx + dy * dy < radius * radius)
          f(k);
      }
    }
}

/// Whether there is solid ahead of x: some particle in the half disk of two particles' size, and at least a cell, on
/// the side of `way`. In a solid there is always one, even where it is stretched by 40 %; within a cell particles hold
/// together whatever their size, and next to a tip in a soft solid small ones are drawn apart much farther.
template <class Real>
bool solid_ahead(const State<Real, 2>& s, Vec2 x, Vec2 way, double particle) {
  bool found = false;
  each_particle_near(s, x, std::max(2 * particle, s.grid.lattice.h), [&](int k) {
    found |= dot(Vec2{s.particles.x[0][k], s.particles.x[1][k]} - x, way) > 1e-6 * particle;
  });
  return found;
}

/// How far one comes from x along `way`, up to `reach`, before there is solid again: to half a particle before the
/// first particle in a strip of one to either side.
template <class Real>
double way_before_solid(const State<Real, 2>& s, Vec2 x, Vec2 way, double reach, double particle) {
  double nearest = reach + particle;
  each_particle_near(s, x, reach + 2 * particle, [&](int k) {
    const Vec2 r = Vec2{s.particles.x[0][k], s.particles.x[1][k]} - x;
    if (const double on = dot(r, way); on > 1e-6 * particle && std::fabs(cross(way, r)) < particle)
      nearest = std::min(nearest, on);
  });
  return std::max(0.0, nearest - particle);
}

/// The body of the particle nearest to x, or `otherwise` where there is none within `radius`. Of those whose nearest
/// particles are as near, but for `margin`, that which comes before(one, other) the others.
template <class Real, class Before>
int body_near(const State<Real, 2>& s, Vec2 x, double radius, double margin, int otherwise, const Before& before) {
  std::map<int, double> nearest;
  each_particle_near(s, x, radius, [&](int k) {
    const double d = norm(Vec2{s.particles.x[0][k], s.particles.x[1][k]} - x);
    const auto [at, fresh] = nearest.try_emplace(s.particles.body[k], d);
    at->second = std::min(at->second, d);
  });
  double least = radius;
  for (const auto& [body, d] : nearest)
    least = std::min(least, d);
  int best = -1;
  for (const auto& [body, d] : nearest)
    if (d <= least + margin && (best < 0 || before(body, best)))
      best = body;
  return best < 0 ? otherwise : best;
}

/// Where the material that is at x now was at first, by the plane fitted to the particles within a cell of x; x plus
/// `shift` where no particle keeps its first position or too few are near. Summed in the order of their numbers, so
/// that it does not depend on how they are sorted.
template <class Real>
Vec2 first_position(const State<Real, 2>& s, Vec2 x, Vec2 shift) {
  const auto& p = s.particles;
  if (p.x0[0].empty())
    return x + shift;
  std::vector<int> near;
  each_particle_near(s, x, s.grid.lattice.h, [&](int k) { near.push_back(k); });
  std::sort(near.begin(), near.end(), [&](int a, int b) { return p.id[a] < p.id[b]; });
  const double n = static_cast<double>(near.size());
  Vec2 mean, mean0;
  for (const int k : near) {
    mean += Vec2{p.x[0][k], p.x[1][k]} * (1 / n);
    mean0 += Vec2{p.x0[0][k], p.x0[1][k]} * (1 / n);
  }
  double xx = 0, xy = 0, yy = 0;
  Vec2 by_x, by_y;  // sums of first positions times x and y
  for (const int k : near) {
    const Vec2 r = Vec2{p.x[0][k], p.x[1][k]} - mean;
    const Vec2 r0 = Vec2{p.x0[0][k], p.x0[1][k]} - mean0;
    xx += r.x * r.x;
    xy += r.x * r.y;
    yy += r.y * r.y;
    by_x += r.x * r0;
    by_y += r.y * r0;
  }
  const double det = xx * yy - xy * xy;
  if (!(det > 0.01 * (xx + yy) * (xx + yy)))  // too few, or all in line
    return x + shift;
  const Vec2 r = x - mean;
  const Vec2 gx = (yy * by_x - xy * by_y) * (1 / det), gy = (xx * by_y - xy * by_x) * (1 / det);
  return mean0 + r.x * gx + r.y * gy;
}

}  // namespace riven
