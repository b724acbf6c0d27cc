#include "kernels/j_integral.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/exec/parallel.hpp"
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
    const auto take = [&](int first, int last) { add(task, first, last); };
    const int* start = s_.particles.tiles.cell_start.data();
    for (int j = j0; j <= j1; ++j) {
      if (task.inertia || j < m0 || j > m1 || k0 > k1) {
        each_stretch_of_row(l, start, j, i0, i1, take);
      } else {
        each_stretch_of_row(l, start, j, i0, k0 - 1, take);
        each_stretch_of_row(l, start, j, k1 + 1, i1, take);
      }
    }
    for (int e = 0; e < 4; ++e)
      task.sums.filled[e] /= d.length(e);
  }

 private:
  void add(TipTask& task, int first, int last) const {
    const Particles<Real, 2>& p = s_.particles;
    const JDomain& d = task.domain;
    for (int i = first; i < last; ++i) {
      const Vec2 r = Vec2{double(p.x[0][i]), double(p.x[1][i])} - d.tip;
      const JWeight q = d.at(r);
      if (q.slope_x > 0 || q.slope_y > 0)
        add_band(task, i, r, q);
      if (task.inertia)
        add_inertia(task, i, r);
    }
  }

  void add_band(TipTask& task, int i, Vec2 r, const JWeight& q) const {
    const Particles<Real, 2>& p = s_.particles;
    const LawState<Real> state = law_state<Law>(p, i);
    const Mat2<double> F{state.F.xx, state.F.xy, state.F.yx, state.F.yy};
    const int body = p.body[i];
    const double m = p.mass[i] / s_.thickness[body];
    const Vec2 v{double(p.v[0][i]), double(p.v[1][i])}, g = q.gradient();
    const double density = 0.5 * dot(v, v) + law_.of(i).energy(state);
    const Vec2 s{state.xx * g.x + state.xy * g.y, state.xy * g.x + state.yy * g.y};
    const Vec2 F_g{F.xx * g.x + F.yx * g.y, F.xy * g.x + F.yy * g.y};
    const Mat2<double> H = task.gradient(F);
    const Vec2 H_s{H.xx * s.x + H.yx * s.y, H.xy * s.x + H.yy * s.y};
    task.sums.J -= m * (density * F_g - H_s);
    const double area = p.mass[i] * s_.specific_area[body] * state.J;
    task.sums.filled[q.edge_x] += area * q.slope_x;
    task.sums.filled[q.edge_y] += area * q.slope_y;
    if (task.interaction)
      add_interaction(task, state, H, m, p.mass[i] * s_.specific_area[body], r, g, v);
  }

  void add_interaction(TipTask& task, const LawState<Real>& p, const Mat2<double>& H, double m, double area, Vec2 r,
                       Vec2 g, Vec2 v) const {
    const Vec2 t = task.heading, n = turned(t);
    const Vec2 local{dot(r, t), dot(r, n)}, q{dot(g, t), dot(g, n)};
    // displacement gradient, in what has turned with the tip, and stress, in the tip's frame
    const Vec2 t0{task.turn.x * t.x + task.turn.y * t.y, task.turn.x * t.y - task.turn.y * t.x};
    const Vec2 ut{H.xx * t0.x + H.xy * t0.y, H.yx * t0.x + H.yy * t0.y};
    const double u1 = dot(ut, t), u2 = dot(ut, n);
    const Vec2 st{p.xx * t.x + p.xy * t.y, p.xy * t.x + p.yy * t.y};
    // velocity times that of the running field, which is - speed du/dx
    const double vx = -task.running.speed * dot(v, t), vy = -task.running.speed * dot(v, n);
    const double sxx = dot(st, t), sxy = dot(st, n), syy = p.xx + p.yy - sxx;
    const AuxiliaryFields known = auxiliary_fields(*task.solid, task.running, local);
    for (int mode = 0; mode < 2; ++mode) {
      const AuxiliaryField& a = known.mode[mode];
      const double energy = sxx * a.exx + syy * a.eyy + 2 * sxy * a.exy + vx * a.dux_dx + vy * a.duy_dx;
      // the actual stress is per mass, the auxiliary one per volume
      const double own = q.x * (sxx * a.dux_dx + sxy * a.duy_dx) + q.y * (sxy * a.dux_dx + syy * a.duy_dx);
      const double other = q.x * (a.sxx * u1 + a.sxy * u2) + q.y * (a.sxy * u1 + a.syy * u2);
      task.sums.interaction[mode] += m * (own - energy * q.x) + area * other;
    }
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
