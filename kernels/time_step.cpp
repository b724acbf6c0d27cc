#include "kernels/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/exec/parallel.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/law_state.hpp"
#include "kernels/report_trouble.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

struct Largest {
  Speeds s;
  RIVEN_FN Largest& operator+=(const Largest& o) {
    s.wave = std::max(s.wave, o.s.wave);
    s.particle = std::max(s.particle, o.s.particle);
    s.sum = std::max(s.sum, o.s.sum);
    return *this;
  }
};

template <class Law, class Real>
Speeds largest_speeds(const exec::Space& space, const BodyLookup<Law>& law, const Particles<Real, 2>& particles) {
  const ParticleReads<Real> p = reads(particles);
  return exec::parallel_reduce<Largest>(
             space, "time step", particles.count(),
             [=] RIVEN_KERNEL(long i) {
               const double c = law.of(i).wave_speed(law_state<Law>(p, i)), v = norm({p.vx[i], p.vy[i]});
               return Largest{{c, v, c + v}};
             })
      .s;
}

/// sqrt(rho h / k) of the stiffest cohesive law and the lightest material, s.
template <class Real>
double cohesive_time(const Scene& scene, const State<Real, 2>& s) {
  double stiffness = 0, density = std::numeric_limits<double>::infinity();
  for (const CrackTraction& t : s.cracks.traction)
    if (t.law.kind == TractionLaw::Kind::cohesive)
      stiffness = std::max(stiffness, t.law.cohesive.stiffness());
  for (const Material& m : scene.materials)
    density = std::min(density, m.density);
  return stiffness > 0 ? std::sqrt(density * s.grid.lattice.h / stiffness) : std::numeric_limits<double>::infinity();
}

}  // namespace

template <class Real>
Speeds measure_speeds(const exec::Space& space, const Plan& plan, const State<Real, 2>& s) {
  return with_law<Real>(
      plan.law, [&](auto law) { return largest_speeds(space, laws<typename decltype(law)::type>(s), s.particles); });
}

template <class Real>
void choose_time_step(const Scene& scene, const Speeds& v, State<Real, 2>& s) {
  Clock& c = s.clock;
  const double cfl = scene.cfl * c.dt_factor, dt_max = scene.dt_max * c.dt_factor;
  c.dt = cfl * s.grid.lattice.h / v.sum;
  c.limiter = v.particle > v.wave ? "particle speed" : "wave speed";
  if (const double limit = cfl * cohesive_time(scene, s); limit < c.dt) {
    c.dt = limit;
    c.limiter = "cohesive law";
  }
  if (dt_max < c.dt) {
    c.dt = dt_max;
    c.limiter = "dt_max";
  }
  constexpr double nothing = 1e-9;  // of what waves allow: none would wait for that
  if (const double least = nothing * s.grid.lattice.h / v.sum; c.dt < least)
    time_stands_still(c, least);
}

void reduce_time_step(double factor, Clock& c) {
  c.dt_factor *= factor;
  c.stable_dt *= factor;
}

#define RIVEN_TIME_STEP(Real)                                                             \
  template Speeds measure_speeds(const exec::Space&, const Plan&, const State<Real, 2>&); \
  template void choose_time_step(const Scene&, const Speeds&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_TIME_STEP)
#undef RIVEN_TIME_STEP

}  // namespace RIVEN_SIDE

}  // namespace riven
