#include "kernels/watch_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/exec/parallel.hpp"
#include "core/scene/names.hpp"
#include "core/state/tractions.hpp"
#include "kernels/report_trouble.hpp"

namespace riven {

namespace {

struct Seen {
  double value = 0;
  Vec2 place = nowhere;
};

/// Least and largest det F; of equal ones the particle that comes first.
struct Extremes {
  double least = std::numeric_limits<double>::infinity(), largest = 0;
  long at_least = 0, at_largest = 0;

  Extremes& operator+=(const Extremes& o) {
    if (o.least < least) {
      least = o.least;
      at_least = o.at_least;
    }
    if (o.largest > largest) {
      largest = o.largest;
      at_largest = o.at_largest;
    }
    return *this;
  }
};

template <class Real>
Extremes extremes(const exec::Space& space, const Particles<Real, 2>& p) {
  const bool by_J = !p.J.empty();
  return exec::parallel_reduce<Extremes>(space, "least and largest det F", p.count(), [&](long i) {
    const double J = by_J ? double(p.J[i]) : p.F[0][i] * p.F[3][i] - p.F[1][i] * p.F[2][i];
    return Extremes{J, J, i, i};
  });
}

template <class Real>
Vec2 place_of(const Particles<Real, 2>& p, long i) {
  return {p.x[0][i], p.x[1][i]};
}

/// The power of time with which the work of loads that begin as 1 - cos grows at first: their force as the square, the
/// way as the fourth. It lags behind the energy by so many times what that of a load at once does.
constexpr double power_of_work = 6;

/// Largest overlap of faces that contact keeps apart, m.
Seen penetration(const Cracks& cracks) {
  Seen most;
  for (int i = 0; i < cracks.points(); ++i) {
    if (cracks.contact[static_cast<size_t>(cracks.crack[i])].law == ContactLaw::ignored)
      continue;
    const double overlap = -face_opening(cracks, i).normal;
    if (overlap > most.value)
      most = {overlap, cracks.plane[i]};
  }
  return most;
}

template <class Real>
[[noreturn]] void stop(const SimulationOf<Real>& m, Watched which, const Seen& seen, double limit) {
  const WatchedText& text = text_of(which);
  const Clock& c = m.state.clock;
  fail({Exit::unstable, text.what,
        fmt::format("step {}, time {:.6g} s at ({:.6g}, {:.6g}) m", c.step, c.time, seen.place.x, seen.place.y),
        fmt::format("{:.4g}{}{}", seen.value, *text.unit ? " " : "", text.unit),
        fmt::format("{:.4g} (limits.stop.{})", limit, name_of(which)), text.advice, seen.place});
}

}  // namespace

template <class Real>
void watch_figures(SimulationOf<Real>& m) {
  auto& s = m.state;
  const auto look = [&](Watched which, Seen seen, double allowance = 0) {
    const auto k = static_cast<size_t>(which);
    const double warn_at = m.scene.limits.warn[k] + allowance, stop_at = m.scene.limits.stop[k] + allowance;
    Monitor& now = s.monitors[k];
    now.value = seen.value;
    if (!(seen.value <= now.worst)) {
      now.worst = seen.value;
      now.place = seen.place;
    }
    if (seen.value <= std::min(warn_at, stop_at))
      return;
    if (std::isnan(seen.place.x))
      seen.place = place_of(s.particles, fastest_particle(s.particles));
    if (!(seen.value <= warn_at) && now.beyond++ == 0) {
      now.first = s.clock.step;
      now.first_place = seen.place;
    }
    if (!(seen.value <= stop_at))
      stop(m, which, seen, stop_at);
  };
  look(Watched::energy, {std::abs(s.ledger.energy.relative_error())}, power_of_work * work_lag(m.plan, s.clock.step));
  look(Watched::momentum, {s.ledger.momentum.error()});
  const Extremes J = extremes(m.space, s.particles);
  look(Watched::compression, {1 / J.least, place_of(s.particles, J.at_least)});
  look(Watched::expansion, {J.largest, place_of(s.particles, J.at_largest)});
  look(Watched::velocity_difference, {s.watch.velocity_difference});
  if (m.plan.contact) {
    Seen most = penetration(s.cracks);
    most.value /= s.grid.lattice.h;
    look(Watched::penetration, most);
  }
}

template void watch_figures(SimulationOf<double>&);
template void watch_figures(SimulationOf<float>&);

}  // namespace riven
