#include "kernels/tally.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/exec/parallel.hpp"
#include "core/state/tractions.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/law_state.hpp"
#include "kernels/velocity_gradient.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

struct Sums {
  double kinetic = 0, strain = 0, px = 0, py = 0, angular = 0, scale = 0, angular_scale = 0;
  RIVEN_FN Sums& operator+=(const Sums& o) {
    kinetic += o.kinetic;
    strain += o.strain;
    px += o.px;
    py += o.py;
    angular += o.angular;
    scale += o.scale;
    angular_scale += o.angular_scale;
    return *this;
  }
};

/// Of one chunk of particles.
struct ChunkSums {
  Sums sums;
  double least_J, largest_J, stretch;
};

/// The same, lane by lane.
struct LaneSums {
  static constexpr int lanes = exec::lanes;
  double kinetic[lanes] = {}, strain[lanes] = {}, px[lanes] = {}, py[lanes] = {}, angular[lanes] = {};
  double scale[lanes] = {}, angular_scale[lanes] = {};
  double least_J[lanes], largest_J[lanes] = {}, stretch[lanes] = {};

  RIVEN_FN LaneSums() {
    for (double& J : least_J)
      J = std::numeric_limits<double>::infinity();
  }
  RIVEN_FN ChunkSums sum() const {
    ChunkSums t{{}, least_J[0], largest_J[0], stretch[0]};
    for (int k = 0; k < lanes; ++k) {
      t.sums += {kinetic[k], strain[k], px[k], py[k], angular[k], scale[k], angular_scale[k]};
      t.least_J = std::min(t.least_J, least_J[k]);
      t.largest_J = std::max(t.largest_J, largest_J[k]);
      t.stretch = std::max(t.stretch, stretch[k]);
    }
    return t;
  }
};

/// The law of a particle: one for all, taken out of its table once, or one for each.
template <class Law>
struct OneLaw {
  const Law* table;
  RIVEN_INLINE auto take() const {
    return [law = *table](long) RIVEN_LANE { return law; };
  }
};
template <class Law>
struct LawOfEach {
  BodyLookup<Law> law;
  RIVEN_INLINE auto take() const {
    return [of = law](long i) RIVEN_LANE { return of.of(i); };
  }
};

/// Over particles [first, first + count) of a chunk; law_of(i) is the law of particle i.
template <class Law, class Real, class LawOf>
RIVEN_INLINE void add_up(const ParticleReads<Real>& p, const LawOf& law_of, long first, int count, LaneSums& t) {
  exec::for_lanes(count, [&](int k) RIVEN_LANE {
    const long i = first + k;
    const double m = p.mass[i], vx = p.vx[i], vy = p.vy[i], x = p.x[i], y = p.y[i];
    const double vv = vx * vx + vy * vy;
    t.kinetic[k] += 0.5 * m * vv;
    const LawState<Real> state = law_state<Law>(p, i);
    const double J = state.J;
    t.strain[k] += m * law_of(i).energy(state);
    t.least_J[k] = J < t.least_J[k] ? J : t.least_J[k];
    t.largest_J[k] = J > t.largest_J[k] ? J : t.largest_J[k];
    double stretch = J;
    if constexpr (Law::keeps_F)
      stretch = principal_stretch(state.F);
    t.stretch[k] = stretch > t.stretch[k] ? stretch : t.stretch[k];
    t.px[k] += m * vx;
    t.py[k] += m * vy;
    t.angular[k] += m * (x * vy - y * vx);
    t.scale[k] += m * std::sqrt(vv);
    t.angular_scale[k] += m * std::sqrt(vv * (x * x + y * y));
  });
}

template <class Law, class Real, class LawOf>
exec::Array<ChunkSums> sum_particles(const exec::Space& space, const Particles<Real, 2>& particles,
                                     const LawOf& law_of) {
  const long n = particles.count(), chunks = (n + exec::chunk - 1) / exec::chunk;
  const ParticleReads<Real> p = reads(particles);
  exec::Array<ChunkSums> part(chunks);
  exec::parallel_tasks(space, "tally", chunks, [=, part = exec::data_to_fill(part)] RIVEN_KERNEL(long c) {
    LaneSums t;
    const auto law = law_of.take();
    const long end = std::min(n, (c + 1) * exec::chunk);
    for (long first = c * exec::chunk; first < end; first += exec::lanes)
      add_up<Law>(p, law, first, static_cast<int>(std::min<long>(exec::lanes, end - first)), t);
    part[c] = t.sum();
  });
  return part;
}

