// The integral of q E_Kj n_j along the faces of cracks that lie in a tip's domain (j_domain.hpp).
//
// An open face bears no traction: of Eshelby's tensor only (W + K) F_jK n_j ds is left, which is the energy per first
// volume on the first face, (W0 + K0) N_K dS. It is taken where that face is, and not where the crack's plane runs
// between the two: across an opening of a cell energies would be carried on half a cell too far. Faces in contact meet
// in the plane; the traction on them is that of the stresses beside them (Nairn and Aimene, section 2.2.2, step 5). The
// target crack's own faces take part where they are not in line with its tip, or bear tractions of their own. A segment
// whose ends another crack has drawn apart spans that crack's opening, and has no solid beside it.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/fracture/auxiliary_fields.hpp"
#include "core/state/state.hpp"
#include "core/state/tractions.hpp"
#include "kernels/cell_rows.hpp"
#include "kernels/crack_faces.hpp"
#include "kernels/j_integral.hpp"
#include "kernels/law_state.hpp"
#include "kernels/surface_field.hpp"

namespace riven {

template <class Shape, class Law, class Real>
class FaceIntegral {
 public:
  FaceIntegral(const State<Real, 2>& s, const SurfaceView& view, TipTask& task)
      : s_(s),
        view_(view),
        law_(laws<Law>(s)),
        task_(task),
        drift_(s.watch.drift / s.grid.lattice.h + 1e-6),
        bears_(!s.cracks.bearing.empty()) {}

  void add() {
    const Lattice& l = s_.grid.lattice;
    const JDomain& d = task_.domain;
    const double inv = 1 / l.h;
    const Vec2 c = (d.tip - l.origin) * inv;
    const auto node = [](double x, int last) { return std::clamp(static_cast<int>(std::floor(x)), 1, last - 2); };
    const auto box = [&](double room, double least) {
      const auto reach = [&](Edge e) { return std::max(d.outer(e) * inv + room, least); };
      return std::array{node(c.x - reach(left), l.nx), node(c.y - reach(bottom), l.ny), node(c.x + reach(right), l.nx),
                        node(c.y + reach(top), l.ny)};
    };
    const std::array nodes = box(around, 0);
    corner_ = {nodes[0], nodes[1]};
    width_ = nodes[2] - nodes[0] + 1;
    height_ = nodes[3] - nodes[1] + 1;
    // half a cell more, as B-splines count cells from mid-cell to mid-cell; behind the tip its own faces are looked at
    // as far as their opening is
    const std::array cells = box(0.5, 5);
    for (int j = cells[1]; j <= cells[3]; ++j)
      for (int i = cells[0]; i <= cells[2]; ++i)
        add_cell(j * l.nx + i);
  }

 private:
  using Fits = std::array<FieldFit, 4>;

  /// The segments whose middle is in a cell, which sees them all.
  void add_cell(int cell) {
    const int seen = view_.cell_index[cell];
    if (seen < 0)
      return;
    for (int at = view_.cell_start[seen]; at < view_.cell_start[seen + 1]; ++at) {
      const int k = view_.cell_segment[at];
      const Vec2 a = view_.plane[k], b = view_.plane[k + 1], middle = 0.5 * (a + b);
      if (cell_of(middle) == cell)
        add_segment(k, middle, b - a);
    }
  }

  int cell_of(Vec2 x) const {
    const Lattice& l = s_.grid.lattice;
    return Shape::cell((x.y - l.origin.y) / l.h) * l.nx + Shape::cell((x.x - l.origin.x) / l.h);
  }

