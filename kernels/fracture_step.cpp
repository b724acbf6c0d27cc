#include "kernels/fracture_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/exec/parallel.hpp"
#include "core/fracture/growth.hpp"
#include "core/fracture/opening.hpp"
#include "core/fracture/place_domain.hpp"
#include "core/fracture/tip_places.hpp"
#include "core/scene/schedule.hpp"
#include "kernels/bridge_integral.hpp"
#include "kernels/bring_near.hpp"
#include "kernels/simulation.hpp"

namespace riven {

namespace {

/// Of the shear wave speed, the fastest tip whose steady fields are taken. Nearer to the Rayleigh speed they grow
/// beyond bounds, and a tip that speeds up would feed itself.
constexpr double fastest_fields = 0.6;

/// Share of an edge of the contour that must lie in the solid, besides the opening of the crack itself where it passes;
/// there less will do where there is no room to draw the edge in.
constexpr double least_filled = 0.9, least_filled_across = 0.4;

/// Cells, the contour that says what drives a tip where the interaction integral of a larger one does not hold: it is
/// crossed or bent, or the tip runs, whose steady fields are about it no farther than waves went while it ran steadily.
constexpr double near_contour = 4;

/// Cells around a contour whose particles have a part in what is found: those of faces beside it, and how far particles
/// have moved since they were sorted.
constexpr double around_contour = 9;

void count(long& counter, Vec2& place, Vec2 here) {
  if (counter++ == 0)
    place = here;
}

Vec2 position_of(const Cracks& cracks, const Tip& tip) {
  return cracks.plane[cracks.end_point(tip.crack, tip.last)];
}

/// One tip on its way to J.
struct Due {
  Tip* tip;
  double most[4];             ///< m, the contour as asked for, or as drawn in
  std::vector<Vec2> bends{};  ///< of the crack itself with faces pressed together, which the contour is to leave out
  bool adapted = false;       ///< the contour leaves out another tip, or a bend
  bool in_cell = false;       ///< a tip is too near for that
  bool bend_in_cell = false;
  double acting = 1;        ///< tips that the contour takes for this one: itself, and those too near that run its way
  bool settled = false;     ///< all of its edges lie in the solid
  bool to_draw_in = false;  ///< some do not, and have room to be drawn in
  bool to_place_anew = false;  ///< bends have become known
  bool near = false;           ///< J is known, and this contour is to say what drives the tip
  bool to_near = false;        ///< the next one is to
};

template <class Real>
class JSearch {
 public:
  /// `tips`: State::tips, or a copy of them.
  JSearch(SimulationOf<Real>& m, const FractureRules& rules, std::vector<Tip>& tips, bool report)
      : m_(m), s_(m.state), rules_(rules), tips_(tips), report_(report), half_(0.5 * rules.contour * m.scene.cell) {
    solids_.reserve(m.scene.materials.size());
    for (const Material& material : m.scene.materials)
      solids_.emplace_back(material, m.scene.plane);
  }

  void run() {
    std::vector<Due> due;
    for (Tip& tip : tips_)
      if (tip.open && (report_ || growth_due(tip, s_.clock.step)))
        due.push_back({&tip, {half_, half_, half_, half_}});
    if (due.empty())
      return;
    std::vector<Vec2> places;
    for (const Tip& t : tips_)
      places.push_back(position_of(s_.cracks, t));
    exec::PartsOnHost parts;
    bring_near(m_.space, s_, places_of(due), half_ / m_.scene.cell + around_contour, parts);
    places_ = TipPlaces(std::move(places));
    while (!due.empty()) {
      std::vector<TipTask> tasks(due.size());
      each("contours", due.size(), [&](size_t k) { tasks[k] = place(due[k]); });
      sum_around_tips(m_.space, m_.plan, s_, tasks);
      each("J to K", due.size(), [&](size_t k) {
        add_bridges(s_, m_.bridges, places_, tasks[k]);
        find_bends(due[k], tasks[k]);
        if (due[k].to_place_anew)
          return;
        draw_in(due[k], tasks[k]);
        if (due[k].near)
          settle_near(due[k], tasks[k]);
        else if (!due[k].to_draw_in)
          settle(due[k], tasks[k]);
      });
      for (size_t k = 0; k < due.size(); ++k)
        note(due[k], tasks[k]);
      std::erase_if(due, [](const Due& d) { return !d.to_place_anew && !d.to_draw_in && !d.to_near; });
      for (Due& d : due)
        d.to_place_anew = false;
      for (Due& d : due)
        if (std::exchange(d.to_near, false)) {
          d.near = true;
          std::fill_n(d.most, 4, 0.5 * near_contour * m_.scene.cell);
        }
    }
  }

