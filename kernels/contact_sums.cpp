#include "kernels/contact_sums.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/math/shape.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/interface_segments.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

template <class Shape, class Real>
void sum_segments(const exec::Space& space, const exec::Array<DomainSetting<Real, 2>>& domains, const Grid<Real>& grid,
                  const CrackFields& fields, const Cracks& cracks, double thickness, exec::Array<ContactArea>& areas) {
  const InterfaceSegments<Shape, Real> segments(domains, grid, fields, cracks);
  const exec::View<const Vec2> jump = exec::view(cracks.jump);  // shorter or empty before the first step
  const long flagged = fields.nodes.size();
  ContactArea* const out = exec::data(areas);
  exec::parallel_tasks(space, "contact areas", cracks.count(), [=] RIVEN_KERNEL(long c) {
    segments.each(c, [&](int p, const SegmentFrame& s, auto&& nodes) {
      const double area = thickness * s.length;
      const Vec2 local = p < jump.size ? jump[p] : Vec2{}, opening = local.x * s.normal + local.y * s.along;
      nodes([&](int i, int k, double weight) {
        ContactArea& to = out[entry_of(segments.nodes[i], i, k, flagged)];
        to.area += area * weight;
        to.opening += (area * weight) * opening;
      });
    });
  });
  exec::parallel_for(space, "contact areas", entries_of(fields), [=] RIVEN_KERNEL(long i) {
    if (out[i].area > 0)
      out[i].opening *= 1 / out[i].area;
  });
}

}  // namespace

template <class Real>
void contact_sums(const exec::Space& space, const ContactSumsChoice& choice, const ContactParticles<Real>& of,
                  const Grid<Real>& grid, const CrackFields& fields, const Cracks& cracks, double thickness,
                  ContactSums& sums) {
  const Particles<Real, 2>& p = of.particles;
  if ((choice.volume && ((p.J.empty() && p.F[0].empty()) || of.specific_area.size() != of.domains.size())) ||
      (choice.position && p.x0[0].empty()) || ((choice.volume || choice.position) && p.tiles.cell_start.empty()))
    fail({Exit::internal, "particles lack the arrays that the detection of contact needs", "contact sums", {}, {}, {}});
  const long slots = long{grid.lattice.nodes()} + fields.extra_slots;
  sums.place.renew(choice.position ? 4 * slots : 0);
  sums.volume.renew(choice.volume ? slots : 0);
  sums.known.resize(fields.nodes.size());
  sums.known.zero();
  sums.area.resize(choice.area ? entries_of(fields) : 0);
  sums.area.zero();
  if (!sums.area.empty())
    with_shape(of.shape, [&](auto type) {
      sum_segments<typename decltype(type)::type>(space, of.domains, grid, fields, cracks, thickness, sums.area);
    });
}

#define RIVEN_SUMS(Real)                                                                                  \
  template void contact_sums(const exec::Space&, const ContactSumsChoice&, const ContactParticles<Real>&, \
                             const Grid<Real>&, const CrackFields&, const Cracks&, double, ContactSums&);
RIVEN_EACH_REAL(RIVEN_SUMS)
#undef RIVEN_SUMS

}  // namespace RIVEN_SIDE

}  // namespace riven
