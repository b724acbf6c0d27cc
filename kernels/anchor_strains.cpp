#include "kernels/anchor_strains.hpp"

#include <cmath>
#include <type_traits>

#include "kernels/dispatch.hpp"
#include "kernels/law_state.hpp"
#include "kernels/stress_update.hpp"
#include "kernels/tiles.hpp"
#include "kernels/views.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// How far F goes at once: most of the way over some twenty sorts, five to ten cells. By a quarter of the way K in a
/// disk that turns comes 1 % nearer to that at rest. But where strains are steep, at tips, F then follows the places
/// that particles have in their cells: energy is lost 1.6 times as fast, and what a running tip leaves behind bears
/// twice as much, 1.6 % of the stress that it bore.
constexpr double strain_at_once = 0.05;

/// Ways that differ by more than this, in cells, are not those of one solid.
constexpr double not_one_solid = 0.1;

/// Numbers at the nodes: [m d_x, m d_y, m, m times a mark] while they are summed, then [d_x d_y body m], the mean
/// number of the particles' body, or `torn`; and [D_xx D_yx D_xy D_yy].
struct NodeNumbers {
  static constexpr int sum_mass = 2, sum_mark = 3, body = 2, mass = 3;
  static constexpr int torn = -1;  ///< some particles there were not one solid
};

/// Particles as this pass sees them.
template <class Real>
struct FirstPlaces {
  ParticleView<Real> p;
  const double *X, *Y;
  const std::uint8_t* body;

  RIVEN_INLINE Mat2<double> F(long i) const { return {p.Fxx[i], p.Fxy[i], p.Fyx[i], p.Fyy[i]}; }
  RIVEN_INLINE Vec2 place(long i) const { return {p.x[i], p.y[i]}; }
  RIVEN_INLINE Vec2 way(long i) const { return {X[i] - p.x[i], Y[i] - p.y[i]}; }
  RIVEN_INLINE double body_of(long i) const { return body[i]; }
};

template <class Real>
FirstPlaces<Real> first_places(State<Real, 2>& s) {
  return {view(s.particles), exec::data(std::as_const(s.particles.x0[0])), exec::data(std::as_const(s.particles.x0[1])),
          exec::data(std::as_const(s.particles.body))};
}

/// F^-1 - I.
RIVEN_INLINE Mat2<double> inverse_less_one(const Mat2<double>& F) {
  const Mat2<double> inverse = inverse_of_one_plus(Mat2<double>{F.xx - 1, F.xy, F.yx, F.yy - 1});
  return {inverse.xx - 1, inverse.xy, inverse.yx, inverse.yy - 1};
}

/// What the nodes know.
template <class Real>
struct NodeWays {
  const Real *ways, *gradients;
  Lattice lattice;

  struct Found {
    Vec2 d;
    Mat2<double> gradient{0, 0, 0, 0};
    bool other = false;  ///< some node has particles of another body, or is torn
  };

  /// At particle p, the k-th of a block.
  template <class Shape, class Slots>
  RIVEN_INLINE Found at(const Block<Real, Shape>& w, int k, const FirstPlaces<Real>& of, long p, Slots slots) const {
    constexpr int N = Shape::width;
    const Vec2 x = of.place(p);
    const double body = of.body_of(p);
    Found all;
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i) {
        long node = static_cast<long>(w.iy[k] + j) * lattice.nx + w.ix[k] + i;
        const Vec2 r = x - lattice.position(w.ix[k] + i, w.iy[k] + j);
        if constexpr (std::is_pointer_v<Slots>)
          node = slots[j * N + i];
        const Real *d = ways + 4 * node, *D = gradients + 4 * node;
        const double S = w.sx[i][k] * w.sy[j][k], Gx = w.gx[i][k] * w.sy[j][k], Gy = w.sx[i][k] * w.gy[j][k];
        const Vec2 from_here{d[0] + 0.5 * (D[0] * r.x + D[2] * r.y), d[1] + 0.5 * (D[1] * r.x + D[3] * r.y)};
        all.d += S * from_here;
        all.gradient.xx += Gx * from_here.x + 0.5 * S * D[0];
        all.gradient.yx += Gx * from_here.y + 0.5 * S * D[1];
        all.gradient.xy += Gy * from_here.x + 0.5 * S * D[2];
        all.gradient.yy += Gy * from_here.y + 0.5 * S * D[3];
        all.other = all.other || (S > 0 && std::fabs(d[NodeNumbers::body] - body) > 1e-3);
      }
    return all;
  }
};

/// A particle's way, its gradient, and a mark, as they are put to the nodes.
struct PutWay {
  Vec2 d;
  Mat2<double> gradient;
  double mark;
};

/// All of it; marked by the body.
template <class Real>
struct OwnWays {
  FirstPlaces<Real> of;

