// What tractions on the faces of a tip's own crack, and those of laws on other cracks, release as the tip moves on, and
// where cracks cut these faces.
//
// With t on the upper face and delta the opening, upper less lower face, the faces add to J
//   J_T = -int q t . d(delta)     (Nairn and Aimene, eq. 11)
// and, with their eq. 12, nothing of the jump that delta makes where another crack cuts them: up to the cut on either
// side delta goes on as in the segments before and behind. The interaction integrals add the same with the openings
// that the fields of K_I = 1 and K_II = 1 have there: the traction on faces that are pressed together takes no part in
// the opening, and yet the fields next to them bear it. Faces that are not in line with the tip add to J as a vector
// along themselves; what goes through them besides, and the interaction integrals, face_integral.hpp adds.
// The springs of an imperfect interface are a law of tractions, too: they follow the jumps of interface_jumps.hpp, and
// delta is these.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include "core/fracture/auxiliary_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/tractions.hpp"
#include "kernels/j_integral.hpp"
#include "kernels/segments_by_cell.hpp"
#include "kernels/surface_field.hpp"

namespace riven {

/// Traction on the upper face of a crack that is in contact, given that of the stresses next to it; zero where the law
/// lets the faces part or slide. What the springs of an interface bear is known without these. `normal` points towards
/// above.
inline Vec2 contact_traction(const ContactSettings& contact, Vec2 traction, Vec2 normal) {
  const double pressure = dot(traction, normal);
  const Vec2 shear = traction - pressure * normal;
  switch (contact.law) {
    case ContactLaw::ignored:
    case ContactLaw::interface: return {};
    case ContactLaw::bonded: return traction;
    case ContactLaw::stick: return pressure > 0 ? traction : Vec2{};
    case ContactLaw::frictionless: return std::max(0.0, pressure) * normal;
    case ContactLaw::coulomb: {
      const double held = norm(shear), most = contact.friction * pressure;
      if (!(pressure > 0))
        return {};
      return pressure * normal + (held > most ? most / held : 1) * shear;
    }
  }
  return {};
}

class OwnFaces {
 public:
  OwnFaces(const Cracks& cracks, const SurfaceView& view, const SegmentsByCell& segments, TipTask& task)
      : cracks_(cracks), view_(view), segments_(segments), task_(task), others_(cleared_others()) {}

  /// A segment of another crack; all that may cut those that are asked for are to be told beforehand.
  void add_other(Vec2 middle, double length) { others_.push_back({middle, length}); }
  /// Part of the longest segment that the middle of such a one is at most away from the middle of the one it cuts.
  static constexpr double reach() { return 1 + at_end; }

  /// Does a segment, or a part of it, bear tractions of a law?
  bool bears(int k) const { return bears_by_law(k) || has_springs(k); }

  /// The mean of them on the upper face of a segment, Pa, each half of it as thick as it bears.
  Vec2 traction_of_law(int k) const {
    Vec2 all = has_springs(k) ? traction_of_springs(k) : Vec2{};
    if (bears_by_law(k)) {
      const double each = 0.5 / task_.thickness;
      all += (each * cracks_.bearing[k].y) * traction_on(cracks_, k) +
             (each * cracks_.bearing[k + 1].x) * traction_on(cracks_, k + 1);
    }
    return all;
  }
  /// Adds what they do on a segment in line with the tip.
  void add_tractions(int k, double q) {
    add_work(k, q, [this](int n) { return traction_of_law(n); });
    if (task_.interaction)
      add_known_opening(k, q, traction_of_law(k));
  }
  /// And on one that is not, which leads along `along`: to J alone.
  void add_tractions_along(int k, double q, Vec2 along) {
    task_.sums.faces -= (q * work_past_cuts(k, [this](int n) { return traction_of_law(n); }).work) * along;
  }
  /// And what contact does.
  void add_contact(int k, double q, Vec2 traction) {
    const bool cut = add_work(k, q, [traction](int) { return traction; });
    if (task_.interaction && !cut)
      add_known_opening(k, q, traction);
  }

