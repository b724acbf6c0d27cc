#include "kernels/j_integral.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/exec/parallel.hpp"
#include "core/fracture/auxiliary_fields.hpp"
#include "kernels/cell_rows.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/face_integral.hpp"
#include "kernels/field_slots.hpp"
#include "kernels/law_state.hpp"

namespace riven {

namespace {

/// Velocity gradient and acceleration of a particle from the advanced grid.
struct Motion {
  Mat2<double> grad{0, 0, 0, 0};
  Vec2 acceleration;
};

template <class Shape, class Real>
Motion motion_of(const State<Real, 2>& s, const FieldSlots& slots, long p) {
  const Lattice& l = s.grid.lattice;
  const DomainSetting<Real, 2>& d = s.domains[s.particles.body[p]];
  const auto a = Shape::axis(Real((s.particles.x[0][p] - l.origin.x) / l.h), d.axis[0]);
  const auto b = Shape::axis(Real((s.particles.x[1][p] - l.origin.y) / l.h), d.axis[1]);
  const std::uint32_t word = s.fields.fields[p];
  Motion m;
  for (int j = 0; j < Shape::width; ++j)
    for (int i = 0; i < Shape::width; ++i) {
      const int node = (b.base + j) * l.nx + a.base + i;
      const Real* q = s.grid.q.data() + 4 * slots.of(node, CrackFields::field_of(word, j * Shape::width + i));
      const double S = a.s[i] * b.s[j], gx = a.g[i] * b.s[j] / l.h, gy = a.s[i] * b.g[j] / l.h;
      m.grad.xx += q[0] * gx;
      m.grad.xy += q[0] * gy;
      m.grad.yx += q[1] * gx;
      m.grad.yy += q[1] * gy;
      m.acceleration += Vec2{S * q[2], S * q[3]};
    }
  return m;
}

/// Particles on which q falls, gathered so that the sums over them are vector instructions.
struct Band {
  static constexpr int lanes = exec::lanes;
  int count = 0;
  alignas(64) double rx[lanes], ry[lanes];  ///< m, from the tip
  alignas(64) double gx[lanes], gy[lanes];  ///< 1/m, gradient of q
  alignas(64) double vx[lanes], vy[lanes];
  alignas(64) double mass[lanes];                         ///< kg/m, per thickness
  alignas(64) double first_area[lanes];                   ///< m^2
  alignas(64) double energy[lanes];                       ///< m^2/s^2, strain and kinetic energy per mass
  alignas(64) double sxx[lanes], syy[lanes], sxy[lanes];  ///< m^2/s^2, Kirchhoff stress per mass
  alignas(64) double Fxx[lanes], Fxy[lanes], Fyx[lanes], Fyy[lanes];

  /// Lanes that no particle was found for weigh nothing.
  void pad() {
    for (int k = count; k < lanes; ++k) {
      rx[k] = 1;
      ry[k] = gx[k] = gy[k] = vx[k] = vy[k] = mass[k] = first_area[k] = energy[k] = sxx[k] = syy[k] = sxy[k] = 0;
      Fxx[k] = Fxy[k] = Fyx[k] = Fyy[k] = 0;
    }
  }

  /// - sum a_p E_Kj dq/dx_j
  Vec2 J(const TipTask& task) const {
    alignas(64) double x[lanes], y[lanes];
    exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
      const double sx = sxx[k] * gx[k] + sxy[k] * gy[k], sy = sxy[k] * gx[k] + syy[k] * gy[k];
      const Mat2<double> H = task.gradient(Mat2<double>{Fxx[k], Fxy[k], Fyx[k], Fyy[k]});
      x[k] = mass[k] * (H.xx * sx + H.yx * sy - energy[k] * (Fxx[k] * gx[k] + Fyx[k] * gy[k]));
      y[k] = mass[k] * (H.xy * sx + H.yy * sy - energy[k] * (Fxy[k] * gx[k] + Fyy[k] * gy[k]));
    });
    return {sum(x), sum(y)};
  }

  /// Interaction of the actual fields with known ones, in the tip's frame; the displacement gradient is that in what
  /// has turned with the tip. The actual stress is per mass, the known one per volume.
  template <class Fields>
  void add_interaction(TipTask& task, const Fields& fields) const {
    alignas(64) double value[2][lanes];
    const Vec2 t = task.heading, n = turned(t);
    const Vec2 t0{task.turn.x * t.x + task.turn.y * t.y, task.turn.x * t.y - task.turn.y * t.x};
    const double speed = task.running.speed;
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
        value[mode][k] = mass[k] * (own - work * q1) + first_area[k] * other;
      }
    });
    task.sums.interaction[0] += sum(value[0]);
    task.sums.interaction[1] += sum(value[1]);
  }

 private:
  static double sum(const double* value) {
    double total = 0;
    for (int k = 0; k < lanes; ++k)
      total += value[k];
    return total;
  }
};

