// The gates that every hard case has to keep: numbers stay numbers, particles stay, momentum is kept to rounding and
// energy to 1 % per 1000 steps.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "tests/physics/scene_gates.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/stability/figures.hpp"

namespace riven::hard_cases {

/// Any number of a particle that is none.
inline bool has_nan(const Particles<double, 2>& p) {
  bool found = false;
  const auto look = [&](const auto& components) {
    for (const auto& a : components)
      for (const double x : a)
        found |= !std::isfinite(x);
  };
  look(p.x);
  look(p.v);
  look(p.stress);
  look(p.F);
  for (const double J : p.J)
    found |= !std::isfinite(J);
  return found;
}

/// The worst of a run so far.
struct Account {
  double lost = 0;      ///< kg m/s, of the momentum
  double momentum = 0;  ///< that over the largest sum of m |v| of the run
  double amiss = 0;     ///< J, |Energy::unaccounted|
  double energy = 0;    ///< that over the largest energy or work of the run: both begin with next to nothing
  double gained = 0;    ///< the same of energy that was made
  bool nan = false;
  long steps = 0;
  int particles = 0;

  explicit Account(Simulation& m) : particles(m.state.particles.count()) { m.take_stock(); }

  void look(Simulation& m) {
    m.take_stock();
    book(m);
  }

  /// What the ledger holds.
  void book(const Simulation& m) {
    const Momentum& p = m.state.ledger.momentum;
    lost = std::max(lost, p.error() * p.scale);
    momentum = p.scale > 0 ? lost / p.scale : 0;
    amiss = std::max(amiss, std::abs(m.state.ledger.energy.unaccounted()));
    energy = amiss / m.state.ledger.energy.largest;
    gained = std::max(gained, m.state.ledger.energy.numerical() / m.state.ledger.energy.largest);
    nan |= has_nan(m.state.particles);
    steps = m.state.clock.step;
  }
};

/// So many steps, with a look at every tenth.
inline void run(Simulation& m, Account& account, int steps, int every = 10) {
  for (int n = 1; n <= steps; ++n) {
    m.step();
    if (n % every == 0 || n == steps)
      account.look(m);
  }
}

inline void expect_kept(const std::string& row, const Account& a, const Simulation& m) {
  EXPECT_FALSE(a.nan) << row;
  EXPECT_EQ(m.state.particles.count(), a.particles) << row;
  below(row + ": momentum error", a.momentum, 1e-12);
  below(row + ": energy error", a.energy, 0.01 * std::max(1., static_cast<double>(a.steps) / 1000));
}

/// sqrt((lambda + 2 mu) / rho), m/s, in plane strain.
inline double wave_speed(const Material& m) {
  return std::sqrt(m.E * (1 - m.nu) / ((1 + m.nu) * (1 - 2 * m.nu)) / m.density);
}

}  // namespace riven::hard_cases
