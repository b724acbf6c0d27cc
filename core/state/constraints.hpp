// Prescribed grid velocities: fixed nodes, symmetry planes and the nodes that grips touch, as one list for the kernels.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/exec/array.hpp"
#include "core/math/vec.hpp"
#include "core/scene/scene.hpp"

namespace riven {

/// A node, or one of its velocity fields, whose velocity is prescribed. Components whose mask bit is unset are free.
struct Constraint {
  int node;
  int slot;               ///< of the field (grid.hpp)
  std::uint8_t mask;      ///< bit 0: x, bit 1: y
  std::int16_t owner[2];  ///< whose reaction each component is
};

/// A force averaged over the steps from one row of the history to the next, as that of one step alone swings with the
/// nodes that a grip comes to touch or leaves.
struct MeanForce {
  Vec2 impulse;         ///< since the last row, N s
  double time = 0;      ///< since then, s
  Vec2 value;           ///< at the last row, N
  double averaged = 0;  ///< s, over which

  void add(Vec2 more, double dt) {
    impulse += more;
    time += dt;
  }
  /// At a row. After less than `least` s, as at the end of a run, the time before counts, too.
  void take(double least) {
    if (time < least && averaged > 0) {
      impulse += averaged * value;
      time += averaged;
    }
    value = time > 0 ? (1 / time) * impulse : Vec2{};
    averaged = time;
    impulse = {};
    time = 0;
  }
};

/// Who prescribes: one entry for each [[fix]], [[symmetry]] and [[grip]].
struct ConstraintOwner {
  std::string name;
  std::optional<TimeFunction> velocity[2];
  double now[2] = {0, 0};     ///< velocity at the start of this step, m/s
  double next[2] = {0, 0};    ///< and at its end
  Vec2 impulse;               ///< given to the body in this step, N s
  double torque_impulse = 0;  ///< about the origin, N m s
  double work_now = 0;        ///< done on the body in this step, J
  double work = 0;            ///< done on the body so far, J
  Vec2 travel;                ///< how far it has moved, m
  Vec2 reaction;              ///< force of the last step, N
  MeanForce mean;             ///< the same, as results report it
  Vec2 move(double dt) const { return 0.5 * dt * Vec2{now[0] + next[0], now[1] + next[1]}; }
};

struct GripBlock {
  int owner;
  std::vector<Vec2> points;
  double half = 0.25;  ///< half size of a rigid particle, in cells
};

struct Constraints {
  std::vector<ConstraintOwner> owners;
  std::vector<Constraint> fixed;  ///< nodes known from the start; their fields are found in each step
  std::vector<GripBlock> grips;
  exec::Array<Constraint> list;  ///< of this step, by fields; those of a node stand together
  exec::Array<Vec2> now, next;   ///< [owners] velocities at the start and the end of this step, m/s
  exec::Array<Vec2> impulse;     ///< [list] given to each field in the stage at hand, N s
  exec::Array<Vec2> change[3];   ///< [list] the same before the update, in it, and after the second extrapolation
  exec::Array<int> at_node;      ///< [nodes] index into list + 1 of the first field while the list is made, else 0

  int first_grip() const { return static_cast<int>(owners.size() - grips.size()); }  ///< owners from there on are grips
};

}  // namespace riven
