#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "io/frames.hpp"
#include "io/particle_stress.hpp"

namespace riven {
namespace {

using Order = std::shared_ptr<const std::vector<int>>;

/// Particle numbers in the order of their ids.
template <class Real>
Order order_by_id(const Particles<Real, 2>& p) {
  std::vector<int> order(static_cast<std::size_t>(p.count()));
  for (int i = 0; i < p.count(); ++i)
    order[static_cast<std::size_t>(p.id[i])] = i;
  return std::make_shared<const std::vector<int>>(std::move(order));
}

template <class T, class... X>
void put(std::vector<T>& out, X... x) {
  (out.push_back(static_cast<T>(x)), ...);
}

/// An array that, when it is made, calls row(i, out) for each particle i in `order` to append `components` numbers.
template <class T, class Row>
PolyArray gather(std::string name, std::string unit, int components, const Order& order, const Row& row) {
  const auto make = [=]() -> PolyValues {
    std::vector<T> out;
    out.reserve(order->size() * static_cast<std::size_t>(components));
    for (const int i : *order)
      row(i, out);
    return out;
  };
  return {std::move(name), components, std::move(unit), std::vector<T>{}, make};
}

}  // namespace

template <class Real>
PolyData particle_poly(const Particles<Real, 2>& p, const Scene& scene) {
  const Order order = order_by_id(p);
  const std::size_t n = order->size();

  const auto stress = std::make_shared<const ParticleStress<Real>>(p, scene);
  const auto body = [&p, &scene](int i) -> const Body& { return scene.bodies[p.body[i]]; };

  PolyData d;
  d.kind = PolyData::Cells::vertices;
  d.connectivity.resize(n);
  d.offsets.resize(n + 1);
  std::iota(d.connectivity.begin(), d.connectivity.end(), std::int64_t{0});
  std::iota(d.offsets.begin(), d.offsets.end(), std::int64_t{0});
  d.points.reserve(3 * n);
  for (const int i : *order)
    d.points.insert(d.points.end(), {p.x[0][i], p.x[1][i], 0.0});

  const auto integers = [&](const char* name, const auto& row) {
    d.point_arrays.push_back(gather<std::int64_t>(name, "", 1, order, row));
  };
  const bool single = scene.output.precision == Precision::as_float;
  const auto reals = [&](const char* name, const char* unit, int components, const auto& row) {
    d.point_arrays.push_back(single ? gather<float>(name, unit, components, order, row)
                                    : gather<double>(name, unit, components, order, row));
  };
  integers("id", [&p](int i, auto& o) { put(o, p.id[i]); });
  integers("body", [&p](int i, auto& o) { put(o, p.body[i]); });
  integers("material", [=](int i, auto& o) { put(o, body(i).material); });
  reals("size", "m", 1, [=, &scene](int i, auto& o) { put(o, scene.cell / body(i).particles_per_cell); });
  reals("velocity", "m/s", 3, [&p](int i, auto& o) { put(o, p.v[0][i], p.v[1][i], 0); });
  if (!p.x0[0].empty())
    reals("displacement", "m", 3, [&p](int i, auto& o) { put(o, p.x[0][i] - p.x0[0][i], p.x[1][i] - p.x0[1][i], 0); });
  reals("stress", "Pa", 6, [=](int i, auto& o) {
    const CauchyStress s = stress->cauchy(i);
    put(o, s.xx, s.yy, s.zz, s.xy, 0, 0);
  });
  reals("von_mises", "Pa", 1, [=](int i, auto& o) { put(o, von_mises(stress->cauchy(i))); });
  reals("J", "", 1, [=](int i, auto& o) { put(o, stress->volume_ratio(i)); });
  if (!p.F[0].empty())
    reals("deformation_gradient", "", 4, [&p](int i, auto& o) { put(o, p.F[0][i], p.F[1][i], p.F[2][i], p.F[3][i]); });
  const auto& extra = scene.output.fields;
  if (std::find(extra.begin(), extra.end(), "fringe") != extra.end())
    reals("fringe", "", 1, [=, &scene](int i, auto& o) {
      const CauchyStress s = stress->cauchy(i);
      put(o, std::cos(scene.output.fringe_constant * std::hypot(s.xx - s.yy, 2 * s.xy)));
    });
  return d;
}

#define RIVEN_PARTICLE_POLY(Real) template PolyData particle_poly(const Particles<Real, 2>&, const Scene&);
RIVEN_EACH_REAL(RIVEN_PARTICLE_POLY)
#undef RIVEN_PARTICLE_POLY

}  // namespace riven
