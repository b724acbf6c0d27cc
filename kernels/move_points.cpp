#include "kernels/move_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/exec/parallel.hpp"

namespace riven {

namespace {

/// How far a crack point moves in this step.
struct Moves {
  Vec2 upper, lower, plane;
  double angle = 0;  ///< by which the body turns there
  bool known = false;
};

/// The move of one surface; `velocity` is that kept by XPIC(1).
Vec2 surface_move(const PointMotion& m, SurfaceUpdate update, double dt, bool velocity_known, Vec2* velocity) {
  const Vec2 after = m.after(dt);
  switch (update) {
    case SurfaceUpdate::pic: return after * dt;
    case SurfaceUpdate::flip: return 0.5 * (m.before + after) * dt;
    case SurfaceUpdate::xpic: break;
  }
  const Vec2 last = velocity_known ? *velocity : m.before;
  *velocity = after;
  return (m.before + 0.5 * (after - last)) * dt;
}

/// A motion of less mass comes from nodes that the body barely reaches, as those around a crack's points that lie
/// outside of it: their accelerations f/m have no bound. Of a crack beside a body all are: `least` says so. Masses are
/// held against each other over the densities of the bodies that they belong to, where these differ.
class SoundMass {
 public:
  SoundMass(const FoundMotions& found, const Cracks& cracks, long first, long last, double least)
      : cracks_(cracks), least_(least) {
    for (long k = first; k < last; ++k)
      for (int side = 0; side < 2; ++side)
        most_ = std::max(most_, found.surface(k, side).mass / density(k, side));
  }
  /// At the upper (0) or the lower surface of point k.
  double of(long k, int side) const { return std::max(least_, 0.2 * most_ * density(k, side)); }

 private:
  double density(long k, int side) const {
    if (cracks_.density.empty())
      return 1;
    const double is = side == 0 ? cracks_.density[k].x : cracks_.density[k].y;
    return is > 0 ? is : std::numeric_limits<double>::max();
  }

  const Cracks& cracks_;
  double least_, most_ = 0;
};

/// What the plane of a point moves with: both faces where solids touch at first, across a gap each as far as the other
/// one is away, and along a single solid that one alone, whatever comes by later.
struct Follows {
  bool gap;           ///< at first, or there was no solid on some side
  bool upper, lower;  ///< there was
  double of_upper = 0.5;

