// Cracks that meet: stars of cracks that end on one node, shut ones that cross, two tips in one cell, cracks half a
// cell apart.
#include <numbers>

#include "tests/physics/plates.hpp"
#include "tests/spaces.hpp"
#include "tests/stability/gates.hpp"

namespace riven {
namespace {

using namespace test;
using namespace hard_cases;

constexpr double coarse = 0.125;  ///< m
constexpr Vec2 on_a_node{1.5, 1.5}, beside_one{1.53, 1.46};

const char* name_of(Vec2 middle) {
  return middle == on_a_node ? "on a node" : "beside one";
}

/// A plate of 24 x 24 coarse cells under tension on all sides, from whose middle cracks run in all directions.
Scene star(int arms, const Vec2 middle, Transfer transfer, double cell = coarse) {
  constexpr double h = coarse, edge = 24 * h;
  Scene s = empty_scene(cell, {{-8 * h, -8 * h}, {edge + 8 * h, edge + 8 * h}});
  s.bodies = {body("plate", Rectangle{{0, 0}, {edge, edge}})};
  s.transfer = transfer;
  for (int k = 0; k < arms; ++k) {
    const double angle = 2 * std::numbers::pi * k / arms;
    s.cracks.push_back(crack("arm", {middle, middle + 6 * h * Vec2{std::cos(angle), std::sin(angle)}}));
  }
  using enum Load::Edge;
  for (const Load::Edge side : {left, right, bottom, top}) {
    Load pull = traction_on(side, s.bodies[0].region);
    pull.name = name_of(side);
    const bool across = side == bottom || side == top;
    pull.value[across] = TimeFunction{(side == left || side == bottom ? -1 : 1) * 1e3,
                                      [](double t) { return std::min(1., t / 0.1); }, ""};
    s.loads.push_back(pull);
  }
  return s;
}

TEST(Star, StandsTensionOnAllSides) {
  for (const int arms : {3, 4, 5})
    for (const Vec2 middle : {on_a_node, beside_one})
      for (const Transfer transfer : {Transfer::flip, Transfer::fmpm}) {
        const Scene s = star(arms, middle, transfer);
        const ChosenSpace space;
        Simulation m(s, space);
        Account account(m);
        double fastest = 0;
        for (int n = 0; n < 200; ++n) {
          run(m, account, 10);
          const auto& p = m.state.particles;
          for (int i = 0; i < p.count(); ++i)
            fastest = std::max(fastest, std::hypot(p.v[0][i], p.v[1][i]));
        }
        const std::string row = fmt::format("star of {} {}, {}", arms, name_of(middle), name_of(transfer));
        below(row + ": momentum error", account.momentum, 1e-12);
        below(row + ": fastest particle over 100 sigma / (rho c)", fastest / (100 * 1e3 / (1000 * wave_speed(solid()))),
              1);
        EXPECT_FALSE(account.nan);
        if (transfer == Transfer::flip)
          below(row + ": energy error in 2000 steps", account.energy, 0.02);
        if (arms > 3) {
          above(row + ": pairs that met a fourth crack, counted",
                static_cast<double>(m.state.fields.warning_fourth_crack), 0);
        } else {
          below(row + ": pairs that met a fourth crack", static_cast<double>(m.state.fields.warning_fourth_crack), 1);
        }
      }
}

/// Pressures along x and y, and shear, Pa.
struct Press {
  double x, y, shear;
};

/// A plate of 40 x 40 mm under these, with shut cracks of 24 mm through one place, at angles in degrees.
Scene pressed_lines(const std::vector<double>& angles, Vec2 middle, Press by, ContactSettings law) {
  constexpr double mm = 1e-3, rise = 1e-4;
  Scene s = empty_scene(mm, {{-24 * mm, -24 * mm}, {24 * mm, 24 * mm}});
  s.materials = {{"plate", LawKind::linear_elastic, 2.5e9, 0.33, 1200}};
  s.thickness = mm;
  s.bodies = {body("plate", Rectangle{{-20 * mm, -20 * mm}, {20 * mm, 20 * mm}})};
  s.contact = law;
  for (const double angle : angles) {
    const double turn = angle * std::numbers::pi / 180;
    const Vec2 half = 12 * mm * Vec2{std::cos(turn), std::sin(turn)};
    s.cracks.push_back(crack("line", {middle - half, middle + half}));
  }
  using enum Load::Edge;
  for (const Load::Edge side : {left, right, bottom, top}) {
    Load press = traction_on(side, s.bodies[0].region);
    press.name = name_of(side);
    const bool across = side == bottom || side == top;
    const double out = side == left || side == bottom ? -1 : 1;
    const auto slowly = [](double t) { return 0.5 - 0.5 * std::cos(std::numbers::pi * std::min(t / rise, 1.)); };
    press.value[across] = TimeFunction{-out * (across ? by.y : by.x), slowly, ""};
    press.value[!across] = TimeFunction{out * by.shear, slowly, ""};
    s.loads.push_back(press);
  }
  return s;
}

/// Particles a rounding error past a crack give a node fields of 1e-69 kg, to which what is next to nothing of its
/// momenta is an energy of 1e4 times that of the plate.
TEST(Crossing, FieldsOfNextToNoMassTakeNoPart) {
  for (const double angle : {15., 17., 30., 40., 60.})
    for (const Transfer transfer : {Transfer::flip, Transfer::fmpm}) {
      Scene s = pressed_lines({angle, angle - 90}, {}, {1e7, 1e7, 0}, {ContactLaw::coulomb, 0.6, 0, 0});
      s.transfer = transfer;
      s.end_time = 2e-5;
      const ChosenSpace space;
      Simulation m(s, space);
      double most = 0;
      while (!m.finished()) {
        m.step();
        m.take_stock();
        most = std::max(most, std::abs(m.state.ledger.energy.contact));
      }
      below(fmt::format("crossing at {} degrees, {}: energy of contact over work", angle, name_of(transfer)),
            most / m.state.ledger.energy.external_work, 1e-3);
    }
}

/// Faces that press stay together in the stages without forces where cracks cross, too. Let go there, they open, and
/// contact makes energy at rest.
TEST(Crossing, ThreeShutCracksRest) {
  for (const int order : {1, 4}) {
    Scene s = pressed_lines({10, 70, 130}, {0.3e-3, 0.2e-3}, {1e7, 8e6, 2e6}, {ContactLaw::frictionless, 0, 0, 0});
    s.transfer = Transfer::fmpm;
    s.order = order;
    s.grid_damping = constant(1.2e5);
    const ChosenSpace space;
    Simulation m(s, space);
    while (m.state.clock.time < 4e-4)
      m.step();
    m.take_stock();
    const Energy& e = m.state.ledger.energy;
    below(
        fmt::format("three shut cracks through one place, FMPM({}): energy made by contact over strain energy", order),
        -e.contact / e.strain, 2e-3);
  }
}

/// m, by which the particles within a coarse cell of the middle have moved away from it, the mean over the time in
/// which waves go through the plate five times.
double opening(const Scene& s, const Vec2 middle) {
  const ChosenSpace space;
  Simulation m(s, space);
  const double end = 5 * 24 * coarse / wave_speed(solid());
  double sum = 0;
  while (m.state.clock.time < end) {
    m.step();
    const auto& p = m.state.particles;
    double moved = 0;
    int near = 0;
    for (int i = 0; i < p.count(); ++i) {
      const Vec2 r = Vec2{p.x0[0][i], p.x0[1][i]} - middle, u = Vec2{p.x[0][i] - p.x0[0][i], p.x[1][i] - p.x0[1][i]};
      if (norm(r) < coarse) {
        moved += dot(u, r) / norm(r);
        ++near;
      }
    }
    sum += m.state.clock.dt * moved / near;
  }
  return sum / m.state.clock.time;
}

/// On a node half the coarse cells are asked for: there the arms along the grid lines open further on coarse cells, and
/// so does one straight crack, by 17 % (on half cells, by 5 %).
TEST(Star, OpensAtItsMiddleOnACoarseGridAsOnAFineOne) {
  for (const int arms : {3, 4, 5})
    for (const Vec2 middle : {on_a_node, beside_one}) {
      const double cell = middle == on_a_node ? coarse / 2 : coarse;
      const double wide = opening(star(arms, middle, Transfer::fmpm, cell), middle);
      const double right = opening(star(arms, middle, Transfer::fmpm, coarse / 4), middle);
      below(fmt::format("star of {} {}: opening less that on cells of a {}", arms, name_of(middle),
                        middle == on_a_node ? "half" : "quarter"),
            std::abs(wide / right - 1), 0.1);
    }
}

/// Two arms are one straight crack; whether it is drawn as one or as two that meet changes nothing but rounding and
/// what lies within the length by which they overlap.
TEST(Star, OfTwoArmsOpensAsOneCrack) {
  for (const Vec2 middle : {on_a_node, beside_one}) {
    const Scene two = star(2, middle, Transfer::fmpm);
    Scene one = two;
    one.cracks.pop_back();
    one.cracks[0].points[0] = two.cracks[1].points[1];
    below(fmt::format("star of 2 {}: opening less that of one crack", name_of(middle)),
          std::abs(opening(two, middle) / opening(one, middle) - 1), 0.006);
  }
}

constexpr double mm = 1e-3;

/// The edge crack of `sent`, or two such, at `places`, on cells of 1 mm; the tips of all of them.
std::vector<Tip> tips_of_edge_cracks(const std::vector<double>& places, double length, int contour) {
  Scene s = gates::shipped("sent", {"grid.cell=1 mm"});
  const CrackLine line = s.cracks[0];
  s.cracks.clear();
  for (const double y : places) {
    s.cracks.push_back(line);
    s.cracks.back().points = {{-mm, y}, {length, y}};
  }
  gates::Plate plate(s);
  plate.hold();
  std::vector<Tip> tips;
  tips.reserve(places.size());
  for (size_t k = 0; k < places.size(); ++k)
    tips.push_back(plate.tip(contour, JMethod::fijc_adaptive, k));
  EXPECT_FALSE(has_nan(plate.simulation().state.particles));
  return tips;
}

/// Cracks that are far nearer to each other than they are long take from the field around them what one takes: their
/// tips share the J of one, and what drives them is that share. On cells of 1 mm, half and a quarter of a cell apart.
TEST(NeighbourCracks, ShareTheJOfOne) {
  const double alone = tips_of_edge_cracks({0}, 25 * mm, 8)[0].J;
  for (const double apart : {0.5 * mm, 0.25 * mm}) {
    const std::string row = fmt::format("parallel cracks {} cells apart, tips as far: ", apart / mm);
    for (const Tip& tip : tips_of_edge_cracks({-apart / 2, apart / 2}, 25 * mm, 8)) {
      below(row + "J over half of that of one, less 1", std::abs(tip.J / (0.5 * alone) - 1), 0.25);
      below(row + "what drives it over the same, less 1", std::abs(tip.release / (0.5 * alone) - 1), 0.25);
    }
  }
}

}  // namespace
}  // namespace riven
