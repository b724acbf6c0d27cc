#include "kernels/contact_sums.hpp"

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "core/math/shape.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/interface_segments.hpp"
#include "kernels/views.hpp"

namespace riven {

namespace {

/// Area of a particle over its first area.
template <class Real>
RIVEN_INLINE double area_ratio(const Real* const F[4], const Real* J, long i) {
  if (J)
    return J[i];
  return double(F[0][i]) * F[3][i] - double(F[1][i]) * F[2][i];
}

/// What the particles add up to, in slots; null where not asked for.
struct SlotSums {
  double *place, *volume;
};

/// A particle's mass and area, and its places [x y X Y] from the first of its nodes.
struct ParticleParts {
  double mass, area;
  Quad<double> places;
};

/// Adds m S (x - x_i) and A S of particle k of a block; slot_of(n) of node n.
template <class Real, class Shape, class SlotOf>
RIVEN_INLINE void add_parts(const Block<Real, Shape>& w, int k, const ParticleParts& p, double h, const SlotSums& to,
                            const SlotOf& slot_of) {
  constexpr int N = Shape::width;
  if (to.place)
    for (int j = 0; j < N; ++j) {
      const Quad<double> row = p.places + Quad<double>{0, -j * h, 0, -j * h};
      const double m = p.mass * double(w.sy[j][k]);
#pragma GCC unroll 3
      for (int i = 0; i < N; ++i)
        quad_at<double>(to.place + 4 * slot_of(j * N + i)) +=
            (m * double(w.sx[i][k])) * (row + Quad<double>{-i * h, 0, -i * h, 0});
    }
  if (to.volume)
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i)
        to.volume[slot_of(j * N + i)] += p.area * double(w.sx[i][k]) * double(w.sy[j][k]);
}

template <class Shape, class Real>
void sum_particles(const exec::Space& space, const Particles<Real, 2>& particles,
                   const exec::Array<DomainSetting<Real, 2>>& domains, const exec::Array<double>& specific_area,
                   const Lattice& lattice, const CrackFields& fields, const SlotSums& to) {
  constexpr int L = exec::lanes;
  const exec::Stopwatch watch(space.timers(), "contact sums");
  const Tiles& tiles = particles.tiles;
  const Real* const F[4] = {particles.F[0].data(), particles.F[1].data(), particles.F[2].data(), particles.F[3].data()};
  const Real *x = particles.x[0].data(), *y = particles.x[1].data(), *mass = particles.mass.data();
  const Real *X = particles.x0[0].data(), *Y = particles.x0[1].data();
  const Real* J = particles.J.empty() ? nullptr : particles.J.data();
  const Positions<Real> at{x,
                           y,
                           Real(lattice.origin.x),
                           Real(lattice.origin.y),
                           Real(1 / lattice.h),
                           {domains.data(), particles.body.data(), domains.size() == 1}};
  const std::uint8_t *body = particles.body.data(), *cell_held = fields.cell_held.data();
  const double* specific = specific_area.data();
  const CrossingSlots extra = crossing_slots(fields, lattice);
  const int* start = tiles.start.data();

  const auto tile_body = [=](int tile) {
    constexpr int N = Shape::width;
    Block<Real, Shape> w;
    alignas(64) int cell[L];
    long block = CrackFields::block_of(start[tile], extra.tile_marked[tile] - 1);
    for (int first = start[tile]; first < start[tile + 1]; first += L, ++block) {
      exec::for_lanes(L, [&](int k) RIVEN_LANE {
        const int i = Shape::cell((x[first + k] - at.origin_x) * at.inv_h);
        const int j = Shape::cell((y[first + k] - at.origin_y) * at.inv_h);
        cell[k] = j * lattice.nx + i;
      });
      unsigned near = 0;
      for (int k = 0; k < std::min(L, start[tile + 1] - first); ++k)
        near |= unsigned{cell_held[cell[k]] != 0} << k;
      if (near == 0)
        continue;
      w.weigh(at, first);
      const unsigned crossing = extra.crossing[block];
      const int* slots = extra.slots + extra.block_slots[block];
      for (; near != 0; near &= near - 1) {
        const int k = std::countr_zero(near), p = first + k;
        const double area = to.volume ? mass[p] * specific[body[p]] * area_ratio(F, J, p) : 0;
        const Vec2 node = lattice.position(w.ix[k], w.iy[k]);
        const Quad<double> places =
            to.place ? Quad<double>{x[p] - node.x, y[p] - node.y, X[p] - node.x, Y[p] - node.y} : Quad<double>{};
        const ParticleParts parts{mass[p], area, places};
        const long corner = long{w.iy[k]} * lattice.nx + w.ix[k];
        if (crossing >> k & 1u) {
          add_parts(w, k, parts, lattice.h, to, [&](int n) RIVEN_LANE { return slots[n]; });
          slots += N * N;  // who crosses is near
        } else {
          add_parts(w, k, parts, lattice.h, to, [&](int n) RIVEN_LANE { return corner + n / N * lattice.nx + n % N; });
        }
      }
    }
  };
  for (int colour = 0; colour < 4; ++colour) {
    const int* some = tiles.by_colour.data() + tiles.colour_start[colour];
    exec::launch(space, tiles.colour_start[colour + 1] - tiles.colour_start[colour], [=](long t) {
      if (extra.tile_marked[some[t]])
        tile_body(some[t]);
    });
  }
}

/// Clears the slots of the nodes that hold cracks.
void clear_sums(const exec::Space& space, const Lattice& lattice, const CrackFields& fields, const SlotSums& sums) {
  exec::parallel_for(space, "contact sums", fields.nodes.size(),
                     [=, held = fields.held.data(), nodes = fields.nodes.data()](long i) {
                       const auto clear = [&](long slot) {
                         if (sums.place)
                           quad_at<double>(sums.place + 4 * slot) = Quad<double>{};
                         if (sums.volume)
                           sums.volume[slot] = 0;
                       };
                       if (held[i] == 0)
                         return;
                       clear(nodes[i].node);
                       for (int f = 1; f <= (held[i] == 1 ? 1 : 3); ++f)
                         clear(long{lattice.nodes()} + nodes[i].extra + f - 1);
                     });
}

template <class Shape, class Real>
void sum_segments(const exec::Space& space, const exec::Array<DomainSetting<Real, 2>>& domains, const Grid<Real>& grid,
                  const CrackFields& fields, const Cracks& cracks, double thickness, ContactArea* out) {
  const InterfaceSegments<Shape, Real> segments(domains, grid, fields, cracks);
  const exec::View<const Vec2> jump = cracks.jump.view();  // shorter or empty before the first step
  exec::parallel_tasks(space, "contact areas", cracks.count(), [=](long c) {
    segments.each(c, [&](int p, const SegmentFrame& s, auto&& nodes) {
      const double area = thickness * s.length;
      const Vec2 local = p < jump.size ? jump[p] : Vec2{}, opening = local.x * s.normal + local.y * s.along;
      nodes([&](int i, int k, double weight) {
        ContactArea& to = out[2L * i + k];
        to.area += area * weight;
        to.opening += (area * weight) * opening;
      });
    });
  });
  exec::parallel_for(space, "contact areas", 2 * fields.nodes.size(), [=](long i) {
    if (out[i].area > 0)
      out[i].opening *= 1 / out[i].area;
  });
}

}  // namespace