  void add_segment(int k, Vec2 middle, Vec2 along) {
    const double q = task_.domain.weight(middle - task_.domain.tip), length = norm(along);
    const int crack = view_.crack[k];
    const bool own = crack == task_.crack;
    if (own)
      find_cut(k, middle);
    if (!(q > 0) || !(length > 0))
      return;
    const Vec2 t = along * (1 / length);
    if (own && bears_)
      add_own_tractions(k, q, cell_of(middle));
    const double turn = std::fabs(cross(t, task_.heading));
    if (own && turn < straight)
      return;
    if (own && turn > bent)
      task_.sums.bent = true;
    if (!own)
      task_.sums.crossed = true;
    if (!own && !task_.other_faces)
      return;
    const Vec2 normal = turned(t);  // towards above
    const int last = view_.start[crack + 1] - 1;
    const double reach = 1.6 * s_.grid.lattice.h;
    const CrackPoint point{
        crack,
        middle,
        normal,
        {},
        norm(middle - view_.plane[view_.start[crack]]) < reach || norm(middle - view_.plane[last]) < reach,
        std::numeric_limits<double>::infinity()};
    const Vec2 first = s_.cracks.plane0[k + 1] - s_.cracks.plane0[k];
    if (length > torn * norm(first))
      return;
    // tractions of laws on its own faces are counted already, however little these have opened
    const bool touches = !(own && bears_) && in_contact(k, normal);
    for (const Side side : {Side::above, Side::below}) {
      const Vec2 x = touches ? middle : middle_of_face(k, side);
      SurfacePoint face{point, side, x, cell_of(x)};
      double value[FieldFit::values] = {}, area = 0;
      values_at(face, value, area);
      if (!(area > 0))
        continue;
      const double out = side == Side::above ? -1 : 1;  // of the solid
      if (touches) {
        const Vec2 n = (out * q * length / area) * normal;
        task_.sums.faces += Vec2{value[1] * n.x + value[2] * n.y, value[3] * n.x + value[4] * n.y};
      } else {
        // carried on past a corner, where it ends, energy could become negative
        task_.sums.faces += (out * q * std::max(0.0, value[0]) / area) * turned(first);
      }
    }
  }

  Vec2 middle_of_face(int k, Side side) const {
    const exec::Array<Vec2>& at = side == Side::above ? s_.cracks.upper : s_.cracks.lower;
    return 0.5 * (at[k] + at[k + 1]);
  }

  /// -int q t . d(delta), with t on the upper face and delta the opening: eq. 11 of Nairn and Aimene, and with their
  /// eq. 12 nothing of the jump that delta makes where another crack cuts the faces. Up to the cut on either side delta
  /// goes on as in the segments before and behind.
  void add_own_tractions(int k, double q, int cell) {
    const Cracks& c = s_.cracks;
    if (!(c.bearing[k].y > 0))
      return;
    const double before = task_.other_faces ? cut_at(k, cell) : uncut;
    const double work = before == uncut ? work_of_opening(k)
                                        : before * work_of_opening(k, uncut_beside(k, -1)) +
                                              (1 - before) * work_of_opening(k, uncut_beside(k, 1));
    task_.sums.tractions -= task_.last ? q * work : -q * work;
    if (task_.interaction && before == uncut)
      add_known_opening(q, k);
  }

  /// t . d(delta) along a segment.
  double work_of_opening(int k) const {
    const Cracks& c = s_.cracks;
    const Vec2 change = (c.upper[k + 1] - c.lower[k + 1]) - (c.upper[k] - c.lower[k]);
    return dot(mean_traction(k), change);
  }
  /// The same by how delta changes along segment n.
  double work_of_opening(int k, int n) const {
    const auto first_length = [&](int at) { return norm(s_.cracks.plane0[at + 1] - s_.cracks.plane0[at]); };
    return n < 0 ? 0 : work_of_opening(n) * first_length(k) / first_length(n);
  }
  Vec2 mean_traction(int k) const { return 0.5 * (traction_on(s_.cracks, k) + traction_on(s_.cracks, k + 1)); }

  /// The same as t . d(delta) with the openings that the fields of K_I = 1 and K_II = 1 have there.
  void add_known_opening(double q, int k) {
    const Vec2 t = task_.heading, n = turned(t), traction = mean_traction(k);
    const double a = norm(view_.plane[k] - task_.domain.tip), b = norm(view_.plane[k + 1] - task_.domain.tip);
    const double behind = 0.5 * (a + b);
    const AuxiliaryFields above = auxiliary_fields(*task_.solid, task_.running, {-behind, 0.0}),
                          below = auxiliary_fields(*task_.solid, task_.running, {-behind, -0.0});
    // the slopes there times this are their integral, for they fall as one over the root of the distance
    const double length = 2 * std::fabs(std::sqrt(a) - std::sqrt(b)) * std::sqrt(behind);
    // the upper face of the crack is the left one of its last tip, the right one of its first
    const double side = task_.last ? 1 : -1;
    for (int mode = 0; mode < 2; ++mode) {
      const double along = above.mode[mode].dux_dx - below.mode[mode].dux_dx;
      const double across = above.mode[mode].duy_dx - below.mode[mode].duy_dx;
      task_.sums.interaction[mode] -= q * length * side * (dot(traction, t) * along + dot(traction, n) * across);
    }
  }

