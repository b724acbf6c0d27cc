#include "kernels/field_impulses.hpp"

#include "kernels/strain_shares.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

constexpr int before = static_cast<int>(ContactStage::before), after = static_cast<int>(ContactStage::after),
              again = static_cast<int>(ContactStage::again), higher = static_cast<int>(ContactStage::higher);

}  // namespace

template <class Real>
ImpulseEnergy impulse_energy(const exec::Space& space, const Grid<Real>& grid, const CrackFields& fields,
                             FieldImpulses& impulses, const ImpulseRule& rule, double dt) {
  const bool again_too = rule.update == StressUpdate::musl || rule.update == StressUpdate::usavg;
  const Real *mass = exec::data(grid.mass), *q = exec::data(grid.q),
             *last = again_too ? exec::data(grid.again) : nullptr;
  const NodeCracks* nodes = exec::data(fields.nodes);
  const ImpulseNotes notes(impulses, grid.lattice);
  const StrainShares share = strain_shares(rule.update);
  return exec::parallel_sum<ImpulseEnergy>(
      space, "energy of impulses", fields.nodes.size(), [=] RIVEN_KERNEL(long i, ImpulseEnergy& sum) {
        const int acted = notes.acted[i];
        if (acted == 0)
          return;
        const NodeCracks& n = nodes[i];
        for (int field = 0; field < n.room(); ++field) {
          const long slot = field == 0 ? n.node : long{notes.nodes} + n.extra + field - 1;
          const double m = mass[slot];
          if (!(m > 0))
            continue;
          const Vec2* noted = notes.at(i, slot);
          const auto given = [&](int stage) { return acted & 1 << stage ? noted[stage] : Vec2{}; };
          const Vec2 a{double(q[4 * slot + 2]), double(q[4 * slot + 3])};
          const Vec2 v1{double(q[4 * slot]), double(q[4 * slot + 1])};
          const Vec2 late = given(higher) + rule.early * given(before);
          const Vec2 v0 = v1 - dt * a - (1 / m) * given(before);
          const Vec2 v2 = last ? Vec2{double(last[4 * slot]), double(last[4 * slot + 1])} - (1 / m) * given(again)
                               : v0 + dt * a + (1 / m) * late;
          const Vec2 strains = share.by_first * given(before) + share.by_last * given(again) +
                               (rule.high_gradient ? 1. : 0.) * given(higher);
          const Vec2 mean = 0.5 * (v0 + v2);
          sum.early += dot(late, mean);
          sum.work += dot(given(after) + late, mean) - dot(dt * a - (1 / m) * given(after), strains);
        }
      });
}

#define RIVEN_IMPULSES(Real)                                                                                       \
  template ImpulseEnergy impulse_energy(const exec::Space&, const Grid<Real>&, const CrackFields&, FieldImpulses&, \
                                        const ImpulseRule&, double);
RIVEN_EACH_REAL(RIVEN_IMPULSES)
#undef RIVEN_IMPULSES

}  // namespace RIVEN_SIDE

}  // namespace riven
