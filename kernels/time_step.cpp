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

/// Lane by lane, so that looking at a block of particles is one vectorised loop.
struct Largest {
  static constexpr int lanes = exec::lanes;
  alignas(exec::line) double wave[lanes] = {}, particle[lanes] = {}, sum[lanes] = {};

  RIVEN_INLINE void take(int k, double c, double v, double both) {
    wave[k] = wave[k] < c ? c : wave[k];
    particle[k] = particle[k] < v ? v : particle[k];
    sum[k] = sum[k] < both ? both : sum[k];
  }
  RIVEN_FN Largest& operator+=(const Largest& o) {
    for (int k = 0; k < lanes; ++k)
      take(k, o.wave[k], o.particle[k], o.sum[k]);
    return *this;
  }
  Speeds speeds() const {
    const auto most = [](const double* of) { return *std::max_element(of, of + lanes); };
    return {most(wave), most(particle), most(sum)};
  }
};

template <class Law, class Real>
Speeds largest_speeds(const exec::Space& space, const BodyLookup<Law>& law, const Particles<Real, 2>& particles) {
  constexpr int L = exec::lanes;
  const ParticleReads<Real> p = reads(particles);
  const long count = particles.count();
  return exec::parallel_sum<Largest>(
             space, "time step", (count + L - 1) / L,
             [=] RIVEN_KERNEL(long block, Largest& most) {
               const long first = block * L;
               const auto look = [&](const auto& law_of) RIVEN_LANE {
                 exec::for_lanes(static_cast<int>(std::min<long>(L, count - first)), [&](int k) RIVEN_LANE {
                   const long i = first + k;
                   const double c = law_of(i).wave_speed(law_state<Law>(p, i)), v = norm({p.vx[i], p.vy[i]});
                   most.take(k, c, v, c + v);
                 });
               };
               if (law.single) {
                 const Law one = law.table[0];
                 look([&](long) -> const Law& { return one; });
               } else {
                 look([&](long i) -> const Law& { return law.of(i); });
               }
             },
             exec::chunk / L)
      .speeds();
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

/// In which damping takes half of the velocities, s: in twice of that it would turn them around.
double damping_time(const Scene& scene, double time) {
  double rate = 0;
  for (const auto* damping : {&scene.grid_damping, &scene.particle_damping})
    if (*damping)
      rate += std::max(0.0, (**damping)(time));
  return 0.5 / rate;
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
  constexpr double most_cfl = 0.45;  // from 0.55 on faces that lie between nodes swing ever further
  if (const double limit = std::min(cfl, most_cfl) * cohesive_time(scene, s); limit < c.dt) {
    c.dt = limit;
    c.limiter = "cohesive law";
  }
  if (const double limit = c.dt_factor * damping_time(scene, c.time); limit < c.dt) {
    c.dt = limit;
    c.limiter = "damping";
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
