#include "kernels/contact_sums.hpp"

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

/// The flagged nodes among the neighbours of the particles in one cell, which are remembered from particle to
/// particle: particles are sorted by cell.
template <class Shape>
struct FlaggedNeighbours {
  int cell_x = -1, cell_y = -1;
  int count = 0;
  int neighbour[neighbours<Shape, 2>];
  int index[neighbours<Shape, 2>];
  Vec2 place[neighbours<Shape, 2>];

  RIVEN_INLINE void find(int x, int y, const Lattice& lattice, const int* node_index, const NodeCracks* nodes) {
    if (x == cell_x && y == cell_y)
      return;
    constexpr int before = Shape::width == 3;  // nodes on the lower side of a cell's own
    cell_x = x;
    cell_y = y;
    count = 0;
    for (int k = 0; k < neighbours<Shape, 2>; ++k) {
      const int ix = x - before + k % Shape::width, iy = y - before + k / Shape::width;
      const int i = node_index[iy * lattice.nx + ix];
      if (i < 0 || nodes[i].crack[0] < 0)
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
  const exec::Stopwatch watch(space.timers(), "contact sums");
  const Tiles& tiles = particles.tiles;
  const Real* const F[4] = {particles.F[0].data(), particles.F[1].data(), particles.F[2].data(), particles.F[3].data()};
  const bool area = choice.volume, position = choice.position;
  const Real *x = particles.x[0].data(), *y = particles.x[1].data(), *mass = particles.mass.data();
  const Real *X = particles.x0[0].data(), *Y = particles.x0[1].data();
  const Real* J = particles.J.empty() ? nullptr : particles.J.data();
  const Real origin_x = Real(lattice.origin.x), origin_y = Real(lattice.origin.y), inv_h = Real(1 / lattice.h);
  const BodyLookup<DomainSetting<Real, 2>> domain{domains.data(), particles.body.data(), domains.size() == 1};
  const std::uint8_t* body = particles.body.data();
  const double* specific = specific_area.data();
  const std::uint32_t* word = fields.fields.data();
  const int *node_index = fields.node_index.data(), *start = tiles.start.data(), *marked = fields.tile_marked.data();
  const NodeCracks* nodes = fields.nodes.data();

  const auto tile_body = [=](int tile) {
    FlaggedNeighbours<Shape> near;
    for (int p = start[tile]; p < start[tile + 1]; ++p) {
      const Real px = (x[p] - origin_x) * inv_h, py = (y[p] - origin_y) * inv_h;
      near.find(Shape::cell(px), Shape::cell(py), lattice, node_index, nodes);
      if (near.count == 0)
        continue;
      const DomainSetting<Real, 2>& d = domain.of(p);
      const auto a = Shape::axis(px, d.axis[0]);
      const auto b = Shape::axis(py, d.axis[1]);
      const double m = mass[p];
      const double A = area ? m * specific[body[p]] * area_ratio(F, J, p) : 0;
      for (int c = 0; c < near.count; ++c) {
        const int k = near.neighbour[c], i = near.index[c];
        const double S = double(a.s[k % Shape::width]) * double(b.s[k / Shape::width]), mS = m * S;
        ContactField& f = out[4L * i + field_of(word[p], k)];
        f.mass += mS;
        f.area += A * S;
        if (position) {
          const Vec2 node = near.place[c];
          f.x += mS * (Vec2{double(x[p]), double(y[p])} - node);
          f.X += mS * (Vec2{double(X[p]), double(Y[p])} - node);
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
  sums.field.zero();
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
