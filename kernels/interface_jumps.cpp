#include "kernels/interface_jumps.hpp"

#include "core/exec/parallel.hpp"
#include "kernels/contact_meetings.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/interface_segments.hpp"

namespace riven {

namespace {

/// Velocity of the face below minus that of the face above at a node, over the step; false where the faces do not meet.
template <class Real>
RIVEN_INLINE bool parting_velocity(const Real* grid_mass, const Real* q, const int* extra, int nodes,
                                   const NodeCracks& n, int k, const ContactSettings* laws, double dt, Vec2& parting) {
  double mass[ContactNode::fields] = {};
  Vec2 v[ContactNode::fields];
  for (int f = 0; f < (n.crack[1] < 0 ? 2 : 4); ++f) {
    const long slot = f == 0 ? n.node : long{nodes} + extra[n.node] + f - 1;
    const Real* d = q + 4 * slot;
    mass[f] = grid_mass[slot];
    v[f] = Vec2{double(d[0]), double(d[1])} - (0.5 * dt) * Vec2{double(d[2]), double(d[3])};
  }
  bool any = false;
  parting = {};
  for (const Meeting& m : find_meetings(n, mass, laws)) {
    if (m.k != k)
      continue;
    any = true;
    parting += m.share * (v[m.below] - v[m.above]);
  }
  return any;
}

template <class Shape, class Real>
void run(const exec::Space& space, const DomainSetting<double, 2>& domain, const Grid<Real>& grid,
         const CrackFields& fields, double dt, Cracks& cracks) {
  const InterfaceSegments<Shape> segments(domain, grid.lattice, fields, cracks);
  const Real *mass = grid.mass.data(), *q = grid.q.data();
  const int *extra = fields.extra.data(), total = grid.lattice.nodes();
  const NodeCracks* nodes = fields.nodes.data();
  const ContactSettings* laws = cracks.contact.data();
  Vec2* jump = cracks.jump.data();
  exec::parallel_tasks(space, "interface jumps", cracks.count(), [=](long c) {
    segments.each(c, [&](int p, const SegmentFrame& s, auto&& each_node) {
      double weight = 0;
      Vec2 sum;
      each_node([&](int i, int k, double S) {
        Vec2 parting;
        if (!parting_velocity(mass, q, extra, total, nodes[i], k, laws, dt, parting))
          return;
        weight += S;
        sum += S * parting;
      });
      if (weight > 0)
        jump[p] += (dt / weight) * Vec2{dot(sum, s.normal), dot(sum, s.along)};
    });
  });
}

}  // namespace

template <class Real>
void advance_jumps(const exec::Space& space, ShapeFunction shape, const exec::Array<DomainSetting<Real, 2>>& domains,
                   const Grid<Real>& grid, const CrackFields& fields, double dt, Cracks& cracks) {
  cracks.jump.resize(cracks.points());
  with_shape(shape, [&](auto type) {
    run<typename decltype(type)::type>(space, crack_point_domain(domains[0]), grid, fields, dt, cracks);
  });
}

template void advance_jumps(const exec::Space&, ShapeFunction, const exec::Array<DomainSetting<float, 2>>&,
                            const Grid<float>&, const CrackFields&, double, Cracks&);
template void advance_jumps(const exec::Space&, ShapeFunction, const exec::Array<DomainSetting<double, 2>>&,
                            const Grid<double>&, const CrackFields&, double, Cracks&);

}  // namespace riven
