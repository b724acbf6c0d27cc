// Particles around a tip where q is not zero, as many at a time as there are lanes of a vector, and what inertia and
// body forces add to J there: sum a_p (q - q_core) P_K - sum a_p q B_K of j_integral.hpp.
#pragma once
#include <algorithm>

#include "core/fracture/auxiliary_fields.hpp"
#include "kernels/body_forces.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/field_slots.hpp"
#include "kernels/gather.hpp"
#include "kernels/j_integral.hpp"
#include "kernels/views.hpp"

namespace riven {

template <class Shape, class Real>
struct AreaSums {
  static constexpr int lanes = exec::lanes, nodes = neighbours<Shape, 2>;

  /// Adds `count` particles, up to as many as there are lanes; the numbers behind them are of particles too, which
  /// weigh nothing.
  void add(const State<Real, 2>& s, const FieldSlots& slots, const TipTask& task, const int* particle, int count) {
    alignas(64) int at[lanes];
    std::copy_n(particle, lanes, at);
    const bool rests = task.running.speed == 0;  // and grad v counts in nothing
    if (task.inertia)
      with_flag(!rests, [&](auto gradient) { gather_motion<decltype(gradient)::value>(s, slots, at, count); });
    if (task.forces != nullptr)
      take_forces(*task.forces, at, count);
    weigh(s, task, at, count);
    const double *A = s.particles.F[0].data(), *B = s.particles.F[1].data(), *C = s.particles.F[2].data(),
                 *D = s.particles.F[3].data();
    const Real *VX = s.particles.v[0].data(), *VY = s.particles.v[1].data();
    const double kinetic = task.kinetic();
    const MeanMotion drift = task.drift;
    exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
      const int i = at[k];
      const Mat2<double> F{A[i], B[i], C[i], D[i]}, H = task.gradient(F);
      const Vec2 mean = drift.at({rx[k], ry[k]});
      const double vx = kinetic * (VX[i] - mean.x), vy = kinetic * (VY[i] - mean.y),
                   vgx = vx * gxx[k] + vy * (gyx[k] - drift.spin), vgy = vx * (gxy[k] + drift.spin) + vy * gyy[k];
      sum_x[k] += moved[k] * (H.xx * ax[k] + H.yx * ay[k] - vgx * F.xx - vgy * F.yx);
      sum_y[k] += moved[k] * (H.xy * ax[k] + H.yy * ay[k] - vgx * F.xy - vgy * F.yy);
      sum_x[k] -= mass[k] * (H.xx * bx[k] + H.yx * by[k]);
      sum_y[k] -= mass[k] * (H.xy * bx[k] + H.yy * by[k]);
    });
    // With known fields at rest rho a_i du_i/dx alone is left of P. Around a tip that runs at one speed, with all
    // fields about it, the parts of P cancel; between the two none of them is taken, so that inertia changes J of a tip
    // that runs but not what drives it, unless its opening says that.
    if (task.interaction && (rests || task.forces != nullptr))
      with_fields(*task.solid, task.running, [&](const auto& fields) { add_interaction(task, rests ? 1 : 0, fields); });
  }

  /// What was added so far.
  void add_to(TipSums& sums) const {
    sums.area += Vec2{sum(sum_x), sum(sum_y)};
    for (int mode = 0; mode < 2; ++mode)
      sums.interaction[mode] += sum(interaction[mode]);
  }

 private:
  /// Acceleration, and velocity gradient if asked for, from the advanced grid. Most particles see no crack: their
  /// nodes' slots follow each other along a row.
  template <bool Gradient>
  void gather_motion(const State<Real, 2>& s, const FieldSlots& slots, const int* at, int count) {
    const Particles<Real, 2>& p = s.particles;
    const Lattice& l = s.grid.lattice;
    const Real* q = s.grid.q.data();
    alignas(64) double x[lanes], y[lanes];
    std::uint8_t body[lanes];
    for (int k = 0; k < lanes; ++k) {
      x[k] = p.x[0][at[k]];
      y[k] = p.x[1][at[k]];
      body[k] = p.body[at[k]];
    }
    Block<Real, Shape> w;
    w.template weigh<Gradient>({x, y, l.origin.x, l.origin.y, 1 / l.h, {s.domains.data(), body, s.domains.size() == 1}},
                               0);
    for (int k = 0; k < count; ++k) {
      const std::uint32_t word = s.fields.fields[at[k]];
      set_motion<Gradient>(
          k, word == 0 ? gather<Gradient>(w, k, q, l.nx) : gather_across<Gradient>(w, k, q, l.nx, slots, word));
    }
  }

  template <bool Gradient>
  static RIVEN_INLINE Gathered<Real> gather_across(const Block<Real, Shape>& w, int k, const Real* q, int nx,
                                                   const FieldSlots& slots, std::uint32_t word) {
    int slot[nodes];
#pragma GCC unroll 3
    for (int j = 0; j < Shape::width; ++j)
#pragma GCC unroll 3
      for (int i = 0; i < Shape::width; ++i) {
        const int n = j * Shape::width + i, node = (w.iy[k] + j) * nx + w.ix[k] + i;
        slot[n] = slots.among_cracks(node, CrackFields::field_of(word, n));
      }
    return gather_slots<Gradient>(w, k, q, slot);
  }

  template <bool Gradient>
  RIVEN_INLINE void set_motion(int k, const Gathered<Real>& m) {
    if constexpr (Gradient) {
      gxx[k] = m.dx[0];
      gxy[k] = m.dy[0];
      gyx[k] = m.dx[1];
      gyy[k] = m.dy[1];
    }
    ax[k] = m.value[2];
    ay[k] = m.value[3];
  }

  void take_forces(const BodyForces& forces, const int* at, int count) {
    for (int k = 0; k < count; ++k) {
      const Vec2 b = forces.on(at[k]);
      bx[k] = b.x;
      by[k] = b.y;
    }
  }

  void weigh(const State<Real, 2>& s, const TipTask& task, const int* at, int count) {
    const double *X = s.particles.x[0].data(), *Y = s.particles.x[1].data();
    const Real* M = s.particles.mass.data();
    alignas(64) double thickness[lanes];
    for (int k = 0; k < lanes; ++k)
      thickness[k] = s.thickness[s.particles.body[at[k]]];
    const JDomain d = task.domain, core = task.core.value_or(d);
    const double moves = task.inertia ? 1 : 0, left_out = task.core ? 1 : 0;
    exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
      const int i = at[k];
      rx[k] = X[i] - d.tip.x;
      ry[k] = Y[i] - d.tip.y;
      const Vec2 r{rx[k], ry[k]};
      const double q = d.weight(r), m = (k < count ? 1.0 : 0.0) * M[i] / thickness[k];
      mass[k] = m * q;
      moved[k] = m * moves * (q - left_out * core.weight(r));
    });
  }

  /// `moving`: share of inertia.
  template <class Fields>
  void add_interaction(const TipTask& task, double moving, const Fields& fields) {
    const Vec2 t = task.heading, n = turned(t);
    alignas(64) double sign[lanes];
    task.find_signs(lanes, rx, ry, sign);
    exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
      const double fx = moving * moved[k] * ax[k] - mass[k] * bx[k], fy = moving * moved[k] * ay[k] - mass[k] * by[k];
      const double f1 = sign[k] * (fx * t.x + fy * t.y), f2 = sign[k] * (fx * n.x + fy * n.y);
      const AuxiliaryFields known = fields(Vec2{rx[k] * t.x + ry[k] * t.y, rx[k] * n.x + ry[k] * n.y});
      for (int mode = 0; mode < 2; ++mode)
        interaction[mode][k] += f1 * known.mode[mode].dux_dx + f2 * known.mode[mode].duy_dx;
    });
  }

  static double sum(const double* value) {
    double total = 0;
    for (int k = 0; k < lanes; ++k)
      total += value[k];
    return total;
  }

  alignas(64) double rx[lanes], ry[lanes];              ///< m, from the tip
  alignas(64) double mass[lanes], moved[lanes];         ///< kg/m, per thickness, times q and times q - q_core
  alignas(64) double gxx[lanes] = {}, gxy[lanes] = {};  ///< 1/s, velocity gradient
  alignas(64) double gyx[lanes] = {}, gyy[lanes] = {};
  alignas(64) double ax[lanes] = {}, ay[lanes] = {};  ///< m/s^2
  alignas(64) double bx[lanes] = {}, by[lanes] = {};  ///< m/s^2, of body forces
  alignas(64) double sum_x[lanes] = {}, sum_y[lanes] = {}, interaction[2][lanes] = {};
};

}  // namespace riven