template <class Shape, class Law, class Real>
class TipSummer {
 public:
  explicit TipSummer(const State<Real, 2>& s) : s_(s), slots_(s.fields, s.grid.lattice.nodes()), law_(laws<Law>(s)) {}

  /// Particles in the cells of the domain. Without inertia those where q is 1 all around are left out.
  void sum(TipTask& task) const {
    const Lattice& l = s_.grid.lattice;
    const JDomain& d = task.domain;
    const Vec2 c = (d.tip - l.origin) * (1 / l.h);
    const double drift = s_.watch.drift / l.h + 1e-6, inv = 1 / l.h;
    const auto cell = [&](double X) { return Shape::cell(X); };
    const int i0 = cell(c.x - d.outer(left) * inv - drift), i1 = cell(c.x + d.outer(right) * inv + drift);
    const int j0 = cell(c.y - d.outer(bottom) * inv - drift), j1 = cell(c.y + d.outer(top) * inv + drift);
    // cells that lie, whole, where q is 1
    const int k0 = cell(c.x - d.inner(left) * inv + drift) + 1, k1 = cell(c.x + d.inner(right) * inv - drift) - 1;
    const int m0 = cell(c.y - d.inner(bottom) * inv + drift) + 1, m1 = cell(c.y + d.inner(top) * inv - drift) - 1;
    FoundList found;
    const auto take = [&](int first, int last) { look(task, found, first, last); };
    const int* start = s_.particles.tiles.cell_start.data();
    for (int j = j0; j <= j1; ++j) {
      if (task.inertia || j < m0 || j > m1 || k0 > k1) {
        each_stretch_of_row(l, start, j, i0, i1, take);
      } else {
        each_stretch_of_row(l, start, j, i0, k0 - 1, take);
        each_stretch_of_row(l, start, j, k1 + 1, i1, take);
      }
    }
    sum_found(task, found);
    for (int e = 0; e < 4; ++e)
      task.sums.filled[e] /= d.length(e);
  }

 private:
  /// A particle on which q falls.
  struct Found {
    int particle;
    Vec2 r;
    JWeight q;
  };
  struct FoundList {
    static constexpr int most = 256;
    int count = 0;
    Found item[most];
  };

  void look(TipTask& task, FoundList& found, int first, int last) const {
    const Particles<Real, 2>& p = s_.particles;
    for (int i = first; i < last; ++i) {
      const Vec2 r = Vec2{double(p.x[0][i]), double(p.x[1][i])} - task.domain.tip;
      const JWeight q = task.domain.at(r);
      if (q.slope_x > 0 || q.slope_y > 0) {
        if (found.count == FoundList::most)
          sum_found(task, found);
        ask_for(i);
        found.item[found.count++] = {i, r, q};
      }
      if (task.inertia)
        add_inertia(task, i, r);
    }
  }

  /// Tips lie far apart in memory, so that their particles are waited for unless asked for beforehand.
  void ask_for(int i) const {
    const Particles<Real, 2>& p = s_.particles;
    for (const Real* array : {p.F[0].data(), p.F[1].data(), p.F[2].data(), p.F[3].data(), p.stress[0].data(),
                              p.stress[1].data(), p.stress[2].data(), p.v[0].data(), p.v[1].data(), p.mass.data()})
      exec::prefetch(array + i);
    exec::prefetch(p.body.data() + i);
  }

  void sum_found(TipTask& task, FoundList& found) const {
    Band band;
    for (int k = 0; k < found.count; ++k) {
      gather(task, band, found.item[k]);
      if (band.count == Band::lanes)
        sum_band(task, band);
    }
    sum_band(task, band);
    found.count = 0;
  }

