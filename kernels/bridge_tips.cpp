#include "kernels/bridge_tips.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/exec/parallel.hpp"
#include "core/fracture/crack_path.hpp"
#include "core/fracture/tip_places.hpp"
#include "kernels/crack_view.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

/// Cells ahead of its tip at which a crack begins to part nodes.
constexpr double front = seen_ahead;
/// What a node a cell behind that parts by, over those behind it, when nothing holds it.
constexpr double free_share = 0.66;
/// Cells from the crack's line within which its particles and nodes see each other across it.
constexpr double beside = 1.5;
/// Least share of a node's weight at which faces that have moved away from it are taken to feel it.
constexpr double least_felt = 0.1;

RIVEN_FN double share_at(double s) {
  return free_share * (1 - std::sqrt(std::max(0.0, 1 - std::max(0.0, front - s))));
}

/// A tip as a kernel sees it.
struct TipEnd {
  int crack;
  bool last, open;
};

/// Half the opening of a tip's crack at `behind` m from its tip, m; 0 ahead of it and where the faces overlap. `t`: out
/// of the tip along the crack.
RIVEN_FN double half_opening(const CrackView& cracks, const TipEnd& tip, Vec2 t, double behind) {
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
RIVEN_FN double felt(double g, double d) {
  const double share = d < 1 - least_felt ? 1 - g / (1 - d) : 1;
  return share > least_felt ? share : least_felt;
}

template <class Real>
struct BridgeFinder {
  Lattice l;
  CrackView cracks;
  const int* node_index;
  const NodeCracks* nodes;
  const std::uint8_t* held;
  const Real* mass;

  RIVEN_FN void find(const TipEnd& tip, TipBridge& bridge) const {
    const Vec2 end = cracks.plane[cracks.end_point(tip.crack, tip.last)];
    const Vec2 along = end - cracks.plane[cracks.next_to_end(tip.crack, tip.last)];
    const Vec2 t = along * (1 / norm(along)), c = (end - l.origin) * (1 / l.h);
    const int i0 = static_cast<int>(std::floor(c.x)), j0 = static_cast<int>(std::floor(c.y));
    for (int j = std::max(0, j0 - 2); j <= std::min(l.ny - 1, j0 + 3); ++j)
      for (int i = std::max(0, i0 - 2); i <= std::min(l.nx - 1, i0 + 3); ++i) {
        const int at = node_index[j * l.nx + i];
        if (at < 0 || held[at] == 0)
          continue;
        const Vec2 r{i - c.x, j - c.y};
        const double s = dot(r, t);
        if (s <= front - 2 || std::fabs(cross(r, t)) > beside)
          continue;
        if (const int m = nodes[at].which(tip.crack); m >= 0)
          add(tip, t, at, m, s, std::fabs(cross(r, t)), bridge);
      }
  }

 private:
  /// The fields of node CrackFields::nodes[at] on either side of the tip's crack, which is the m-th that it holds; once
  /// for each side of the other cracks that it holds. s and d cells from the tip, along the crack and across.
  RIVEN_FN void add(const TipEnd& tip, Vec2 t, int at, int m, double s, double d, TipBridge& bridge) const {
    const NodeCracks& n = nodes[at];
    const auto slot = [&](int field) { return field == 0 ? long{n.node} : long{l.nodes()} + n.extra + field - 1; };
    for (int beyond = 0; beyond < n.fields(); ++beyond) {
      if (beyond & 1 << m)
        continue;
      const long near = slot(beyond), across = slot(beyond | 1 << m);
      if (!(mass[near] > 0) || !(mass[across] > 0))
        continue;
      const bool near_above = n.side[m] == Side::below;
      const double at_faces = felt(half_opening(cracks, tip, t, -s * l.h) / l.h, d);
      if (bridge.count < TipBridge::most)
        bridge.pair[bridge.count++] = {n.node,
                                       at,
                                       near_above ? near : across,
                                       near_above ? across : near,
                                       s > front - 1 ? share_at(s) / at_faces : -at_faces,
                                       {}};
    }
  }
};

/// Tips whose nodes may be the same lie this near to each other, in cells.
constexpr double shared_within = 6;

/// Tips that share nodes are bridged in turns: each bridge is the least change of momentum that meets it, and so is
/// what many turns lead to that meets them all. One turn alone would make energy: the first bridge no longer holds
/// where the second has acted. Until a turn changes so little of what the first did, or so many times.
constexpr double settled = 1e-4;
constexpr int most_turns = 100;

/// Groups the tips that have to wait for each other.
void group(const Cracks& cracks, const std::vector<Tip>& tips, double h, TipBridges& bridges) {
  const int count = static_cast<int>(tips.size());
  bridges.tip.resize(count);
  bridges.start.resize(count + 1);
  int groups = 0, listed = 0;
  std::vector<Vec2> at;
  for (const Tip& t : tips)
    at.push_back(cracks.plane[cracks.end_point(t.crack, t.last)]);
  const TipPlaces places(std::move(at));
  std::vector<bool> known(tips.size());
  for (int first = 0; first < count; ++first) {
    if (known[static_cast<size_t>(first)])
      continue;
    known[static_cast<size_t>(first)] = true;
    const int begin = bridges.start[groups++] = listed;
    bridges.tip[listed++] = first;
    for (int k = begin; k < listed; ++k)
      places.each_near(places[static_cast<size_t>(bridges.tip[k])], shared_within * h, [&](size_t near) {
        if (!known[near])
          bridges.tip[listed++] = static_cast<int>(near);
        known[near] = true;
      });
    std::sort(&bridges.tip[begin], &bridges.tip[begin] + (listed - begin));
  }
  bridges.start[groups] = listed;
  bridges.start.resize(groups + 1);
}

/// Brings the jumps around one tip to what the bridge asks for.
template <class Real, ContactStage stage>
class Bridging {
 public:
  Bridging(State<Real, 2>& s, FieldImpulses& impulses, bool last)
      : motion_(s.grid, last),
        notes_(impulses, s.grid.lattice),
        nodes_(exec::data(std::as_const(s.fields.nodes))),
        dt_(s.clock.dt) {}

  /// Returns the largest impulse, N s.
  RIVEN_FN double across(TipBridge& bridge) const {
    Vec2 jumps[TipBridge::most];
    double reduced_mass[TipBridge::most];
    Vec2 behind, sum;
    double mass = 0, all = 0, at_faces = 0, largest = 0;
    for (int k = 0; k < bridge.count; ++k) {
      const BridgedPair& p = bridge.pair[k];
      const double ma = motion_.mass[p.above], mb = motion_.mass[p.below];
      const double reduced = ma * mb / (ma + mb);
      const Vec2 jump = motion_.momentum_of(p.above) * (1 / ma) - motion_.momentum_of(p.below) * (1 / mb);
      jumps[k] = jump;
      reduced_mass[k] = reduced;
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
      return 0;
    at_faces /= mass;
    const Vec2 W = (behind + at_faces * sum) * (1 / (mass + at_faces * at_faces * all));
    const Vec2 shift = W - behind * (1 / mass);
    for (int k = 0; k < bridge.count; ++k) {
      BridgedPair& p = bridge.pair[k];
      const Vec2 impulse = reduced_mass[k] * (p.share < 0 ? shift : (at_faces * p.share) * W - jumps[k]);
      if constexpr (stage == ContactStage::after)
        p.force += impulse * (1 / dt_);
      largest = std::max(largest, norm(impulse));
      push(p, p.above, impulse);
      push(p, p.below, -impulse);
    }
    return largest;
  }

 private:
  RIVEN_FN void push(const BridgedPair& p, long slot, Vec2 impulse) const {
    const Vec2 velocity = (motion_.momentum_of(slot) + impulse) * (1 / double(motion_.mass[slot]));
    motion_.change(slot, impulse, velocity, dt_);
    notes_.add(stage, p.flagged, nodes_[p.flagged], slot, impulse);
  }

  FieldMotion<Real, stage> motion_;
  ImpulseNotes notes_;
  const NodeCracks* nodes_;
  double dt_;
};

template <ContactStage stage, class Real>
void run(const exec::Space& space, State<Real, 2>& s, TipBridges& bridges, FieldImpulses& impulses, bool last = false) {
  const Bridging<Real, stage> bridging(s, impulses, last);
  const int *start = exec::data(std::as_const(bridges.start)), *tip = exec::data(std::as_const(bridges.tip));
  const long groups = bridges.start.size() - 1;
  const long each = exec::lanes > 1 ? groups : 1;  // too little for threads of the host to be woken for
  exec::parallel_tasks(space, "bridge tips", exec::lanes > 1 ? 1 : groups,
                       [=, bridge = exec::data(bridges.of_tip)] RIVEN_KERNEL(long task) {
                         for (long g = task * each; g < (task + 1) * each; ++g) {
                           double first = 0;
                           for (int turn = 0; turn < most_turns; ++turn) {
                             double largest = 0;
                             for (int k = start[g]; k < start[g + 1]; ++k)
                               largest = std::max(largest, bridging.across(bridge[tip[k]]));
                             first = turn == 0 ? largest : first;
                             if (start[g + 1] - start[g] == 1 || !(largest > settled * first))
                               break;
                           }
                         }
                       });
}

}  // namespace

template <class Real>
void list_bridges(const exec::Space& space, const State<Real, 2>& s, TipBridges& bridges) {
  const long tips = static_cast<long>(s.tips.size());
  exec::Array<TipEnd> ends(tips);
  for (long k = 0; k < tips; ++k) {
    const Tip& tip = s.tips[static_cast<size_t>(k)];
    ends[k] = {tip.crack, tip.last, tip.open};
  }
  group(s.cracks, s.tips, s.grid.lattice.h, bridges);
  bridges.of_tip.resize(tips);
  const BridgeFinder<Real> finder{s.grid.lattice,
                                  crack_view(s.cracks),
                                  exec::data(s.fields.node_index),
                                  exec::data(s.fields.nodes),
                                  exec::data(s.fields.held),
                                  exec::data(s.grid.mass)};
  exec::parallel_tasks(
      space, "bridge tips", tips,
      [=, end = exec::data(std::as_const(ends)), bridge = exec::data_to_fill(bridges.of_tip)] RIVEN_KERNEL(long k) {
        bridge[k].count = 0;
        if (end[k].open)
          finder.find(end[k], bridge[k]);
      });
}

template <class Real>
void bridge_tips(const exec::Space& space, State<Real, 2>& s, TipBridges& bridges, ContactStage stage,
                 FieldImpulses& impulses, bool last) {
  switch (stage) {
    case ContactStage::before: return run<ContactStage::before>(space, s, bridges, impulses);
    case ContactStage::after: return run<ContactStage::after>(space, s, bridges, impulses);
    case ContactStage::again: return run<ContactStage::again>(space, s, bridges, impulses);
    case ContactStage::term: return run<ContactStage::term>(space, s, bridges, impulses, last);
    case ContactStage::higher: break;  // holds what is linear in each term
  }
}

#define RIVEN_BRIDGE_TIPS(Real)                                                       \
  template void list_bridges(const exec::Space&, const State<Real, 2>&, TipBridges&); \
  template void bridge_tips(const exec::Space&, State<Real, 2>&, TipBridges&, ContactStage, FieldImpulses&, bool);
RIVEN_EACH_REAL(RIVEN_BRIDGE_TIPS)
#undef RIVEN_BRIDGE_TIPS

}  // namespace RIVEN_SIDE

}  // namespace riven
