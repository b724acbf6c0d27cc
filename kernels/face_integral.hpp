// The integral of q E_Kj n_j along the faces of cracks that lie in a tip's domain (j_domain.hpp).
//
// An open face bears no traction: of Eshelby's tensor only (W + K) F_jK n_j ds is left, which is the energy per first
// volume on the first face, (W0 + K0) N_K dS. It is taken where that face is, and not where the crack's plane runs
// between the two: across an opening of a cell energies would be carried on half a cell too far. Faces in contact meet
// in the plane; the traction on them is that of the stresses beside them (Nairn and Aimene, section 2.2.2, step 5). A
// small gap is no contact yet: contact must have acted on the nodes around, and the law must bear what the stresses ask
// of it, as a law that only presses bears nothing behind a tip that is about to open.
// Of the target crack's own faces those in line with its tip have no share of the energy; what they bear is counted by
// how they open (own_faces.hpp), which holds up to the tip where stresses on faces are beyond any fit. From
// BranchCut::bent on they are like those of other cracks; only that their strain energy is that of the fitted tension
// along them and of what a law puts on them. The particles that a tip has passed keep stresses that cancel on the grid:
// their energies, which are squares, do not, and would make J of a tip that has turned by one segment 7 % low. Next to
// a tip the tension is that of the first segment clear of it. A segment whose ends another crack has drawn apart spans
// that crack's opening, and has no solid beside it.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "kernels/face_fields.hpp"
#include "kernels/known_on_faces.hpp"
#include "kernels/own_faces.hpp"

namespace riven {

template <class Shape, class Law, class Real>
class FaceIntegral {
 public:
  FaceIntegral(const State<Real, 2>& s, const SurfaceView& view, const SegmentsByCell& segments, TipTask& task)
      : cracks_(s.cracks),
        view_(view),
        segments_(segments),
        h_(s.grid.lattice.h),
        task_(task),
        fields_(s, view, task),
        own_(s.cracks, view, segments, task),
        known_(s.cracks, own_, task) {}

  void add() {
    // half a cell more, as B-splines count cells from mid-cell to mid-cell; behind the tip its own faces are looked at
    // as far as their opening is, and what may cut these lies around
    const auto cells = fields_.cells_of_domain(0.5, 5);
    const int around = static_cast<int>(std::ceil(OwnFaces::reach() * segments_.longest() / h_));
    thread_local Lists lists;
    lists.segments.clear();
    lists.own.clear();
    for (int j = cells.lower[1] - around; j <= cells.upper[1] + around; ++j)
      segments_.each_of_row(j, cells.lower[0] - around, cells.upper[0] + around, [&](const SegmentsByCell::Entry& e) {
        const int i = e.cell - j * view_.lattice.nx;
        list(e, j >= cells.lower[1] && j <= cells.upper[1] && i >= cells.lower[0] && i <= cells.upper[0], lists);
      });
    if (own_.any_others())
      for (const SegmentsByCell::Entry& e : lists.own)
        own_.find_cut(e.segment, e.cell);
    for (const Segment& s : lists.segments)
      if (is_bent(s) || s.crack != task_.crack)
        fields_.ask_for_energies();
    for (const Segment& s : lists.segments) {
      if (s.crack == task_.crack)
        add_own(s);
      else if (task_.other_faces)
        add_other(s);
      else
        see(false);
    }
    task_.sums.steep = task_.sums.steep || (loaded_ && task_.sums.crossed);
    note_bends(lists.segments);
  }

 private:
  using Segment = FaceSegment;

  /// Kept by its thread from tip to tip.
  struct Lists {
    std::vector<Segment> segments;           ///< with a part in J
    std::vector<SegmentsByCell::Entry> own;  ///< of the tip's crack
  };

