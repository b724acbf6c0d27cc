#include "kernels/tally.hpp"

#include <algorithm>
#include <cmath>

#include "core/exec/parallel.hpp"
#include "core/state/tractions.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/law_state.hpp"

namespace riven {

namespace {

struct Sums {
  double kinetic = 0, strain = 0, px = 0, py = 0, angular = 0, scale = 0, angular_scale = 0;
  Sums& operator+=(const Sums& o) {
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

}  // namespace

template <class Real>
void tally(const exec::Space& space, const Plan& plan, State<Real, 2>& s) {
  const auto& p = s.particles;
  const Sums t = with_law<Real>(plan.law, [&](auto law) {
    using Law = typename decltype(law)::type;
    const BodyLookup<Law> of = laws<Law>(s);
    return exec::parallel_reduce<Sums>(space, "tally", p.count(), [&, of](long i) {
      const double m = p.mass[i], vx = p.v[0][i], vy = p.v[1][i], x = p.x[0][i], y = p.x[1][i];
      const double v = std::sqrt(vx * vx + vy * vy);
      return Sums{0.5 * m * v * v, m * of.of(i).energy(law_state<Law>(p, i)), m * vx, m * vy, m * (x * vy - y * vx),
                  m * v,           m * v * std::sqrt(x * x + y * y)};
    });
  });
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
  e.largest = std::max({e.largest, e.total(), std::abs(e.external_work)});
  b.scale = std::max(b.scale, t.scale);
  b.angular_scale = std::max(b.angular_scale, t.angular_scale);
}

template <class Real>
void book_particle_damping(const exec::Space& space, double damping, State<Real, 2>& s) {
  const auto& p = s.particles;
  const Sums t = exec::parallel_reduce<Sums>(space, "particle damping sums", p.count(), [&](long i) {
    const double m = p.mass[i], vx = p.v[0][i], vy = p.v[1][i];
    return Sums{0.5 * m * (vx * vx + vy * vy), 0, m * vx, m * vy, m * (p.x[0][i] * vy - p.x[1][i] * vx), 0, 0};
  });
  const double d = damping * s.clock.dt;
  s.ledger.energy.damping += 2 * d * (1 - 0.5 * d) * t.kinetic;
  s.ledger.momentum.impulse -= d * Vec2{t.px, t.py};
  s.ledger.momentum.torque_impulse -= d * t.angular;
}

#define RIVEN_TALLY(Real)                                                           \
  template void book_particle_damping(const exec::Space&, double, State<Real, 2>&); \
  template void tally(const exec::Space&, const Plan&, State<Real, 2>&);
RIVEN_TALLY(double)
RIVEN_TALLY(float)
#undef RIVEN_TALLY

}  // namespace riven
