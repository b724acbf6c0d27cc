// Transfers between particles and grid against dense matrices: with S from grid to particles and S+ = m^-1 S^T M back,
//   v(k) = sum_{j<k} (I - S+ S)^j S+ V,
//   PIC and XPIC(1): V' = S (v + a dt),  XPIC(k): V' = S v(k) + dt S a,  FMPM(k): V' = S v~(k) from v~ = v + a dt,
//   FLIP: V' = V + dt S a;   all: X' = X + dt S v~ - dt^2/2 S a    (Nairn and Aimene, section 2.1 and eqs. 1 to 7).
// Particles with gradients of velocity have two rows of S more, the moments over D, whose masses are those times D
// (kernels/velocity_gradient.hpp): the formulas stay.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/scene/names.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/simulation.hpp"
#include "kernels/sort_particles.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

/// Row-major dense matrix, and what little is done with it.
struct Matrix {
  int rows = 0, columns = 0;
  std::vector<double> a;
  Matrix(int r, int c) : rows(r), columns(c), a(static_cast<size_t>(r) * static_cast<size_t>(c)) {}
  double& operator()(int r, int c) {
    return a[static_cast<size_t>(r) * static_cast<size_t>(columns) + static_cast<size_t>(c)];
  }
  double operator()(int r, int c) const { return const_cast<Matrix&>(*this)(r, c); }
};
using Column = std::vector<Vec2>;

Column operator*(const Matrix& m, const Column& v) {
  Column out(static_cast<size_t>(m.rows));
  for (int r = 0; r < m.rows; ++r)
    for (int c = 0; c < m.columns; ++c)
      out[static_cast<size_t>(r)] += m(r, c) * v[static_cast<size_t>(c)];
  return out;
}
Column plus(Column a, double s, const Column& b) {
  for (size_t i = 0; i < a.size(); ++i)
    a[i] += s * b[i];
  return a;
}
double largest(const Column& a) {
  double most = 0;
  for (const Vec2 v : a)
    most = std::max(most, norm(v));
  return most;
}
double apart(const Column& a, const Column& b) {
  return largest(plus(a, -1, b));
}

/// A block of 4 x 3 cells whose particles have random velocities and stresses.
Scene block_scene(ShapeFunction shape, Transfer transfer, int order) {
  Scene s;
  s.cell = 1;
  s.grid = {{-3, -3}, {8, 7}};
  s.end_time = 1e3;
  s.thickness = 1;
  s.materials = {{"solid", LawKind::linear_elastic, 1e3, 0.3, 1}};
  s.deterministic = true;
  s.shape = shape;
  s.transfer = transfer;
  s.order = order;
  s.pic_fraction = 1;
  s.stress_update = StressUpdate::usl;
  s.limits.energy_growth = 1e9;
  Body b;
  b.name = "block";
  b.region = Rectangle{{0, 0}, {4, 3}};
  s.bodies = {b};
  return s;
}

void shake(Simulation& m, bool stresses) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  auto& p = m.state.particles;
  for (int i = 0; i < p.count(); ++i) {
    for (auto& x : p.x)
      x[i] += 0.05 * u(random);
    for (auto& v : p.v)
      v[i] = u(random);
    for (auto& t : p.stress)
      t[i] = stresses ? 10 * u(random) : 0;
    p.mass[i] *= 1 + 0.3 * u(random);
    if (m.plan.affine)
      for (auto& c : p.C)
        c[i] = u(random);
  }
  sort_particles(m.space, m.plan, m.state);
}

/// Velocities of particles in the order of their ids, and behind them gradients along x, and along y.
Column velocities(const Simulation& m) {
  const auto& p = m.state.particles;
  const size_t n = static_cast<size_t>(p.count());
  Column v(m.plan.affine ? 3 * n : n);
  for (int i = 0; i < p.count(); ++i) {
    const size_t id = static_cast<size_t>(p.id[i]);
    v[id] = {p.v[0][i], p.v[1][i]};
    if (m.plan.affine) {
      v[n + id] = {p.C[0][i], p.C[2][i]};
      v[2 * n + id] = {p.C[1][i], p.C[3][i]};
    }
  }
  return v;
}