template <class Real>
void contact_sums(const exec::Space& space, ShapeFunction shape, const ContactSumsChoice& choice,
                  const Particles<Real, 2>& particles, const exec::Array<DomainSetting<Real, 2>>& domains,
                  const exec::Array<double>& specific_area, const Grid<Real>& grid, const CrackFields& fields,
                  const Cracks& cracks, double thickness, ContactSums& sums) {
  if ((choice.volume && particles.J.empty() && particles.F[0].empty()) ||
      (choice.position && particles.x0[0].empty()) || (choice.volume && specific_area.size() != domains.size()))
    fail({Exit::internal, "particles lack the arrays that the detection of contact needs", "contact sums", {}, {}, {}});
  const long slots = long{grid.lattice.nodes()} + fields.extra_slots;
  sums.place.resize(choice.position ? 4 * slots : 0);
  sums.volume.resize(choice.volume ? slots : 0);
  sums.area.resize(choice.area ? 2 * fields.nodes.size() : 0);
  sums.area.zero();
  const SlotSums to{choice.position ? sums.place.data() : nullptr, choice.volume ? sums.volume.data() : nullptr};
  clear_sums(space, grid.lattice, fields, to);
  with_shape(shape, [&](auto type) {
    using Shape = typename decltype(type)::type;
    if (to.place || to.volume)
      sum_particles<Shape>(space, particles, domains, specific_area, grid.lattice, fields, to);
    if (sums.area.empty())
      return;
    sum_segments<Shape>(space, domains, grid, fields, cracks, thickness, sums.area.data());
  });
}

template void contact_sums(const exec::Space&, ShapeFunction, const ContactSumsChoice&, const Particles<float, 2>&,
                           const exec::Array<DomainSetting<float, 2>>&, const exec::Array<double>&, const Grid<float>&,
                           const CrackFields&, const Cracks&, double, ContactSums&);
template void contact_sums(const exec::Space&, ShapeFunction, const ContactSumsChoice&, const Particles<double, 2>&,
                           const exec::Array<DomainSetting<double, 2>>&, const exec::Array<double>&,
                           const Grid<double>&, const CrackFields&, const Cracks&, double, ContactSums&);

}  // namespace riven
