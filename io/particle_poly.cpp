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
  using Reals = std::vector<double>;
  using Integers = std::vector<std::int64_t>;
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

  auto& a = d.point_arrays;
  a.push_back(gather<std::int64_t>("id", "", 1, order, [&p](int i, Integers& o) { o.push_back(p.id[i]); }));
  a.push_back(gather<std::int64_t>("body", "", 1, order, [&p](int i, Integers& o) { o.push_back(p.body[i]); }));
  a.push_back(
      gather<std::int64_t>("material", "", 1, order, [=](int i, Integers& o) { o.push_back(body(i).material); }));
  a.push_back(gather<double>("size", "m", 1, order,
                             [=, &scene](int i, Reals& o) { o.push_back(scene.cell / body(i).particles_per_cell); }));
  a.push_back(gather<double>("velocity", "m/s", 3, order, [&p](int i, Reals& o) {
    o.insert(o.end(), {double(p.v[0][i]), double(p.v[1][i]), 0.0});
  }));
  if (!p.x0[0].empty())
    a.push_back(gather<double>("displacement", "m", 3, order, [&p](int i, Reals& o) {
      o.insert(o.end(), {p.x[0][i] - p.x0[0][i], p.x[1][i] - p.x0[1][i], 0.0});
    }));
  a.push_back(gather<double>("stress", "Pa", 6, order, [=](int i, Reals& o) {
    const CauchyStress s = stress->cauchy(i);
    o.insert(o.end(), {s.xx, s.yy, s.zz, s.xy, 0.0, 0.0});
  }));
  a.push_back(
      gather<double>("von_mises", "Pa", 1, order, [=](int i, Reals& o) { o.push_back(von_mises(stress->cauchy(i))); }));
  a.push_back(gather<double>("J", "", 1, order, [=](int i, Reals& o) { o.push_back(stress->volume_ratio(i)); }));
  if (!p.F[0].empty())
    a.push_back(gather<double>("deformation_gradient", "", 4, order, [&p](int i, Reals& o) {
      o.insert(o.end(), {p.F[0][i], p.F[1][i], p.F[2][i], p.F[3][i]});
    }));
  const auto& extra = scene.output.fields;
  if (std::find(extra.begin(), extra.end(), "fringe") != extra.end())
    a.push_back(gather<double>("fringe", "", 1, order, [=, &scene](int i, Reals& o) {
      const CauchyStress s = stress->cauchy(i);
      o.push_back(std::cos(scene.output.fringe_constant * std::hypot(s.xx - s.yy, 2 * s.xy)));
    }));
  return d;
}

#define RIVEN_PARTICLE_POLY(Real) template PolyData particle_poly(const Particles<Real, 2>&, const Scene&);
RIVEN_EACH_REAL(RIVEN_PARTICLE_POLY)
#undef RIVEN_PARTICLE_POLY

}  // namespace riven
