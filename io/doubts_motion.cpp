// How bodies move: faster than their waves, or so that they strain by their spin.
#include <cmath>

#include "io/checks.hpp"
#include "io/doubts.hpp"

namespace riven {

using namespace checks;

namespace {

/// What flies faster than its own waves is meant to hit something at hundreds of metres a second, at least.
void doubt_velocity(const Scene& s, const Body& b, std::vector<Doubt>& list) {
  const Material& m = s.materials[static_cast<size_t>(b.material)];
  const double waves = std::sqrt(m.E / m.density), speed = norm(b.velocity);
  if (speed > waves)
    list.push_back({place(s, "body " + b.name),
                    fmt::format("it begins at {:.4g} m/s, faster than its waves, which run at {:.4g}", speed, waves),
                    "look at the unit of velocity"});
}

/// At a border nodes have the velocity of particles within the body, so that one that spins strains there. Where stress
/// comes last the grid gives way at once; velocities extrapolated from particles do not. A disk with a radius of 40
/// cells whose rim moves at 0.013 of its wave speed has by FLIP 1.5 times its strain energy more in each 11 degrees of
/// its turn, by FMPM 20 times; with usl, or with gradients of velocity, as much as it should.
void doubt_border_of_spin(const Scene& s, const Body& b, std::vector<Doubt>& list) {
  constexpr double far = 0.1;  // rad
  if (std::fabs(b.spin) * s.end_time > far && s.stress_update != StressUpdate::usl && !s.affine &&
      s.shape != ShapeFunction::linear)
    list.push_back({place(s, "body " + b.name), "it spins, and would strain at its borders by that",
                    "try solver.affine = true, or solver.stress_update = \"usl\""});
}

/// FLIP keeps what gradients of velocity have of noise, and with two updates of stress in a step uGIMP feeds it where a
/// loaded body flies: by a part in each cell of its way. A plate of 40 cells under tractions has gained 3 % of its
/// strain energy after 60 cells, 8 % after 80, and has 100 times as much after 133. With usl and FMPM it flies 370
/// cells unharmed, with B-splines and a part of PIC 150.
void doubt_gradients_that_fly(const Scene& s, const Body& b, std::vector<Doubt>& list) {
  constexpr double far = 30;  // cells
  if (s.affine && norm(b.velocity) * s.end_time > far * s.cell && s.transfer == Transfer::flip &&
      s.stress_update == StressUpdate::usavg && s.shape == ShapeFunction::ugimp)
    list.push_back({place(s, "body " + b.name),
                    fmt::format("it flies {:.0f} cells, and loaded it would gain energy by its gradients of velocity",
                                norm(b.velocity) * s.end_time / s.cell),
                    "try solver.stress_update = \"usl\", or solver.transfer = \"fmpm\" with solver.order = 1"});
}

}  // namespace

void doubt_motion(const Scene& s, std::vector<Doubt>& list) {
  for (const Body& b : s.bodies) {
    doubt_velocity(s, b, list);
    doubt_border_of_spin(s, b, list);
    doubt_gradients_that_fly(s, b, list);
  }
}

}  // namespace riven