  template <class Shape, class Slots>
  RIVEN_INLINE PutWay put(const Block<Real, Shape>&, int, long i, Slots) const {
    return {of.way(i), inverse_less_one(of.F(i)), of.body_of(i)};
  }
};

/// What the nodes do not know of it; marked where that is more than `most`, m.
template <class Real>
struct MissedWays {
  FirstPlaces<Real> of;
  NodeWays<Real> known;
  double most;

  template <class Shape, class Slots>
  RIVEN_INLINE PutWay put(const Block<Real, Shape>& w, int k, long i, Slots slots) const {
    const auto found = known.at(w, k, of, i, slots);
    const Vec2 d = of.way(i) - found.d;
    return {d, inverse_less_one(of.F(i)) + -1. * found.gradient, double(found.other || dot(d, d) > most * most)};
  }
};

/// Adds what `of` says of the particles up at the nodes, with Gradients these alone.
template <class Shape, bool Gradients, class Real, class Ways>
void sum_ways(const exec::Space& space, const Plan& plan, State<Real, 2>& s, const Ways& of) {
  Real* const sum = exec::data(s.grid.q);
  exec::parallel_zero(space, "anchor strains", s.grid.q);
  const ParticleView<Real> p = view(s.particles);
  const Positions<Real> at = positions(s);
  const CrossingSlots extra = crossing_slots(s, slots_are_shared(space, plan.scatter));
  const TileRun<Real> tiles{
      s.particles.tiles, s.grid.lattice, extra, {{p.x, p.y, p.Fxx, p.Fxy, p.Fyx, p.Fyy}, {p.mass}, {sum}}};
  scatter_tiles<false>(
      space, "anchor strains", plan.scatter, tiles, static_cast<Real*>(nullptr), sum, WatchNothing{},
      [p, at, extra, of, sum] RIVEN_KERNEL(auto stretch, long begin, long end, const NodeTarget<Real>& to, auto&)
          RIVEN_LANE {
            Block<Real, Shape> w;
            for (long first = begin; first < end; first += exec::lanes) {
              const int count = static_cast<int>(std::min<long>(exec::lanes, end - first));
              ask_ahead(stretch, first);
              w.template weigh<true, true>(at, first);
              each_particle<Shape>(stretch, first, count, [&](int k, auto slots) RIVEN_LANE {
                const Real m = p.mass[first + k];
                const PutWay put = of.put(w, k, first + k, slots);
                const Mat2<double>& D = put.gradient;
                Quad<Real> A{Real(put.d.x), Real(put.d.y), 1, Real(put.mark)};
                Quad<Real> B{Real(D.xx), Real(D.yx), 0, 0}, C{Real(D.xy), Real(D.yy), 0, 0};
                if constexpr (Gradients)
                  A = Quad<Real>{Real(D.xx), Real(D.yx), Real(D.xy), Real(D.yy)};
                if constexpr (std::is_pointer_v<decltype(slots)>)
                  scatter_slots<false, !Gradients, Second::moments>(w, k, Real(0), m * A, m * B, m * C, to, slots,
                                                                    extra, static_cast<Real*>(nullptr), sum);
                else
                  scatter<false, !Gradients, Second::moments>(w, k, Real(0), m * A, m * B, m * C, to);
              });
            }
          });
}

/// Adds the sums of ways to what the nodes know: the first sums, marked by bodies, or the second ones, marked where a
/// particle was not one solid with the others.
template <bool Again, class Real>
void add_ways(const exec::Space& space, const State<Real, 2>& s, Real* ways) {
  exec::parallel_for(space, "anchor strains", s.grid.slots(), [ways, sums = exec::data(s.grid.q)] RIVEN_KERNEL(long n) {
    const Real *sum = sums + 4 * n, m = sum[NodeNumbers::sum_mass];
    Real* const to = ways + 4 * n;
    to[NodeNumbers::mass] = m;
    if (!(m > 0))
      return;
    const double mark = double(sum[NodeNumbers::sum_mark]) / double(m);
    to[0] += sum[0] / m;
    to[1] += sum[1] / m;
    if (!Again || mark > 0)
      to[NodeNumbers::body] = Again ? Real(NodeNumbers::torn) : Real(mark);
  });
}

/// Means of the gradients that were summed up.
template <class Real>
void mean_gradients(const exec::Space& space, const State<Real, 2>& s, const Real* ways, Real* gradients) {
  exec::parallel_for(space, "anchor strains", s.grid.slots(),
                     [ways, gradients, sums = exec::data(s.grid.q)] RIVEN_KERNEL(long n) {
                       const Real m = ways[4 * n + NodeNumbers::mass];
                       for (int c = 0; c < 4; ++c)
                         gradients[4 * n + c] = m > 0 ? sums[4 * n + c] / m : Real(0);
                     });
}

/// Notices det F, and what strain energy was taken.
template <class Real>
struct WatchStrains {
  using Seen = TileWatch<Real>;
  WatchTiles<Real, false, false, true> dets;
  double* taken;  ///< [tiles] J

