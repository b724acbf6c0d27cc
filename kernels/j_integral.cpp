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
#include "kernels/j_area.hpp"
#include "kernels/j_band.hpp"

namespace riven {

namespace {

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

  /// Lists the particles in the cells of the domain. Unless the area is summed those where q is 1 all around are left
  /// out.
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
      if (task.sums_area() || j < m0 || j > m1 || k0 > k1) {
        each_stretch_of_row(l, start, j, i0, i1, take);
      } else {
        each_stretch_of_row(l, start, j, i0, k0 - 1, take);
        each_stretch_of_row(l, start, j, k1 + 1, i1, take);
      }
    }
  }

  /// Meanwhile asks for the data of the next tip.
  void sum(TipTask& task, const Patch& patch, Patch& next) const {
    Sums sums(task, next);
    if (task.kinetic() > 0)
      task.drift = mean_motion(task.domain, patch);
    with_flag(task.sums_area(), [&](auto area) {
      for (const auto [first, last] : patch.stretches)
        look<decltype(area)::value>(sums, first, last);
    });
    sum_band(sums);
    sum_area(sums);
    for (int e = 0; e < 4; ++e)
      task.sums.filled[e] /= task.domain.length(e);
  }

 private:
  static constexpr int lanes = exec::lanes;
  static constexpr int line = 64 / sizeof(double);  ///< particles of which a line of memory holds one number each

  struct Chosen {
    static constexpr int most = 512;
    int count = 0;
    int particle[most + lanes];

    bool full() const { return count > most - lanes; }
    void take(int first, int n, const std::int64_t* taken) {
      for (int k = 0; k < n; ++k) {
        particle[count] = first + k;
        count += static_cast<int>(taken[k]);
      }
    }
    void fill_last_lanes() {
      if (count > 0)
        std::fill_n(particle + count, lanes, particle[count - 1]);
    }
  };

  struct Sums {
    TipTask& task;
    Patch& next;
    Chosen band;  ///< where q falls
    Chosen area;  ///< where q is not zero
    // leaves the lists as they are: to zero them would cost as much as to fill them
    Sums(TipTask& to_fill, Patch& to_ask_for) : task(to_fill), next(to_ask_for) {}
  };

  /// Of the particles on which q falls: the rigid motion with their momentum and angular momentum.
  MeanMotion mean_motion(const JDomain& d, const Patch& patch) const {
    const Particles<Real, 2>& p = s_.particles;
    double mass = 0, inertia = 0, turning = 0;  // the latter two about the tip
    Vec2 moment, momentum;
    for (const auto [first, last] : patch.stretches)
      for (int k = first; k < last; ++k) {
        const Vec2 r{p.x[0][k] - d.tip.x, p.x[1][k] - d.tip.y};
        if (const double q = d.weight(r); q > 0 && q < 1) {
          const double m = p.mass[k];
          const Vec2 v{p.v[0][k], p.v[1][k]};
          mass += m;
          moment += m * r;
          momentum += m * v;
          inertia += m * dot(r, r);
          turning += m * cross(r, v);
        }
      }
    if (!(mass > 0))
      return {};
    const Vec2 centre = moment * (1 / mass), mean = momentum * (1 / mass);
    const double about_centre = inertia - mass * dot(centre, centre);
    MeanMotion motion{mean, about_centre > 0 ? (turning - cross(moment, mean)) / about_centre : 0};
    motion.at_tip -= motion.spin * turned(centre);
    return motion;
  }

  /// Chooses particles of the band, and of the area where that is asked for.
  template <bool Area>
  void look(Sums& sums, int first, int last) const {
    const JDomain d = sums.task.domain;
    const double outer[4] = {d.outer(right), d.outer(top), -d.outer(left), -d.outer(bottom)};
    const double inner[4] = {d.inner(right), d.inner(top), -d.inner(left), -d.inner(bottom)};
    for (int at = first; at < last; at += lanes) {
      const double *x = s_.particles.x[0].data() + at, *y = s_.particles.x[1].data() + at;
      alignas(64) std::int64_t falls[lanes], weighs[lanes];
      exec::for_lanes(lanes, [&](int k) RIVEN_LANE {
        const double rx = x[k] - d.tip.x, ry = y[k] - d.tip.y;
        const bool inside = (rx > outer[left]) & (rx < outer[right]) & (ry > outer[bottom]) & (ry < outer[top]);
        const bool full = (rx >= inner[left]) & (rx <= inner[right]) & (ry >= inner[bottom]) & (ry <= inner[top]);
        falls[k] = inside & !full;
        if constexpr (Area)
          weighs[k] = inside;
      });
      const int count = std::min(lanes, last - at);
      if (sums.band.full())
        sum_band(sums);
      sums.band.take(at, count, falls);
      if constexpr (Area) {
        if (sums.area.full())
          sum_area(sums);
        sums.area.take(at, count, weighs);
      }
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

  void sum_band(Sums& sums) const {
    Chosen& chosen = sums.band;
    TipTask& task = sums.task;
    chosen.fill_last_lanes();
    const int share = sums.next.left() * lanes / (3 * std::max(1, chosen.count)) + 1;
    Band band;
    for (int k = 0; k < chosen.count; k += lanes) {
      band.take(s_, law_, task, chosen.particle + k, std::min(lanes, chosen.count - k));
      ask_for(sums.next, share);
      band.add_j(task);
      ask_for(sums.next, share);
      if (task.interaction)
        with_fields(*task.solid, task.running, [&](const auto& fields) { band.add_interaction(task, fields); });
      ask_for(sums.next, share);
    }
    band.add_to(task.sums);
    chosen.count = 0;
  }

  void sum_area(Sums& sums) const {
    Chosen& chosen = sums.area;
    if (chosen.count == 0)
      return;
    chosen.fill_last_lanes();
    AreaSums<Shape, Real> area;
    for (int k = 0; k < chosen.count; k += lanes)
      area.add(s_, slots_, sums.task, chosen.particle + k, std::min(lanes, chosen.count - k));
    area.add_to(sums.task.sums);
    chosen.count = 0;
  }

  const State<Real, 2>& s_;
  FieldSlots slots_;
  BodyLookup<Law> law_;
};

/// Tips in the order in which their particles lie in memory. They lie far apart there: a thread takes some that follow
/// each other, and asks for the data of the next one in time.
std::vector<size_t> by_place(const Lattice& l, const std::vector<Vec2>& tips) {
  std::vector<std::pair<int, size_t>> places;
  places.reserve(tips.size());
  for (const Vec2 tip : tips) {
    const Vec2 X = (tip - l.origin) * (1 / l.h);
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
void sum_tips(const exec::Space& space, const State<Real, 2>& s, const std::vector<Vec2>& tips,
              const TipQuestions& ask) {
  if constexpr (Law::keeps_F) {
    using Patch = typename TipSummer<Shape, Law, Real>::Patch;
    const TipSummer<Shape, Law, Real> summer(s);
    const SurfaceView view = surface_view(s.grid.lattice, s.cracks, s.fields);
    const SegmentsByCell segments(Shape{}, s.grid.lattice, s.cracks);
    const std::vector<size_t> order = by_place(s.grid.lattice, tips);
    const size_t n = tips.size(), threads = static_cast<size_t>(space.threads());
    const size_t block = std::min<size_t>(16, (n + threads - 1) / threads);  // a few tips keep all threads busy
    exec::parallel_tasks(space, "J integral", static_cast<long>((n + block - 1) / block), [&](long b) {
      const size_t first = static_cast<size_t>(b) * block, last = std::min(n, first + block);
      TipTask task, next = ask.place(order[first]);
      Patch patch, next_patch;
      summer.list(next, next_patch);
      for (size_t k = first; k < last; ++k) {
        std::swap(task, next);
        std::swap(patch, next_patch);
        if (k + 1 < last) {
          next = ask.place(order[k + 1]);
          summer.list(next, next_patch);
        }
        for (;;) {
          summer.sum(task, patch, next_patch);
          FaceIntegral<Shape, Law, Real>(s, view, segments, task).add();
          if (!ask.take(order[k], task))
            break;
          task = ask.place(order[k]);
          summer.list(task, patch);
        }
      }
    });
  } else {
    fail({Exit::internal, "J was not planned for: displacement gradients are not kept", "J integral", {}, {}, {}});
  }
}

}  // namespace

template <class Real>
void sum_around_tips(const exec::Space& space, const Plan& plan, const State<Real, 2>& s, const std::vector<Vec2>& tips,
                     const TipQuestions& ask) {
  with_shape(plan.shape, [&](auto shape) {
    with_law<Real>(plan.law, [&](auto law) {
      sum_tips<typename decltype(shape)::type, typename decltype(law)::type>(space, s, tips, ask);
    });
  });
}

#define RIVEN_J_INTEGRAL(Real)                                                                                    \
  template void sum_around_tips(const exec::Space&, const Plan&, const State<Real, 2>&, const std::vector<Vec2>&, \
                                const TipQuestions&);
RIVEN_EACH_REAL(RIVEN_J_INTEGRAL)
#undef RIVEN_J_INTEGRAL

}  // namespace riven
