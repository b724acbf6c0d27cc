#include "kernels/report_trouble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace riven {

namespace {

template <class Real>
std::string where(const State<Real, 2>& s, long i) {
  const auto& p = s.particles;
  return fmt::format("step {}, time {:.6g} s, particle {} (body {}) at ({:.6g}, {:.6g}) m", s.clock.step, s.clock.time,
                     p.id[i], p.body[i], p.x[0][i], p.x[1][i]);
}

constexpr const char* cures =
    "solver.stress_update = \"usavg\" or \"musl\"; a smaller solver.cfl; solver.shape = \"ugimp\"; "
    "a solver.order of 4 or less";

/// Fails with the particle's step, time and place.
template <class Real>
[[noreturn]] void stop(const State<Real, 2>& s, long i, std::string what, std::string value, std::string limit,
                       std::string suggestion = cures) {
  fail({Exit::unstable, std::move(what), where(s, i), std::move(value), std::move(limit), std::move(suggestion),
        Vec2{s.particles.x[0][i], s.particles.x[1][i]}});
}

}  // namespace

template <class Real>
void particle_left_grid(const State<Real, 2>& s, long i) {
  const Lattice& l = s.grid.lattice;
  const Vec2 a = l.position(l.wall_lower[0], l.wall_lower[1]), b = l.position(l.wall_upper[0], l.wall_upper[1]);
  stop(s, i, "a particle left the grid",
       fmt::format("velocity ({:.4g}, {:.4g}) m/s", s.particles.v[0][i], s.particles.v[1][i]),
       fmt::format("({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) m", a.x, a.y, b.x, b.y),
       std::string("a larger [grid], if it flew there on purpose; ") + cures);
}

template <class Real>
void check_particles(const State<Real, 2>& s) {
  const auto& p = s.particles;
  if (!std::isfinite(s.watch.largest_move))
    for (long i = 0; i < p.count(); ++i)
      if (!std::isfinite(p.x[0][i] + p.x[1][i] + p.v[0][i] + p.v[1][i]))
        stop(s, i, "a particle's motion is not a number any more",
             fmt::format("velocity ({}, {}) m/s", p.v[0][i], p.v[1][i]), "finite");
  if (!(s.watch.least_J > 0))
    for (long i = 0; i < p.count(); ++i)
      if (!(det_F(p, i) > 0))
        stop(s, i, "a particle turned inside out", fmt::format("det F = {:.4g}", det_F(p, i)), "det F > 0");
  if (s.watch.largest_move > s.grid.lattice.h)
    for (long i = 0; i < p.count(); ++i)
      if (std::max(std::abs(p.v[0][i]), std::abs(p.v[1][i])) * s.clock.dt > 0.9 * s.grid.lattice.h)
        stop(s, i, "a particle moved further than a cell in one step",
             fmt::format("velocity ({:.4g}, {:.4g}) m/s", p.v[0][i], p.v[1][i]),
             fmt::format("{:.4g} m/s, a cell in a step", s.grid.lattice.h / s.clock.dt));
}

template <class Real>
long fastest_particle(const Particles<Real, 2>& p) {
  long fastest = 0;
  for (long i = 1; i < p.count(); ++i)
    if (std::hypot(p.v[0][i], p.v[1][i]) > std::hypot(p.v[0][fastest], p.v[1][fastest]))
      fastest = i;
  return fastest;
}

double work_lag(const Plan& plan, long step, double power) {
  const auto strain_ahead = [](StressUpdate update) {
    switch (update) {
      case StressUpdate::usl:
      case StressUpdate::usf: return 1.7;
      case StressUpdate::musl: return 0.3;
      default: return 0.;
    }
  };
  return plan.worked_on() ? (0.5 * power + strain_ahead(plan.update)) / static_cast<double>(std::max(1L, step)) : 0;
}

template <class Real>
void check_energy(const Plan& plan, const State<Real, 2>& s) {
  const Energy& e = s.ledger.energy;
  const double limit = plan.energy_growth;
  const double grown = plan.watch_energy ? e.unaccounted() : std::min(e.numerical(), e.unaccounted());
  // work that rises as a high power of time is behind by half of what the last step has done
  const double lag = work_lag(plan, s.clock.step) + (e.largest > 0 ? 0.5 * std::abs(s.watch.step_work) / e.largest : 0);
  const double most_given = std::max(0.2, limit), given = e.given_by_contact();
  if (plan.contact && given > most_given * e.largest)
    stop(s, fastest_particle(s.particles), "contact makes energy; the fastest particle is named",
         fmt::format("{:.3g} % of the largest energy, {:.4g} J", 100 * given / e.largest, e.largest),
         fmt::format("{:.3g} % (limits.energy_growth, where that is more than 20 %)", 100 * most_given),
         "solver.transfer = \"fmpm\", or \"pic\" with a small solver.pic_fraction: FLIP keeps the noise between faces "
         "that contact and a cohesive law act on in turn; a smaller solver.cfl; a solver.order of 4 or less");
  if (!(grown > (limit + lag) * e.largest))
    return;
  stop(s, fastest_particle(s.particles), "energy grows without work being done; the fastest particle is named",
       fmt::format("{:.3g} % of the largest energy, {:.4g} J", 100 * grown / e.largest, e.largest),
       fmt::format("{:.3g} % (limits.energy_growth){}", 100 * limit,
                   lag > 0.01 * limit ? fmt::format(", and {:.3g} % so soon after the start", 100 * lag) : ""));
}

void time_stands_still(const Clock& c, double least) {
  fail({Exit::unstable, "the time step is so small that the run would get nowhere",
        fmt::format("step {}, time {:.6g} s", c.step, c.time), fmt::format("{:.6g} s, for the {}", c.dt, c.limiter),
        fmt::format("{:.6g} s or more", least),
        "a larger solver.cfl or solver.dt_max, slower particles, or a cohesive law that is less stiff", std::nullopt});
}

#define RIVEN_REPORT_TROUBLE(Real)                               \
  template void particle_left_grid(const State<Real, 2>&, long); \
  template void check_particles(const State<Real, 2>&);          \
  template long fastest_particle(const Particles<Real, 2>&);     \
  template void check_energy(const Plan&, const State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_REPORT_TROUBLE)
#undef RIVEN_REPORT_TROUBLE

}  // namespace riven