  /// Which part of a segment comes before the place where another crack cuts it or one of its ends, or `uncut`. An end
  /// on that crack belongs to neither side of it.
  double cut_at(int k, int cell) const {
    const int seen = view_.cell_index[cell];
    const Vec2 a = view_.plane[k], along = view_.plane[k + 1] - a;
    for (int at = view_.cell_start[seen]; at < view_.cell_start[seen + 1]; ++at) {
      const int n = view_.cell_segment[at];
      if (view_.crack[n] == task_.crack)
        continue;
      const Vec2 r = view_.plane[n] - a, across = view_.plane[n + 1] - view_.plane[n];
      const double det = cross(along, across);
      const double place = cross(r, across) / det, there = cross(r, along) / det;
      if (place >= -at_end && place <= 1 + at_end && there >= 0 && there <= 1)
        return std::clamp(place, 0.0, 1.0);
    }
    return uncut;
  }

  void find_cut(int k, Vec2 middle) {
    const Vec2 a = view_.plane[k], b = view_.plane[k + 1];
    const double place = cut_at(k, cell_of(middle));
    if (place == uncut)
      return;
    const double behind = norm(a + place * (b - a) - task_.domain.tip) - at_end * norm(b - a);
    task_.sums.whole = std::min(task_.sums.whole, std::max(0.0, behind));
  }

  /// The nearest segment on one side of a cut one that is not, or -1.
  int uncut_beside(int k, int step) const {
    for (int n = k + step; std::abs(n - k) <= 2; n += step) {
      if (n < view_.start[task_.crack] || n + 1 >= view_.start[task_.crack + 1])
        return -1;
      const int cell = cell_of(0.5 * (view_.plane[n] + view_.plane[n + 1]));
      if (view_.cell_index[cell] >= 0 && cut_at(n, cell) == uncut)
        return n;
    }
    return -1;
  }

  bool in_contact(int k, Vec2 normal) const {
    const Cracks& c = s_.cracks;
    if (c.contact[static_cast<size_t>(view_.crack[k])].law == ContactLaw::ignored)
      return false;
    const Vec2 gap = 0.5 * (c.upper[k] + c.upper[k + 1] - c.lower[k] - c.lower[k + 1]);
    return dot(gap, normal) < touching * s_.grid.lattice.h;
  }

  /// Adds up the fits of the nodes of the face point's cell; the values are sums over `area`.
  void values_at(SurfacePoint& face, double* value, double& area) {
    const Lattice& l = s_.grid.lattice;
    const Vec2 X = (face.x - l.origin) * (1 / l.h);
    const int i = static_cast<int>(std::floor(X.x)), j = static_cast<int>(std::floor(X.y));
    for (int n = 0; n < 4; ++n) {
      const int ni = i + n % 2, nj = j + n / 2, node = nj * l.nx + ni;
      if (static_cast<unsigned>(ni - corner_[0]) >= static_cast<unsigned>(width_) ||
          static_cast<unsigned>(nj - corner_[1]) >= static_cast<unsigned>(height_))
        continue;
      const Vec2 r{X.x - ni, X.y - nj};
      const double N = (1 - std::fabs(r.x)) * (1 - std::fabs(r.y));
      if (!(N > 0))
        continue;
      const int f = view_.node_index[node];
      int field = 0;
      if (f >= 0) {
        face.look(view_);
        field = field_of_surface(view_, face, view_.nodes[f], l.position(ni, nj));
      }
      if (field < 0)
        continue;
      const FieldFit& fit = fits(ni, nj)[static_cast<size_t>(field)];
      if (!(fit.area > least_area))
        continue;
      fit.evaluate(r, N * fit.area, value);
      area += N * fit.area;
    }
  }

  const Fits& fits(int i, int j) {
    if (index_.empty())
      index_.assign(static_cast<size_t>(width_) * static_cast<size_t>(height_), -1);
    int& at = index_[static_cast<size_t>((j - corner_[1]) * width_ + i - corner_[0])];
    if (at < 0) {
      at = static_cast<int>(fits_.size());
      fits_.emplace_back();
      sum_node(i, j, fits_.back());
    }
    return fits_[static_cast<size_t>(at)];
  }

  void sum_node(int I, int J, Fits& fits) {
    const double reach = 1.5 + drift_;
    for (int j = Shape::cell(J - reach); j <= Shape::cell(J + reach); ++j)
      for (int i = Shape::cell(I - reach); i <= Shape::cell(I + reach); ++i) {
        const auto [first, last] = seen_in(i, j);
        for (int k = first; k < last; ++k)
          seen_[static_cast<size_t>(k)].add(I, J, fits);
      }
  }

  /// What a particle adds to the fits of its nodes.
  struct Seen {
    int base_x, base_y;
    double x, y;  ///< from the first of its nodes, in cells
    double weight_x[Shape::width], weight_y[Shape::width];
    double area;  ///< in cells
    std::uint32_t word;
    double value[FieldFit::values];