 private:
  /// f(k) for k in [0, n), some tips at a time, as one alone is too little for a thread to be woken for.
  template <class F>
  void each(const char* label, size_t n, const F& f) const {
    constexpr size_t block = 16;
    exec::parallel_tasks(m_.space, label, static_cast<long>((n + block - 1) / block), [&](long b) {
      const size_t first = static_cast<size_t>(b) * block, last = std::min(n, first + block);
      for (size_t k = first; k < last; ++k)
        f(k);
    });
  }

  std::vector<Vec2> places_of(const std::vector<Due>& due) const {
    std::vector<Vec2> list;
    list.reserve(due.size());
    for (const Due& d : due)
      list.push_back(position_of(s_.cracks, *d.tip));
    return list;
  }

  TipTask place(Due& d) const {
    const Tip& tip = *d.tip;
    const Vec2 at = position_of(s_.cracks, tip);
    std::vector<Vec2> left_out = others(tip);
    leave_out_bends(d, at, left_out);
    const PlacedDomain placed = place_domain(at, d.most, m_.scene.cell, left_out);
    d.adapted = placed.adapted;
    d.in_cell = placed.in_cell;
    d.acting = placed.in_cell ? acting_within(tip, placed.domain) : 1;
    TipTask task;
    task.domain = placed.domain;
    task.crack = tip.crack;
    task.last = tip.last;
    task.heading = heading_of(s_.cracks, tip);
    const Vec2 laid = heading_of(s_.cracks, tip, true);
    task.turn = {dot(laid, task.heading), cross(laid, task.heading)};
    task.solid = &solids_[static_cast<size_t>(tip.material)];
    task.thickness = s_.thickness[tip.body];
    task.running = RunningTip(*task.solid, std::min(tip.speed, fastest_fields * task.solid->shear_speed));
    if (!m_.contact_sums.touched.empty())
      task.touched = m_.contact_sums.touched.data();
    task.other_faces = rules_.method != JMethod::pijc;
    task.inertia = counts_inertia(d, task.running.speed > 0);
    task.interaction = rules_.interaction;
    return task;
  }

  /// J has inertia within the contour; of a tip that runs, what a near one says of its drive has none.
  bool counts_inertia(const Due& d, bool runs) const {
    if (rules_.area == AreaTerm::automatic)
      return runs ? !d.near : rules_.contour > 10;
    return rules_.area == AreaTerm::always && !(runs && d.near);
  }

  /// The other tips, where the contour is to leave them out.
  std::vector<Vec2> others(const Tip& tip) const {
    std::vector<Vec2> list;
    if (rules_.method != JMethod::fijc_adaptive)
      return list;
    const Vec2 at = places_[static_cast<size_t>(&tip - tips_.data())];
    places_.each_near(at, 2 * half_ + 2 * m_.scene.cell, [&](size_t k) {
      if (tips_[k].open && &tips_[k] != &tip)
        list.push_back(places_[k]);
    });
    return list;
  }

  /// Where there is no room for a contour before a bend, the smallest takes in least of what is behind it.
  void leave_out_bends(Due& d, Vec2 tip, std::vector<Vec2>& left_out) const {
    const double h = m_.scene.cell;
    for (const Vec2 bend : d.bends) {
      const Vec2 r = bend - tip;
      if (std::max(std::fabs(r.x), std::fabs(r.y)) >= h) {
        left_out.push_back(bend);
        continue;
      }
      d.bend_in_cell = true;
      for (double& most : d.most)
        most = std::min(most, h);
    }
  }