  void gather(TipTask& task, Band& band, const Found& found) const {
    const Particles<Real, 2>& p = s_.particles;
    const auto& [i, r, q] = found;
    const LawState<Real> state = law_state<Law>(p, i);
    const int body = p.body[i], k = band.count++;
    const Vec2 v{double(p.v[0][i]), double(p.v[1][i])}, g = q.gradient();
    const double area = p.mass[i] * s_.specific_area[body] * state.J;
    task.sums.filled[q.edge_x] += area * q.slope_x;
    task.sums.filled[q.edge_y] += area * q.slope_y;
    band.rx[k] = r.x;
    band.ry[k] = r.y;
    band.gx[k] = g.x;
    band.gy[k] = g.y;
    band.vx[k] = v.x;
    band.vy[k] = v.y;
    band.mass[k] = p.mass[i] / s_.thickness[body];
    band.first_area[k] = p.mass[i] * s_.specific_area[body];
    band.energy[k] = 0.5 * dot(v, v) + law_.of(i).energy(state);
    band.sxx[k] = state.xx;
    band.syy[k] = state.yy;
    band.sxy[k] = state.xy;
    band.Fxx[k] = state.F.xx;
    band.Fxy[k] = state.F.xy;
    band.Fyx[k] = state.F.yx;
    band.Fyy[k] = state.F.yy;
  }

  static void sum_band(TipTask& task, Band& band) {
    if (band.count == 0)
      return;
    band.pad();
    task.sums.J += band.J(task);
    if (task.interaction)
      with_fields(*task.solid, task.running, [&](const auto& fields) { band.add_interaction(task, fields); });
    band.count = 0;
  }

  void add_inertia(TipTask& task, int i, Vec2 r) const {
    const double q = task.domain.weight(r);
    if (!(q > 0))
      return;
    const Particles<Real, 2>& p = s_.particles;
    const Motion motion = motion_of<Shape>(s_, slots_, i);
    const Mat2<double> F{double(p.F[0][i]), double(p.F[1][i]), double(p.F[2][i]), double(p.F[3][i])};
    const Mat2<double> rate = motion.grad * F, H = task.gradient(F);
    const Vec2 a = motion.acceleration, v{double(p.v[0][i]), double(p.v[1][i])};
    const double m = q * p.mass[i] / s_.thickness[p.body[i]];
    task.sums.inertia += m * Vec2{H.xx * a.x + H.yx * a.y - rate.xx * v.x - rate.yx * v.y,
                                  H.xy * a.x + H.yy * a.y - rate.xy * v.x - rate.yy * v.y};
    if (task.interaction && task.running.speed == 0)
      add_interaction_inertia(task, m * a, r);
  }

  /// With known fields at rest rho a_i du_i/dx alone is left of P. Around a tip that runs at one speed, with all fields
  /// about it, the parts of P cancel; between the two none of them is taken.
  void add_interaction_inertia(TipTask& task, Vec2 force, Vec2 r) const {
    const Vec2 t = task.heading, n = turned(t);
    const AuxiliaryFields known = auxiliary_fields(*task.solid, task.running, Vec2{dot(r, t), dot(r, n)});
    for (int mode = 0; mode < 2; ++mode) {
      const AuxiliaryField& a = known.mode[mode];
      task.sums.interaction[mode] += dot(force, t) * a.dux_dx + dot(force, n) * a.duy_dx;
    }
  }

  const State<Real, 2>& s_;
  FieldSlots slots_;
  BodyLookup<Law> law_;
};

template <class Shape, class Law, class Real>
void sum_tasks(const exec::Space& space, const State<Real, 2>& s, std::vector<TipTask>& tasks) {
  if constexpr (Law::keeps_F) {
    const TipSummer<Shape, Law, Real> summer(s);
    const SurfaceView view = surface_view(s.grid.lattice, s.cracks, s.fields);
    exec::parallel_tasks(space, "J integral", static_cast<long>(tasks.size()), [&](long k) {
      TipTask& task = tasks[static_cast<size_t>(k)];
      task.sums = {};
      summer.sum(task);
      FaceIntegral<Shape, Law, Real>(s, view, task).add();
    });
  } else {
    fail({Exit::internal, "J was not planned for: displacement gradients are not kept", "J integral", {}, {}, {}});
  }
}

}  // namespace

template <class Real>
void sum_around_tips(const exec::Space& space, const Plan& plan, const State<Real, 2>& s, std::vector<TipTask>& tasks) {
  with_shape(plan.shape, [&](auto shape) {
    with_law<Real>(plan.law, [&](auto law) {
      sum_tasks<typename decltype(shape)::type, typename decltype(law)::type>(space, s, tasks);
    });
  });
}

template void sum_around_tips(const exec::Space&, const Plan&, const State<double, 2>&, std::vector<TipTask>&);

}  // namespace riven
