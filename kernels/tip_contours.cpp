#include "kernels/tip_contours.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/fracture/opening.hpp"
#include "core/fracture/place_domain.hpp"
#include "core/state/make_tips.hpp"
#include "kernels/simulation.hpp"

namespace riven {

namespace {

/// Of the shear wave speed, the fastest tip whose steady fields are taken. Nearer to the Rayleigh speed they grow
/// beyond bounds, and a tip that speeds up would feed itself.
constexpr double fastest_fields = 0.6;

/// Cells from a tip that runs to the edges of its core, where no inertia is summed: in a strip whose release is known J
/// of 16 cells is 1.01, 0.99, 0.97 and 0.97 of it at 0.2, 0.4, 0.6 and 0.8 of the Rayleigh speed, give or take 0.07.
/// With 2 cells it is 1.00, 0.99, 0.97, 0.85; with none 0.92, 0.81, 0.64, 0.40, give or take 0.3.
constexpr double core_of_running_tip = 3;

/// Cells from a tip whose faces are pressed together to a bend from which J and K are known: 4 cells before one of 75
/// degrees K is 5 % off, 3 cells 8 %, 2 cells 13 to 41 %, and by 1.5 it may be twice as large.
constexpr double resolved_before_bend = 2.5;

/// Share of an edge of the contour that must lie in the solid, besides the opening of the crack itself where it passes;
/// there less will do where there is no room to draw the edge in.
constexpr double least_filled = 0.9, least_filled_across = 0.4;
/// By how much the shares of edges may differ that are drawn in at once.
constexpr double alike_filled = 0.1;

/// Cells from a tip from which on an edge that has been drawn in to the border of the solid is drawn in once more: in
/// the cell beside a border, above all a loaded one, stresses are off by tens of per cent.
constexpr double clear_of_border = 2.5;

/// rho a R^1.5 / K of a contour with edges at R, in a solid that speeds up by a, from which on its inertia counts by
/// any contour: without it J of a crack along a is off by some 3 times that part.
constexpr double least_inertia = 0.01;
/// Of its toughness, what a tip that may grow is taken to have at least then.
constexpr double least_load = 0.3;

std::vector<Vec2> positions_of(const Cracks& cracks, const std::vector<Tip>& tips) {
  std::vector<Vec2> list;
  list.reserve(tips.size());
  for (const Tip& t : tips)
    list.push_back(position_of(cracks, t));
  return list;
}

}  // namespace

template <class Real>
TipContours<Real>::TipContours(const SimulationOf<Real>& m, const FractureRules& rules, const std::vector<Tip>& tips)
    : m_(m), s_(m.state), rules_(rules), tips_(tips), places_(positions_of(m.state.cracks, tips)) {
  solids_.reserve(m.scene.materials.size());
  for (const Material& material : m.scene.materials)
    solids_.emplace_back(material, m.scene.plane);
}

template <class Real>
TipTask TipContours<Real>::place(DueTip& d) const {
  const Tip& tip = *d.tip;
  const Vec2 at = position_of(s_.cracks, tip);
  std::vector<Vec2> left_out = other_tips(tip);
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
  task.grown = tip.length;
  task.running = RunningTip(*task.solid, std::min(tip.speed, fastest_fields * task.solid->shear_speed));
  if (!m_.contact_sums.touched.empty())
    task.touched = m_.contact_sums.touched.data();
  task.other_faces = rules_.method != JMethod::pijc;
  task.forces = d.forces;
  task.inertia = counts_inertia(d, task);
  if (task.running.speed > 0)
    task.core = core_of(task.domain, core_of_running_tip * m_.scene.cell, m_.scene.cell);
  task.interaction = rules_.interaction;
  task.way = WayFromTip::of(s_.cracks, tip, task.domain);
  if (task.interaction) {
    task.passes = task.way.host >= 0 ||
                  !(task.domain.weight(s_.cracks.plane[s_.cracks.end_point(tip.crack, !tip.last)] - at) > 0);
    task.cut = BranchCut::along(s_.cracks, tip, task.heading, task.way);
  }
  return task;
}

/// J has inertia within the contour; of a tip that runs, beyond its core, and what a near one says of its drive has
/// none. Body forces are what a free body gives way to: around a tip at rest both count, or neither.
template <class Real>
bool TipContours<Real>::counts_inertia(const DueTip& d, const TipTask& task) const {
  if (rules_.area == AreaTerm::never)
    return false;
  if (task.running.speed > 0)
    return !d.near && rules_.contour > 2 * core_of_running_tip;
  return rules_.area == AreaTerm::always || rules_.contour > 10 || d.forces != nullptr ||
         (!d.tip->running && speeds_up(*d.tip, task));
}

/// Does the solid speed up so much at the corners of the contour that it counts? Not around a tip that has grown
/// lately: what its last segment let go speeds up within the contour, and J of the few cells around is what drives it
/// on.
template <class Real>
bool TipContours<Real>::speeds_up(const Tip& tip, const TipTask& task) const {
  const Grid<Real>& grid = s_.grid;
  const Lattice& l = grid.lattice;
  const JDomain& d = task.domain;
  double a = 0;  // m/s^2, the mean of its sizes: on either side of a crack it may point either way
  for (const double x : {-d.reach[left], d.reach[right]})
    for (const double y : {-d.reach[bottom], d.reach[top]}) {
      const Vec2 X = (d.tip + Vec2{x, y} - l.origin) * (1 / l.h);
      const int i = static_cast<int>(std::lround(X.x)), j = static_cast<int>(std::lround(X.y));
      const long node = long{j} * l.nx + i;
      if (i >= 0 && i < l.nx && j >= 0 && j < l.ny)
        a += 0.25 * norm(Vec2{double{grid.q[4 * node + 2]}, double{grid.q[4 * node + 3]}});
    }
  const double E = task.solid->E, R = *std::max_element(d.reach, d.reach + 4);
  const double density = m_.scene.materials[static_cast<size_t>(tip.material)].density;
  const double most_K = density * a * R * std::sqrt(R) / least_inertia;  // with which it counts
  if (tip.grows) {
    const GrowthRule rule = growth_rule_at(m_.scene, tip);
    const bool by_K = rule.criterion == GrowthCriterion::k_max;
    if (most_K <= least_load * (by_K ? rule.toughness : std::sqrt(E * rule.toughness)))
      return false;
  }
  return E * std::sqrt(2 * std::numbers::pi) / 8 * norm(opening_behind(s_.cracks, tip, l.h)) < most_K;
}

/// The other tips, where the contour is to leave them out.
template <class Real>
std::vector<Vec2> TipContours<Real>::other_tips(const Tip& tip) const {
  std::vector<Vec2> list;
  if (rules_.method != JMethod::fijc_adaptive)
    return list;
  const Vec2 at = places_[static_cast<size_t>(&tip - tips_.data())];
  places_.each_near(at, (rules_.contour + 2) * m_.scene.cell, [&](size_t k) {
    if (tips_[k].open && &tips_[k] != &tip)
      list.push_back(places_[k]);
  });
  return list;
}

/// Where there is no room for a contour before a bend, the smallest takes in least of what is behind it.
template <class Real>
void TipContours<Real>::leave_out_bends(DueTip& d, Vec2 tip, std::vector<Vec2>& left_out) const {
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

/// A contour that cannot part tips gives what all of them release: J = sum_k q(x_k) cos(t, t_k) J_k, with t the way
/// each runs. Which of them has how much is below what the grid resolves, and each is given as much.
template <class Real>
double TipContours<Real>::acting_within(const Tip& tip, const JDomain& domain) const {
  const Vec2 heading = heading_of(s_.cracks, tip);
  double sum = 1;
  places_.each_near(domain.tip, 2 * m_.scene.cell, [&](size_t k) {
    if (tips_[k].open && &tips_[k] != &tip)
      sum += domain.weight(places_[k] - domain.tip) * std::max(0., dot(heading, heading_of(s_.cracks, tips_[k])));
  });
  return sum;
}

/// Bends are left out once: those that a smaller contour should leave out a larger one should, too.
template <class Real>
void TipContours<Real>::review(DueTip& d, const TipTask& task) const {
  d.settled = d.to_draw_in = d.to_leave_bends = false;
  if (rules_.method == JMethod::fijc_adaptive && d.bends.empty() && !task.sums.bends.empty()) {
    d.bends = task.sums.bends;
    d.pressed_bend = task.sums.pressed && std::any_of(d.bends.begin(), d.bends.end(), [&](Vec2 bend) {
                       return norm(bend - task.domain.tip) < resolved_before_bend * m_.scene.cell;
                     });
    d.to_leave_bends = true;
  } else {
    draw_in(d, task);
  }
}

/// Draws those edges of the contour that lie outside of the solid in by a cell, where there is room: the emptiest at
/// first, as an edge along the solid may be empty beyond its corners alone.
template <class Real>
void TipContours<Real>::draw_in(DueTip& d, const TipTask& task) const {
  const double h = m_.scene.cell;
  bool full[4], room[4];
  double least = 1;
  for (int e = 0; e < 4; ++e) {
    const double filled = task.sums.filled[e], reach = task.domain.reach[e];
    const std::optional<double> opening = filled < least_filled ? opening_within(task, *d.tip, e) : std::nullopt;
    full[e] = filled + opening.value_or(0) / task.domain.length(e) >= least_filled ||
              (reach <= 1.5 * h && opening && filled >= least_filled_across);
    room[e] = reach > 1.5 * h;
    if (!full[e] && room[e])
      least = std::min(least, filled);
  }
  d.settled = true;
  for (int e = 0; e < 4; ++e) {
    const bool beside_border = full[e] && d.drawn_in[e] && task.domain.reach[e] > clear_of_border * h;
    if (full[e] && !beside_border)
      continue;
    d.settled = false;
    if (!room[e])
      continue;
    d.to_draw_in = !d.near;
    if (!full[e] && task.sums.filled[e] > least + alike_filled)
      continue;
    d.drawn_in[e] = !full[e];
    d.most[e] = std::max(h, task.domain.reach[e] - h);
  }
}

/// The largest distance between the faces of the tip's own crack within the band of an edge; none where it does not
/// pass there. The tip itself is in no band, but by rounding.
template <class Real>
std::optional<double> TipContours<Real>::opening_within(const TipTask& task, const Tip& tip, int edge) const {
  const Cracks& c = s_.cracks;
  const int end = c.end_point(tip.crack, tip.last), other = c.end_point(tip.crack, !tip.last);
  const int step = tip.last ? -1 : 1;
  std::optional<double> most;
  for (int k = end + step; k != other + step; k += step)
    if (task.domain.at(c.plane[k] - task.domain.tip).slope(edge) > 0)
      most = std::max(most.value_or(0), norm(c.upper[k] - c.lower[k]));
  return most;
}

#define RIVEN_CONTOURS(Real) template class TipContours<Real>;
RIVEN_EACH_REAL(RIVEN_CONTOURS)
#undef RIVEN_CONTOURS

}  // namespace riven
