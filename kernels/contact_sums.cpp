#include "kernels/contact_sums.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/math/shape.hpp"
#include "kernels/block.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/interface_segments.hpp"

namespace riven {

namespace {

/// Area of a particle over its first area.
template <class Real>
RIVEN_INLINE double area_ratio(const Real* const F[4], const Real* J, long i) {
  if (J)
    return J[i];
  return double(F[0][i]) * F[3][i] - double(F[1][i]) * F[2][i];
}

/// Where nodes hold cracks; see CrackFields.
struct CrackNodes {
  const int* index;
  const std::uint8_t *held, *cell_held;
};

/// The nodes that hold cracks among the neighbours of the particles in one cell, which are remembered from particle to
/// particle: particles are sorted by cell.
template <class Shape>
struct HeldNeighbours {
  int cell = -1;
  int count = 0;
  int neighbour[neighbours<Shape, 2>];
  int index[neighbours<Shape, 2>];
  Vec2 place[neighbours<Shape, 2>];

  RIVEN_INLINE void find(int of, const Lattice& lattice, const CrackNodes& at) {
    if (of == cell)
      return;
    constexpr int before = Shape::width == 3;  // nodes on the lower side of a cell's own
    cell = of;
    count = 0;
    if (at.cell_held[cell] == 0)
      return;
    const int x = cell % lattice.nx - before, y = cell / lattice.nx - before;
    for (int k = 0; k < neighbours<Shape, 2>; ++k) {
      const int ix = x + k % Shape::width, iy = y + k / Shape::width, i = at.index[iy * lattice.nx + ix];
      if (i < 0 || at.held[i] == 0)
        continue;
      neighbour[count] = k;
      place[count] = lattice.position(ix, iy);
      index[count++] = i;
    }
  }
};

template <class Shape, class Real>
void sum_particles(const exec::Space& space, const ContactSumsChoice& choice, const Particles<Real, 2>& particles,
                   const exec::Array<DomainSetting<Real, 2>>& domains, const exec::Array<double>& specific_area,
                   const Lattice& lattice, const CrackFields& fields, ContactField* out) {
  constexpr int L = exec::lanes, N = Shape::width;
  const exec::Stopwatch watch(space.timers(), "contact sums");
  const Tiles& tiles = particles.tiles;
  const Real* const F[4] = {particles.F[0].data(), particles.F[1].data(), particles.F[2].data(), particles.F[3].data()};
  const bool area = choice.volume, position = choice.position;
  const Real *x = particles.x[0].data(), *y = particles.x[1].data(), *mass = particles.mass.data();
  const Real *X = particles.x0[0].data(), *Y = particles.x0[1].data();
  const Real* J = particles.J.empty() ? nullptr : particles.J.data();
  const Positions<Real> at{x,
                           y,
                           Real(lattice.origin.x),
                           Real(lattice.origin.y),
                           Real(1 / lattice.h),
                           {domains.data(), particles.body.data(), domains.size() == 1}};
  const std::uint8_t* body = particles.body.data();
  const CrackNodes nodes{fields.node_index.data(), fields.held.data(), fields.cell_held.data()};
  const double* specific = specific_area.data();
  const std::uint32_t* word = fields.fields.data();
  const int *start = tiles.start.data(), *marked = fields.tile_marked.data();

  const auto tile_body = [=](int tile) {
    HeldNeighbours<Shape> near;
    Block<Real, Shape> w;
    alignas(64) int cell[L];
    for (int first = start[tile]; first < start[tile + 1]; first += L) {
      exec::for_lanes(L, [&](int k) RIVEN_LANE {
        const int i = Shape::cell((x[first + k] - at.origin_x) * at.inv_h);
        const int j = Shape::cell((y[first + k] - at.origin_y) * at.inv_h);
        cell[k] = j * lattice.nx + i;
      });
      bool weighed = false;
      for (int k = 0; k < std::min(L, start[tile + 1] - first); ++k) {
        near.find(cell[k], lattice, nodes);
        if (near.count == 0)
          continue;
        if (!weighed)
          w.weigh(at, first);
        weighed = true;
        const int p = first + k;
        const double m = mass[p], A = area ? m * specific[body[p]] * area_ratio(F, J, p) : 0;
        const Quad<double> places =
            position ? Quad<double>{double(x[p]), double(y[p]), double(X[p]), double(Y[p])} : Quad<double>{};
        for (int c = 0; c < near.count; ++c) {
          const int n = near.neighbour[c];
          const double S = double(w.sx[n % N][k]) * double(w.sy[n / N][k]), mS = m * S;
          ContactField& f = out[4L * near.index[c] + field_of(word[p], n)];
          f.mass += mS;
          f.area += A * S;
          const Vec2 node = near.place[c];
          if (position)
            quad_at<double>(&f.x.x) += mS * (places - Quad<double>{node.x, node.y, node.x, node.y});
        }
      }
    }
  };
  for (int colour = 0; colour < 4; ++colour) {
    const int* some = tiles.by_colour.data() + tiles.colour_start[colour];
    exec::launch(space, tiles.colour_start[colour + 1] - tiles.colour_start[colour], [=](long t) {
      if (marked[some[t]])
        tile_body(some[t]);
    });
  }
}

/// Clears the sums of the nodes that hold cracks.
void clear_sums(const exec::Space& space, const CrackFields& fields, ContactField* out) {
  exec::parallel_for(space, "contact sums", fields.nodes.size(), [=, held = fields.held.data()](long i) {
    if (held[i])
      std::fill(out + 4 * i, out + 4 * (i + 1), ContactField{});
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
  sums.volumes = choice.volume;
  sums.field.resize(choice.volume || choice.position ? 4 * fields.nodes.size() : 0);
  sums.area.resize(choice.area ? 2 * fields.nodes.size() : 0);
  if (!sums.field.empty())
    clear_sums(space, fields, sums.field.data());
  sums.area.zero();
  with_shape(shape, [&](auto type) {
    using Shape = typename decltype(type)::type;
    if (!sums.field.empty())
      sum_particles<Shape>(space, choice, particles, domains, specific_area, grid.lattice, fields, sums.field.data());
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