  /// Lists a segment if it has a part in J; those that are not `inside` may cut others.
  void list(const SegmentsByCell::Entry& e, bool inside, Lists& lists) {
    const int k = e.segment;
    const bool own = e.crack == task_.crack;
    if (own && !inside)
      return;
    const Vec2 middle = middle_of(k), along = view_.plane[k + 1] - view_.plane[k];
    const double length = norm(along);
    if (own)
      lists.own.push_back(e);
    else
      own_.add_other(middle, length);
    const double q = inside ? task_.domain.weight(middle - task_.domain.tip) : 0;
    if (!(q > 0) || !(length > 0))
      return;
    const Vec2 t = along * (1 / length);
    task_.sums.crossed = task_.sums.crossed || !own;
    lists.segments.push_back({k, e.crack, middle, turned(t), length, q, own ? std::fabs(cross(t, task_.heading)) : 2});
  }

  void add_own(const Segment& s) {
    const bool loaded = own_.bears(s.k), off_line = is_bent(s);
    if (loaded && off_line)
      own_.add_tractions_along(s.k, s.q, -turned(s.normal));
    else if (loaded)
      own_.add_tractions(s.k, s.q);
    loaded_ = loaded_ || loaded;
    const Meeting meeting = off_line ? meet(s, touching) : meet_shut(s);
    shut_ = shut_ || meeting.holds;
    see(!comes_back(s) && (!off_line || (task_.cut && !meeting.holds)));
    task_.sums.steep = task_.sums.steep || (off_line && was_bent(s));
    if (meeting.holds && !off_line)
      own_.add_contact(s.k, s.q, meeting.traction);
    if (!(s.turn < straight))
      add_faces(s, off_line ? meeting : Meeting{});
  }

  /// Where the tip's own crack ends within the domain the known fields are torn in the solid: a mouth is no matter,
  /// another crack is, unless the cut goes on along that.
  void add_other(const Segment& s) {
    const Meeting meeting = meet(s, touching);  // what a law puts on faces that touch is in the stresses next to them
    const bool loaded = own_.bears(s.k) && !meeting.holds, host = s.crack == task_.way.host;
    if (loaded)
      own_.add_tractions_along(s.k, s.q, -turned(s.normal));
    loaded_ = loaded_ || loaded;
    see(task_.passes && !(host && meeting.holds));
    task_.sums.steep = task_.sums.steep || host || meeting.holds;
    add_faces(s, meeting);
  }

  /// Notes whether the interaction integral can follow.
  void see(bool follows) { task_.sums.blind = task_.sums.blind || !follows; }

  /// Notes bends that the contour is to leave out: those with faces that are pressed together before the bend or next
  /// behind it, in the domain or beyond, and those so sharp that no grid resolves the energies around them. Where the
  /// solid has a corner of 270 degrees these rise as r^-0.91: what they add along the faces lies within a fraction of a
  /// cell.
  void note_bends(const std::vector<Segment>& segments) {
    for (const Segment& s : segments)
      if (s.crack == task_.crack && comes_back(s))
        task_.sums.bends.insert(task_.sums.bends.end(), {view_.plane[s.k], view_.plane[s.k + 1]});
    const Segment* first = nullptr;
    for (const Segment& s : segments)
      if (is_bent(s) && (first == nullptr || (s.k > first->k) == task_.last))
        first = &s;
    if (first == nullptr)
      return;
    double far = 0;
    for (Segment at = *first; !shut_ && far < pressed_within * h_ && behind(at); far += at.length)
      shut_ = meet(at, touching).holds;
    task_.sums.pressed = shut_;
    for (const Segment& s : segments)
      if (is_bent(s) && (shut_ || is_sharp(s)))
        task_.sums.bends.push_back(view_.plane[s.k + int{task_.last}]);
  }

  /// Does it lie where the tip's crack has come back?
  bool comes_back(const Segment& s) const { return task_.last ? s.k < task_.way.until : s.k >= task_.way.until; }

  bool is_bent(const Segment& s) const { return s.crack == task_.crack && s.turn > BranchCut::bent; }

  /// Was it before strains turned it? Those of a soft solid do, behind a blunt tip, and leave no corner.
  bool was_bent(const Segment& s) const {
    const Vec2 laid = task_.turn_with_tip(cracks_.plane0[s.k + 1] - cracks_.plane0[s.k]);
    return std::fabs(cross(laid, task_.heading)) > BranchCut::bent * norm(laid);
  }

