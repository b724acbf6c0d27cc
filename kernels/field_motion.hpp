// The motion of a node's velocity fields, which impulses between them change at several stages of the step.
#pragma once
#include <utility>

#include "core/math/vec.hpp"
#include "core/state/grid.hpp"

namespace riven {

enum class ContactStage {
  before,  ///< Grid::q holds [px py . .]: p changes
  after,   ///< Grid::q holds [vx vy ax ay]: v and a change
  again,   ///< Grid::again holds [px py . .]: p changes
  higher,  ///< Grid::high holds [vx vy . .]: v changes
  term     ///< Grid::next holds a term of the series of higher orders, [vx vy . .]: it changes
};

inline namespace RIVEN_SIDE {

/// The motion as each stage keeps it, in groups of four numbers.
template <class Real, ContactStage stage>
struct FieldMotion {
  static constexpr bool momentum = stage == ContactStage::before || stage == ContactStage::again;
  static constexpr bool acceleration = stage == ContactStage::after;

  const Real* mass;
  Real* data;
  Real* sum;  ///< to which the term that changes has been added; null if none

  /// `last`: of a term, Grid::high has it, too.
  explicit FieldMotion(Grid<Real>& grid, bool last = false)
      : mass(exec::data(std::as_const(grid.mass))),
        data(exec::data(stage == ContactStage::again    ? grid.again
                        : stage == ContactStage::higher ? grid.high
                        : stage == ContactStage::term   ? grid.next
                                                        : grid.q)),
        sum(stage == ContactStage::term && last ? exec::data(grid.high) : nullptr) {}
  RIVEN_INLINE Vec2 momentum_of(long slot) const {
    const Real* d = data + 4 * slot;
    return (momentum ? 1 : double(mass[slot])) * Vec2{double(d[0]), double(d[1])};
  }
  RIVEN_INLINE Vec2 velocity_of(long slot) const {
    const Real* d = data + 4 * slot;
    return (momentum ? 1 / double(mass[slot]) : 1) * Vec2{double(d[0]), double(d[1])};
  }
  /// Velocity before the forces and the impulses whose work is asked for: in the stage `after` those of the whole step.
  RIVEN_INLINE Vec2 first_velocity(long slot, double dt) const {
    const Real* d = data + 4 * slot;
    if constexpr (acceleration)
      return {d[0] - dt * d[2], d[1] - dt * d[3]};
    return momentum_of(slot) * (1 / double(mass[slot]));
  }
  RIVEN_INLINE void change(long slot, Vec2 impulse, Vec2 velocity, double dt) const {
    Real* d = data + 4 * slot;
    if constexpr (momentum) {
      d[0] = Real(d[0] + impulse.x);
      d[1] = Real(d[1] + impulse.y);
    } else {
      if constexpr (acceleration) {
        d[2] = Real(d[2] + (velocity.x - d[0]) / dt);
        d[3] = Real(d[3] + (velocity.y - d[1]) / dt);
      }
      if constexpr (stage == ContactStage::term)
        if (sum) {
          sum[4 * slot] += Real(velocity.x - d[0]);
          sum[4 * slot + 1] += Real(velocity.y - d[1]);
        }
      d[0] = Real(velocity.x);
      d[1] = Real(velocity.y);
    }
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
