#include "kernels/link_fields.hpp"

#include <utility>

#include "core/exec/parallel.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/prescribed_fields.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

template <class Real>
struct Linking {
  static constexpr ContactStage stage = ContactStage::term;

  FieldMotion<Real, stage> motion;
  ImpulseNotes notes;
  PrescribedFields prescribed;
  const NodeNormals* normals;
  int nodes;
  double dt;

  RIVEN_INLINE void give(long index, const NodeCracks& n, long slot, Vec2 impulse) const {
    const Vec2 velocity = motion.velocity_of(slot) + (1 / double(motion.mass[slot])) * impulse;
    prescribed.give(motion, notes, index, n, slot, impulse, velocity, dt);
  }

  RIVEN_INLINE void two(long index, const NodeCracks& n, bool stick) const {
    const long slot[2] = {n.node, long{nodes} + n.extra};
    const double mass[2] = {double(motion.mass[slot[0]]), double(motion.mass[slot[1]])};
    const Vec2 u = motion.velocity_of(slot[0]) - motion.velocity_of(slot[1]), W = prescribed.yielding(slot, mass);
    const Vec2 normal = normals[index].now[0];
    const Vec2 impulse = stick ? Vec2{inverse_or_none(W.x) * u.x, inverse_or_none(W.y) * u.y}
                               : (reduced_masses(W, normal).x * dot(u, normal)) * normal;
    give(index, n, slot[0], -impulse);
    give(index, n, slot[1], impulse);
  }

  RIVEN_INLINE void several(long index, const NodeCracks& n, FieldLinks links) const {
    for (int first = 0; first < n.fields(); ++first) {
      double mass = 0, held_mass[2] = {0, 0};
      Vec2 momentum, held_momentum;
      const auto each = [&](auto&& act) {
        for (int f = first; f < n.fields(); ++f)
          if (const long slot = f == 0 ? n.node : long{nodes} + n.extra + f - 1;
              links.group(f) == first && motion.mass[slot] > 0)
            act(slot, double(motion.mass[slot]));
      };
      each([&](long slot, double m) {
        const Vec2 p = motion.momentum_of(slot);
        const unsigned held = prescribed.of(slot);
        mass += m;
        momentum += p;
        held_mass[0] += held & 1u ? m : 0;
        held_mass[1] += held & 2u ? m : 0;
        held_momentum += Vec2{held & 1u ? p.x : 0, held & 2u ? p.y : 0};
      });
      if (!(mass > 0))
        continue;
      const Vec2 common{held_mass[0] > 0 ? held_momentum.x / held_mass[0] : momentum.x / mass,
                        held_mass[1] > 0 ? held_momentum.y / held_mass[1] : momentum.y / mass};
      each([&](long slot, double m) { give(index, n, slot, m * (common - motion.velocity_of(slot))); });
    }
  }
};

}  // namespace

template <class Real>
void link_fields(const exec::Space& space, Grid<Real>& grid, const CrackFields& fields, double dt, bool last,
                 ContactSums& sums, FieldImpulses& impulses) {
  const Linking<Real> linking{FieldMotion<Real, ContactStage::term>(grid, last),
                              {impulses, grid.lattice},
                              prescribed_fields(sums),
                              exec::data(fields.normals),
                              grid.lattice.nodes(),
                              dt};
  const FieldLinks* links = exec::data(std::as_const(sums.links));
  const NodeCracks* nodes = exec::data(fields.nodes);
  exec::parallel_for(space, "link fields", sums.links.size(), [=] RIVEN_KERNEL(long i) {
    if (!links[i].any())
      return;
    if (links[i].groups())
      linking.several(i, nodes[i], links[i]);
    else
      linking.two(i, nodes[i], links[i].stick());
  });
}

#define RIVEN_LINK_FIELDS(Real)                                                                              \
  template void link_fields(const exec::Space&, Grid<Real>&, const CrackFields&, double, bool, ContactSums&, \
                            FieldImpulses&);
RIVEN_EACH_REAL(RIVEN_LINK_FIELDS)
#undef RIVEN_LINK_FIELDS

}  // namespace RIVEN_SIDE

}  // namespace riven