  explicit Follows(Vec2 first)
      : gap(first.x + first.y > 0), upper(std::isfinite(first.x)), lower(std::isfinite(first.y)) {
    if (gap && upper != lower)
      of_upper = upper ? 1 : 0;
    else if (gap && upper)
      of_upper = first.y / (first.x + first.y);
  }
  /// Is the move of the plane known?
  bool known(bool has_upper, bool has_lower) const {
    return gap ? (of_upper == 0 || has_upper) && (of_upper == 1 || has_lower) : has_upper || has_lower;
  }
};

/// The moves of point k by what was found for it with no less mass than is sound.
Moves moves_of(const FoundMotions& found, const SoundMass& sound, CrackRules rules, double dt, long k, Cracks& cracks) {
  const auto kept = [](const PointMotion& m, double least) { return m.mass < least ? PointMotion{} : m; };
  const double above = sound.of(k, 0), below = sound.of(k, 1);
  const PointMotion up = kept(found.surface(k, 0), above), low = kept(found.surface(k, 1), below),
                    all = kept(found.of_all(k), std::min(above, below));
  const Follows follows(cracks.gap.empty() ? Vec2{} : cracks.gap[k]);
  const bool has_up = up.mass > 0 && follows.upper, has_low = low.mass > 0 && follows.lower;
  const bool xpic = rules.update == SurfaceUpdate::xpic;
  Vec2* const up_velocity = xpic ? &cracks.upper_velocity[k] : nullptr;
  Vec2* const low_velocity = xpic ? &cracks.lower_velocity[k] : nullptr;
  Moves m;
  if (has_up)
    m.upper = surface_move(up, rules.update, dt, cracks.velocities_known, up_velocity);
  if (has_low)
    m.lower = surface_move(low, rules.update, dt, cracks.velocities_known, low_velocity);
  const PointMotion& any = has_up ? up : has_low ? low : all;
  if (xpic && !has_up)
    *up_velocity = any.after(dt);
  if (xpic && !has_low)
    *low_velocity = any.after(dt);
  const double of_upper = has_up && has_low ? follows.of_upper : has_up;
  m.plane = of_upper * m.upper + (1 - of_upper) * m.lower;
  m.angle = dt * (of_upper * up.spin + (1 - of_upper) * low.spin);
  m.known = follows.known(has_up, has_low);
  if (all.mass > 0 && !follows.gap) {
    m.plane = surface_move(all, SurfaceUpdate::flip, dt, true, nullptr);
    m.angle = dt * all.spin;
    m.known = true;
  }
  if (!has_up)
    m.upper = m.plane;
  if (!has_low)
    m.lower = m.plane;
  return m;
}

/// The nearest point along a crack whose moves are known; k itself if there is none.
long nearest_known(const std::vector<Moves>& moves, long k) {
  const long count = static_cast<long>(moves.size());
  for (long d = 0; d <= k || k + d < count; ++d)
    for (const long at : {k - d, k + d})
      if (at >= 0 && at < count && moves[static_cast<size_t>(at)].known)
        return at;
  return k;
}

/// Lets a point without moves of its own move as if it were fixed to another one.
void follow(const Moves& m, long other, long k, Moves& own, Cracks& cracks) {
  const Vec2 arm = cracks.plane[k] - cracks.plane[other];
  own.plane = m.plane + (std::cos(m.angle) - 1) * arm + std::sin(m.angle) * turned(arm);
  own.upper = own.lower = own.plane;
  if (!cracks.upper_velocity.empty()) {
    cracks.upper_velocity[k] = cracks.upper_velocity[other];
    cracks.lower_velocity[k] = cracks.lower_velocity[other];
  }
}

/// The faces are one at an open tip.
void close_tip(Moves& m, long k, Cracks& cracks) {
  m.upper = m.lower = m.plane;
  if (!cracks.upper_velocity.empty())
    cracks.upper_velocity[k] = cracks.lower_velocity[k] = 0.5 * (cracks.upper_velocity[k] + cracks.lower_velocity[k]);
}

/// Moves the points of one crack by what was found for them.
void move_crack(const CrackRules& rules, double dt, int crack, const FoundMotions& found, Cracks& cracks) {
  const long first = cracks.end_point(crack, false), last = cracks.end_point(crack, true) + 1;
  const SoundMass sound(found, cracks, first, last, rules.least_mass);
  std::vector<Moves> moves(static_cast<size_t>(last - first));
  for (long k = first; k < last; ++k)
    moves[static_cast<size_t>(k - first)] = moves_of(found, sound, rules, dt, k, cracks);
  for (long k = first; k < last; ++k) {
    Moves& own = moves[static_cast<size_t>(k - first)];
    if (own.known)
      continue;
    const long other = nearest_known(moves, k - first);
    follow(moves[static_cast<size_t>(other)], first + other, k, own, cracks);
  }
  if (cracks.is_open(crack, false))
    close_tip(moves.front(), first, cracks);
  if (cracks.is_open(crack, true))
    close_tip(moves.back(), last - 1, cracks);
  for (long k = first; k < last; ++k) {
    const Moves& m = moves[static_cast<size_t>(k - first)];
    cracks.upper[k] += m.upper;
    cracks.lower[k] += m.lower;
    cracks.plane[k] += m.plane;
  }
}

}  // namespace

void move_points(const exec::Space& space, const FoundMotions& found, const CrackRules& rules, double dt,
                 Cracks& cracks) {
  exec::parallel_tasks(space, "move cracks", cracks.count(),
                       [&](long c) { move_crack(rules, dt, static_cast<int>(c), found, cracks); });
  cracks.velocities_known = true;
}

}  // namespace riven
