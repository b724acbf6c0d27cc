#include "kernels/body_forces.hpp"

#include "core/fracture/tip_places.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/simulation.hpp"

namespace riven {

template <class Real>
BodyForces body_forces_near(const SimulationOf<Real>& m, const std::vector<Vec2>& tips, double reach) {
  BodyForces forces{m.gravity(), {}, {}};
  const Loads& loads = m.state.loads;
  const Particles<Real, 2>& p = m.state.particles;
  const long count = loads.loaded.size();
  if (count == 0)
    return forces;
  const TipPlaces places(tips);
  forces.loaded.resize(tips.size());
  const int *loaded = loads.loaded.data(), *position = loads.position.data();
  const Vec2* force = loads.force.data();
  const double *x = p.x[0].data(), *y = p.x[1].data();
  const Real* mass = p.mass.data();
  for (long n = 0; n < count; ++n) {
    const int i = position[loaded[n]];
    bool near = false;
    places.each_near({x[i], y[i]}, reach, [&](size_t tip) { near = forces.loaded[tip] = true; });
    if (near)
      forces.some.emplace_back(i, force[n] * (1 / double(mass[i])));
  }
  std::stable_sort(forces.some.begin(), forces.some.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  return forces;
}

#define RIVEN_BODY_FORCES(Real) \
  template BodyForces body_forces_near(const SimulationOf<Real>&, const std::vector<Vec2>&, double);
RIVEN_EACH_REAL(RIVEN_BODY_FORCES)
#undef RIVEN_BODY_FORCES

}  // namespace riven
