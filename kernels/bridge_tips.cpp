#include "kernels/bridge_tips.hpp"

#include <algorithm>
#include <cmath>

#include "core/exec/parallel.hpp"
#include "core/fracture/crack_path.hpp"

namespace riven {

namespace {

/// Cells ahead of its tip at which a crack begins to part nodes.
constexpr double front = seen_ahead;
/// What a node a cell behind that parts by, over those behind it, when nothing holds it.
constexpr double free_share = 0.66;
/// Cells from the crack's line within which its particles and nodes see each other across it.
constexpr double beside = 1.5;
/// Least share of a node's weight at which faces that have moved away from it are taken to feel it.
constexpr double least_felt = 0.1;

double share_at(double s) {
  return free_share * (1 - std::sqrt(std::max(0.0, 1 - std::max(0.0, front - s))));
}

/// Half the opening of a tip's crack at `behind` m from its tip, m; 0 ahead of it and where the faces overlap. `t`: out
/// of the tip along the crack.
double half_opening(const Cracks& cracks, const Tip& tip, Vec2 t, double behind) {
  const int end = cracks.end_point(tip.crack, tip.last), other = cracks.end_point(tip.crack, !tip.last);
  const int step = tip.last ? -1 : 1;
  const Vec2 across = turned(tip.last ? t : -t);  // towards above
  double last = 0, from = 0;
  for (int k = end + step; behind > 0 && k != other + step; k += step) {
    const double to = norm(cracks.plane[k] - cracks.plane[end]);
    const double here = 0.5 * std::max(0.0, dot(cracks.upper[k] - cracks.lower[k], across));
    if (to >= behind && to > from)
      return last + (here - last) * (behind - from) / (to - from);
    last = here;
    from = to;
  }
  return last;
}

/// The weight at a face of a node beyond it, over that while the crack is shut: the node lies d from the crack's line,
/// the face has moved away from that by g, both in cells.
double felt(double g, double d) {
  return d < 1 - least_felt ? std::max(least_felt, 1 - g / (1 - d)) : 1;
}

template <class Real>
void find_bridge(const State<Real, 2>& state, const Tip& tip, TipBridge& bridge) {
  const CrackFields& fields = state.fields;
  const Cracks& cracks = state.cracks;
  const Lattice& l = state.grid.lattice;
  const Vec2 end = cracks.plane[cracks.end_point(tip.crack, tip.last)];
  const Vec2 along = end - cracks.plane[cracks.next_to_end(tip.crack, tip.last)];
  const Vec2 t = along * (1 / norm(along)), c = (end - l.origin) * (1 / l.h);
  const int i0 = static_cast<int>(std::floor(c.x)), j0 = static_cast<int>(std::floor(c.y));
  for (int j = std::max(0, j0 - 2); j <= std::min(l.ny - 1, j0 + 3); ++j)
    for (int i = std::max(0, i0 - 2); i <= std::min(l.nx - 1, i0 + 3); ++i) {
      const int node = j * l.nx + i, at = fields.node_index[node];
      if (at < 0 || fields.held[at] == 0)
        continue;
      const Vec2 r{i - c.x, j - c.y};
      const double s = dot(r, t);
      if (s <= front - 2 || std::fabs(cross(r, t)) > beside)
        continue;
      const NodeCracks& n = fields.nodes[at];
      const int m = n.which(tip.crack);
      if (m < 0)
        continue;
      const auto slot = [&](int field) { return field == 0 ? long{node} : long{l.nodes()} + n.extra + field - 1; };
      // on either side of the other cracks that the node holds
      for (int beyond = 0; beyond < n.fields(); ++beyond) {
        if (beyond & 1 << m)
          continue;
        const long near = slot(beyond), across = slot(beyond | 1 << m);
        if (!(state.grid.mass[near] > 0) || !(state.grid.mass[across] > 0))
          continue;
        const bool near_above = n.side[m] == Side::below;
        const double at_faces = felt(half_opening(cracks, tip, t, -s * l.h) / l.h, std::fabs(cross(r, t)));
        if (bridge.count < TipBridge::most)
          bridge.pair[bridge.count++] = {node, at, near_above ? near : across, near_above ? across : near,
                                         s > front - 1 ? share_at(s) / at_faces : -at_faces};
      }
    }
}

/// Brings the jumps around one tip to what the bridge asks for.
template <class Real, ContactStage stage>
class Bridging {
 public:
  Bridging(State<Real, 2>& s, FieldImpulses& impulses)
      : motion_(s.grid), notes_(impulses, s.grid.lattice), nodes_(s.fields.nodes.data()), dt_(s.clock.dt) {}