  /// Does the crack turn sharply between this segment and the next one towards the tip, where it was drawn? What has
  /// grown is next to the tip, and J of what drives it would be that of the least contour.
  bool is_sharp(const Segment& s) const {
    const int ahead = s.k + (task_.last ? 1 : -1);
    if (ahead < cracks_.end_point(task_.crack, false) || ahead >= cracks_.end_point(task_.crack, true))
      return false;
    const Vec2 along = view_.plane[ahead + 1] - view_.plane[ahead];
    return dot(turned(along), s.normal) < sharp * norm(along) && length_before(s) > task_.grown + 0.1 * h_;
  }

  /// Length of the crack from the tip to a segment.
  double length_before(const Segment& s) const {
    double length = 0;
    for (int k = cracks_.end_point(task_.crack, task_.last); k != s.k + int{task_.last};) {
      const int next = k + (task_.last ? -1 : 1);
      length += norm(view_.plane[next] - view_.plane[k]);
      k = next;
    }
    return length;
  }

  /// A segment itself, or, nearer to the tip than so many cells, the first one behind it that is not.
  Segment clear_of_tip(const Segment& s, double cells) const {
    Segment at = s;
    while (norm(at.middle - task_.domain.tip) < cells * h_ && behind(at)) {
    }
    return at;
  }

  /// The segment of the tip's crack that ends in it.
  Segment next_to_tip() const {
    Segment at{};
    at.crack = task_.crack;
    move_to(at, cracks_.end_point(task_.crack, task_.last) - int{task_.last});
    return at;
  }

  /// Takes the next segment behind one of the tip's crack; false if there is none.
  bool behind(Segment& at) const {
    if (at.k == cracks_.end_point(task_.crack, !task_.last) - (task_.last ? 0 : 1))
      return false;
    move_to(at, at.k + (task_.last ? -1 : 1));
    return true;
  }

  void move_to(Segment& at, int k) const {
    at.k = k;
    at.middle = middle_of(k);
    const Vec2 along = view_.plane[k + 1] - view_.plane[k];
    at.length = norm(along);
    if (at.length > 0)
      at.normal = turned(along * (1 / at.length));
  }

  /// Both faces where they touch each other.
  struct Meeting {
    bool holds = false;
    FaceValues face[2];
    Vec2 traction;  ///< of contact, on the upper one
  };

  /// Are faces closer than some cells, may they press on each other, and have they acted on each other?
  bool touch(const Segment& s, double cells) const {
    const Vec2 gap = middle_of_face(s.k, Side::above) - middle_of_face(s.k, Side::below);
    const double most = cells * h_ + aslant * std::fabs(cross(gap, s.normal));
    return cracks_.contact[s.crack].law != ContactLaw::ignored && dot(gap, s.normal) < most && acted(s.middle);
  }

  /// Meets where faces touch and their law of contact bears what the stresses next to them ask for beyond what a law
  /// of tractions puts on them.
  Meeting meet(const Segment& s, double cells) {
    Meeting m;
    if (!touch(s, cells))
      return m;
    Vec2 traction;
    for (const Side side : {Side::above, Side::below}) {
      FaceValues& face = m.face[side == Side::below];
      if (!fields_.at(s.middle, s.crack, s.middle, s.normal, side, face))
        return m;
      const double *stress = face.data() + face_stress, x = s.normal.x, y = s.normal.y;
      traction -= 0.5 * Vec2{stress[0] * x + stress[2] * y, stress[2] * x + stress[1] * y};
    }
    const Vec2 law = borne_by(s.k), contact = contact_traction(cracks_.contact[s.crack], traction - law, s.normal);
    m.holds = norm(contact) > told * norm(law);
    if (m.holds)
      m.traction = contact;
    return m;
  }