/// Matrices and columns of a simulation as it stands; particles in the order of their ids, nodes with mass only.
struct Dense {
  Matrix S, Gx, Gy, back;
  std::vector<double> m, M;
  Column X, V, a;
};
Dense dense(const Simulation& sim, ShapeFunction shape) {
  const auto& p = sim.state.particles;
  const Lattice& l = sim.state.grid.lattice;
  const int n = p.count(), nodes = l.nodes();
  const int rows = sim.plan.affine ? 3 * n : n;
  Dense d{Matrix(rows, nodes), Matrix(n, nodes), Matrix(n, nodes), Matrix(nodes, rows), {}, {}, {}, {}, {}};
  d.M.resize(static_cast<size_t>(rows));
  d.m.resize(static_cast<size_t>(nodes));
  d.X.resize(static_cast<size_t>(n));
  d.V = velocities(sim);
  Column f(static_cast<size_t>(nodes));
  with_shape(shape, [&](auto type) {
    using Shape = typename decltype(type)::type;
    for (int i = 0; i < n; ++i) {
      const int id = p.id[i];
      const auto& setting = sim.state.domains[0].axis;
      const auto a = Shape::axis((p.x[0][i] - l.origin.x) / l.h, setting[0]);
      const auto b = Shape::axis((p.x[1][i] - l.origin.y) / l.h, setting[1]);
      d.M[static_cast<size_t>(id)] = p.mass[i];
      d.X[static_cast<size_t>(id)] = {p.x[0][i], p.x[1][i]};
      double D[2] = {};
      for (int k = 0; k < Shape::width; ++k) {
        D[0] += a.s[k] * std::pow(l.origin.x + (a.base + k) * l.h - p.x[0][i], 2);
        D[1] += b.s[k] * std::pow(l.origin.y + (b.base + k) * l.h - p.x[1][i], 2);
      }
      for (int axis = 0; sim.plan.affine && axis < 2; ++axis)
        d.M[static_cast<size_t>(id) + static_cast<size_t>(1 + axis) * static_cast<size_t>(n)] = p.mass[i] * D[axis];
      for (int j = 0; j < Shape::width; ++j)
        for (int k = 0; k < Shape::width; ++k) {
          const int node = (b.base + j) * l.nx + a.base + k;
          const double gx = a.g[k] * b.s[j] / l.h, gy = a.s[k] * b.g[j] / l.h;
          d.S(id, node) = a.s[k] * b.s[j];
          if (sim.plan.affine) {
            const Vec2 r = l.position(node) - Vec2{p.x[0][i], p.x[1][i]};
            d.S(id + n, node) = a.s[k] * b.s[j] * r.x / D[0];
            d.S(id + 2 * n, node) = a.s[k] * b.s[j] * r.y / D[1];
          }
          d.m[static_cast<size_t>(node)] += p.mass[i] * a.s[k] * b.s[j];
          f[static_cast<size_t>(node)] -=
              p.mass[i] * Vec2{p.stress[0][i] * gx + p.stress[2][i] * gy, p.stress[2][i] * gx + p.stress[1][i] * gy};
        }
    }
  });
  d.a.resize(static_cast<size_t>(nodes));
  for (int k = 0; k < nodes; ++k) {
    const double mass = d.m[static_cast<size_t>(k)];
    if (mass == 0)
      continue;
    d.a[static_cast<size_t>(k)] = (1 / mass) * f[static_cast<size_t>(k)];
    for (int i = 0; i < rows; ++i)
      d.back(k, i) = d.S(i, k) * d.M[static_cast<size_t>(i)] / mass;
  }
  return d;
}

/// sum_{j<k} (I - S+ S)^j v
Column series(const Dense& d, const Column& v, int k) {
  Column sum = v, term = v;
  for (int j = 1; j < k; ++j) {
    term = plus(term, -1, d.back * (d.S * term));
    sum = plus(sum, 1, term);
  }
  return sum;
}

Column places(const Simulation& m) {
  const auto& p = m.state.particles;
  Column x(static_cast<size_t>(p.count()));
  for (int i = 0; i < p.count(); ++i)
    x[static_cast<size_t>(p.id[i])] = {p.x[0][i], p.x[1][i]};
  return x;
}

constexpr ShapeFunction shapes[] = {ShapeFunction::linear, ShapeFunction::ugimp, ShapeFunction::bspline};

/// What the gradients of moving particles lose of themselves in a step by FLIP: L L dt; `moved` has the L.
void take_own_motion(Column& V, const Column& moved, double dt) {
  const size_t n = moved.size() / 3;
  for (size_t i = 0; i < n; ++i) {
    const Vec2 x = moved[n + i], y = moved[2 * n + i];
    V[n + i] -= dt * (x.x * x + x.y * y);
    V[2 * n + i] -= dt * (y.x * x + y.y * y);
  }
}