    void add(int I, int J, Fits& fits) const {
      const int m = I - base_x, n = J - base_y;
      if (static_cast<unsigned>(m) >= Shape::width || static_cast<unsigned>(n) >= Shape::width)
        return;
      const double S = weight_x[m] * weight_y[n];
      if (S > 0)
        fits[static_cast<size_t>(CrackFields::field_of(word, n * Shape::width + m))].add(area * S, x - m, y - n, value);
    }
  };
  struct Range {
    int first = -1, last = -1;
  };

  /// The particles of a cell, positions in seen_.
  Range seen_in(int i, int j) {
    const int x = i - corner_[0] + margin, y = j - corner_[1] + margin, width = width_ + 2 * margin;
    if (of_cell_.empty())
      of_cell_.resize(static_cast<size_t>(width) * static_cast<size_t>(height_ + 2 * margin));
    if (x < 0 || y < 0 || x >= width || y >= height_ + 2 * margin)
      return {0, 0};
    Range& range = of_cell_[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
    if (range.first < 0) {
      range.first = static_cast<int>(seen_.size());
      each_stretch_of_row(s_.grid.lattice, s_.particles.tiles.cell_start.data(), j, i, i, [&](int first, int last) {
        for (int p = first; p < last; ++p)
          see(p);
      });
      range.last = static_cast<int>(seen_.size());
    }
    return range;
  }

  void see(int i) {
    const Particles<Real, 2>& p = s_.particles;
    const Lattice& l = s_.grid.lattice;
    const DomainSetting<Real, 2>& d = s_.domains[p.body[i]];
    const double inv = 1 / l.h, X = (p.x[0][i] - l.origin.x) * inv, Y = (p.x[1][i] - l.origin.y) * inv;
    const auto a = Shape::axis(X, d.axis[0]), b = Shape::axis(Y, d.axis[1]);
    const LawState<Real> state = law_state<Law>(p, i);
    const auto& F = state.F;
    const double density = 1 / (s_.specific_area[p.body[i]] * s_.thickness[p.body[i]] * state.J);
    const double W = density * (law_.of(i).energy(state) + 0.5 * (p.v[0][i] * p.v[0][i] + p.v[1][i] * p.v[1][i]));
    const double xx = density * state.xx, yy = density * state.yy, xy = density * state.xy;
    const Mat2<double> H = task_.gradient(F);
    Seen seen;
    seen.base_x = a.base;
    seen.base_y = b.base;
    seen.x = X - a.base;
    seen.y = Y - b.base;
    for (int k = 0; k < Shape::width; ++k) {
      seen.weight_x[k] = a.s[k];
      seen.weight_y[k] = b.s[k];
    }
    seen.area = p.mass[i] * s_.specific_area[p.body[i]] * state.J * inv * inv;
    seen.word = s_.fields.fields[i];
    // energy per first volume, then the tensor: rows K, columns j
    seen.value[0] = W * state.J;
    seen.value[1] = W * F.xx - (xx * H.xx + xy * H.yx);
    seen.value[2] = W * F.yx - (xy * H.xx + yy * H.yx);
    seen.value[3] = W * F.xy - (xx * H.xy + xy * H.yy);
    seen.value[4] = W * F.yy - (xy * H.xy + yy * H.yy);
    seen_.push_back(seen);
  }

  static constexpr double straight = 1e-3;  ///< sine of the angle to the tip's heading up to which a face is in line
  static constexpr double bent = 0.2;       ///< and from which on the crack is bent for the interaction integral
  static constexpr double torn = 2;         ///< length of a segment over its first one from which it spans an opening
  static constexpr double uncut = -1;
  static constexpr double at_end = 0.25;      ///< of a segment: how near to its end a cut is one of the end
  static constexpr int around = 4;            ///< cells around the domain in which faces of its segments may lie
  static constexpr int margin = 3;            ///< cells around those nodes in which their particles may be
  static constexpr double touching = 0.05;    ///< opening in cells below which faces may press on each other
  static constexpr double least_area = 0.02;  ///< cells: a field with fewer particles says nothing

  const State<Real, 2>& s_;
  const SurfaceView& view_;
  BodyLookup<Law> law_;
  TipTask& task_;
  double drift_;
  bool bears_;  ///< the tip's own crack bears tractions
  std::array<int, 2> corner_{0, 0};
  int width_ = 0, height_ = 0;
  std::vector<int> index_;  ///< [nodes of the domain] position in fits_, or -1
  std::vector<Fits> fits_;
  std::vector<Range> of_cell_;  ///< [cells of the domain and its margin]
  std::vector<Seen> seen_;
};

}  // namespace riven