  /// A contour gets no more than one new place for them, when it is known whether they are pressed.
  void find_bends(Due& d, const TipTask& task) const {
    if (rules_.method != JMethod::fijc_adaptive || !d.bends.empty() || task.sums.shut_bends.empty())
      return;
    d.bends = task.sums.shut_bends;
    d.to_place_anew = true;
  }

  /// A contour that cannot part tips gives what all of them release: J = sum_k q(x_k) cos(t, t_k) J_k, with t the way
  /// each runs. Which of them has how much is below what the grid resolves, and each is given as much.
  double acting_within(const Tip& tip, const JDomain& domain) const {
    const Vec2 heading = heading_of(s_.cracks, tip);
    double sum = 1;
    places_.each_near(domain.tip, 2 * m_.scene.cell, [&](size_t k) {
      if (tips_[k].open && &tips_[k] != &tip)
        sum += domain.weight(places_[k] - domain.tip) * std::max(0., dot(heading, heading_of(s_.cracks, tips_[k])));
    });
    return sum;
  }

  /// Draws those edges of the contour that lie outside of the solid in by a cell, where there is room.
  void draw_in(Due& d, const TipTask& task) const {
    const double h = m_.scene.cell;
    d.settled = true;
    d.to_draw_in = false;
    for (int e = 0; e < 4; ++e) {
      const double filled = task.sums.filled[e];
      if (filled >= least_filled)
        continue;
      const std::optional<double> opening = opening_within(task, *d.tip, e);
      if (opening && filled + *opening / task.domain.length(e) >= least_filled)
        continue;
      if (task.domain.reach[e] > 1.5 * h) {
        d.most[e] = std::max(h, task.domain.reach[e] - h);
        d.to_draw_in = true;
        d.settled = false;
      } else if (!opening || filled < least_filled_across) {
        d.settled = false;
      }
    }
  }

  /// The largest distance between the faces of the tip's own crack within the band of an edge; none where it does not
  /// pass there. The tip itself is in no band, but by rounding.
  std::optional<double> opening_within(const TipTask& task, const Tip& tip, int edge) const {
    const Cracks& c = s_.cracks;
    const int end = c.end_point(tip.crack, tip.last), other = c.end_point(tip.crack, !tip.last);
    const int step = tip.last ? -1 : 1;
    std::optional<double> most;
    for (int k = end + step; k != other + step; k += step)
      if (task.domain.at(c.plane[k] - task.domain.tip).slope(edge) > 0)
        most = std::max(most.value_or(0), norm(c.upper[k] - c.lower[k]));
    return most;
  }

  void note(const Due& d, const TipTask& task) {
    if (d.near || d.to_place_anew)
      return;
    if (d.bend_in_cell)
      count(m_.fracture.bent, m_.fracture.place[3], task.domain.tip);
    if (d.in_cell)
      count(m_.fracture.in_cell, m_.fracture.place[0], task.domain.tip);
    if (d.to_draw_in) {
      count(m_.fracture.drawn_in, m_.fracture.place[1], task.domain.tip);
      return;
    }
    if (!d.settled)
      count(m_.fracture.unsound, m_.fracture.place[2], task.domain.tip);
    ++m_.fracture.evaluations;
    m_.fracture.crossed += task.sums.crossed;
  }

  void settle(Due& d, const TipTask& task) const {
    Tip& tip = *d.tip;
    const TipSums& sums = task.sums;
    const Vec2 J = (1 / d.acting) * (sums.J + sums.inertia + sums.faces);
    tip.step = s_.clock.step;
    tip.J1 = J.x;
    tip.J2 = J.y;
    tip.J = dot(J, heading_of(s_.cracks, tip, true)) + sums.tractions / d.acting;
    tip.adapted = d.adapted;
    tip.crossed = sums.crossed;
    tip.sound = d.settled;
    for (int e = 0; e < 4; ++e)
      tip.reach[e] = task.domain.reach[e] / m_.scene.cell;
    share(d, task);
  }

