#include "kernels/fracture_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/fracture/growth.hpp"
#include "core/fracture/opening.hpp"
#include "core/laws/contact.hpp"
#include "core/scene/schedule.hpp"
#include "kernels/body_forces.hpp"
#include "kernels/bridge_integral.hpp"
#include "kernels/bring_near.hpp"
#include "kernels/simulation.hpp"
#include "kernels/tip_contours.hpp"

namespace riven {

namespace {

/// Cells around a contour whose particles have a part in what is found: those of faces beside it, and how far particles
/// have moved since they were sorted.
constexpr double around_contour = 9;

/// Cells from a tip to where another crack crosses its own, or its own ends on another, from which K is right, to 7 %
/// and 5 degrees. By 1.2 cells it is off by up to 10 % and 14 degrees, by 0.8 by up to 36 % and 17.
constexpr double resolved = 1.5;

template <class Real>
class JSearch {
 public:
  /// `tips`: State::tips, or a copy of them.
  JSearch(SimulationOf<Real>& m, const FractureRules& rules, std::vector<Tip>& tips, bool report)
      : m_(m), s_(m.state), rules_(rules), tips_(tips), report_(report), half_(0.5 * rules.contour * m.scene.cell) {}

  void run() {
    std::vector<DueTip> due;
    for (Tip& tip : tips_)
      if (tip.open && (report_ || growth_due(tip, s_.clock.step)))
        due.push_back({&tip, {half_, half_, half_, half_}});
    if (due.empty())
      return;
    exec::PartsOnHost parts;
    bring_near(m_.space, s_, places_of(due), half_ / m_.scene.cell + around_contour, parts);
    const BodyForces forces = body_forces_near(m_, places_of(due), half_ + 2 * m_.scene.cell);
    for (size_t k = 0; k < due.size(); ++k)
      due[k].forces = forces.act_at(k) ? &forces : nullptr;
    const TipContours<Real> contours(m_, rules_, tips_);
    std::vector<FractureReport> reports(due.size());
    sum_around_tips(m_.space, m_.plan, s_, places_of(due),
                    {[&](size_t k) { return contours.place(due[k]); },
                     [&](size_t k, TipTask& task) { return take(contours, due[k], task, reports[k]); }});
    for (size_t k = 0; k < due.size(); ++k)
      add(reports[k], position_of(s_.cracks, *due[k].tip));
  }

 private:
  std::vector<Vec2> places_of(const std::vector<DueTip>& due) const {
    std::vector<Vec2> list;
    list.reserve(due.size());
    for (const DueTip& d : due)
      list.push_back(position_of(s_.cracks, *d.tip));
    return list;
  }

  /// Takes what was summed on a tip's contour. True: it is to be summed once more, on another one.
  bool take(const TipContours<Real>& contours, DueTip& d, TipTask& task, FractureReport& report) const {
    add_bridges(s_, m_.bridges, contours.places(), task);
    contours.review(d, task);
    const bool elsewhere = d.to_draw_in || d.to_leave_bends;
    if (!elsewhere)
      d.near ? settle_near(d, task) : settle(d, task);
    note(d, task, report);
    if (elsewhere || !std::exchange(d.to_near, false))
      return elsewhere;
    d.near = true;
    std::fill_n(d.most, 4, 0.5 * near_contour * m_.scene.cell);
    return true;
  }

  void note(const DueTip& d, const TipTask& task, FractureReport& report) const {
    if (d.near || d.to_leave_bends)
      return;
    report.bent += d.bend_in_cell || d.pressed_bend;
    report.in_cell += d.in_cell;
    report.drawn_in += d.to_draw_in;
    if (d.to_draw_in)
      return;
    report.unsound += !d.settled;
    report.cut += is_cut_short(*d.tip, task);
    ++report.evaluations;
    report.crossed += task.sums.crossed;
  }

