// Particles around a tip on which q falls, as many at a time as there are lanes of a vector, and the sums over them.
#pragma once
#include <algorithm>

#include "core/fracture/auxiliary_fields.hpp"
#include "kernels/j_integral.hpp"
#include "kernels/views.hpp"

namespace riven {

struct Band {
  static constexpr int lanes = exec::lanes;
  alignas(64) double rx[lanes], ry[lanes];  ///< m, from the tip
  alignas(64) double gx[lanes], gy[lanes];  ///< 1/m, gradient of q
  alignas(64) double vx[lanes], vy[lanes];  ///< m/s, beyond TipTask::drift
  alignas(64) double mass[lanes];           ///< kg/m, per thickness
  alignas(64) double first_area[lanes];     ///< m^2
  alignas(64) double energy[lanes];         ///< m^2/s^2, strain energy per mass, and kinetic where it counts
  alignas(64) double sxx[lanes], syy[lanes], sxy[lanes];  ///< m^2/s^2, Kirchhoff stress per mass
  alignas(64) double Fxx[lanes], Fxy[lanes], Fyx[lanes], Fyy[lanes];
  alignas(64) double sign[lanes];  ///< of the known fields

  /// Takes `count` particles, up to as many as there are lanes; the numbers behind them are of particles too, which
  /// weigh nothing.
  template <class Law, class Real>
  void take(const State<Real, 2>& s, const BodyLookup<Law>& law, const TipTask& task, const int* particle, int count) {
    if (law.single) {
      const Solid<Law> one{law.table[0], s.specific_area[0], 1 / s.thickness[0]};
      take_each(
          s, [&](int) -> const Solid<Law>& { return one; }, task, particle, count);
    } else {
      Solid<Law> solid[lanes];
      for (int k = 0; k < lanes; ++k) {
        const int body = s.particles.body[particle[k]];
        solid[k] = {law.table[body], s.specific_area[body], 1 / s.thickness[body]};
      }
      take_each(
          s, [&](int k) -> const Solid<Law>& { return solid[k]; }, task, particle, count);
    }
  }