  /// Are there any of those?
  bool any_others() const { return !others_.empty(); }

  /// What a traction on a segment does as its faces go on from where they are at its first point to where they are at
  /// its second, per thickness.
  double work(int k, Vec2 traction) const { return dot(traction, opening_change(k)); }

  /// Is another crack so near that it may cut a segment? Most are not, and the hash need not be looked at.
  bool meets_other(int k) const {
    const Vec2 a = view_.plane[k], b = view_.plane[k + 1], middle = 0.5 * (a + b);
    const double own = (0.5 + at_end) * norm(b - a);
    return std::any_of(others_.begin(), others_.end(), [&](const Other& o) {
      const Vec2 r = o.middle - middle;
      const double far = own + 0.5 * o.length;
      return dot(r, r) <= 1.001 * far * far;
    });
  }

  /// Notes how far behind the tip another crack first cuts the faces.
  void find_cut(int k, int cell) {
    const Vec2 a = view_.plane[k], b = view_.plane[k + 1];
    const double place = meets_other(k) ? cut_at(k, cell) : uncut;
    if (place == uncut)
      return;
    const double behind = norm(a + place * (b - a) - task_.domain.tip) - at_end * norm(b - a);
    task_.sums.whole = std::min(task_.sums.whole, std::max(0.0, behind));
  }

 private:
  struct Work {
    double work;  ///< J/m^2 times the length of the segment
    bool cut;
  };
  template <class Traction>
  Work work_past_cuts(int k, const Traction& traction) const {
    const bool own = view_.crack[k] == task_.crack;
    const double before = task_.other_faces && (!own || meets_other(k)) ? cut_at(k, segments_.cell_of(k)) : uncut;
    const auto as_on = [&](int n) { return n < 0 ? 0 : work(n, traction(n)) * first_length(k) / first_length(n); };
    if (before == uncut)
      return {as_on(k), false};
    return {before * as_on(uncut_beside(k, -1)) + (1 - before) * as_on(uncut_beside(k, 1)), true};
  }

  /// Is the segment cut?
  template <class Traction>
  bool add_work(int k, double q, const Traction& traction) {
    const Work all = work_past_cuts(k, traction);
    task_.sums.tractions -= task_.last ? q * all.work : -q * all.work;
    return all.cut;
  }

  bool bears_by_law(int k) const {
    return !cracks_.bearing.empty() && (cracks_.bearing[k].y > 0 || cracks_.bearing[k + 1].x > 0);
  }

  /// Is it of an interface whose faces have moved?
  bool has_springs(int k) const {
    return k < cracks_.jump.size() && cracks_.contact[cracks_.crack[k]].law == ContactLaw::interface;
  }
  Vec2 direction(int k) const {
    const Vec2 line = cracks_.plane[k + 1] - cracks_.plane[k];
    return line * (1 / norm(line));
  }
  /// Opening in the middle of a segment of an interface. Next to a tip, where jumps are those of nodes that hardly any
  /// particle feels, it is that of the first segment clear of the tip times the root of the distance: what the springs
  /// hold is a matter of how far the faces are apart where the contour cuts them.
  Vec2 opening_of_springs(int k) const {
    const int c = cracks_.crack[k];
    for (const bool last : {false, true}) {
      const Vec2 tip = cracks_.plane[cracks_.end_point(c, last)];
      const double clear = near_tip * view_.lattice.h, far = distance(k, tip);
      if (!cracks_.is_open(c, last) || far >= clear)
        continue;
      int at = k;
      const int beyond = cracks_.end_point(c, !last) - int{!last};
      while (at != beyond && distance(at, tip) < clear)
        at += last ? -1 : 1;
      return std::sqrt(far / distance(at, tip)) * jump_of(at);
    }
    return jump_of(k);
  }
  double distance(int k, Vec2 from) const { return norm(0.5 * (cracks_.plane[k] + cracks_.plane[k + 1]) - from); }
  Vec2 jump_of(int k) const {
    const Vec2 along = direction(k), jump = cracks_.jump[k];
    return jump.x * turned(along) - jump.y * along;
  }
  /// On the upper face, Pa.
  Vec2 traction_of_springs(int k) const {
    const ContactSettings& law = cracks_.contact[cracks_.crack[k]];
    const Vec2 along = direction(k), normal = turned(along), opening = opening_of_springs(k);
    return -(law.normal_stiffness * dot(opening, normal)) * normal -
           (law.shear_stiffness * dot(opening, along)) * along;
  }
  /// Opening at a point, where a tip has none.
  Vec2 opening_of_springs_at(int point) const {
    const int c = cracks_.crack[point];
    for (const bool last : {false, true})
      if (point == cracks_.end_point(c, last))
        return cracks_.is_open(c, last) ? Vec2{} : opening_of_springs(point - int{last});
    return 0.5 * (opening_of_springs(point - 1) + opening_of_springs(point));
  }

