#include "kernels/j_integral.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/exec/parallel.hpp"
#include "core/fracture/auxiliary_fields.hpp"
#include "kernels/cell_rows.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/face_integral.hpp"
#include "kernels/field_slots.hpp"
#include "kernels/j_band.hpp"

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
    Chosen chosen;
    const auto take = [&](int first, int last) { look(task, chosen, first, last); };
    const int* start = s_.particles.tiles.cell_start.data();
    for (int j = j0; j <= j1; ++j) {
      if (task.inertia || j < m0 || j > m1 || k0 > k1) {
        each_stretch_of_row(l, start, j, i0, i1, take);
      } else {
        each_stretch_of_row(l, start, j, i0, k0 - 1, take);
        each_stretch_of_row(l, start, j, k1 + 1, i1, take);
      }
    }
    sum_chosen(task, chosen);
    for (int e = 0; e < 4; ++e)
      task.sums.filled[e] /= d.length(e);
  }

 private:
  static constexpr int lanes = exec::lanes;

  /// Particles on which q falls.
  struct Chosen {
    static constexpr int most = 512;
    int count = 0;
    int particle[most + lanes];
  };

  void look(TipTask& task, Chosen& chosen, int first, int last) const {
    const JDomain d = task.domain;
    const double outer[4] = {d.outer(right), d.outer(top), -d.outer(left), -d.outer(bottom)};
    const double inner[4] = {d.inner(right), d.inner(top), -d.inner(left), -d.inner(bottom)};
    for (int at = first; at < last; at += lanes) {
      const Real *x = s_.particles.x[0].data() + at, *y = s_.particles.x[1].data() + at;
      alignas(64) std::int64_t falls[lanes];
      exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
        const double rx = x[k] - d.tip.x, ry = y[k] - d.tip.y;
        const bool inside = (rx > outer[left]) & (rx < outer[right]) & (ry > outer[bottom]) & (ry < outer[top]);
        const bool full = (rx >= inner[left]) & (rx <= inner[right]) & (ry >= inner[bottom]) & (ry <= inner[top]);
        falls[k] = inside & !full;
      });
      if (chosen.count > Chosen::most - lanes)
        sum_chosen(task, chosen);
      const int count = std::min(lanes, last - at), before = chosen.count;
      for (int k = 0; k < count; ++k) {
        chosen.particle[chosen.count] = at + k;
        chosen.count += static_cast<int>(falls[k]);
      }
      if (chosen.count > before)
        ask_for(at);
      if (task.inertia)
        for (int k = 0; k < count; ++k)
          add_inertia(task, at + k, {x[k] - d.tip.x, y[k] - d.tip.y});
    }
  }

  /// Tips lie far apart in memory, so that their particles are waited for unless asked for beforehand.
  void ask_for(int first) const {
    const Particles<Real, 2>& p = s_.particles;
    constexpr int line = 64 / sizeof(Real);
    for (const Real* array : {p.F[0].data(), p.F[1].data(), p.F[2].data(), p.F[3].data(), p.stress[0].data(),
                              p.stress[1].data(), p.stress[2].data(), p.v[0].data(), p.v[1].data(), p.mass.data()})
      for (int k = 0; k < lanes; k += line)
        exec::prefetch(array + first + k);
    exec::prefetch(p.body.data() + first);
  }

  void sum_chosen(TipTask& task, Chosen& chosen) const {
    if (chosen.count > 0)
      std::fill_n(chosen.particle + chosen.count, lanes, chosen.particle[chosen.count - 1]);
    Band band;
    for (int k = 0; k < chosen.count; k += lanes) {
      band.take(s_, law_, task.domain, chosen.particle + k, std::min(lanes, chosen.count - k));
      band.add_j(task);
      if (task.interaction)
        with_fields(*task.solid, task.running, [&](const auto& fields) { band.add_interaction(task, fields); });
    }
    band.add_to(task.sums);
    chosen.count = 0;
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
    const SegmentsByCell segments(Shape{}, s.grid.lattice, s.cracks);
    exec::parallel_tasks(space, "J integral", static_cast<long>(tasks.size()), [&](long k) {
      TipTask& task = tasks[static_cast<size_t>(k)];
      task.sums = {};
      summer.sum(task);
      FaceIntegral<Shape, Law, Real>(s, view, segments, task).add();
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
