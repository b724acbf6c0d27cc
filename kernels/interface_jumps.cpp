#include "kernels/interface_jumps.hpp"

#include "core/exec/parallel.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/interface_segments.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

template <class Shape, class Real>
void run(const exec::Space& space, const exec::Array<DomainSetting<Real, 2>>& domains, const Grid<Real>& grid,
         const CrackFields& fields, double dt, Cracks& cracks) {
  const InterfaceSegments<Shape, Real> segments(domains, grid, fields, std::as_const(cracks));
  const Real* q = exec::data(grid.q);
  const NodeCracks* nodes = exec::data(fields.nodes);
  Vec2* jump = exec::data(cracks.jump);
  exec::parallel_tasks(space, "interface jumps", cracks.count(), [=] RIVEN_KERNEL(long c) {
    segments.each(c, [&](int p, const SegmentFrame& s, auto&& each_node) {
      each_node([&](int i, int k, double weight) {
        const NodeCracks& n = nodes[i];
        const auto mean_velocity = [&](int f) {  // over the step
          const Real* d = q + 4 * segments.slot(n, f);
          return Vec2{double(d[0]), double(d[1])} - (0.5 * dt) * Vec2{double(d[2]), double(d[3])};
        };
        segments.each_meeting(n, k, [&](const Meeting& m) {
          const Vec2 parting = (dt * weight * m.share) * (mean_velocity(m.below) - mean_velocity(m.above));
          jump[p] += Vec2{dot(parting, s.normal), dot(parting, s.along)};
        });
      });
    });
  });
}

}  // namespace

template <class Real>
void advance_jumps(const exec::Space& space, ShapeFunction shape, const exec::Array<DomainSetting<Real, 2>>& domains,
                   const Grid<Real>& grid, const CrackFields& fields, double dt, Cracks& cracks) {
  cracks.jump.resize(cracks.points());
  with_shape(shape, [&](auto type) { run<typename decltype(type)::type>(space, domains, grid, fields, dt, cracks); });
}

#define RIVEN_ADVANCE_JUMPS(Real)                                                                            \
  template void advance_jumps(const exec::Space&, ShapeFunction, const exec::Array<DomainSetting<Real, 2>>&, \
                              const Grid<Real>&, const CrackFields&, double, Cracks&);
RIVEN_EACH_REAL(RIVEN_ADVANCE_JUMPS)
#undef RIVEN_ADVANCE_JUMPS

}  // namespace RIVEN_SIDE

}  // namespace riven
