// Where energy and momentum went, term by term.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/math/vec.hpp"

namespace riven {

struct Energy {
  double kinetic = 0, strain = 0;  ///< J, now
  double cohesive = 0;             ///< stored in cohesive laws, to be given back
  double external_work = 0;        ///< done on the bodies by loads, body forces, prescribed motion
  double damping = 0;              ///< taken by grid and particle damping
  double contact = 0;              ///< taken by contact (friction and impact) and by what ends cracks between nodes
  double capture = 0;              ///< taken by prescribed motion, as by an impact, beyond the work of its reactions
  /// Taken by the transfer from grid to particles: what PIC, XPIC and FMPM wear off waves of a few cells, contact's
  /// early impulses left out. FLIP takes none.
  double transfer = 0;
  double anchoring = 0;  ///< taken as strains were held to where particles are (kernels/anchor_strains.hpp)
  double fracture = 0;   ///< released by crack growth, J times new area; see below
  double debonding = 0;  ///< taken by damage of cohesive laws
  double first = 0;      ///< total at the start
  double largest = 0;    ///< largest total, or work done, so far

  double total() const { return kinetic + strain + cohesive; }
  /// Energy that the scheme made (> 0) or lost: the parts of the transfer and of anchoring, and what is left over. What
  /// a crack takes by growing is in here as a loss, not on its own: a new segment changes no particle's energy. It lets
  /// go of the stress across it, and that energy runs away as waves of a few cells, which the transfers then wear down
  /// as they do all such waves, or keep. `fracture` tells how much of the loss is due to growth; where `transfer` is
  /// less, the rest is still in waves.
  double numerical() const { return total() + damping + contact + capture + debonding - external_work - first; }
  /// The part of it that nothing accounts for.
  double unaccounted() const { return numerical() + transfer + anchoring; }
  /// What contact, which should take energy only, has given, beyond what the transfer has worn down: what it gives to
  /// short waves that are worn down again is no gain.
  double given_by_contact() const { return std::max(0., -contact - std::max(0., transfer)); }
  /// unaccounted() over the largest energy or work so far.
  double relative_error() const { return largest > 0 ? unaccounted() / largest : 0; }
};

struct Momentum {
  Vec2 linear;         ///< kg m/s, now
  double angular = 0;  ///< kg m^2/s about the origin, now
  Vec2 first;
  double first_angular = 0;
  Vec2 impulse;  ///< of loads, body forces, damping and reactions so far
  double torque_impulse = 0;
  double torque_size = 0;    ///< the same, of each source and step without its sign
  double scale = 0;          ///< largest sum of m |v| so far
  double angular_scale = 0;  ///< largest sum of m |x| |v| so far

  double error() const { return scale > 0 ? norm(linear - first - impulse) / scale : 0; }
  /// Moments that keep each other in balance are a measure, too: by the motion alone, of a body that they hold nearly
  /// at rest, a rounding of them is large.
  double angular_error() const {
    const double size = std::max(angular_scale, torque_size);
    return size > 0 ? std::abs(angular - first_angular - torque_impulse) / size : 0;
  }
  /// Books a moment of impulse.
  void turn(double moment) {
    torque_impulse += moment;
    torque_size += std::abs(moment);
  }
};

struct Ledger {
  Energy energy;
  Momentum momentum;
};

}  // namespace riven
