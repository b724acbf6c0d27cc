#include "kernels/j_integral.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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
  const auto a = Shape::axis((s.particles.x[0][p] - l.origin.x) / l.h, d.axis[0]);
  const auto b = Shape::axis((s.particles.x[1][p] - l.origin.y) / l.h, d.axis[1]);
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

  /// The particles in the cells of a tip's domain.
  struct Patch {
    struct Stretch {
      int first, last;
    };
    std::vector<Stretch> stretches;
    std::vector<int> lines;  ///< first particles of the lines of memory that hold theirs
    size_t asked = 0;        ///< of these
    int left() const { return static_cast<int>(lines.size() - asked); }
  };

  /// Lists the particles in the cells of the domain. Without inertia those where q is 1 all around are left out.
  void list(const TipTask& task, Patch& patch) const {
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
    patch.stretches.clear();
    patch.lines.clear();
    patch.asked = 0;
    const auto take = [&](int first, int last) {
      patch.stretches.push_back({first, last});
      for (int at = first / line * line; at < last; at += line)
        patch.lines.push_back(at);
    };
    const int* start = s_.particles.tiles.cell_start.data();
    for (int j = j0; j <= j1; ++j) {
      if (task.inertia || j < m0 || j > m1 || k0 > k1) {
        each_stretch_of_row(l, start, j, i0, i1, take);
      } else {
        each_stretch_of_row(l, start, j, i0, k0 - 1, take);
        each_stretch_of_row(l, start, j, k1 + 1, i1, take);
      }
    }
  }

  /// Meanwhile asks for the data of the next tip.
  void sum(TipTask& task, const Patch& patch, Patch& next) const {
    Chosen chosen;
    for (const auto [first, last] : patch.stretches)
      look(task, chosen, first, last, next);
    sum_chosen(task, chosen, next);
    for (int e = 0; e < 4; ++e)
      task.sums.filled[e] /= task.domain.length(e);
  }

 private:
  static constexpr int lanes = exec::lanes;
  static constexpr int line = 64 / sizeof(double);  ///< particles of which a line of memory holds one number each

  /// Particles on which q falls.
  struct Chosen {
    static constexpr int most = 512;
    int count = 0;
    int particle[most + lanes];
  };

  void look(TipTask& task, Chosen& chosen, int first, int last, Patch& next) const {
    const JDomain d = task.domain;
    const double outer[4] = {d.outer(right), d.outer(top), -d.outer(left), -d.outer(bottom)};
    const double inner[4] = {d.inner(right), d.inner(top), -d.inner(left), -d.inner(bottom)};
    for (int at = first; at < last; at += lanes) {
      const double *x = s_.particles.x[0].data() + at, *y = s_.particles.x[1].data() + at;
      alignas(64) std::int64_t falls[lanes];
      exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
        const double rx = x[k] - d.tip.x, ry = y[k] - d.tip.y;
        const bool inside = (rx > outer[left]) & (rx < outer[right]) & (ry > outer[bottom]) & (ry < outer[top]);
        const bool full = (rx >= inner[left]) & (rx <= inner[right]) & (ry >= inner[bottom]) & (ry <= inner[top]);
        falls[k] = inside & !full;
      });
      if (chosen.count > Chosen::most - lanes)
        sum_chosen(task, chosen, next);
      const int count = std::min(lanes, last - at);
      for (int k = 0; k < count; ++k) {
        chosen.particle[chosen.count] = at + k;
        chosen.count += static_cast<int>(falls[k]);
      }
      if (task.inertia)
        for (int k = 0; k < count; ++k)
          add_inertia(task, at + k, {x[k] - d.tip.x, y[k] - d.tip.y});
    }
  }

  /// Asks for some of the lines that are left. A few at a time: a core can wait for a score of them at once, and drops
  /// what it is asked for beyond these.
  void ask_for(Patch& patch, int lines) const {
    const Particles<Real, 2>& p = s_.particles;
    const size_t first = patch.asked, end = std::min(patch.lines.size(), first + static_cast<size_t>(lines));
    for (size_t k = first; k < end; ++k) {
      ask_for_line(patch.lines[k], p.x[0], p.x[1], p.v[0], p.v[1], p.F[0], p.F[1], p.F[2], p.F[3], p.stress[0],
                   p.stress[1], p.stress[2], p.mass, p.body, s_.fields.fields);
    }
    patch.asked = end;
  }
  template <class... Arrays>
  static RIVEN_INLINE void ask_for_line(int first, const Arrays&... arrays) {
    (exec::prefetch_far(arrays.data() + first), ...);
  }

  void sum_chosen(TipTask& task, Chosen& chosen, Patch& next) const {
    if (chosen.count > 0)
      std::fill_n(chosen.particle + chosen.count, lanes, chosen.particle[chosen.count - 1]);
    const int share = next.left() * lanes / (3 * std::max(1, chosen.count)) + 1;
    Band band;
    for (int k = 0; k < chosen.count; k += lanes) {
      band.take(s_, law_, task.domain, chosen.particle + k, std::min(lanes, chosen.count - k));
      ask_for(next, share);
      band.add_j(task);
      ask_for(next, share);
      if (task.interaction)
        with_fields(*task.solid, task.running, [&](const auto& fields) { band.add_interaction(task, fields); });
      ask_for(next, share);
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
    const Mat2<double> F{p.F[0][i], p.F[1][i], p.F[2][i], p.F[3][i]};
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

/// Tips in the order in which their particles lie in memory. They lie far apart there: a thread takes some that follow
/// each other, and asks for the data of the next one in time.
std::vector<size_t> by_place(const Lattice& l, const std::vector<TipTask>& tasks) {
  std::vector<std::pair<int, size_t>> places;
  places.reserve(tasks.size());
  for (const TipTask& task : tasks) {
    const Vec2 X = (task.domain.tip - l.origin) * (1 / l.h);
    places.emplace_back(l.sorted_cell(static_cast<int>(X.x), static_cast<int>(X.y)), places.size());
  }
  std::sort(places.begin(), places.end());
  std::vector<size_t> order;
  order.reserve(places.size());
  for (const auto& [cell, tip] : places)
    order.push_back(tip);
  return order;
}

template <class Shape, class Law, class Real>
void sum_tasks(const exec::Space& space, const State<Real, 2>& s, std::vector<TipTask>& tasks) {
  if constexpr (Law::keeps_F) {
    const TipSummer<Shape, Law, Real> summer(s);
    const SurfaceView view = surface_view(s.grid.lattice, s.cracks, s.fields);
    const SegmentsByCell segments(Shape{}, s.grid.lattice, s.cracks);
    const std::vector<size_t> order = by_place(s.grid.lattice, tasks);
    const size_t n = tasks.size(), threads = static_cast<size_t>(space.threads());
    const size_t block = std::min<size_t>(16, (n + threads - 1) / threads);  // a few tips keep all threads busy
    exec::parallel_tasks(space, "J integral", static_cast<long>((n + block - 1) / block), [&](long b) {
      const size_t first = static_cast<size_t>(b) * block, last = std::min(n, first + block);
      typename TipSummer<Shape, Law, Real>::Patch now, next;
      summer.list(tasks[order[first]], next);
      for (size_t k = first; k < last; ++k) {
        std::swap(now, next);
        if (k + 1 < last)
          summer.list(tasks[order[k + 1]], next);
        TipTask& task = tasks[order[k]];
        task.sums = {};
        summer.sum(task, now, next);
        FaceIntegral<Shape, Law, Real>(s, view, segments, task).add();
      }
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

#define RIVEN_J_INTEGRAL(Real) \
  template void sum_around_tips(const exec::Space&, const Plan&, const State<Real, 2>&, std::vector<TipTask>&);
RIVEN_EACH_REAL(RIVEN_J_INTEGRAL)
#undef RIVEN_J_INTEGRAL

}  // namespace riven
