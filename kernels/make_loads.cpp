#include "kernels/make_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "core/error.hpp"
#include "core/exec/parallel.hpp"
#include "core/scene/names.hpp"

namespace riven {

namespace {

/// Particles that have no neighbour of their own body on the loaded side, with the edge length that each carries.
template <class Real>
void load_edge(const Scene& scene, const State<Real, 2>& s, const Load& load, LoadGroup& group) {
  const auto& p = s.particles;
  const bool along_x = load.edge == Load::Edge::left || load.edge == Load::Edge::right;
  const int sign = load.edge == Load::Edge::right || load.edge == Load::Edge::top ? 1 : -1;
  group.out.along[along_x ? 0 : 1] = static_cast<signed char>(sign);
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

/// The particles of the load's region, and what each carries of a force (the same part) or feels of an acceleration
/// (its mass).
template <class Real>
void load_region(const Particles<Real, 2>& p, const Load& load, LoadGroup& group) {
  const bool force = load.kind == Load::Kind::force;
  for (long i = 0; i < p.count(); ++i)
    if (contains(load.region, {p.x[0][i], p.x[1][i]})) {
      group.id.push_back(p.id[i]);
      group.share.push_back(force ? 1 : double(p.mass[i]));
    }
  if (force)
    for (double& share : group.share)
      share = 1 / static_cast<double>(group.id.size());
}

/// Of a load that finds no particle: why.
template <class Real>
[[noreturn]] void refuse_load(const Scene& scene, const Particles<Real, 2>& p, const Load& load) {
  bool holds_some = false;
  for (long i = 0; i < p.count() && !holds_some; ++i)
    holds_some = contains(load.region, {p.x[0][i], p.x[1][i]});
  const std::string edge(name_of(load.edge)), where = place(scene, "load " + load.name);
  if (holds_some)
    fail({Exit::bad_input, "the traction finds no particle at an edge: all in its region have neighbours", where,
          fmt::format("edge = \"{}\"", edge), fmt::format("a region that reaches over the {} edge of a body", edge),
          "move the region there, or name another edge"});
  fail({Exit::bad_input, "the load finds no particle in its region", where, "", "a region that holds particle centres",
        "make the region a cell larger"});
}

/// Fields must be numbers where they act: at the start, in the middle and at the end of the run.
void check_values(const Scene& scene, const Load& load, const LoadGroup& g) {
  for (const double t : {0.0, 0.5 * scene.end_time, scene.end_time})
    for (const Field& f : g.value) {
      const std::vector<double> v = f.at(t, g.first);
      const auto bad = std::find_if(v.begin(), v.end(), [](double x) { return !std::isfinite(x); });
      if (bad == v.end())
        continue;
      const auto i = static_cast<size_t>(bad - v.begin());
      fail({Exit::bad_input, "the load is not a number everywhere", place(scene, "load " + load.name),
            fmt::format("{} at ({:.6g}, {:.6g}) m, {:.6g} s", *bad, g.first.X[i], g.first.Y[i], t),
            "finite wherever it acts", ""});
    }
}

}  // namespace

template <class Real>
void make_loads(const Scene& scene, State<Real, 2>& s) {
  const auto& p = s.particles;
  std::vector<int> loaded;
  std::vector<Outward> out;
  for (const Load& load : scene.loads) {
    LoadGroup g;
    g.value[0] = load.value[0];
    g.value[1] = load.value[1];
    if (load.kind == Load::Kind::traction)
      load_edge(scene, s, load, g);
    else
      load_region(p, load, g);
    if (g.id.empty())
      refuse_load(scene, p, load);
    if (load.value[0].places || load.value[1].places) {
      for (const int id : g.id)  // particles are not sorted yet: each is at the place of its id
        g.first.add({p.x[0][id], p.x[1][id]});
      check_values(scene, load, g);
    }
    loaded.insert(loaded.end(), g.id.begin(), g.id.end());
    out.resize(loaded.size(), g.out);
    s.loads.groups.push_back(std::move(g));
  }
  s.loads.loaded.resize(static_cast<long>(loaded.size()));
  std::copy(loaded.begin(), loaded.end(), s.loads.loaded.begin());
  s.loads.out.resize(s.loads.loaded.size());
  std::copy(out.begin(), out.end(), s.loads.out.begin());
  s.loads.force.resize(s.loads.loaded.size());
  s.loads.from.resize(s.loads.loaded.size());
  s.loads.applied_at.resize(s.loads.loaded.size());
  s.loads.position.resize(p.count());  // filled when they are sorted
}

void find_forces(const exec::Space& space, const LoadGroup& g, double t, Vec2* force) {
  if (g.first.count() == 0) {
    const Vec2 all{g.value[0](t), g.value[1](t)};
    for (size_t k = 0; k < g.id.size(); ++k)
      force[k] = g.share[k] * all;
    return;
  }
  constexpr long block = 512;
  const long n = g.first.count();
  exec::parallel_tasks(space, "loads", (n + block - 1) / block, [&](long b) {
    double v[2][block] = {};
    const long first = b * block, count = std::min(block, n - first);
    for (const int axis : {0, 1})
      g.value[axis].at(t, count, g.first.X.data() + first, g.first.Y.data() + first, v[axis]);
    for (long k = 0; k < count; ++k)
      force[first + k] = g.share[static_cast<size_t>(first + k)] * Vec2{v[0][k], v[1][k]};
  });
}

#define RIVEN_MAKE_LOADS(Real) template void make_loads(const Scene&, State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_MAKE_LOADS)
#undef RIVEN_MAKE_LOADS

}  // namespace riven