  /// - sum a_p E_Kj dq/dx_j
  void add_j(const TipTask& task) {
    exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
      const double sx = sxx[k] * gx[k] + sxy[k] * gy[k], sy = sxy[k] * gx[k] + syy[k] * gy[k];
      const Mat2<double> H = task.gradient(Mat2<double>{Fxx[k], Fxy[k], Fyx[k], Fyy[k]});
      sum_x[k] += mass[k] * (H.xx * sx + H.yx * sy - energy[k] * (Fxx[k] * gx[k] + Fyx[k] * gy[k]));
      sum_y[k] += mass[k] * (H.xy * sx + H.yy * sy - energy[k] * (Fxy[k] * gx[k] + Fyy[k] * gy[k]));
    });
  }

  /// Interaction of the actual fields with known ones, in the tip's frame; the displacement gradient is that in what
  /// has turned with the tip. The actual stress is per mass, the known one per volume.
  template <class Fields>
  void add_interaction(const TipTask& task, const Fields& fields) {
    const Vec2 t = task.heading, n = turned(t);
    const Vec2 t0{task.turn.x * t.x + task.turn.y * t.y, task.turn.x * t.y - task.turn.y * t.x};
    const double speed = task.running.speed;
    task.find_signs(lanes, rx, ry, sign);
    exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
      const Mat2<double> H = task.gradient(Mat2<double>{Fxx[k], Fxy[k], Fyx[k], Fyy[k]});
      const Vec2 ut{H.xx * t0.x + H.xy * t0.y, H.yx * t0.x + H.yy * t0.y};
      const double u1 = ut.x * t.x + ut.y * t.y, u2 = ut.x * n.x + ut.y * n.y;
      const double sx = sxx[k] * t.x + sxy[k] * t.y, sy = sxy[k] * t.x + syy[k] * t.y;
      const double s11 = sx * t.x + sy * t.y, s12 = sx * n.x + sy * n.y, s22 = sxx[k] + syy[k] - s11;
      const double q1 = gx[k] * t.x + gy[k] * t.y, q2 = gx[k] * n.x + gy[k] * n.y;
      // velocity times that of the running field, which is - speed du/dx
      const double v1 = -speed * (vx[k] * t.x + vy[k] * t.y), v2 = -speed * (vx[k] * n.x + vy[k] * n.y);
      const AuxiliaryFields known = fields(Vec2{rx[k] * t.x + ry[k] * t.y, rx[k] * n.x + ry[k] * n.y});
      for (int mode = 0; mode < 2; ++mode) {
        const AuxiliaryField& a = known.mode[mode];
        const double work = s11 * a.exx + s22 * a.eyy + 2 * s12 * a.exy + v1 * a.dux_dx + v2 * a.duy_dx;
        const double own = q1 * (s11 * a.dux_dx + s12 * a.duy_dx) + q2 * (s12 * a.dux_dx + s22 * a.duy_dx);
        const double other = q1 * (a.sxx * u1 + a.sxy * u2) + q2 * (a.sxy * u1 + a.syy * u2);
        interaction[mode][k] += sign[k] * (mass[k] * (own - work * q1) + first_area[k] * other);
      }
    });
  }

  /// What was added for all bands so far.
  void add_to(TipSums& sums) const {
    sums.J += Vec2{sum(sum_x), sum(sum_y)};
    for (int e = 0; e < 4; ++e)
      sums.filled[e] += sum(filled[e]);
    for (int mode = 0; mode < 2; ++mode)
      sums.interaction[mode] += sum(interaction[mode]);
  }

 private:
  template <class Law>
  struct Solid {
    Law law;
    double specific_area, inv_thickness;
  };

  template <class Real, class SolidOf>
  void take_each(const State<Real, 2>& s, const SolidOf& solid_of, const TipTask& task, const int* particle,
                 int count) {
    const Particles<Real, 2>& p = s.particles;
    alignas(64) int at[lanes];
    std::copy_n(particle, lanes, at);
    const double *X = p.x[0].data(), *Y = p.x[1].data();
    const Real *VX = p.v[0].data(), *VY = p.v[1].data();
    const Real *M = p.mass.data(), *SX = p.stress[0].data(), *SY = p.stress[1].data(), *SXY = p.stress[2].data();
    const double *A = p.F[0].data(), *B = p.F[1].data(), *C = p.F[2].data(), *D = p.F[3].data();
    const JDomain d = task.domain;
    const double half = 0.5 * task.kinetic();
    const MeanMotion drift = task.drift;
    exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
      const int i = at[k];
      const auto& solid = solid_of(k);
      const Vec2 r{X[i] - d.tip.x, Y[i] - d.tip.y};
      const JWeight q = d.at(r);
      const Vec2 g = q.gradient();
      LawState<Real> state{};
      state.F = {A[i], B[i], C[i], D[i]};
      state.J = det(state.F);
      state.xx = SX[i];
      state.yy = SY[i];
      state.xy = SXY[i];
      const Vec2 mean = drift.at(r);
      const double m = (k < count ? 1.0 : 0.0) * M[i], v0 = VX[i] - mean.x, v1 = VY[i] - mean.y;
      const double first = m * solid.specific_area, area = first * state.J;
      filled[right][k] += q.edge_x == right ? area * q.slope_x : 0;
      filled[left][k] += q.edge_x == left ? area * q.slope_x : 0;
      filled[top][k] += q.edge_y == top ? area * q.slope_y : 0;
      filled[bottom][k] += q.edge_y == bottom ? area * q.slope_y : 0;
      rx[k] = r.x;
      ry[k] = r.y;
      gx[k] = g.x;
      gy[k] = g.y;
      vx[k] = v0;
      vy[k] = v1;
      mass[k] = m * solid.inv_thickness;
      first_area[k] = first;
      energy[k] = half * (v0 * v0 + v1 * v1) + solid.law.energy(state);
      sxx[k] = state.xx;
      syy[k] = state.yy;
      sxy[k] = state.xy;
      Fxx[k] = state.F.xx;
      Fxy[k] = state.F.xy;
      Fyx[k] = state.F.yx;
      Fyy[k] = state.F.yy;
    });
  }

  static double sum(const double* value) {
    double total = 0;
    for (int k = 0; k < lanes; ++k)
      total += value[k];
    return total;
  }

  alignas(64) double sum_x[lanes] = {}, sum_y[lanes] = {}, filled[4][lanes] = {}, interaction[2][lanes] = {};
};

}  // namespace riven