  /// J to the modes: by the interaction integral where that holds, else by the opening.
  void share(Due& d, const TipTask& task) const {
    Tip& tip = *d.tip;
    const PlaneElasticity& solid = *task.solid;
    const double none = std::numeric_limits<double>::quiet_NaN();
    const Vec2 opening = opening_behind(s_.cracks, tip, m_.scene.cell, task.sums.whole);
    const StressIntensity by_opening = share_out(solid, tip.J, tip.speed, opening);
    tip.O_I = by_opening.I;
    tip.O_II = by_opening.II;
    const bool by_interaction = usable(task);
    if (by_interaction) {
      const StressIntensity M = interaction(d, task);
      tip.M_I = M.I;
      tip.M_II = M.II;
      set_intensity(tip, solid, share_in_proportion(solid, tip.J, tip.speed, M), at_rest(task, M));
    } else {
      tip.M_I = tip.M_II = none;
      set_intensity(tip, solid, by_opening, share_out(solid, tip.J, 0, opening));
    }
    d.to_near = task.interaction && half_ > 0.5 * near_contour * m_.scene.cell && (!by_interaction || tip.speed > 0);
  }

  static void set_intensity(Tip& tip, const PlaneElasticity& solid, StressIntensity K, StressIntensity drive) {
    tip.K_I = K.I;
    tip.K_II = K.II;
    tip.drive_I = drive.I;
    tip.drive_II = drive.II;
    tip.release = (drive.I * drive.I + drive.II * drive.II) / solid.E;
  }

  static bool usable(const TipTask& task) { return task.interaction && !task.sums.crossed && !task.sums.bent; }

  static StressIntensity interaction(const Due& d, const TipTask& task) {
    const double of_all = task.solid->mu / d.acting;
    return {of_all * task.sums.interaction[0] / task.running.A_I,
            of_all * task.sums.interaction[1] / task.running.A_II};
  }

  /// The intensities of a tip at rest that release as much.
  static StressIntensity at_rest(const TipTask& task, StressIntensity M) {
    const RunningTip &running = task.running, rest(*task.solid, 0);
    return {M.I * std::sqrt(running.A_I / rest.A_I), M.II * std::sqrt(running.A_II / rest.A_II)};
  }

  /// J as it stands, in the proportion of the modes that a contour near the tip finds, which drives the tip.
  void settle_near(Due& d, const TipTask& task) const {
    d.to_draw_in = false;
    if (!d.settled || !usable(task))
      return;
    Tip& tip = *d.tip;
    const StressIntensity M = interaction(d, task);
    set_intensity(tip, *task.solid, share_in_proportion(*task.solid, tip.J, tip.speed, M), at_rest(task, M));
  }

  SimulationOf<Real>& m_;
  State<Real, 2>& s_;
  const FractureRules& rules_;
  std::vector<Tip>& tips_;
  bool report_;
  double half_;
  std::vector<PlaneElasticity> solids_;
  TipPlaces places_;
};

}  // namespace

template <class Real>
void find_j_and_k(SimulationOf<Real>& m) {
  const Clock& c = m.state.clock;
  if (!m.contact_watch.on) {  // no faces act on each other
    m.contact_sums.touched.resize(m.state.fields.nodes.size());
    m.contact_sums.touched.zero();
  }
  const bool report = report_due(m.scene, c.time, c.time + c.dt);
  JSearch(m, m.scene.fracture, m.state.tips, report).run();
  if (!report)
    return;
  for (size_t k = 0; k < m.scene.readings.size(); ++k) {
    m.state.readings[k] = m.state.tips;
    JSearch(m, m.scene.readings[k].rules, m.state.readings[k], report).run();
  }
}

#define RIVEN_TASKS(Real) template void find_j_and_k(SimulationOf<Real>&);
RIVEN_EACH_REAL(RIVEN_TASKS)
#undef RIVEN_TASKS

}  // namespace riven