  void across(TipBridge& bridge) {
    Vec2 behind, sum;
    double mass = 0, all = 0, at_faces = 0;
    for (int k = 0; k < bridge.count; ++k) {
      const BridgedPair& p = bridge.pair[k];
      const double ma = motion_.mass[p.above], mb = motion_.mass[p.below];
      const double reduced = ma * mb / (ma + mb);
      const Vec2 jump = motion_.momentum_of(p.above) * (1 / ma) - motion_.momentum_of(p.below) * (1 / mb);
      jump_[k] = jump;
      reduced_[k] = reduced;
      if (p.share < 0) {
        behind += reduced * jump;
        mass += reduced;
        at_faces -= p.share * reduced;
      } else {
        sum += (p.share * reduced) * jump;
        all += p.share * p.share * reduced;
      }
    }
    if (!(mass > 0))
      return;
    at_faces /= mass;
    const Vec2 W = (behind + at_faces * sum) * (1 / (mass + at_faces * at_faces * all));
    const Vec2 shift = W - behind * (1 / mass);
    for (int k = 0; k < bridge.count; ++k) {
      BridgedPair& p = bridge.pair[k];
      const Vec2 impulse = reduced_[k] * (p.share < 0 ? shift : (at_faces * p.share) * W - jump_[k]);
      if constexpr (stage == ContactStage::after)
        p.force = impulse * (1 / dt_);
      push(p, p.above, impulse);
      push(p, p.below, -impulse);
    }
  }

 private:
  void push(const BridgedPair& p, long slot, Vec2 impulse) {
    const Vec2 velocity = (motion_.momentum_of(slot) + impulse) * (1 / double(motion_.mass[slot]));
    motion_.change(slot, impulse, velocity, dt_);
    notes_.add(stage, p.flagged, nodes_[p.flagged], slot, impulse);
  }

  FieldMotion<Real, stage> motion_;
  ImpulseNotes notes_;
  const NodeCracks* nodes_;
  double dt_;
  Vec2 jump_[TipBridge::most];
  double reduced_[TipBridge::most];
};

template <ContactStage stage, class Real>
void run(State<Real, 2>& s, std::vector<TipBridge>& bridges, FieldImpulses& impulses) {
  Bridging<Real, stage> bridging(s, impulses);
  for (TipBridge& bridge : bridges)
    bridging.across(bridge);
}

}  // namespace

template <class Real>
void list_bridges(const exec::Space& space, const State<Real, 2>& s, std::vector<TipBridge>& bridges) {
  bridges.resize(s.tips.size());
  exec::parallel_tasks(space, "bridge tips", static_cast<long>(s.tips.size()), [&](long k) {
    const Tip& tip = s.tips[static_cast<size_t>(k)];
    TipBridge& bridge = bridges[static_cast<size_t>(k)];
    bridge.count = 0;
    if (tip.open)
      find_bridge(s, tip, bridge);
  });
}

template <class Real>
void bridge_tips(State<Real, 2>& s, std::vector<TipBridge>& bridges, ContactStage stage, FieldImpulses& impulses) {
  switch (stage) {
    case ContactStage::before: return run<ContactStage::before>(s, bridges, impulses);
    case ContactStage::after: return run<ContactStage::after>(s, bridges, impulses);
    case ContactStage::again: return run<ContactStage::again>(s, bridges, impulses);
    case ContactStage::higher: return run<ContactStage::higher>(s, bridges, impulses);
  }
}

#define RIVEN_BRIDGE_TIPS(Real)                                                                   \
  template void list_bridges(const exec::Space&, const State<Real, 2>&, std::vector<TipBridge>&); \
  template void bridge_tips(State<Real, 2>&, std::vector<TipBridge>&, ContactStage, FieldImpulses&);
RIVEN_EACH_REAL(RIVEN_BRIDGE_TIPS)
#undef RIVEN_BRIDGE_TIPS

}  // namespace riven