void expect_matrix_formulas(bool affine) {
  for (const ShapeFunction shape : shapes)
    for (const Transfer transfer : {Transfer::flip, Transfer::pic, Transfer::xpic, Transfer::fmpm})
      for (const int order : {1, 2, 3, 5, 8}) {
        if (order > 1 && (transfer == Transfer::flip || transfer == Transfer::pic))
          continue;
        if (affine && shape == ShapeFunction::linear)
          continue;
        Scene s = block_scene(shape, transfer, order);
        s.affine = affine;
        const test::ChosenSpace space;
        Simulation m(s, space);
        shake(m, true);
        const Dense d = dense(m, shape);
        m.step();
        const double dt = m.state.clock.dt;
        const Column v = d.back * d.V, after = plus(v, dt, d.a), Sa = d.S * d.a;
        Column expected;
        if (transfer == Transfer::flip)
          expected = plus(d.V, dt, Sa);
        else if (transfer == Transfer::xpic)
          expected = plus(d.S * series(d, v, order), dt, Sa);
        else
          expected = d.S * series(d, after, order);
        if (affine && transfer == Transfer::flip)
          take_own_motion(expected, d.S * after, dt);
        SCOPED_TRACE(testing::Message() << static_cast<int>(shape) << " " << static_cast<int>(transfer) << " "
                                        << order);
        EXPECT_LT(apart(velocities(m), expected), 1e-12 * largest(expected));
        EXPECT_LT(apart(places(m), plus(plus(d.X, dt, d.S * after), -0.5 * dt * dt, Sa)), 1e-13 * 8);
        EXPECT_GT(apart(expected, d.V), 0.01);
      }
}

TEST(Transfers, FollowTheirMatrixFormulas) {
  expect_matrix_formulas(false);
}

TEST(Transfers, FollowThemWithGradientsOfVelocity) {
  expect_matrix_formulas(true);
}

/// A linear velocity comes back as it was, borders and all, from every transfer and order; by FLIP but for how it
/// carries itself along.
TEST(Transfers, KeepALinearVelocityByItsGradient) {
  const test::ChosenSpace space;
  for (const ShapeFunction shape : {ShapeFunction::ugimp, ShapeFunction::bspline})
    for (const StressUpdate update : {StressUpdate::usl, StressUpdate::usf, StressUpdate::musl, StressUpdate::usavg})
      for (const int order : {0, 1, 2, 4}) {
        Scene s = block_scene(shape, order == 0 ? Transfer::flip : Transfer::fmpm, std::max(1, order));
        s.stress_update = update;
        s.affine = true;
        s.materials[0].E = 1e-12;
        s.dt_max = 1e-3;
        Simulation m(s, space);
        shake(m, false);
        auto& p = m.state.particles;
        for (int i = 0; i < p.count(); ++i) {
          p.v[0][i] = 1 + 0.3 * p.x[0][i] - 0.7 * p.x[1][i];
          p.v[1][i] = 0.2 * p.x[0][i] + 0.5 * p.x[1][i] - 2;
          const double C[4] = {0.3, -0.7, 0.2, 0.5};
          for (int k = 0; k < 4; ++k)
            p.C[k][i] = C[k];
        }
        Column expected = velocities(m);
        if (order == 0)
          take_own_motion(expected, velocities(m), s.dt_max);
        m.step();
        EXPECT_LT(apart(velocities(m), expected), 1e-12) << name_of(shape) << " " << name_of(update) << " " << order;
      }
}

/// Each particle one of its own.
void give_velocities(Simulation& m) {
  auto& p = m.state.particles;
  for (int i = 0; i < p.count(); ++i)
    for (int axis : {0, 1})
      p.v[axis][i] = std::sin(7.3 * p.id[i] + axis);
}