/// What gradients of velocity add to kinetic energy, J, and angular momentum, kg m^2/s (velocity_gradient.hpp).
template <class Shape, class Real>
Sums sum_gradients_by(const exec::Space& space, const State<Real, 2>& s) {
  const auto slopes = velocity_gradients(s.particles);
  const Real* mass = exec::data(s.particles.mass);
  const Positions<Real> at = positions(s);
  const long n = s.particles.count(), blocks = (n + exec::lanes - 1) / exec::lanes;
  return exec::parallel_reduce<Sums>(space, "tally: gradients of velocity", blocks, [=] RIVEN_KERNEL(long block) {
    const long first = block * exec::lanes;
    const int count = static_cast<int>(std::min<long>(exec::lanes, n - first));
    Block<Real, Shape> w;
    w.template weigh<false, true>(at, first);
    Sums t;
    for (int k = 0; k < count; ++k) {
      const double m = mass[first + k];
      const Mat2<Real> C = slopes.of(first + k);
      t.kinetic += 0.5 * m * product_of(w, k, C, C);
      t.angular += m * (w.xx[k] * C.yx - w.yy[k] * C.xy);
    }
    return t;
  });
}

template <class Real>
Sums sum_gradients(const exec::Space& space, const Plan& plan, const State<Real, 2>& s) {
  return with_shape(plan.shape, [&](auto shape) { return sum_gradients_by<typename decltype(shape)::type>(space, s); });
}

/// J, of motion of 1e-12 of a cell in a step: what is less, as where a grip's weight on a node is a rounding, is none.
template <class Real>
double of_rounding(const State<Real, 2>& s) {
  const double speed = s.clock.dt > 0 ? 1e-12 * s.grid.lattice.h / s.clock.dt : 0;
  return 0.5 * s.particle_mass * s.particles.count() * speed * speed;
}

/// Adds up what chunks hold, in their order; of equal figures the first chunk's counts.
Sums total_of(const exec::Array<ChunkSums>& part, Deformation& all) {
  Sums total;
  all = {};
  for (long c = 0; c < part.size(); ++c) {
    total += part[c].sums;
    if (c == 0 || part[c].least_J < all.least_J) {
      all.least_J = part[c].least_J;
      all.least_J_chunk = c;
    }
    if (c == 0 || part[c].largest_J > all.largest_J) {
      all.largest_J = part[c].largest_J;
      all.largest_J_chunk = c;
    }
    if (c == 0 || part[c].stretch > all.stretch) {
      all.stretch = part[c].stretch;
      all.stretch_chunk = c;
    }
  }
  return total;
}

}  // namespace

template <class Real>
void tally(const exec::Space& space, const Plan& plan, State<Real, 2>& s) {
  const auto& p = s.particles;
  const exec::Array<ChunkSums> part = with_law<Real>(plan.law, [&](auto law) {
    using Law = typename decltype(law)::type;
    const BodyLookup<Law> of = laws<Law>(s);
    if (of.single)
      return sum_particles<Law>(space, p, OneLaw<Law>{of.table});
    return sum_particles<Law>(space, p, LawOfEach<Law>{of});
  });
  Sums t = total_of(part, s.watch.deformation);
  if (plan.affine)
    t += sum_gradients(space, plan, s);
  Energy& e = s.ledger.energy;
  Momentum& b = s.ledger.momentum;
  e.kinetic = t.kinetic;
  e.strain = t.strain;
  if (plan.tractions)
    e.cohesive = cohesive_energy(s.cracks);
  b.linear = {t.px, t.py};
  b.angular = t.angular;
  if (s.clock.step == 0) {
    e.first = e.total();
    b.first = b.linear;
    b.first_angular = b.angular;
  }
  e.largest = std::max({e.largest, e.total(), std::abs(e.external_work), of_rounding(s)});
  b.scale = std::max(b.scale, t.scale);
  b.angular_scale = std::max(b.angular_scale, t.angular_scale);
}

template <class Real>
void book_particle_damping(const exec::Space& space, const Plan& plan, double damping, State<Real, 2>& s) {
  const ParticleReads<Real> p = reads(s.particles);
  Sums t = exec::parallel_reduce<Sums>(space, "particle damping sums", s.particles.count(), [=] RIVEN_KERNEL(long i) {
    const double m = p.mass[i], vx = p.vx[i], vy = p.vy[i];
    return Sums{0.5 * m * (vx * vx + vy * vy), 0, m * vx, m * vy, m * (p.x[i] * vy - p.y[i] * vx), 0, 0};
  });
  if (plan.affine)
    t += sum_gradients(space, plan, s);
  const double d = damping * s.clock.dt;
  s.ledger.energy.damping += 2 * d * (1 - 0.5 * d) * t.kinetic;
  s.ledger.momentum.impulse -= d * Vec2{t.px, t.py};
  s.ledger.momentum.turn(-d * t.angular);
}

#define RIVEN_TALLY(Real)                                                                        \
  template void book_particle_damping(const exec::Space&, const Plan&, double, State<Real, 2>&); \
  template void tally(const exec::Space&, const Plan&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_TALLY)
#undef RIVEN_TALLY

}  // namespace RIVEN_SIDE

}  // namespace riven