  /// Adds what a tip there came to.
  void add(const FractureReport& of_tip, Vec2 tip) {
    FractureReport& all = m_.fracture;
    const auto take_over = [&](long FractureReport::*count, int place) {
      if (all.*count == 0 && of_tip.*count > 0)
        all.place[place] = tip;
      all.*count += of_tip.*count;
    };
    take_over(&FractureReport::in_cell, 0);
    take_over(&FractureReport::drawn_in, 1);
    take_over(&FractureReport::unsound, 2);
    take_over(&FractureReport::bent, 3);
    take_over(&FractureReport::cut, 5);
    all.evaluations += of_tip.evaluations;
    all.crossed += of_tip.crossed;
  }

  /// Does another crack cross the tip's, or the tip's begin on it, so near that the grid does not resolve what lies
  /// beyond?
  bool is_cut_short(const Tip& tip, const TipTask& task) const {
    const double h = m_.scene.cell, whole = task.sums.whole;
    const Vec2 other = s_.cracks.plane[s_.cracks.end_point(tip.crack, !tip.last)];
    const double length = norm(other - task.domain.tip);
    return task.way.host >= 0 ? length < resolved * h : whole < resolved * h && length > whole + 0.5 * h;
  }

  /// The integral along the grid's axes, J/m^2.
  static Vec2 along_axes(const DueTip& d, const TipSums& sums) {
    return (1 / d.acting) * (sums.J + sums.area + sums.faces);
  }
  /// And along the crack.
  double along_crack(const DueTip& d, const TipSums& sums) const {
    return dot(along_axes(d, sums), heading_of(s_.cracks, *d.tip, true)) + sums.tractions / d.acting;
  }

  void settle(DueTip& d, const TipTask& task) const {
    Tip& tip = *d.tip;
    const TipSums& sums = task.sums;
    const Vec2 J = along_axes(d, sums);
    tip.step = s_.clock.step;
    tip.J1 = J.x;
    tip.J2 = J.y;
    tip.J = along_crack(d, sums);
    tip.adapted = d.adapted;
    tip.crossed = sums.crossed;
    tip.sound = d.settled;
    for (int e = 0; e < 4; ++e)
      tip.reach[e] = task.domain.reach[e] / m_.scene.cell;
    share(d, task);
  }

