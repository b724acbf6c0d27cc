#include "kernels/bridge_integral.hpp"

#include <algorithm>
#include <cmath>

#include "core/fracture/auxiliary_fields.hpp"
#include "core/fracture/opening.hpp"

namespace riven {

namespace {

/// Cells from a tip within which nodes are bridged.
constexpr double extent = 2.5;

/// F . d(delta)/ds for the openings of K_I = 1 and K_II = 1, the upper face being to the left of the heading if `last`.
void add_known(TipTask& task, double weight, Vec2 force, double behind) {
  const Vec2 t = task.heading, n = turned(t);
  const AuxiliaryFields above = auxiliary_fields(*task.solid, task.running, {-behind, 0.0}),
                        below = auxiliary_fields(*task.solid, task.running, {-behind, -0.0});
  const double side = task.last ? 1 : -1;
  for (int mode = 0; mode < 2; ++mode) {
    const double along = above.mode[mode].dux_dx - below.mode[mode].dux_dx;
    const double across = above.mode[mode].duy_dx - below.mode[mode].duy_dx;
    task.sums.interaction[mode] -= weight * side * (dot(force, t) * along + dot(force, n) * across);
  }
}

void add_bridge(const State<double, 2>& s, const Tip& tip, const TipBridge& bridge, bool own, TipTask& task) {
  const Lattice& l = s.grid.lattice;
  const Vec2 end = s.cracks.plane[s.cracks.end_point(tip.crack, tip.last)];
  const Vec2 t = heading_of(s.cracks, tip), laid = heading_of(s.cracks, tip, true);
  const Vec2 opening =
      opening_behind(s.cracks, tip, l.h);  // over the root of the distance; across the heading, along it
  const double side = tip.last ? 1 : -1;
  const double at_tip = task.domain.weight(end - task.domain.tip), inv = 1 / s.thickness[tip.body];
  for (int k = 0; k < bridge.count; ++k) {
    const BridgedPair& p = bridge.pair[k];
    const Vec2 x = l.position(p.node);
    const double weight = (task.domain.weight(x - task.domain.tip) - at_tip) * inv;
    if (weight == 0)
      continue;
    const double behind = -dot(x - end, t);
    if (!(behind > 0))
      continue;
    const double slope = -0.5 * side / std::sqrt(behind);
    task.sums.faces -= (weight * slope * (dot(p.force, turned(t)) * opening.x + dot(p.force, t) * opening.y)) * laid;
    if (own && task.interaction)
      add_known(task, weight, p.force, behind);
  }
}

}  // namespace

void add_bridges(const State<double, 2>& s, const std::vector<TipBridge>& bridges, TipTask& task) {
  const double h = s.grid.lattice.h;
  const JDomain& d = task.domain;
  for (size_t k = 0; k < bridges.size(); ++k) {
    const Tip& tip = s.tips[k];
    if (!tip.open || bridges[k].count == 0)
      continue;
    const Vec2 r = s.cracks.plane[s.cracks.end_point(tip.crack, tip.last)] - d.tip;
    const double inside =
        std::min({d.inner(right) - r.x, d.inner(left) + r.x, d.inner(top) - r.y, d.inner(bottom) + r.y});
    const double outside =
        std::max({r.x - d.outer(right), -r.x - d.outer(left), r.y - d.outer(top), -r.y - d.outer(bottom)});
    if (inside > extent * h || outside > extent * h)
      continue;
    add_bridge(s, tip, bridges[k], tip.crack == task.crack && tip.last == task.last, task);
  }
}

}  // namespace riven