  RIVEN_INLINE void put(int tile, const Seen* seen, int count = 1) const {
    dets.put(tile, seen, count);
    double sum = 0;
    for (const Seen* t = seen; t < seen + count; ++t)
      for (int k = 0; k < t->lanes; ++k)
        sum += t->worn[k];
    taken[tile] = sum;
  }
};

/// Takes F a part of the way to what the nodes know.
template <class Shape, class Law, class Real>
void pull_strains(const exec::Space& space, State<Real, 2>& s, const NodeWays<Real>& known) {
  const FirstPlaces<Real> of = first_places(s);
  const ParticleReads<Real> reading = reads(s.particles);
  const BodyLookup<Law> law = laws<Law>(s);
  const Positions<Real> at = positions(s);
  const CrossingSlots extra = crossing_slots(s);
  exec::Array<double> taken(s.watch.tile_J.size());
  const WatchStrains<Real> see{WatchTiles<Real, false, false, true>(s.watch), exec::data_to_fill(taken)};
  const ParticleView<Real>& p = of.p;
  const TileRun<Real> tiles{
      s.particles.tiles,
      s.grid.lattice,
      extra,
      {{at.x, at.y, p.Fxx, p.Fxy, p.Fyx, p.Fyy}, {p.mass, p.sxx, p.syy, p.sxy}, {known.ways, known.gradients}}};
  each_tile(space, "anchor strains", tiles, see,
            [of, reading, law, at, known] RIVEN_KERNEL(auto stretch, long begin, long end, TileWatch<Real>& seen)
                RIVEN_LANE {
                  Block<Real, Shape> w;
                  GradientLanes<Real> gradient;
                  const auto energy = [&](long i) RIVEN_LANE {
                    return double(of.p.mass[i]) * double(law.of(i).energy(law_state<Law>(reading, i)));
                  };
                  for (long first = begin; first < end; first += exec::lanes) {
                    const int count = static_cast<int>(std::min<long>(exec::lanes, end - first));
                    ask_ahead(stretch, first);
                    w.template weigh<true>(at, first);
                    each_particle<Shape>(stretch, first, count, [&](int k, auto slots) RIVEN_LANE {
                      const auto found = known.at(w, k, of, first + k, slots);
                      const Mat2<double>& D = found.gradient;
                      Mat2<double> change{0, 0, 0, 0};  // F_c F^-1 - I
                      if (!found.other)
                        change = inverse_less_one(of.F(first + k) * Mat2<double>{1 + D.xx, D.xy, D.yx, 1 + D.yy});
                      gradient.xx[k] = Real(change.xx);
                      gradient.xy[k] = Real(change.xy);
                      gradient.yx[k] = Real(change.yx);
                      gradient.yy[k] = Real(change.yy);
                    });
                    for (int k = 0; k < count; ++k)
                      seen.worn[k] += energy(first + k);
                    update_stress_lanes<false>(of.p, first, count, gradient, Real(strain_at_once), law, seen);
                    for (int k = 0; k < count; ++k)
                      seen.worn[k] -= energy(first + k);
                  }
                });
  watch_J(s);
  for (const int tile : std::as_const(s.particles.tiles.filled))
    s.ledger.energy.anchoring += std::as_const(taken)[tile];
}

}  // namespace

template <class Real>
void anchor_strains(const exec::Space& space, const Plan& plan, State<Real, 2>& s) {
  exec::Array<Real> ways(s.grid.q.size()), gradients(s.grid.q.size());
  exec::parallel_zero(space, "anchor strains", ways);
  const FirstPlaces<Real> of = first_places(s);
  const NodeWays<Real> known{exec::data(std::as_const(ways)), exec::data(std::as_const(gradients)), s.grid.lattice};
  const OwnWays<Real> own{of};
  const MissedWays<Real> missed{of, known, not_one_solid * s.grid.lattice.h};
  with_shape(plan.shape, [&](auto shape) {
    using Shape = typename decltype(shape)::type;
    sum_ways<Shape, false>(space, plan, s, own);
    add_ways<false>(space, s, exec::data(ways));
    sum_ways<Shape, true>(space, plan, s, own);
    mean_gradients(space, s, known.ways, exec::data(gradients));
    sum_ways<Shape, false>(space, plan, s, missed);
    add_ways<true>(space, s, exec::data(ways));
    with_law<Real>(plan.law, [&](auto law) {
      using Law = typename decltype(law)::type;
      if constexpr (Law::keeps_F)
        pull_strains<Shape, Law>(space, s, known);
    });
  });
}

#define RIVEN_ANCHOR_STRAINS(Real) template void anchor_strains(const exec::Space&, const Plan&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_ANCHOR_STRAINS)
#undef RIVEN_ANCHOR_STRAINS

}  // namespace RIVEN_SIDE

}  // namespace riven
