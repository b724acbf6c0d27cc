#include "kernels/watch_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/exec/parallel.hpp"
#include "core/scene/names.hpp"
#include "core/state/tractions.hpp"
#include "kernels/report_trouble.hpp"

namespace riven {

namespace {

struct Overlap {
  double depth = 0;  ///< m
  Vec2 place = nowhere;
};

template <class Real>
Vec2 place_of(const Particles<Real, 2>& p, long i) {
  return {p.x[0][i], p.x[1][i]};
}

/// Where the particle of a chunk is whose det F comes nearest to this one.
template <class Real>
Vec2 place_of_det_F(const Particles<Real, 2>& p, long chunk, double value) {
  const long first = chunk * exec::chunk, end = std::min<long>(p.count(), first + exec::chunk);
  long nearest = first;
  for (long i = first; i < end; ++i)
    if (std::abs(det_F(p, i) - value) < std::abs(det_F(p, nearest) - value))
      nearest = i;
  return place_of(p, nearest);
}

/// Where the particle of a chunk is that is stretched most.
template <class Real>
Vec2 place_of_stretch(const Particles<Real, 2>& p, long chunk) {
  const long first = chunk * exec::chunk, end = std::min<long>(p.count(), first + exec::chunk);
  const auto of = [&](long i) {
    return p.F[0].empty() ? det_F(p, i) : principal_stretch(Mat2<double>{p.F[0][i], p.F[1][i], p.F[2][i], p.F[3][i]});
  };
  long most = first;
  for (long i = first; i < end; ++i)
    if (of(i) > of(most))
      most = i;
  return place_of(p, most);
}

/// The power of time with which the work of loads that begin as 1 - cos grows at first: their force as the square, the
/// way as the fourth. It lags behind the energy by so many times what that of a load at once does.
constexpr double power_of_work = 6;

/// Is one of the segments of a point torn? Its normal is not that of faces then.
bool beside_tear(const Cracks& cracks, int point) {
  const auto torn = [&](int k) {
    return k >= 0 && k + 1 < cracks.points() && cracks.crack[k] == cracks.crack[k + 1] && is_torn(cracks, k);
  };
  return torn(point - 1) || torn(point);
}

/// The largest of all faces, also of those that may pass through each other: what follows is no solid. Points of both
/// faces that have slid by more than a cell no longer lie opposite each other: what is between them says nothing of an
/// overlap.
Overlap penetration(const Cracks& cracks, double cell) {
  Overlap most;
  for (int i = 0; i < cracks.points(); ++i) {
    const FacePair opening = face_opening(cracks, i);
    const double overlap = -opening.normal;
    if (overlap > most.depth && std::abs(opening.sliding) < cell && !beside_tear(cracks, i))
      most = {overlap, cracks.plane[i]};
  }
  return most;
}

template <class Real>
[[noreturn]] void stop(const SimulationOf<Real>& m, Watched which, double value, Vec2 place, double allowance) {
  const WatchedText& text = text_of(which);
  const Clock& c = m.state.clock;
  fail({Exit::unstable, text.what,
        fmt::format("step {}, time {:.6g} s at ({:.6g}, {:.6g}) m", c.step, c.time, place.x, place.y),
        fmt::format("{:.4g}{}{}", value, *text.unit ? " " : "", text.unit),
        fmt::format("{:.4g} (limits.stop.{}){}", m.scene.limits.stop[static_cast<size_t>(which)], name_of(which),
                    allowance > 0 ? fmt::format(", and {:.2g} so soon after the start", allowance) : ""),
        text.advice, place});
}

}  // namespace

template <class Real>
void watch_figures(SimulationOf<Real>& m) {
  auto& s = m.state;
  const auto no_place = [] { return nowhere; };
  const auto look = [&](Watched which, double value, const auto& place_of_it, double allowance = 0) {
    const auto k = static_cast<size_t>(which);
    const double warn_at = m.scene.limits.warn[k] + allowance, stop_at = m.scene.limits.stop[k] + allowance;
    Monitor& now = s.monitors[k];
    now.value = value;
    if (!(value <= now.worst)) {
      now.worst = value;
      now.place = place_of_it();
    }
    if (value <= std::min(warn_at, stop_at))
      return;
    Vec2 place = place_of_it();
    if (std::isnan(place.x))
      place = place_of(s.particles, fastest_particle(s.particles));
    if (!(value <= warn_at) && now.beyond++ == 0) {
      now.first = s.clock.step;
      now.first_place = place;
    }
    if (!(value <= stop_at))
      stop(m, which, value, place, allowance);
  };
  const Energy& e = s.ledger.energy;
  const double given = e.largest > 0 ? e.given_by_contact() / e.largest : 0;
  look(Watched::energy, std::max(std::abs(e.relative_error()), given), no_place,
       work_lag(m.plan, s.clock.step, power_of_work));
  look(Watched::momentum, s.ledger.momentum.error(), no_place);
  look(Watched::angular_momentum, s.ledger.momentum.angular_error(), no_place);
  const Deformation& d = s.watch.deformation;
  look(Watched::compression, 1 / d.least_J, [&] { return place_of_det_F(s.particles, d.least_J_chunk, d.least_J); });
  look(Watched::expansion, d.largest_J, [&] { return place_of_det_F(s.particles, d.largest_J_chunk, d.largest_J); });
  look(Watched::stretch, d.stretch, [&] { return place_of_stretch(s.particles, d.stretch_chunk); });
  look(Watched::velocity_difference, s.watch.velocity_difference, no_place);
  if (m.plan.cracks) {
    const Overlap most = penetration(s.cracks, s.grid.lattice.h);
    look(Watched::penetration, most.depth / s.grid.lattice.h, [&] { return most.place; });
  }
}

#define RIVEN_WATCH_FIGURES(Real) template void watch_figures(SimulationOf<Real>&);
RIVEN_EACH_REAL(RIVEN_WATCH_FIGURES)
#undef RIVEN_WATCH_FIGURES

}  // namespace riven
