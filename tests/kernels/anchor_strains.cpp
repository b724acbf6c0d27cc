// Strains held to where particles are (kernels/anchor_strains.hpp). Particles stay where they are laid down, on unit
// cells; where they were at first, and so how they are strained, is set.
#include "kernels/anchor_strains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "kernels/simulation.hpp"
#include "kernels/tally.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

/// A way back, X - x, and its gradient.
struct WayBack {
  Vec2 d;
  Mat2<double> gradient;
};
using WayOf = std::function<WayBack(Vec2 x, int body)>;

/// A block of 8 x 6 cells, or more, or two beside each other, cut through three cells above its lower edge.
Scene cut_block(ShapeFunction shape, bool two_bodies = false, Vec2 size = {8, 6}) {
  Scene s;
  s.cell = 1;
  s.grid = {{-3, -3}, size + Vec2{3, 3}};
  s.end_time = 1e3;
  s.thickness = 1;
  s.deterministic = true;
  s.shape = shape;
  s.materials = {{"solid", LawKind::neo_hookean, 1e3, 0.3, 1}};
  Body b;
  b.name = "left";
  b.region = Rectangle{{0, 0}, {two_bodies ? 4. : size.x, size.y}};
  s.bodies = {b};
  if (two_bodies) {
    b.name = "apart";  // so that the mean of the numbers of the others is one, too
    b.region = Rectangle{{-2.5, 0}, {-1.5, 1}};
    s.bodies.push_back(b);
    b.name = "right";
    b.region = Rectangle{{4, 0}, size};
    s.bodies.push_back(b);
  }
  CrackLine c;
  c.name = "cut";
  c.points = {{-1, 3}, {size.x + 1, 3}};
  s.cracks = {c};
  s.fracture.asked = true;
  return s;
}

/// One that has taken a step, at rest, so that its fields are known, with F that follows from where particles were.
class Block {
 public:
  Block(const Scene& s, const WayOf& way) : Block(s, way, test::ChosenSpace()) {}
  Block(const Scene& s, const WayOf& way, const exec::Space& space)
      : space_(space.kind(), space.threads()), m_(s, space_) {
    m_.step();
    auto& p = m_.state.particles;
    for (int i = 0; i < p.count(); ++i) {
      const Vec2 x{p.x[0][i], p.x[1][i]};
      const WayBack back = way(x, p.body[i]);
      p.x0[0][i] = x.x + back.d.x;
      p.x0[1][i] = x.y + back.d.y;
      set_F(i, inverse_of_one_plus(back.gradient));
    }
    update_stress();
  }

  void set_F(int i, const Mat2<double>& F) {
    auto& p = m_.state.particles;
    p.F[0][i] = F.xx;
    p.F[1][i] = F.xy;
    p.F[2][i] = F.yx;
    p.F[3][i] = F.yy;
  }
  Mat2<double> F(int i) const {
    const auto& p = m_.state.particles;
    return {p.F[0][i], p.F[1][i], p.F[2][i], p.F[3][i]};
  }
  /// By the law, from F.
  LawState<double> stress_of(int i) const {
    LawState<double> s{};
    s.F = F(i);
    std::as_const(m_.state).laws.neo[0].update(Mat2<double>{0, 0, 0, 0}, s);
    return s;
  }
  void update_stress() {
    auto& p = m_.state.particles;
    for (int i = 0; i < p.count(); ++i) {
      const LawState<double> s = stress_of(i);
      p.stress[0][i] = s.xx;
      p.stress[1][i] = s.yy;
      p.stress[2][i] = s.xy;
    }
  }
  double strain_energy() {
    tally(space_, m_.plan, m_.state);
    return m_.state.ledger.energy.strain;
  }
  /// Strains that do not follow from where particles are.
  void shake() {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-0.02, 0.02);
    for (int i = 0; i < count(); ++i)
      set_F(i, (Mat2<double>{1 + u(random), u(random), u(random), 1 + u(random)}) * F(i));
    update_stress();
  }
  void anchor() { anchor_strains(space_, m_.plan, m_.state); }

  /// Largest difference from F as it follows from the way back, of particles within `inside`.
  double off(const WayOf& way, const Rectangle& inside = {{-3, -1}, {9, 7}}) const {
    double most = 0;
    const auto& p = m_.state.particles;
    for (int i = 0; i < p.count(); ++i) {
      const Vec2 x{p.x[0][i], p.x[1][i]};
      if (x.x < inside.lower.x || x.x > inside.upper.x || x.y < inside.lower.y || x.y > inside.upper.y)
        continue;
      const Mat2<double> a = F(i), b = inverse_of_one_plus(way(x, p.body[i]).gradient);
      most =
          std::max({most, std::abs(a.xx - b.xx), std::abs(a.xy - b.xy), std::abs(a.yx - b.yx), std::abs(a.yy - b.yy)});
    }
    return most;
  }
  long count() const { return m_.state.particles.count(); }
  double anchoring() const { return m_.state.ledger.energy.anchoring; }

 private:
  exec::Space space_;
  Simulation m_;
};

WayBack linear(Vec2 x, Vec2 d, const Mat2<double>& D) {
  return {{d.x + D.xx * x.x + D.xy * x.y, d.y + D.yx * x.x + D.yy * x.y}, D};
}

constexpr ShapeFunction shapes[] = {ShapeFunction::linear, ShapeFunction::ugimp, ShapeFunction::bspline};

