// Particles beside the faces of cracks, some side by side, and what they add to the fits of a node (crack_faces.hpp).
#pragma once
#include <algorithm>

#include "core/exec/bits.hpp"
#include "core/math/quad.hpp"
#include "core/state/state.hpp"
#include "kernels/crack_faces.hpp"
#include "kernels/j_integral.hpp"
#include "kernels/law_state.hpp"

namespace riven {

/// As many as most cells hold: they are looked at cell by cell.
inline constexpr int face_lanes = 4;
using FaceLanes = Quad<double>;

/// The sums of FieldFit, of one field of a node, lane by lane.
template <size_t Count>
struct FitLanes {
  FaceLanes sum[6 + 3 * Count];

  void clear() {
    for (FaceLanes& s : sum)
      s = FaceLanes{};
  }
  /// Adds particles of these weights, at r from the node.
  RIVEN_INLINE void add(const FaceLanes& w, const FaceLanes& rx, const FaceLanes& ry,
                        const double (*values)[face_lanes]) {
    const FaceLanes wx = w * rx, wy = w * ry;
    sum[0] += w;
    sum[1] += wx;
    sum[2] += wy;
    sum[3] += wx * rx;
    sum[4] += wx * ry;
    sum[5] += wy * ry;
    for (size_t v = 0; v < Count; ++v) {
      const FaceLanes& value = quad_at<double>(values[v]);
      sum[6 + 3 * v] += w * value;
      sum[7 + 3 * v] += wx * value;
      sum[8 + 3 * v] += wy * value;
    }
  }

  void add_to(FieldFit& fit) const {
    double total[6 + 3 * Count];
    for (size_t n = 0; n < 6 + 3 * Count; ++n)
      total[n] = (sum[n][0] + sum[n][1]) + (sum[n][2] + sum[n][3]);
    fit.area = total[0];
    fit.x = total[1];
    fit.y = total[2];
    fit.xx = total[3];
    fit.xy = total[4];
    fit.yy = total[5];
    for (size_t v = 0; v < Count; ++v) {
      fit.f[v] = total[6 + 3 * v];
      fit.fx[v] = total[7 + 3 * v];
      fit.fy[v] = total[8 + 3 * v];
    }
  }
};

template <class Shape, class Law, class Real>
class FaceParticles {
 public:
  /// Where they come from.
  struct Source {
    const State<Real, 2>& s;
    BodyLookup<Law> law;
    ParticleReads<Real> reads;

    explicit Source(const State<Real, 2>& state)
        : s(state), law(laws<Law>(state)), reads(::riven::reads(s.particles)) {}
  };

  /// Sets no numbers: to zero them would cost as much as to fill them.
  FaceParticles() {}  // NOLINT(modernize-use-equals-default)

  /// Takes `count` particles from `first` on, up to as many as there are lanes; those behind them have no area. Without
  /// energies only the first values are found (face_cheap): the others are dear.
  void take(const Source& from, const TipTask& task, int first, int count, bool energies) {
    take_places(from, first, count);
    take_values(from, task, first, count);
    for (int k = 0; energies && k < lanes; ++k)
      take_energies(from, task, first + std::min(k, count - 1), k);
  }

  /// Adds what they are to the fits of the fields of node (I, J), in its order of fields.
  template <size_t Count>
  RIVEN_INLINE void add(int I, int J, FitLanes<Count>* fits) const {
    const FaceLanes m = I - quad_at<double>(base_x_), n = J - quad_at<double>(base_y_);
    FaceLanes sx{}, sy{};
    for (int i = 0; i < width; ++i) {
      sx = m == double(i) ? quad_at<double>(weight_x_[i]) : sx;
      sy = n == double(i) ? quad_at<double>(weight_y_[i]) : sy;
    }
    const FaceLanes w = quad_at<double>(area_) * (sx * sy);
    if (!((w[0] + w[1]) + (w[2] + w[3]) > 0))
      return;
    const FaceLanes rx = quad_at<double>(x_) - I, ry = quad_at<double>(y_) - J;
    if (!crossing_)
      return fits[0].add(w, rx, ry, values_);
    FaceLanes field;
    unsigned present = 0;
    for (int k = 0; k < lanes; ++k) {
      const int f =
          w[k] > 0 ? CrackFields::field_of(word_[k], static_cast<int>(n[k]) * width + static_cast<int>(m[k])) : 0;
      field[k] = f;
      present |= 1u << f;
    }
    for (; present != 0; present &= present - 1) {
      const int f = exec::lowest_bit(present);
      fits[f].add(field == double(f) ? w : FaceLanes{}, rx, ry, values_);
    }
  }

 private:
  static constexpr int lanes = face_lanes, width = Shape::width;

