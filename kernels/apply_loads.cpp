#include "kernels/apply_loads.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/error.hpp"
#include "kernels/block.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/field_slots.hpp"

namespace riven {

namespace {

/// Particles that have no neighbour of their own body on the loaded side, with the edge length that each carries.
template <class Real>
void load_edge(const Scene& scene, const State<Real, 2>& s, const Load& load, LoadGroup& group) {
  const auto& p = s.particles;
  const bool along_x = load.edge == Load::Edge::left || load.edge == Load::Edge::right;
  const int sign = load.edge == Load::Edge::right || load.edge == Load::Edge::top ? 1 : -1;
  const Lattice& l = s.grid.lattice;
  // places on each body's own lattice of particles
  const auto place = [&](long i, double d) {
    const long a = std::lround((p.x[0][i] - l.origin.x) / d - 0.5), b = std::lround((p.x[1][i] - l.origin.y) / d - 0.5);
    return std::pair{a, b};
  };
  const auto key = [&](int body, long a, long b) { return (long{body} << 56) ^ (a << 28) ^ b; };
  std::unordered_map<long, bool> taken;
  const auto spacing = [&](long i) { return l.h / scene.bodies[p.body[i]].particles_per_cell; };
  for (long i = 0; i < p.count(); ++i) {
    const auto [a, b] = place(i, spacing(i));
    taken[key(p.body[i], a, b)] = true;
  }
  for (long i = 0; i < p.count(); ++i) {
    if (!contains(load.region, {p.x[0][i], p.x[1][i]}))
      continue;
    const double d = spacing(i);
    auto [a, b] = place(i, d);
    (along_x ? a : b) += sign;
    if (taken.count(key(p.body[i], a, b)))
      continue;
    const Body& body = scene.bodies[p.body[i]];
    group.id.push_back(p.id[i]);
    group.share.push_back(d * (body.thickness > 0 ? body.thickness : scene.thickness));
  }
}

}  // namespace

template <class Real>
void make_loads(const Scene& scene, State<Real, 2>& s) {
  const auto& p = s.particles;
  for (const Load& load : scene.loads) {
    LoadGroup g;
    g.value[0] = load.value[0];
    g.value[1] = load.value[1];
    if (load.kind == Load::Kind::traction) {
      load_edge(scene, s, load, g);
    } else {
      for (long i = 0; i < p.count(); ++i)
        if (contains(load.region, {p.x[0][i], p.x[1][i]}))
          g.id.push_back(p.id[i]);
      g.share.assign(g.id.size(), g.id.empty() ? 0 : 1.0 / static_cast<double>(g.id.size()));
    }
    if (g.id.empty())
      fail({Exit::bad_input, "the load finds no particle in its region", "load \"" + load.name + "\"", "",
            "a region that holds particle centres", "make the region a cell larger"});
    s.loads.groups.push_back(std::move(g));
  }
  size_t total = 0;
  for (const LoadGroup& g : s.loads.groups)
    total += g.id.size();
  s.loads.applied_at.resize(total);
  s.loads.position.resize(static_cast<size_t>(p.count()));
  for (long i = 0; i < p.count(); ++i)
    s.loads.position[static_cast<size_t>(p.id[i])] = static_cast<int>(i);
}

template <class Real>
void apply_loads(const Plan& plan, State<Real, 2>& s) {
  const Lattice& l = s.grid.lattice;
  const FieldSlots slots(s.fields, l.nodes());
  const auto& p = s.particles;
  size_t n = 0;
  with_shape(plan.shape, [&](auto shape) {
    using Shape = typename decltype(shape)::type;
    for (const LoadGroup& g : s.loads.groups) {
      const Vec2 total{g.value[0](s.clock.time), g.value[1](s.clock.time)};
      for (size_t k = 0; k < g.id.size(); ++k, ++n) {
        const long i = s.loads.position[static_cast<size_t>(g.id[k])];
        const Vec2 force = g.share[k] * total, x{p.x[0][i], p.x[1][i]};
        const DomainSetting<Real, 2>& d = s.domains[p.body[i]];
        const auto a = Shape::axis((x.x - l.origin.x) / l.h, d.axis[0]);
        const auto b = Shape::axis((x.y - l.origin.y) / l.h, d.axis[1]);
        const std::uint32_t word = s.fields.extra.empty() ? 0 : s.fields.fields[i];
        for (int j = 0; j < Shape::width; ++j)
          for (int m = 0; m < Shape::width; ++m) {
            const int node = (b.base + j) * l.nx + a.base + m;
            Real* q = s.grid.q.data() + 4 * slots.of(node, CrackFields::field_of(word, j * Shape::width + m));
            q[2] += Real(force.x) * a.s[m] * b.s[j];
            q[3] += Real(force.y) * a.s[m] * b.s[j];
          }
        s.loads.applied_at[n] = x;
        s.ledger.momentum.impulse += s.clock.dt * force;
        s.ledger.momentum.torque_impulse += s.clock.dt * cross(x, force);
      }
    }
  });
}

template <class Real>
void settle_loads(State<Real, 2>& s) {
  const auto& p = s.particles;
  size_t n = 0;
  for (const LoadGroup& g : s.loads.groups) {
    const Vec2 total{g.value[0](s.clock.time), g.value[1](s.clock.time)};
    for (size_t k = 0; k < g.id.size(); ++k, ++n) {
      const long i = s.loads.position[static_cast<size_t>(g.id[k])];
      const Vec2 move = Vec2{p.x[0][i], p.x[1][i]} - s.loads.applied_at[n];
      s.ledger.energy.external_work += dot(g.share[k] * total, move);
    }
  }
}

#define RIVEN_APPLY_LOADS(Real)                            \
  template void make_loads(const Scene&, State<Real, 2>&); \
  template void apply_loads(const Plan&, State<Real, 2>&); \
  template void settle_loads(State<Real, 2>&);
RIVEN_APPLY_LOADS(double)
RIVEN_APPLY_LOADS(float)
#undef RIVEN_APPLY_LOADS

}  // namespace riven