/// The two sides of the cut have turned by different angles, are stretched in different ways, and lie apart.
WayBack of_two_sides(Vec2 x, int) {
  return x.y > 3 ? linear(x, {20, 7}, {-1.6, 0.7, -0.9, -1.7}) : linear(x, {-3, 0.2}, {0.1, -0.05, 0.2, -0.1});
}

TEST(AnchorStrains, LeavesLinearMapsOnBothSidesOfACrack) {
  for (const ShapeFunction shape : shapes) {
    Block block(cut_block(shape), of_two_sides);
    block.anchor();
    EXPECT_LT(block.off(of_two_sides), 1e-12) << static_cast<int>(shape);
    EXPECT_LT(std::abs(block.anchoring()), 1e-12 * block.strain_energy());
  }
}

/// What particles have of strains that do not follow from where they are goes, the stresses with it, and the ledger
/// knows what energy that was.
TEST(AnchorStrains, TakesThemToWhereParticlesAre) {
  for (const ShapeFunction shape : {ShapeFunction::ugimp, ShapeFunction::bspline}) {
    Block block(cut_block(shape), of_two_sides);
    block.shake();
    const double off = block.off(of_two_sides), energy = block.strain_energy();
    block.anchor();
    const double taken = block.anchoring(), fallen = energy - block.strain_energy();
    EXPECT_GT(taken, 0);
    EXPECT_NEAR(taken, fallen, 1e-12 * energy);
    for (int n = 1; n < 500; ++n)
      block.anchor();
    EXPECT_LT(block.off(of_two_sides), 0.1 * off) << static_cast<int>(shape);
    EXPECT_NEAR(block.anchoring(), energy - block.strain_energy(), 1e-11 * energy);
  }
}

/// Away from borders quadratic maps stay as they are, wherever in a cell particles are.
TEST(AnchorStrains, LeavesQuadraticMaps) {
  const WayOf bent = [](Vec2 x, int) {
    const double a = 0.003, b = -0.002;
    return WayBack{{a * x.x * x.x + b * x.x * x.y, b * x.y * x.y}, {2 * a * x.x + b * x.y, b * x.x, 0, 2 * b * x.y}};
  };
  for (const ShapeFunction shape : shapes) {
    Block block(cut_block(shape, false, {20, 20}), bent);
    block.anchor();
    EXPECT_LT(block.off(bent, {{8, 10}, {12, 13}}), 1e-12) << static_cast<int>(shape);
    EXPECT_LT(block.off(bent), 5e-4) << static_cast<int>(shape);
  }
}

/// Of waves they take what falls with the square of the cell at least.
TEST(AnchorStrains, LeavesWavesOfManyCells) {
  double off[2] = {};
  for (const int fine : {0, 1}) {
    const double k = std::numbers::pi / (fine ? 8 : 4);  // waves of 8 and 16 cells
    const WayOf wave = [k](Vec2 x, int) {
      const double a = 0.01 / k;
      return WayBack{
          {a * std::sin(k * x.x + 0.3 * k * x.y), 0},
          {a * k * std::cos(k * x.x + 0.3 * k * x.y), 0.3 * a * k * std::cos(k * x.x + 0.3 * k * x.y), 0, 0}};
    };
    Block block(cut_block(ShapeFunction::ugimp, false, {20, 16}), wave);
    block.anchor();
    off[fine] = block.off(wave, {{6, 7}, {14, 12}}) / 0.01;
  }
  RecordProperty("wave of 8 cells", std::to_string(off[0]));
  RecordProperty("wave of 16 cells", std::to_string(off[1]));
  EXPECT_LT(off[0], 0.0012);
  EXPECT_LT(off[1], off[0] / 4);
}

TEST(AnchorStrains, IsTheSameInAnySpace) {
  std::vector<Mat2<double>> first;
  for (const test::SpaceCase& c : test::space_cases()) {
    Scene s = cut_block(ShapeFunction::ugimp, false, {20, 20});
    s.scatter = c.scatter;
    s.deterministic = c.scatter == ScatterKind::ordered;
    Block block(s, of_two_sides, exec::Space(c.kind, c.threads));
    block.shake();
    block.anchor();
    const double tolerance = c.same_bits() ? 0 : 1e-13;
    for (int i = 0; i < block.count(); ++i) {
      const Mat2<double> F = block.F(i);
      if (static_cast<long>(first.size()) < block.count())
        first.push_back(F);
      const Mat2<double>& other = first[static_cast<size_t>(i)];
      EXPECT_LE(std::max(std::abs(F.xx - other.xx), std::abs(F.yx - other.yx)), tolerance) << c.name() << ", " << i;
    }
  }
}

/// Bodies that have come to touch, however little they have moved, and pieces of one that were not together at first,
/// have no strain between them.
TEST(AnchorStrains, LeavesWhatWasNotOneSolid) {
  const WayOf bodies = [](Vec2 x, int body) { return linear(x, {0.02 * body, 0}, {0, 0, 0, 0}); };
  const WayOf pieces = [](Vec2 x, int) { return linear(x, {x.x < 4 ? 0. : 0.4, 0}, {0, 0, 0, 0}); };
  for (const bool two_bodies : {true, false}) {
    const WayOf& way = two_bodies ? bodies : pieces;
    Block block(cut_block(ShapeFunction::ugimp, two_bodies), way);
    block.anchor();
    EXPECT_LT(block.off(way), 1e-13) << two_bodies;
  }
}

}  // namespace
}  // namespace riven
