#include "core/state/make_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/tensor.hpp"
#include "core/state/bodies_at_cracks.hpp"
#include "core/state/first_gaps.hpp"
#include "core/state/junctions.hpp"
#include "core/state/keep_off_cracks.hpp"
#include "core/state/lay_points.hpp"
#include "core/state/make_tips.hpp"
#include "core/state/tractions.hpp"

namespace riven {

namespace {

template <class Real>
void make_tables(const Scene& scene, const Plan& plan, State<Real, 2>& s) {
  const Lattice& l = s.grid.lattice;
  for (const Body& b : scene.bodies) {
    const Material& m = scene.materials[static_cast<size_t>(b.material)];
    const long i = s.domains.size();
    s.domains.resize(i + 1);
    for (int d = 0; d < 2; ++d) {
      const Real half = Real(0.5 / b.particles_per_cell);
      s.domains[i].axis[d] = {half, Real(1) / (4 * half), l.wall_lower[d], l.wall_upper[d]};
    }
    s.specific_area.resize(i + 1);
    s.thickness.resize(i + 1);
    s.thickness[i] = b.thickness > 0 ? b.thickness : scene.thickness;
    s.specific_area[i] = 1 / (m.density * s.thickness[i]);
    const auto add = [&](auto& table) {
      table.resize(i + 1);
      table[i] = {m, scene.plane};
    };
    switch (plan.law) {
      case LawChoice::linear_elastic: add(s.laws.linear); break;
      case LawChoice::linear_elastic_F: add(s.laws.linear_F); break;
      case LawChoice::neo_hookean: add(s.laws.neo); break;
      case LawChoice::any: add(s.laws.any); break;
    }
  }
}

struct Seed {
  Vec2 x, v;
  Mat2<double> C;  ///< gradient of v
  double mass;
  int body;
};

/// What a body's velocity field adds at each of its points.
std::vector<Vec2> field_velocities(const Scene& scene, const Body& body, const std::vector<Vec2>& points) {
  std::vector<Vec2> all(points.size());
  if (!body.velocity_field[0] && !body.velocity_field[1])
    return all;
  Places places;
  for (const Vec2 p : points)
    places.add(p);
  const auto component = [&](int axis) { return body.velocity_field[axis].value_or(Field{}).at(0, places); };
  const std::vector<double> v[2] = {component(0), component(1)};
  for (size_t i = 0; i < points.size(); ++i) {
    all[i] = {v[0][i], v[1][i]};
    if (!std::isfinite(v[0][i] + v[1][i]))
      fail({Exit::bad_input, "the first velocity is not a number everywhere", place(scene, "body " + body.name),
            std::to_string(v[0][i]) + ", " + std::to_string(v[1][i]) + " m/s at " + std::to_string(points[i].x) + ", " +
                std::to_string(points[i].y) + " m",
            "finite in the whole body", ""});
  }
  return all;
}

/// Its gradients, from one edge of each particle to the other: a jump of the field is then one within a particle.
std::vector<Mat2<double>> field_gradients(const Scene& scene, const Body& body, const std::vector<Vec2>& points,
                                          double edge) {
  const auto differences = [&](Vec2 half) {
    std::vector<Vec2> ahead = points, behind = points;
    for (size_t i = 0; i < points.size(); ++i) {
      ahead[i] += half;
      behind[i] -= half;
    }
    std::vector<Vec2> v = field_velocities(scene, body, ahead);
    const std::vector<Vec2> before = field_velocities(scene, body, behind);
    for (size_t i = 0; i < points.size(); ++i)
      v[i] = (1 / edge) * (v[i] - before[i]);
    return v;
  };
  const std::vector<Vec2> of_x = differences({0.5 * edge, 0}), of_y = differences({0, 0.5 * edge});
  std::vector<Mat2<double>> all(points.size());
  for (size_t i = 0; i < points.size(); ++i)
    all[i] = {of_x[i].x, of_y[i].x, of_x[i].y, of_y[i].y};
  return all;
}

/// Particles of all bodies, with their first velocities.
std::vector<Seed> lay_bodies(const Scene& scene, const Lattice& lattice) {
  std::vector<Seed> seeds;
  for (size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    const std::vector<Vec2> points = lay_points(body.region, body.holes, lattice, body.particles_per_cell);
    if (points.empty())
      fail({Exit::bad_input, "the body holds no particle", place(scene, "body " + body.name), "",
            "a region larger than a particle", "smaller cells, or more particles_per_cell"});
    Vec2 center;
    for (const Vec2 p : points)
      center += p;
    center *= 1 / static_cast<double>(points.size());
    const double edge = lattice.h / body.particles_per_cell;
    const double mass = scene.materials[static_cast<size_t>(body.material)].density * edge * edge *
                        (body.thickness > 0 ? body.thickness : scene.thickness);
    const std::vector<Vec2> field = field_velocities(scene, body, points);
    const std::vector<Mat2<double>> slope =
        scene.affine ? field_gradients(scene, body, points, edge) : std::vector<Mat2<double>>(points.size());
    const Mat2<double> spin{0, -body.spin, body.spin, 0};
    for (size_t i = 0; i < points.size(); ++i)
      seeds.push_back({points[i], body.velocity + body.spin * turned(points[i] - center) + field[i], spin + slope[i],
                       mass, static_cast<int>(b)});
  }
  return seeds;
}

}  // namespace

template <class Real>
void make_state(const Scene& scene, const Plan& plan, State<Real, 2>& s) {
  s.grid.lattice = make_lattice(scene.grid.lower, scene.grid.upper, scene.cell);
  make_tables(scene, plan, s);
  const std::vector<Seed> seeds = lay_bodies(scene, s.grid.lattice);
  const long n = static_cast<long>(seeds.size());
  auto& p = s.particles;
  for (int d = 0; d < 2; ++d) {
    p.x[d].resize(n);
    p.v[d].resize(n);
  }
  for (auto& a : p.stress)
    a.resize(n);
  for (auto* a : {&p.mass})
    a->resize(n);
  p.body.resize(n);
  p.id.resize(n);
  if (plan.keeps_F())
    for (auto& a : p.F)
      a.resize(n);
  if (plan.keeps_J())
    p.J.resize(n);
  if (plan.affine)
    for (auto& a : p.C)
      a.resize(n);
  for (long i = 0; i < n; ++i) {
    const Seed& seed = seeds[static_cast<size_t>(i)];
    p.x[0][i] = seed.x.x;
    p.x[1][i] = seed.x.y;
    p.v[0][i] = Real(seed.v.x);
    p.v[1][i] = Real(seed.v.y);
    p.mass[i] = Real(seed.mass);
    p.body[i] = static_cast<std::uint8_t>(seed.body);
    p.id[i] = static_cast<int>(i);
    if (plan.keeps_F())
      p.F[0][i] = p.F[3][i] = 1;
    if (plan.keeps_J())
      p.J[i] = 1;
    if (plan.affine) {
      p.C[0][i] = Real(seed.C.xx);
      p.C[1][i] = Real(seed.C.xy);
      p.C[2][i] = Real(seed.C.yx);
      p.C[3][i] = Real(seed.C.yy);
    }
    s.particle_mass = std::max(s.particle_mass, seed.mass);
  }
  if (plan.cracks) {
    s.cracks = make_cracks(scene, least_particle_distance(scene));
    s.cracks.gap = first_gaps(scene, s.cracks);
    tie_from_start(scene, s.cracks);
    lay_densities(scene, s.cracks);
    lay_in_solid(scene, s.cracks);
    if (plan.fracture)
      for (const Tip& t : make_tips(scene))
        s.cracks.set_open(t.crack, t.last, true);
    if (plan.tractions)
      lay_tractions(scene, s.cracks);
    s.fields.fields.resize(n);
    const KeepOffCracks keep_off(s.cracks, s.grid.lattice);
    int body = 0;
    const std::function<bool(Vec2)> holds = [&](Vec2 at) { return body_at(scene, at) == body; };
    for (long i = 0; i < n; ++i) {
      body = p.body[i];
      const Vec2 x = keep_off.from({p.x[0][i], p.x[1][i]}, holds);
      p.x[0][i] = x.x;
      p.x[1][i] = x.y;
    }
  }
  if (plan.first_positions())
    for (int d = 0; d < 2; ++d)
      p.x0[d] = p.x[d];
  if (plan.first_gaps) {
    for (auto& a : p.closed)
      a.resize(n);
    const ClosedGaps gaps(s.cracks, scene.cell);
    for (long i = 0; i < n; ++i) {
      const Vec2 x = gaps.place({p.x[0][i], p.x[1][i]});
      p.closed[0][i] = x.x;
      p.closed[1][i] = x.y;
    }
  }
  if (plan.fracture) {
    s.tips = make_tips(scene);
    s.readings.assign(scene.readings.size(), s.tips);
  }
  size_grid(plan, s);
}

template <class Real>
void size_grid(const Plan& plan, State<Real, 2>& s) {
  const long slots = long{s.grid.lattice.nodes()} + s.fields.extra_slots;
  if (slots == s.grid.mass.size())
    return;
  // cracks that grow ask for a few more slots at a time, beside many plain ones
  const long room = slots + s.fields.extra_slots / 4;
  const auto resize = [&](exec::Array<Real>& a, long width) {
    if (width * slots > a.capacity())
      a.reserve(width * room);
    a.renew(width * slots);  // every step clears it
  };
  resize(s.grid.mass, 1);
  resize(s.grid.q, 4);
  if (plan.extrapolate_again())
    resize(s.grid.again, 4);
  if (plan.higher_order() && plan.order > 1)
    for (auto* a : {&s.grid.high, &s.grid.term, &s.grid.next})
      resize(*a, 4);
  if (plan.full_mass())
    s.grid.full_mass.resize(long{full_mass_entries} * s.grid.lattice.nodes());
}

template <class Real>
std::vector<ArrayReport> list_arrays(const State<Real, 2>& s) {
  std::vector<ArrayReport> list;
  const auto add = [&](const char* name, const auto&... arrays) {
    ArrayReport r{name, 0, 0};
    ((r.items += arrays.size(), r.bytes += arrays.empty() ? 0 : arrays.bytes()), ...);
    if (r.items > 0)
      list.push_back(r);
  };
  const auto& p = s.particles;
  add("particles: position", p.x[0], p.x[1]);
  add("particles: velocity", p.v[0], p.v[1]);
  add("particles: deformation gradient", p.F[0], p.F[1], p.F[2], p.F[3]);
  add("particles: det F", p.J);
  add("particles: stress", p.stress[0], p.stress[1], p.stress[2]);
  add("particles: mass", p.mass);
  add("particles: velocity gradient", p.C[0], p.C[1], p.C[2], p.C[3]);
  add("particles: first position", p.x0[0], p.x0[1]);
  add("particles: closed position", p.closed[0], p.closed[1]);
  add("particles: body", p.body);
  add("particles: id", p.id);
  const CrackFields& f = s.fields;
  add("particles: crack fields", f.fields, f.crossing, f.block_slots, f.slots);
  add("particles: crossing memory", f.memory);
  add("grid: mass", s.grid.mass);
  add("grid: momentum and force", s.grid.q);
  add("grid: second extrapolation", s.grid.again);
  add("grid: higher orders", s.grid.high, s.grid.term, s.grid.next);
  add("grid: full mass", s.grid.full_mass);
  ArrayReport points{"cracks: points", 0, 0};
  s.cracks.each_point_array([&](const auto& a) {
    points.items += a.size();
    points.bytes += a.bytes();
  });
  if (points.items > 0)
    list.push_back(points);
  add("cracks: motion", f.hashed, f.traced, f.crack_move);
  add("cracks: crossings", f.records, f.limit, f.block_limit, f.tiles);
  add("cracks: cells and nodes", f.cell_index, f.cells, f.cell_start, f.cell_segment, f.tile_marked, f.marked_tiles,
      f.tile_crack_start, f.tile_crack, f.node_index, f.extra, f.nodes, f.normals, f.third_normals, f.held,
      f.candidate_start, f.candidate, f.segment_start, f.node_segment, f.clearance, f.follow_at, f.turned, f.tally,
      f.recount, f.verdict);
  return list;
}

#define RIVEN_MAKE_STATE(Real)                                          \
  template void make_state(const Scene&, const Plan&, State<Real, 2>&); \
  template void size_grid(const Plan&, State<Real, 2>&);                \
  template std::vector<ArrayReport> list_arrays(const State<Real, 2>&);
RIVEN_EACH_REAL(RIVEN_MAKE_STATE)
#undef RIVEN_MAKE_STATE

}  // namespace riven