  /// Lanes behind the last particle read others, or what pads the arrays, and are left at the lattice's first node.
  void take_places(const Source& from, int first, int count) {
    const exec::Array<DomainSetting<Real, 2>>& domains = from.s.domains;
    if (from.law.single) {
      const DomainSetting<Real, 2> d = domains[0];
      take_places(from, first, count, [&](int) -> const DomainSetting<Real, 2>& { return d; });
    } else {
      const std::uint8_t* body = from.s.particles.body.data();
      take_places(from, first, count, [&](int p) -> const DomainSetting<Real, 2>& { return domains[body[p]]; });
    }
  }
  template <class DomainOf>
  RIVEN_INLINE void take_places(const Source& from, int first, int count, const DomainOf& domain_of) {
    const Lattice l = from.s.grid.lattice;
    const double inv = 1 / l.h, *x = from.reads.x + first, *y = from.reads.y + first;
    const std::uint32_t* fields = from.s.fields.fields.data() + first;
#pragma omp simd
    for (int k = 0; k < lanes; ++k) {
      const DomainSetting<Real, 2>& d = domain_of(first + k);
      x_[k] = k < count ? (x[k] - l.origin.x) * inv : 0;
      y_[k] = k < count ? (y[k] - l.origin.y) * inv : 0;
      const auto a = Shape::axis(x_[k], d.axis[0]), b = Shape::axis(y_[k], d.axis[1]);
      for (int i = 0; i < width; ++i) {
        weight_x_[i][k] = a.s[i];
        weight_y_[i][k] = b.s[i];
      }
      base_x_[k] = a.base;
      base_y_[k] = b.base;
      word_[k] = fields[k];
    }
    crossing_ = ((word_[0] | word_[1]) | (word_[2] | word_[3])) != 0;
  }

  void take_values(const Source& from, const TipTask& task, int first, int count) {
    const ParticleReads<Real>& p = from.reads;
    const double inv = 1 / from.s.grid.lattice.h, half = 0.5 * task.kinetic();
    const MeanMotion drift = task.drift;
    const Vec2 tip = task.domain.tip;
    double specific_area[lanes], inv_first[lanes];
    for (int k = 0; k < lanes; ++k) {
      const int body = from.s.particles.body[first + std::min(k, count - 1)];
      specific_area[k] = from.s.specific_area[body];
      inv_first[k] = 1 / (specific_area[k] * from.s.thickness[body]);
    }
#pragma omp simd
    for (int k = 0; k < lanes; ++k) {
      const LawState<Real> state = law_state<Law>(p, first + k);
      const Vec2 mean = drift.at({p.x[first + k] - tip.x, p.y[first + k] - tip.y});
      const double density = k < count ? inv_first[k] / state.J : 0, vx = p.vx[first + k] - mean.x,
                   vy = p.vy[first + k] - mean.y;
      area_[k] = k < count ? p.mass[first + k] * specific_area[k] * state.J * inv * inv : 0;
      values_[face_stress][k] = k < count ? density * state.xx : 0;
      values_[face_stress + 1][k] = k < count ? density * state.yy : 0;
      values_[face_stress + 2][k] = k < count ? density * state.xy : 0;
      values_[face_kinetic][k] = k < count ? half * inv_first[k] * (vx * vx + vy * vy) : 0;
      values_[face_rotation][k] = k < count ? task.rotation(state.F) : 0;
    }
  }

  void take_energies(const Source& from, const TipTask& task, int p, int k) {
    const LawState<Real> state = law_state<Law>(from.reads, p);
    const double xx = values_[face_stress][k], yy = values_[face_stress + 1][k], xy = values_[face_stress + 2][k];
    const int body = from.s.particles.body[p];
    const double first = 1 / (from.s.specific_area[body] * from.s.thickness[body]);
    const double W0 = first * from.law.of(p).energy(state) + values_[face_kinetic][k], W = W0 / state.J;
    const auto& F = state.F;
    const Mat2<double> H = task.gradient(F);
    values_[face_energy][k] = W0;
    values_[face_eshelby][k] = W * F.xx - (xx * H.xx + xy * H.yx);
    values_[face_eshelby + 1][k] = W * F.yx - (xy * H.xx + yy * H.yx);
    values_[face_eshelby + 2][k] = W * F.xy - (xx * H.xy + xy * H.yy);
    values_[face_eshelby + 3][k] = W * F.yy - (xy * H.xy + yy * H.yy);
  }

  alignas(32) double x_[lanes], y_[lanes];  ///< cells, from the lattice's first node
  alignas(32) double weight_x_[width][lanes], weight_y_[width][lanes];
  alignas(32) double base_x_[lanes], base_y_[lanes];  ///< the first node that each sees
  alignas(32) double area_[lanes];                    ///< cells
  alignas(32) double values_[face_values][lanes];
  std::uint32_t word_[lanes];
  bool crossing_;  ///< some see nodes across cracks
};

}  // namespace riven
