#include "kernels/bridge_integral.hpp"

#include <algorithm>
#include <cmath>

#include "core/fracture/auxiliary_fields.hpp"
#include "core/fracture/opening.hpp"

namespace riven {

namespace {

/// Cells from a tip within which nodes are bridged.
constexpr double extent = 2.5;

/// Cells behind a tip from which on the slope of its opening is taken where a node is. What acts on a node acts on the
/// faces around it: one next to the tip has no part in a slope without bounds.
constexpr double least_behind = 0.25;

template <class Real>
void add_bridge(const State<Real, 2>& s, const Tip& tip, const TipBridge& bridge, Vec2 end, bool own, TipTask& task) {
  const Lattice& l = s.grid.lattice;
  const Vec2 t = heading_of(s.cracks, tip);
  const double at_tip = task.domain.weight(end - task.domain.tip), inv = 1 / s.thickness[tip.body];
  Vec2 force;  // over the root of the distance behind the tip
  for (int k = 0; k < bridge.count; ++k) {
    const BridgedPair& p = bridge.pair[k];
    const Vec2 x = l.position(p.node);
    const double weight = task.domain.weight(x - task.domain.tip) - at_tip, behind = dot(end - x, t);
    if (weight != 0 && behind > 0)
      force += (weight * inv / std::sqrt(std::max(behind, least_behind * l.h))) * p.force;
  }
  if (force.x == 0 && force.y == 0)
    return;
  // over the root of the distance; across the heading, and along it
  const Vec2 opening = opening_behind(s.cracks, tip, l.h);
  const double slope = -0.5 * (tip.last ? 1 : -1);
  task.sums.faces -=
      (slope * (dot(force, turned(t)) * opening.x + dot(force, t) * opening.y)) * heading_of(s.cracks, tip, true);
  if (!own || !task.interaction)
    return;
  const KnownOpening known(*task.solid, task.running, task.heading, task.last);
  for (int mode = 0; mode < 2; ++mode)
    task.sums.interaction[mode] -= dot(force, known.slope[mode]);
}

}  // namespace

template <class Real>
void add_bridges(const State<Real, 2>& s, const TipBridges& bridges, const TipPlaces& places, TipTask& task) {
  const double h = s.grid.lattice.h;
  const JDomain& d = task.domain;
  const double far = std::max({d.outer(right), d.outer(top), d.outer(left), d.outer(bottom)}) + extent * h;
  if (bridges.of_tip.empty())
    return;
  places.each_near(d.tip, far, [&](size_t k) {
    const Vec2 r = places[k] - d.tip;
    const double inside =
        std::min({d.inner(right) - r.x, d.inner(left) + r.x, d.inner(top) - r.y, d.inner(bottom) + r.y});
    const double outside =
        std::max({r.x - d.outer(right), -r.x - d.outer(left), r.y - d.outer(top), -r.y - d.outer(bottom)});
    if (inside > extent * h || outside > extent * h)
      return;
    const Tip& tip = s.tips[k];
    if (tip.open && bridges.of_tip[static_cast<long>(k)].count > 0)
      add_bridge(s, tip, bridges.of_tip[static_cast<long>(k)], places[k],
                 tip.crack == task.crack && tip.last == task.last, task);
  });
}

#define RIVEN_BRIDGES(Real) \
  template void add_bridges(const State<Real, 2>&, const TipBridges&, const TipPlaces&, TipTask&);
RIVEN_EACH_REAL(RIVEN_BRIDGES)
#undef RIVEN_BRIDGES

}  // namespace riven