  /// Faces in line with their tip. Next to it stresses fall so steeply that what they are on a face is known no better
  /// than to a tenth of what the tip makes of them, which is as much as friction. What faces bear there, if they touch,
  /// is what they bear behind; within a cell of the tip, where all faces are near each other, they touch if the next
  /// do.
  Meeting meet_shut(const Segment& s) {
    if (!half_)
      half_ = half_length();
    const double near = std::min(clear, *half_);
    if (!(norm(s.middle - task_.domain.tip) < near * h_))
      return meet(s, shut);
    if (!near_tip_)
      near_tip_ = meet_behind_tip(near, *half_);
    return near_tip_->holds && touch(clear_of_tip(s, std::min(1.0, near)), shut) ? *near_tip_ : Meeting{};
  }

  /// Friction is that of the first place behind so many cells, and the pressure the mean of some places, a cell apart,
  /// as nodes take turns in bearing it.
  Meeting meet_behind_tip(double near, double half) {
    const Segment tip = next_to_tip();
    Segment at = clear_of_tip(tip, near);
    Meeting m = meet(at, shut);
    const Vec2 n = at.normal;
    const double pressure = dot(m.traction, n);
    task_.sums.shut = pressure > 0 && meet(clear_of_tip(tip, std::min(1.0, near)), shut).holds;
    double sum = pressure;
    int count = 1;
    for (double cells = near + 1; m.holds && count < places && cells <= half; ++cells, ++count) {
      at = clear_of_tip(at, cells);
      sum += dot(meet(at, shut).traction, at.normal);
    }
    m.traction += (sum / count - pressure) * n;
    return m;
  }

  /// Cells from the tip to the middle between it and the other one, or a bend, or to the other end; as far as it is
  /// asked for.
  double half_length() const {
    const int other = cracks_.end_point(task_.crack, !task_.last), step = task_.last ? -1 : 1;
    int k = cracks_.end_point(task_.crack, task_.last);
    const auto in_line = [&](int to) {
      const Vec2 along = view_.plane[to] - view_.plane[k];
      return std::fabs(cross(along, task_.heading)) <= BranchCut::bent * norm(along);
    };
    const auto cells_to = [&](int point) { return norm(view_.plane[point] - task_.domain.tip) / h_; };
    while (k != other && cells_to(k) < 2 * (clear + places) && in_line(k + step))
      k += step;
    const double length = cells_to(k);
    return k != other || cracks_.is_open(task_.crack, !task_.last) ? 0.5 * length : length;
  }

  void add_faces(const Segment& s, const Meeting& meeting) {
    const Vec2 first = cracks_.plane0[s.k + 1] - cracks_.plane0[s.k];
    if (is_torn(cracks_, s.k))
      return;
    const bool own_meet = meeting.holds && s.crack == task_.crack;
    if (own_meet)
      task_.sums.faces -= (s.q * own_.work(s.k, meeting.traction)) * -turned(s.normal);
    for (const Side side : {Side::above, Side::below}) {
      const double out = side == Side::above ? -s.q : s.q;  // of the solid
      if (meeting.holds) {
        const double* E = meeting.face[side == Side::below].data() + face_eshelby;
        const Vec2 n = (out * s.length) * s.normal, released{E[0] * n.x + E[1] * n.y, E[2] * n.x + E[3] * n.y};
        task_.sums.faces += own_meet ? dot(released, s.normal) * s.normal : released;
        if (!own_meet)
          known_.add_beside(s, side, FaceStress(meeting.face[side == Side::below], s.normal), {},
                            meeting.face[side == Side::below][face_rotation]);
      } else if (s.crack == task_.crack) {
        if (const auto face = own_face(s, side)) {
          task_.sums.faces += (out * face->through(*task_.solid)) * turned(first);
          known_.add_own(s, side, *face, is_bent(s) ? borne_by(s.k) : Vec2{});
        }
      } else if (const auto face = beside(s, side)) {
        // carried on past a corner, where it ends, it could become negative
        const double energy = std::max(0.0, (*face)[face_energy]);
        const Vec2 borne = borne_by(s.k);
        const FaceStress stress(FaceStress(*face, s.normal).along, borne, s.normal);
        const double through = energy - FaceStrain(stress, *task_.solid).work_across(stress, (*face)[face_rotation]);
        task_.sums.faces += (out * through) * turned(first);
        known_.add_beside(s, side, stress, borne, (*face)[face_rotation]);
      }
    }
  }

