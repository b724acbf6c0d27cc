// Energy and stresses on the faces of cracks near a tip, from the particles on either side (crack_faces.hpp). Fits of
// nodes are made when first asked for and kept as long as their tip is looked at.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/fracture/j_domain.hpp"
#include "core/state/state.hpp"
#include "kernels/cell_rows.hpp"
#include "kernels/cells_around.hpp"
#include "kernels/face_particles.hpp"
#include "kernels/surface_field.hpp"

namespace riven {

template <class Shape, class Law, class Real>
class FaceFields {
 public:
  FaceFields(const State<Real, 2>& s, const SurfaceView& view, const TipTask& task)
      : s_(s),
        view_(view),
        source_(s),
        task_(task),
        drift_(s.watch.drift / s.grid.lattice.h + 1e-6),
        memory_(cleared_memory()) {
    const auto [lower, upper] = cells_of_domain(around, 0);
    corner_ = lower;
    width_ = upper[0] - lower[0] + 1;
    height_ = upper[1] - lower[1] + 1;
  }

  int cell_of(Vec2 x) const {
    const Lattice& l = s_.grid.lattice;
    return cell_at<Shape>(l, (x - l.origin) * (1 / l.h));
  }

  /// Before any values are: strain energies and Eshelby's tensor are left out otherwise, being dear.
  void ask_for_energies() { energies_ = true; }

  struct Cells {
    std::array<int, 2> lower, upper;
  };
  /// Cells as far as `room` cells around the tip's domain, and at least `least` from the tip.
  Cells cells_of_domain(double room, double least) const {
    const Lattice& l = s_.grid.lattice;
    const JDomain& d = task_.domain;
    const double inv = 1 / l.h;
    const Vec2 c = (d.tip - l.origin) * inv;
    const auto node = [](double x, int last) { return std::clamp(static_cast<int>(std::floor(x)), 1, last - 2); };
    const auto reach = [&](Edge e) { return std::max(d.outer(e) * inv + room, least); };
    return {{node(c.x - reach(left), l.nx), node(c.y - reach(bottom), l.ny)},
            {node(c.x + reach(right), l.nx), node(c.y + reach(top), l.ny)}};
  }

  /// The values at x on one side of a crack, `normal` towards above, near a point `middle` of it; false where no
  /// particle tells.
  bool at(Vec2 x, int crack, Vec2 middle, Vec2 normal, Side side, FaceValues& values) {
    const int last = view_.start[crack + 1] - 1;
    const double reach = 1.6 * s_.grid.lattice.h;
    const bool tip = norm(middle - view_.plane[view_.start[crack]]) < reach || norm(middle - view_.plane[last]) < reach;
    const CrackPoint point{.crack = crack,
                           .x = middle,
                           .left = normal,
                           .beyond = {},
                           .back = {},
                           .tip = tip,
                           .off = std::numeric_limits<double>::infinity()};
    SurfacePoint face{point, side, x, cell_of(x)};
    double area = 0;
    values = {};
    add_nodes(face, values, area);
    if (!(area > 0))
      return false;
    for (double& value : values)
      value /= area;
    return true;
  }

 private:
  /// Adds up the fits of the nodes of the face point's cell, by `area`.
  void add_nodes(SurfacePoint& face, FaceValues& values, double& area) {
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
      if (f >= 0)
        field = field_of_surface(view_, face, view_.nodes[f], l.position(ni, nj));
      if (field < 0)
        continue;
      const FieldFit& fit = fits(ni, nj, f)[field];
      if (!(fit.area > least_area))
        continue;
      fit.evaluate(r, N * fit.area, energies_ ? face_values : face_cheap, values);
      area += N * fit.area;
    }
  }

  /// The fits of all fields of a node, which is number `flagged` of those that may see cracks, or -1.
  const FieldFit* fits(int i, int j, int flagged) {
    if (memory_.index.empty())
      memory_.index.assign(static_cast<size_t>(width_) * static_cast<size_t>(height_), -1);
    int& at = memory_.index[static_cast<size_t>((j - corner_[1]) * width_ + i - corner_[0])];
    if (at < 0) {
      at = static_cast<int>(memory_.fits.size());
      const int fields = flagged < 0 ? 1 : view_.nodes[flagged].room();
      memory_.fits.resize(memory_.fits.size() + static_cast<size_t>(fields));
      if (energies_)
        sum_node<face_values>(i, j, fields, memory_.fits.data() + at);
      else
        sum_node<face_cheap>(i, j, fields, memory_.fits.data() + at);
    }
    return memory_.fits.data() + at;
  }

  template <size_t Count>
  void sum_node(int I, int J, int fields, FieldFit* fits) {
    FitLanes<Count> sums[1 << most_held];
    for (int f = 0; f < fields; ++f)
      sums[f].clear();
    const double reach = 1.5 + drift_;
    for (int j = Shape::cell(J - reach); j <= Shape::cell(J + reach); ++j)
      for (int i = Shape::cell(I - reach); i <= Shape::cell(I + reach); ++i) {
        const auto [first, last] = seen_in(i, j);
        for (int k = first; k < last; ++k)
          memory_.seen[static_cast<size_t>(k)].add(I, J, sums);
      }
    for (int f = 0; f < fields; ++f)
      sums[f].add_to(fits[f]);
  }

  struct Range {
    int first = -1, last = -1;
  };

  /// Kept by its thread from tip to tip, as asking for memory would take as long as filling it.
  struct Memory {
    std::vector<int> index;                             ///< [nodes of the domain] position of the first in fits, or -1
    std::vector<FieldFit> fits;                         ///< of the fields of nodes that were asked for
    std::vector<Range> of_cell;                         ///< [cells of the domain and its margin]
    std::vector<FaceParticles<Shape, Law, Real>> seen;  ///< of cells that were asked for
  };
  static Memory& cleared_memory() {
    thread_local Memory memory;
    memory.index.clear();
    memory.fits.clear();
    memory.of_cell.clear();
    memory.seen.clear();
    return memory;
  }

  /// The particles of a cell, positions in Memory::seen.
  Range seen_in(int i, int j) {
    const int x = i - corner_[0] + margin, y = j - corner_[1] + margin, width = width_ + 2 * margin;
    if (memory_.of_cell.empty())
      memory_.of_cell.resize(static_cast<size_t>(width) * static_cast<size_t>(height_ + 2 * margin));
    if (x < 0 || y < 0 || x >= width || y >= height_ + 2 * margin)
      return {0, 0};
    Range& range = memory_.of_cell[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
    if (range.first < 0) {
      range.first = static_cast<int>(memory_.seen.size());
      each_stretch_of_row(s_.grid.lattice, s_.particles.tiles.cell_start.data(), j, i, i, [&](int first, int last) {
        for (int p = first; p < last; p += face_lanes)
          memory_.seen.emplace_back().take(source_, task_, p, std::min(face_lanes, last - p), energies_);
      });
      range.last = static_cast<int>(memory_.seen.size());
    }
    return range;
  }

  static constexpr int around = 6;            ///< cells around the domain in which faces that are asked for may lie
  static constexpr int margin = 3;            ///< cells around those nodes in which their particles may be
  static constexpr double least_area = 0.02;  ///< cells: a field with fewer particles says nothing

  const State<Real, 2>& s_;
  const SurfaceView& view_;
  typename FaceParticles<Shape, Law, Real>::Source source_;
  const TipTask& task_;
  double drift_;
  std::array<int, 2> corner_{0, 0};
  int width_ = 0, height_ = 0;
  bool energies_ = false;
  Memory& memory_;
};

}  // namespace riven