/// Particles of one cell are taken by four as long as they are in the cells that they were sorted by, and one by one
/// when they have drifted: the same sums, in another order. A device always takes them one by one.
TEST(Transfers, AreTheSameOneByOneAndByFour) {
  const test::ChosenSpace space;
  const auto after_two_steps = [&](const Scene& s, double drift) {
    Simulation m(s, space);
    give_velocities(m);
    m.step();
    m.state.watch.drift = drift;
    m.step();
    return velocities(m);
  };
  for (const ShapeFunction shape : shapes)
    for (const StressUpdate update : {StressUpdate::usl, StressUpdate::usf, StressUpdate::musl, StressUpdate::usavg})
      for (const int order : {0, 2, 4, -1, -2, -4}) {  // negative: with gradients of velocity
        if (order < 0 && shape == ShapeFunction::linear)
          continue;
        const int k = std::abs(order);
        Scene s = block_scene(shape, k < (order < 0 ? 2 : 1) ? Transfer::flip : Transfer::fmpm, std::max(1, k));
        s.stress_update = update;
        s.affine = order < 0;
        const Column four = after_two_steps(s, 0), one = after_two_steps(s, 0.3 * s.cell);
        EXPECT_LT(apart(four, one), 1e-13 * largest(one)) << name_of(shape) << " " << name_of(update) << " " << order;
        if (update == StressUpdate::usavg && space.kind() != exec::Kind::cuda) {
          EXPECT_GT(apart(four, one), 0) << "not taken by four";
        }
      }
}

/// A solid on a crack that runs through moves as if there were none on the other side, in every order.
TEST(Transfers, KeepToTheirSideOfACrack) {
  const test::ChosenSpace space;
  const auto after_a_step = [&](const Scene& s) {
    Simulation m(s, space);
    give_velocities(m);
    m.step();
    return velocities(m);
  };
  for (const ShapeFunction shape : shapes)
    for (const int order : {2, 3, 6}) {
      Scene alone = block_scene(shape, Transfer::fmpm, order);
      alone.bodies[0].region = Rectangle{{0, 0}, {4, 1.5}};
      Scene beside = alone;
      beside.bodies.push_back(alone.bodies[0]);
      beside.bodies[1].region = Rectangle{{0, 1.5}, {4, 3}};
      CrackLine crack;
      crack.name = "crack";
      crack.points = {{-1, 1.5}, {5, 1.5}};
      beside.cracks = {crack};
      beside.contact.law = ContactLaw::ignored;
      const Column one = after_a_step(alone);
      Column both = after_a_step(beside);
      both.resize(one.size());
      EXPECT_LT(apart(one, both), 1e-13 * largest(one)) << name_of(shape) << " " << order;
      beside.cracks.clear();
      both = after_a_step(beside);
      both.resize(one.size());
      EXPECT_GT(apart(one, both), 0.01) << "without the crack";
    }
}

/// S+ S leaves constants alone and S+ S S+ is what smoothing once more means: the series telescopes,
/// S+ S v(k) = v - (I - S+ S)^k v.
TEST(Transfers, SmoothingIdentities) {
  for (const ShapeFunction shape : shapes) {
    const Scene s = block_scene(shape, Transfer::flip, 1);
    const test::ChosenSpace space;
    Simulation m(s, space);
    shake(m, false);
    const Dense d = dense(m, shape);
    Column ones(d.m.size());
    for (size_t k = 0; k < ones.size(); ++k)
      ones[k] = d.m[k] > 0 ? Vec2{1, -2} : Vec2{};
    EXPECT_LT(apart(d.back * (d.S * ones), ones), 1e-13);
    const Column v = d.back * d.V;
    Column remains = v;
    for (int k = 1; k <= 6; ++k) {
      remains = plus(remains, -1, d.back * (d.S * remains));
      EXPECT_LT(apart(d.back * (d.S * series(d, v, k)), plus(v, -1, remains)), 1e-12);
    }
  }
}

TEST(Transfers, FirstOrdersArePic) {
  const test::ChosenSpace space;
  std::vector<Column> results;
  for (const Transfer transfer : {Transfer::pic, Transfer::xpic, Transfer::fmpm}) {
    const Scene s = block_scene(ShapeFunction::ugimp, transfer, 1);
    Simulation m(s, space);
    shake(m, true);
    for (int n = 0; n < 20; ++n)
      m.step();
    results.push_back(velocities(m));
  }
  EXPECT_LT(apart(results[0], results[1]), 1e-13);
  EXPECT_LT(apart(results[0], results[2]), 1e-13);
}

double kinetic(const Dense& d, const Column& V) {
  double sum = 0;
  for (size_t i = 0; i < V.size(); ++i)
    sum += 0.5 * d.M[i] * dot(V[i], V[i]);
  return sum;
}
Vec2 momentum(const Dense& d, const Column& V) {
  Vec2 sum;
  for (size_t i = 0; i < V.size(); ++i)
    sum += d.M[i] * V[i];
  return sum;
}