  /// Values next to an open face; none where no particle tells.
  std::optional<FaceValues> beside(const Segment& s, Side side) {
    FaceValues face;
    if (!fields_.at(middle_of_face(s.k, side), s.crack, s.middle, s.normal, side, face))
      return std::nullopt;
    return face;
  }

  /// What the law of a crack puts on the upper face of a segment, Pa.
  Vec2 borne_by(int k) const { return own_.bears(k) ? own_.traction_of_law(k) : Vec2{}; }

  /// On a face of the tip's own crack that is not pressed against the other.
  std::optional<OpenFace> own_face(const Segment& s, Side side) {
    const Segment at = clear_of_tip(s, disturbed);
    FaceValues face;
    if (!fields_.at(middle_of_face(at.k, side), at.crack, at.middle, at.normal, side, face))
      return std::nullopt;
    return OpenFace{face[face_kinetic], FaceStress(FaceStress(face, at.normal).along, borne_by(s.k), s.normal),
                    face[face_rotation]};
  }

  /// Has contact acted on one of the four nodes around a place?
  bool acted(Vec2 x) const {
    if (!task_.touched)
      return true;
    const Vec2 X = (x - view_.lattice.origin) * (1 / h_);
    const int columns = view_.lattice.nx;
    const int corner = static_cast<int>(std::floor(X.y)) * columns + static_cast<int>(std::floor(X.x));
    for (const int node : {corner, corner + 1, corner + columns, corner + columns + 1})
      if (const int at = view_.node_index[node]; at >= 0 && task_.touched[at] != 0)
        return true;
    return false;
  }

  Vec2 middle_of(int k) const { return 0.5 * (view_.plane[k] + view_.plane[k + 1]); }
  Vec2 middle_of_face(int k, Side side) const {
    const exec::Array<Vec2>& at = side == Side::above ? cracks_.upper : cracks_.lower;
    return 0.5 * (at[k] + at[k + 1]);
  }

  /// Sine of the angle to the tip's heading up to which a face is in line. Faces next to a contour of 4 cells would add
  /// 0.1 % to J of a crack ten cells long where they lie at that angle and the solid on one side is free of stress;
  /// with 1e-3 J of ten cracks in a plate differs by 6e-5 at most, and takes twice as long.
  static constexpr double straight = 1e-2;
  static constexpr double sharp = 0.26;  ///< cosine of the angle between segments of a sharp bend, 75 degrees: J is 13
                                         ///< % low at 70, 30 at 80
  static constexpr double disturbed = 1.6;  ///< cells from the tip within which faces have stresses of its field, and
  static constexpr double clear = 3;        ///< those within which what they are is not known well enough for friction
  static constexpr int places = 4;          ///< at which it is looked for instead
  static constexpr double told = 0.1;       ///< of the tractions of a law, what stresses beside them tell of contact
  static constexpr double pressed_within = 4;  ///< cells behind a bend in which pressed faces are looked for
  /// Opening in cells below which faces may press on each other; below the second, those in line with their tip, which
  /// have opened by little at any tip while nodes next to it may still touch. Where faces slide their normals are not
  /// known so well that the third number, of how far, would tell that they have parted.
  static constexpr double touching = 0.05, shut = 1e-3, aslant = 0.05;

  const Cracks& cracks_;
  const SurfaceView& view_;
  const SegmentsByCell& segments_;
  double h_;
  TipTask& task_;
  FaceFields<Shape, Law, Real> fields_;
  OwnFaces own_;
  KnownOnFaces known_;
  std::optional<double> half_;       ///< half_length(), once asked for
  std::optional<Meeting> near_tip_;  ///< once asked for
  bool shut_ = false;                ///< some faces of the tip's own crack are pressed together
  bool loaded_ = false;              ///< some faces bear tractions of a law
};

}  // namespace riven
