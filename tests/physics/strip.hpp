// A crack along the middle of a strip of 60 x 24 mm between clamps that are pulled apart: behind the tip the strip is
// slack, ahead it is stretched without contraction along it, so that the energy release rate is that of the strip
// ahead,
//   J = 2 H W = E eps^2 H / (1 - nu^2)   (plane stress, half height H, eps = u / H),
// whatever the crack's length (Rice, J. Appl. Mech. 35 (1968) 379-386).
#pragma once
#include "tests/physics/scenes.hpp"

namespace riven::test {

struct Strip {
  static constexpr double mm = 1e-3, cell = mm, H = 12 * mm, length = 60 * mm;
  static constexpr double E = 2.5e9, nu = 0.33, density = 1000;

  /// With a crack from the left edge to `tip`, m, that grows where J reaches `toughness`, J/m^2; each clamp moves at
  /// `speed`.
  static Scene scene(double tip, double toughness, const TimeFunction& speed) {
    Scene s = empty_scene(cell, {{-4 * mm, -18 * mm}, {length + 4 * mm, 18 * mm}});
    s.plane = Plane::stress;
    s.thickness = mm;
    s.materials = {{"strip", LawKind::linear_elastic, E, nu, density}};
    s.transfer = Transfer::fmpm;
    s.order = 1;
    s.bodies = {body("strip", Rectangle{{0, -H}, {length, H}})};
    s.cracks = {crack("middle", {{-mm, 0}, {tip, 0}})};
    s.growth = GrowthRule{};
    s.growth->criterion = GrowthCriterion::critical_j;
    s.growth->toughness = toughness;
    clamp(s, "low", {{0, -H - mm}, {length, -H}}, -1, speed);
    clamp(s, "high", {{0, H}, {length, H + mm}}, 1, speed);
    return s;
  }

  static double strain(const Simulation& m) { return m.state.constraints.owners[1].travel.y / H; }
  /// J/m^2.
  static double J(double strain) { return E * strain * strain * H / (1 - nu * nu); }
  /// Across the strip, where it is ahead of the tip, Pa.
  static double stress_ahead(double strain) { return E * strain / (1 - nu * nu); }

 private:
  static void clamp(Scene& s, const char* name, const Rectangle& region, double sign, TimeFunction speed) {
    Grip g;
    g.name = name;
    g.region = region;
    g.velocity[0] = constant(0);
    speed.value *= sign;
    g.velocity[1] = std::move(speed);
    s.grips.push_back(g);
  }
};

}  // namespace riven::test
