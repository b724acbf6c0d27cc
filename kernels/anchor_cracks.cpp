#include "kernels/anchor_cracks.hpp"

#include "core/exec/parallel.hpp"
#include "kernels/advance_grid.hpp"
#include "kernels/contact_sums.hpp"
#include "kernels/crack_view.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/point_motion.hpp"
#include "kernels/return_surfaces.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Of that by which their ways differ, what surfaces go at once: most of it over some four sorts, a cell or more.
constexpr double way_at_once = 0.25;

constexpr long points_of_anchor = 16, nodes_of_anchor = 16;

/// Where the particles of a node's field are as a function of where they were: sums of m S times each.
struct FieldMap {
  double mass = 0;
  Vec2 x, X;  ///< m, from the node
  Mat2<double> F;

  RIVEN_INLINE void add(double m, Vec2 now, Vec2 first, const Mat2<double>& stretch) {
    mass += m;
    x += m * now;
    X += m * first;
    F = F + m * stretch;
  }
  /// mass times where that is now which was first at `place`, both from the node.
  RIVEN_INLINE Vec2 at(Vec2 place) const {
    const Vec2 r = place - X * (1 / mass);
    return x + Vec2{F.xx * r.x + F.xy * r.y, F.yx * r.x + F.yy * r.y};
  }
};

/// Where field `field` of CrackFields::nodes[f] = n stands in a list of all fields of those nodes.
RIVEN_INLINE long place_in_maps(long f, const NodeCracks& n, int field) {
  return f + n.extra + field;
}

template <class Shape, class Real>
exec::Array<FieldMap> map_fields(const exec::Space& space, ShapeFunction shape, const State<Real, 2>& s) {
  ContactSums none;
  const ContactParticles<Real> of{shape, s.particles, s.domains, s.specific_area, s.watch.drift};
  exec::Array<FieldMap> maps(s.fields.nodes.size() + s.fields.extra_slots);
  exec::launch_some(space, s.fields.nodes.size(), nodes_of_anchor,
                    [nodes = exec::data(s.fields.nodes), sums = node_sums(of, s.grid.lattice, s.fields, none),
                     to = exec::data_to_fill(maps)] RIVEN_KERNEL(long f) {
                      const NodeCracks& n = nodes[f];
                      const Vec2 node = sums.lattice.position(n.node);
                      FieldMap found[1 << most_held]{};
                      sums.template each_particle_of<Shape>(n, [&](int p, int field, double S) RIVEN_LANE {
                        found[field].add(sums.mass[p] * S, Vec2{sums.at.x[p], sums.at.y[p]} - node,
                                         Vec2{sums.X[p], sums.Y[p]} - node,
                                         {sums.F[0][p], sums.F[1][p], sums.F[2][p], sums.F[3][p]});
                      });
                      for (int field = 0; field < n.room(); ++field)
                        to[place_in_maps(f, n, field)] = found[field];
                    });
  return maps;
}

/// How far the surfaces of points are from where the particles beside them say.
template <class Shape, class Real>
struct WaysBack {
  Extrapolation<Shape, Real> from;
  CrackView cracks;
  const Vec2* plane0;  ///< Cracks
  const FieldMap* maps;
  double seen;  ///< kg, of less mass a surface sees nothing

  /// The ways of the upper and the lower surface of point k; not known where it sees too little mass.
  RIVEN_FN void find(int k, WayBack* found) const {
    found[0] = found[1] = {};
    const Vec2 x[2] = {cracks.upper[k], cracks.lower[k]};
    from.each_surface(crack_point(from.view, k), x, [&](int side, const auto& around, const auto& slot) {
      constexpr int width = AxisWeights::width;
      const int corner = from.corner(x[side]);
      double mass = 0;
      Vec2 sum;  // of m times the way
      for (int j = 0; j < width; ++j)
        for (int i = 0; i < width; ++i) {
          const FieldMap* const map = map_of(corner + j * from.view.lattice.nx + i, slot[side][j * width + i]);
          if (map == nullptr || !(map->mass > 0))
            continue;
          const Vec2 node{around.x.r[i], around.y.r[j]};  // from the surface
          const double N = around.x.near[i] * around.y.near[j];
          mass += N * map->mass;
          sum += N * (map->at(plane0[k] - x[side] - node) + map->mass * node);
        }
      if (mass > seen)
        found[side] = {sum * (1 / mass), true};
    });
  }

 private:
  /// Null where the node sees no crack, or has no such field.
  RIVEN_FN const FieldMap* map_of(int node, int slot) const {
    const int f = from.view.node_index[node];
    if (f < 0 || slot < 0)
      return nullptr;
    const NodeCracks& n = from.view.nodes[f];
    return maps + place_in_maps(f, n, slot == node ? 0 : slot - from.view.lattice.nodes() - n.extra + 1);
  }
};

template <class Shape, class Real>
exec::Array<WayBack> find_ways(const exec::Space& space, const State<Real, 2>& s, const exec::Array<FieldMap>& maps) {
  const WaysBack<Shape, Real> ways{{s.grid, false, s.cracks, s.fields, 0},
                                   crack_view(s.cracks),
                                   exec::data(s.cracks.plane0),
                                   exec::data(maps),
                                   least_mass_borne(s)};
  exec::Array<WayBack> found(2 * s.cracks.points());
  exec::launch_some(
      space, s.cracks.points(), points_of_anchor,
      [=, to = exec::data_to_fill(found)] RIVEN_KERNEL(long k) { ways.find(static_cast<int>(k), to + 2 * k); });
  return found;
}

}  // namespace

template <class Real>
void anchor_cracks(const exec::Space& space, ShapeFunction shape, State<Real, 2>& s) {
  with_shape(shape, [&](auto type) {
    using Shape = typename decltype(type)::type;
    const exec::Array<FieldMap> maps = map_fields<Shape>(space, shape, s);
    return_surfaces(space, find_ways<Shape>(space, s, maps), way_at_once, s.cracks);
  });
}

#define RIVEN_ANCHOR(Real) template void anchor_cracks(const exec::Space&, ShapeFunction, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_ANCHOR)
#undef RIVEN_ANCHOR

}  // namespace RIVEN_SIDE

}  // namespace riven