/// What the grid can show of the particles' velocities stays, more of it with each order (FLIP keeps all of it); and
/// momentum is the same to rounding in every order.
TEST(Transfers, HigherOrdersLoseLess) {
  const test::ChosenSpace space;
  for (const Transfer transfer : {Transfer::xpic, Transfer::fmpm}) {
    double before = 0, first = 0, last = 0;
    for (const int order : {1, 2, 4, 8, 16, 32, 64}) {
      const Scene s = block_scene(ShapeFunction::ugimp, transfer, order);
      Simulation m(s, space);
      shake(m, false);
      // a field that the grid can show
      const auto& l = m.state.grid.lattice;
      Column v(static_cast<size_t>(l.nodes()));
      for (int n = 0; n < l.nodes(); ++n)
        v[static_cast<size_t>(n)] = {std::sin(0.6 * l.position(n).x), std::cos(0.8 * l.position(n).y)};
      const Dense d = dense(m, s.shape);
      const Column V = d.S * v;
      auto& p = m.state.particles;
      for (int i = 0; i < p.count(); ++i) {
        p.v[0][i] = V[static_cast<size_t>(p.id[i])].x;
        p.v[1][i] = V[static_cast<size_t>(p.id[i])].y;
      }
      m.step();
      const Column after = velocities(m);
      const double kept = kinetic(d, after) / kinetic(d, V);
      EXPECT_GT(kept, before) << order;
      EXPECT_LE(kept, 1 + 1e-12) << order;
      EXPECT_LT(norm(momentum(d, after) - momentum(d, V)), 1e-13 * largest(V) * 12) << order;
      before = kept;
      (order == 1 ? first : last) = apart(after, V);
    }
    EXPECT_LT(before, 1);
    EXPECT_GT(before, 0.999);
    EXPECT_LT(last, 0.15 * first);
  }
}

/// The part of the particles' velocities that no node sees: what is left when each node's weights are taken out,
/// by Gram and Schmidt in the inner product of the masses, twice against rounding.
Column unseen(const Dense& d) {
  const auto inner = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
      sum += d.M[i] * a[i] * b[i];
    return sum;
  };
  std::vector<std::vector<double>> basis;
  const auto take_out = [&](std::vector<double>& v) {
    for (int twice = 0; twice < 2; ++twice)
      for (const auto& b : basis) {
        const double part = inner(b, v);
        for (size_t i = 0; i < v.size(); ++i)
          v[i] -= part * b[i];
      }
  };
  for (int node = 0; node < d.S.columns; ++node) {
    std::vector<double> column(d.M.size());
    for (size_t i = 0; i < column.size(); ++i)
      column[i] = d.S(static_cast<int>(i), node);
    const double before = std::sqrt(inner(column, column));
    take_out(column);
    const double length = std::sqrt(inner(column, column));
    if (length <= 1e-9 * before)
      continue;
    for (double& c : column)
      c /= length;
    basis.push_back(column);
  }
  std::vector<double> x, y;
  for (const Vec2 v : d.V) {
    x.push_back(v.x);
    y.push_back(v.y);
  }
  take_out(x);
  take_out(y);
  Column noise;
  for (size_t i = 0; i < x.size(); ++i)
    noise.push_back({x[i], y[i]});
  return noise;
}

/// Velocities that no node sees, S+ V = 0: FLIP keeps them for ever and they neither grow nor move anything; XPIC and
/// FMPM of any order wipe them out at once.
TEST(Transfers, NullSpaceNoise) {
  const test::ChosenSpace space;
  for (const Transfer transfer : {Transfer::flip, Transfer::xpic, Transfer::fmpm})
    for (const int order : {1, 2, 5}) {
      Scene s = block_scene(ShapeFunction::ugimp, transfer, order);
      Simulation m(s, space);
      shake(m, false);
      const Dense d = dense(m, s.shape);
      const Column noise = unseen(d);
      ASSERT_GT(largest(noise), 0.1);
      ASSERT_LT(largest(d.back * noise), 1e-9);
      auto& p = m.state.particles;
      for (int i = 0; i < p.count(); ++i) {
        p.v[0][i] = noise[static_cast<size_t>(p.id[i])].x;
        p.v[1][i] = noise[static_cast<size_t>(p.id[i])].y;
      }
      const int steps = transfer == Transfer::flip ? 100 : 1;
      for (int n = 0; n < steps; ++n)
        m.step();
      if (transfer == Transfer::flip) {
        EXPECT_LT(apart(velocities(m), noise), 1e-9);
        EXPECT_LT(apart(places(m), d.X), 1e-9);
      } else {
        EXPECT_LT(largest(velocities(m)), 1e-11) << order;
      }
    }
}

}  // namespace
}  // namespace riven