  Vec2 opening_change(int k) const {
    if (has_springs(k))
      return opening_of_springs_at(k + 1) - opening_of_springs_at(k);
    return (cracks_.upper[k + 1] - cracks_.lower[k + 1]) - (cracks_.upper[k] - cracks_.lower[k]);
  }
  double first_length(int k) const { return norm(cracks_.plane0[k + 1] - cracks_.plane0[k]); }

  void add_known_opening(int k, double q, Vec2 traction) {
    const double a = norm(view_.plane[k] - task_.domain.tip), b = norm(view_.plane[k + 1] - task_.domain.tip);
    if (!known_)
      known_.emplace(*task_.solid, task_.running, task_.heading, task_.last);
    // slopes that fall as one over the root of the distance, integrated
    const double length = 2 * std::fabs(std::sqrt(a) - std::sqrt(b));
    for (int mode = 0; mode < 2; ++mode)
      task_.sums.interaction[mode] -= q * length * dot(traction, known_->slope[mode]);
  }

  /// Kept by its thread from tip to tip.
  struct Other {
    Vec2 middle;
    double length;
  };
  static std::vector<Other>& cleared_others() {
    thread_local std::vector<Other> others;
    others.clear();
    return others;
  }

  /// Which part of a segment comes before the place where another crack cuts it or one of its ends, or `uncut`. An end
  /// on that crack belongs to neither side of it.
  double cut_at(int k, int cell) const {
    const int seen = view_.cell_index[cell];
    if (seen < 0)
      return uncut;
    const Vec2 a = view_.plane[k], along = view_.plane[k + 1] - a;
    for (int at = view_.cell_start[seen]; at < view_.cell_start[seen + 1]; ++at) {
      const int n = view_.cell_segment[at];
      if (view_.crack[n] == view_.crack[k])
        continue;
      const Vec2 r = view_.plane[n] - a, across = view_.plane[n + 1] - view_.plane[n];
      const double det = cross(along, across);
      const double place = cross(r, across) / det, there = cross(r, along) / det;
      if (place >= -at_end && place <= 1 + at_end && there >= 0 && there <= 1)
        return std::clamp(place, 0.0, 1.0);
    }
    return uncut;
  }

  /// The nearest segment on one side of a cut one that is not, or -1.
  int uncut_beside(int k, int step) const {
    for (int n = k + step; std::abs(n - k) <= 2; n += step) {
      if (n < view_.start[view_.crack[k]] || n + 1 >= view_.start[view_.crack[k] + 1])
        return -1;
      const int cell = segments_.cell_of(n);
      if (view_.cell_index[cell] >= 0 && cut_at(n, cell) == uncut)
        return n;
    }
    return -1;
  }

  static constexpr double uncut = -1;
  static constexpr double near_tip = 2;   ///< cells to a tip within which springs are not looked at
  static constexpr double at_end = 0.25;  ///< of a segment: how near to its end a cut is one of the end

  const Cracks& cracks_;
  const SurfaceView& view_;
  const SegmentsByCell& segments_;
  TipTask& task_;
  std::vector<Other>& others_;
  std::optional<KnownOpening> known_;  ///< once asked for
};

}  // namespace riven
