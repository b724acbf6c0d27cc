// A plate whose cracks grow by K and J set by hand.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "kernels/assign_fields.hpp"
#include "kernels/hash_cracks.hpp"
#include "kernels/simulation.hpp"
#include "tests/spaces.hpp"

namespace riven::driven_growth {

inline constexpr double stretch = 0.02;  // 1/s

inline CrackLine crack(const char* name, std::vector<Vec2> points) {
  CrackLine c;
  c.name = name;
  c.points = std::move(points);
  return c;
}

/// A plate of 24 x 16 cells of 1 m, in which waves run 33 m in a second and particles are 0.5 m wide.
inline Scene plate(std::vector<CrackLine> cracks, double speed_limit = 10) {
  Scene s;
  s.name = s.title = "plate";
  s.end_time = 1e3;
  s.cell = 1;
  s.thickness = 0.5;
  s.grid = {{-4, -4}, {28, 20}};
  s.materials = {{"solid", LawKind::linear_elastic, 1e6, 0.3, 1000}};
  Body b;
  b.name = "plate";
  b.region = Rectangle{{0, 0}, {24, 16}};
  s.bodies = {b};
  s.cracks = std::move(cracks);
  s.contact.law = ContactLaw::frictionless;
  s.growth = GrowthRule{};
  s.growth->toughness = 1;
  s.growth->speed_limit = speed_limit;
  s.deterministic = true;
  return s;
}

using Drive = std::function<void(Tip&)>;

/// Opens every tip in mode I.
inline void open(Tip& t) {
  t.drive_I = 2;
  t.J = t.release = 3;
}

struct Driven {
  Driven(const Scene& s, Drive d, const exec::Space& space = serial())
      : scene(s), drive(std::move(d)), m(scene, space) {
    std::erase_if(m.tasks, [](const Task& t) { return t.effect == "J"; });  // the drive says what J is
    auto& p = m.state.particles;
    for (long i = 0; i < p.count(); ++i) {
      first.resize(static_cast<size_t>(p.count()));
      first[static_cast<size_t>(p.id[i])] = {p.x[0][i], p.x[1][i]};
      p.v[1][i] = stretch * (p.x[1][i] - 8);
    }
  }
  static const exec::Space& serial() {
    static const test::ChosenSpace space;
    return space;
  }
  void steps(int n) {
    for (; n > 0; --n) {
      for (Tip& t : m.state.tips) {
        t.step = m.state.clock.step;
        drive(t);
      }
      m.step();
    }
  }
  /// Until no tip is open.
  void to_the_end(int most = 3000) {
    const auto is_open = [](const Tip& t) { return t.open; };
    while (most-- > 0 && std::any_of(m.state.tips.begin(), m.state.tips.end(), is_open))
      steps(1);
    EXPECT_GT(most, 0) << "a tip is still open";
  }
  std::vector<CrackEvent::Kind> events() const {
    std::vector<CrackEvent::Kind> list;
    for (const CrackEvent& e : m.state.events)
      list.push_back(e.kind);
    return list;
  }
  Vec2 end(int c, bool last) const { return m.state.cracks.plane[m.state.cracks.end_point(c, last)]; }

  /// Nodes' fields that particles of different parts write to, the parts being numbered by first position; -1 leaves a
  /// particle out.
  long shared_fields(const std::function<int(Vec2)>& part) const {
    const auto& s = m.state;
    const Lattice& l = s.grid.lattice;
    CrackFields fresh;
    hash_cracks<UGimp>(serial(), l, s.cracks, fresh);
    determine_fields<UGimp>(serial(), s.particles, s.domains.data(), l, s.cracks, fresh);
    std::map<long, int> part_of;
    long shared = 0;
    for (long i = 0; i < s.particles.count(); ++i) {
      const auto x = UGimp::axis(s.particles.x[0][i] - l.origin.x, s.domains[0].axis[0]);
      const auto y = UGimp::axis(s.particles.x[1][i] - l.origin.y, s.domains[0].axis[1]);
      const int own = part(first[static_cast<size_t>(s.particles.id[i])]);
      for (int k = 0; k < 9; ++k) {
        if (x.s[k % 3] * y.s[k / 3] == 0)
          continue;
        const int node = (y.base + k / 3) * l.nx + x.base + k % 3;
        const long slot = 4L * node + CrackFields::field_of(fresh.fields[i], k);
        if (own < 0)
          continue;
        const auto [at, added] = part_of.emplace(slot, own);
        shared += !added && at->second != own;
      }
    }
    return shared;
  }

  const Scene scene;
  Drive drive;
  Simulation m;
  std::vector<Vec2> first;
};

}  // namespace riven::driven_growth