  /// J to the modes: by the interaction integral where that holds, else by the opening.
  void share(DueTip& d, const TipTask& task) const {
    Tip& tip = *d.tip;
    const PlaneElasticity& solid = *task.solid;
    const double none = std::numeric_limits<double>::quiet_NaN();
    const bool by_interaction = usable(task);
    tip.M_I = tip.M_II = none;
    if (by_interaction) {
      const StressIntensity M = interaction(d, task);
      tip.M_I = M.I;
      tip.M_II = M.II;
      share_in_proportion_of(M, tip, task, tip.J);
    }
    const Vec2 opening = opening_behind(s_.cracks, tip, m_.scene.cell, task.sums.whole);
    const StressIntensity by_opening = share_out(solid, tip.J, speed_of(tip), opening);
    tip.O_I = by_opening.I;
    tip.O_II = by_opening.II;
    if (!by_interaction) {
      const Vec2 open{opening_mode(opening.x, task), opening.y};
      set_intensity(tip, solid, share_out(solid, tip.J, speed_of(tip), open), share_out(solid, tip.J, 0, open));
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

  /// From the Rayleigh speed on, which a `speed_limit` may let a tip pass, there are no K: those just below are taken.
  double speed_of(const Tip& tip) const {
    const Material& material = m_.scene.materials[static_cast<size_t>(tip.material)];
    return tip.speed > 0 ? std::min(tip.speed, 0.99 * rayleigh_speed(material, m_.scene.plane)) : 0;
  }

  static bool usable(const TipTask& task) { return task.interaction && !task.sums.blind; }

  /// J to the modes as the interaction integral has them. Along bent and pressed faces, and where faces that cross bear
  /// tractions, energies are steeper than the grid resolves. J counts their squares, that integral does not: of a tip
  /// at rest it then tells J better.
  void share_in_proportion_of(StressIntensity M, Tip& tip, const TipTask& task, double released) const {
    const PlaneElasticity& solid = *task.solid;
    const double by_modes = (M.I * M.I + M.II * M.II) / solid.E;
    const bool better = task.sums.steep || (task.sums.shut && is_noise(tip.J, by_modes));
    if (rules_.method == JMethod::fijc_adaptive && better && !(tip.speed > 0))
      tip.J = released = by_modes;
    set_intensity(tip, solid, share_in_proportion(solid, tip.J, speed_of(tip), M), driving(tip, task, M, released));
  }

  /// Energies beside shut faces are large and cancel. Where a crack slides J is right by that, to 2 %, and the
  /// interaction integral 1 to 3 % low in K; where it hardly does J is what is left of their errors.
  static bool is_noise(double J, double by_modes) {
    constexpr double apart = 0.1;  // in K
    return !(J > (1 - apart) * (1 - apart) * by_modes && J < (1 + apart) * (1 + apart) * by_modes);
  }

  /// Tips that a contour cannot part share the field around them: each has a part of its J, and K of the root of that.
  StressIntensity interaction(const DueTip& d, const TipTask& task) const {
    const double of_each = task.solid->mu / std::sqrt(d.acting);
    return {opening_mode(of_each * task.sums.interaction[0] / task.running.A_I, task),
            of_each * task.sums.interaction[1] / task.running.A_II};
  }

  /// What opens a tip. Faces that may not overlap press on each other before it is negative; in waves, where they
  /// bounce and a node or two bears them now and then, nothing but that sign tells.
  double opening_mode(double value, const TipTask& task) const {
    const bool overlaps = !keeps_apart(s_.cracks.contact[task.crack].law);
    return task.sums.shut ? 0 : overlaps ? value : std::max(0.0, value);
  }

  /// What drives a tip: as much as the task's contour finds to be released, in the proportion of the modes; and the
  /// more the modes themselves the faster it runs. Of a tip at rest J is right to a per cent where K is not, as where
  /// other terms of Williams' series than the first are large near it: in a beam of two arms of 6 cells the interaction
  /// integral has K 4 % too large, by contours of 4 to 10 cells alike. Of one that runs J by 4 cells swings more, and
  /// is 4 to 15 % low at 0.6 and 0.8 of the Rayleigh speed, where the modes are right to 3 %.
  StressIntensity driving(const Tip& tip, const TipTask& task, StressIntensity M, double released) const {
    constexpr double fast = 0.1;  // of the shear wave speed
    const PlaneElasticity& solid = *task.solid;
    const StressIntensity modes = at_rest(task, M);
    const double by_modes = (modes.I * modes.I + modes.II * modes.II) / solid.E;
    const double runs = std::min(1.0, speed_of(tip) / (fast * solid.shear_speed));
    const double scale = by_modes > 0 ? std::sqrt(runs + (1 - runs) * std::max(0.0, released) / by_modes) : 0;
    return {scale * modes.I, scale * modes.II};
  }

  /// The intensities of a tip at rest that release as much.
  static StressIntensity at_rest(const TipTask& task, StressIntensity M) {
    const RunningTip &running = task.running, rest(*task.solid, 0);
    return {M.I * std::sqrt(running.A_I / rest.A_I), M.II * std::sqrt(running.A_II / rest.A_II)};
  }

  /// In the proportion of the modes that a contour near the tip finds; what it finds drives the tip.
  void settle_near(DueTip& d, const TipTask& task) const {
    if (!d.settled || !usable(task))
      return;
    share_in_proportion_of(interaction(d, task), *d.tip, task, along_crack(d, task.sums));
  }

  SimulationOf<Real>& m_;
  State<Real, 2>& s_;
  const FractureRules& rules_;
  std::vector<Tip>& tips_;
  bool report_;
  double half_;
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
