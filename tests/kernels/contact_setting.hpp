// Particles, cracks and grids that contact acts on, and their motion set by hand.
#pragma once
#include <functional>
#include <random>

#include "kernels/contact.hpp"
#include "tests/kernels/crack_scene.hpp"

namespace riven::contact_setting {

using namespace crack_scene;
using Line = std::vector<Vec2>;

inline constexpr double dt = 1e-2;

struct Setting {
  Lattice lattice = unit_cells(24, 24);
  Cracks cracks;
  CrackFields fields;
  Particles<double, 2> particles;
  exec::Array<DomainSetting<double, 2>> domains;
  exec::Array<double> specific_area;
  Grid<double> grid;
  ContactSums sums;
  FieldImpulses impulses;
  double drift = 0;  ///< of the particles since they were sorted

  ContactParticles<double> all(ShapeFunction shape = ShapeFunction::ugimp) const {
    return {shape, particles, domains, specific_area, drift};
  }
};

/// Where a particle of first position X is now.
using Map = std::function<Vec2(Vec2)>;

/// A body over [4, 20]^2 of a grid of unit cells, four particles of mass 0.5 and first area 0.25 in each, with cracks,
/// particles and crack points moved by `map` from where they are first.
template <class Shape = UGimp>
Setting make_setting(const std::vector<Line>& lines, const Map& map, const Map& map_crack, ContactLaw law) {
  Setting s;
  s.cracks = cracks_of(lines, 0.5);
  for (int p = 0; p < s.cracks.points(); ++p)
    s.cracks.plane[p] = s.cracks.upper[p] = s.cracks.lower[p] = map_crack(s.cracks.plane0[p]);
  for (ContactSettings& c : s.cracks.contact)
    c.law = law;
  std::vector<Vec2> X, x;
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 32; ++i) {
      X.push_back({4.25 + 0.5 * i, 4.25 + 0.5 * j});
      x.push_back(map(X.back()));
    }
  Particles<double, 2>& p = s.particles;
  p = sorted_particles<Shape>(s.lattice, x, in_order(x.size()));
  p.mass.resize(p.count());
  p.J.resize(p.count());
  for (auto& a : p.x0)
    a.resize(p.count());
  for (int i = 0; i < p.count(); ++i) {
    p.mass[i] = 0.5;
    p.J[i] = 1;
    p.x0[0][i] = X[static_cast<size_t>(p.id[i])].x;
    p.x0[1][i] = X[static_cast<size_t>(p.id[i])].y;
  }
  s.domains.resize(1);
  s.domains[0] = quarter_cells(s.lattice);
  s.specific_area.resize(1);
  s.specific_area[0] = 0.5;
  const exec::Space serial;
  hash_cracks<Shape>(serial, s.lattice, s.cracks, s.fields);
  determine_fields<Shape>(serial, p, s.domains.data(), s.lattice, s.cracks, s.fields);
  s.grid.lattice = s.lattice;
  s.grid.mass.resize(s.lattice.nodes() + s.fields.extra_slots);
  clear_impulses(s.fields, s.impulses);
  return s;
}

inline Vec2 stay(Vec2 X) {
  return X;
}

inline long slot_of(const Setting& s, const NodeCracks& n, int field) {
  return field == 0 ? n.node : long{s.lattice.nodes()} + s.fields.extra[n.node] + field - 1;
}

/// The impulse on a field that a stage noted.
inline Vec2 noted(Setting& s, const NodeCracks& n, long slot, ContactStage stage) {
  const ImpulseNotes notes(s.impulses, s.lattice);
  const long i = s.fields.node_index[n.node];
  const int k = static_cast<int>(stage);
  return notes.acted[i] & 1 << k ? notes.at(i, slot)[k] : Vec2{};
}

/// f(flagged node, field, particle, weight) for all pairs of particles and nodes that hold cracks.
template <class Shape, class F>
void each_pair(const Setting& s, const F& f) {
  const Particles<double, 2>& p = s.particles;
  for (int i = 0; i < p.count(); ++i) {
    const auto a = Shape::axis(p.x[0][i] - s.lattice.origin.x, s.domains[0].axis[0]);
    const auto b = Shape::axis(p.x[1][i] - s.lattice.origin.y, s.domains[0].axis[1]);
    for (int k = 0; k < neighbours<Shape, 2>; ++k) {
      const int index = s.fields.node_index[(b.base + k / Shape::width) * s.lattice.nx + a.base + k % Shape::width];
      if (index >= 0 && s.fields.nodes[index].crack[0] >= 0)
        f(index, CrackFields::field_of(s.fields.fields[i], k), i, a.s[k % Shape::width] * b.s[k / Shape::width]);
    }
  }
}

/// Masses of the slots of nodes that hold cracks.
template <class Shape = UGimp>
void set_masses(Setting& s) {
  s.grid.mass.zero();
  each_pair<Shape>(s, [&](int index, int field, int i, double S) {
    s.grid.mass[slot_of(s, s.fields.nodes[index], field)] += s.particles.mass[i] * S;
  });
}

template <class Shape = UGimp>
void sum(Setting& s, const exec::Space& space, ShapeFunction shape = ShapeFunction::ugimp, double thickness = 2) {
  set_masses<Shape>(s);
  contact_sums(space, {true, true, true}, s.all(shape), s.grid, s.fields, s.cracks, thickness, s.sums);
  const NodeSums<double> sums = node_sums(s.all(shape), s.lattice, s.fields, s.sums);
  for (long i = 0; i < s.fields.nodes.size(); ++i)
    sums.ask(i, s.fields.nodes[i]);
}

inline const Line level{{1, 12.3}, {23, 12.3}};
inline const Line upright{{11.8, 1}, {11.8, 23}};
inline const Line slanting{{2.1, 10.2}, {9.7, 11.6}, {22.3, 14.9}};

/// Momenta of the after-contact state, whatever a stage keeps.
inline void random_motion(Setting& s, unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  const long slots = s.grid.mass.size();
  s.grid.q.resize(4 * slots);
  s.grid.again.resize(4 * slots);
  s.grid.high.resize(4 * slots);
  for (double& q : s.grid.q)
    q = any(rng);
  for (double& q : s.grid.again)
    q = any(rng);
  for (double& q : s.grid.high)
    q = any(rng);
}

struct StageData {
  ContactStage stage;
  bool momentum;
  exec::Array<double> Grid<double>::*data;
};
inline const StageData stages[] = {{ContactStage::before, true, &Grid<double>::q},
                                   {ContactStage::after, false, &Grid<double>::q},
                                   {ContactStage::again, true, &Grid<double>::again},
                                   {ContactStage::higher, false, &Grid<double>::high}};

inline Setting crossing_setting(ContactLaw a, ContactLaw b) {
  Setting s = make_setting({slanting, upright}, stay, stay, a);
  s.cracks.contact[0] = {a, 0.3, 50, 20};
  s.cracks.contact[1] = {b, 0.2, 1e9, 5};
  sum(s, exec::Space());
  set_masses(s);
  return s;
}

/// Three cracks through one place.
inline Setting triple_setting(ContactLaw a, ContactLaw b, ContactLaw c) {
  Setting s = make_setting({slanting, upright, {{4.3, 4.2}, {19.3, 19.8}}}, stay, stay, a);
  s.cracks.contact[0] = {a, 0.3, 50, 20};
  s.cracks.contact[1] = {b, 0.2, 1e9, 5};
  s.cracks.contact[2] = {c, 0.1, 30, 1e9};
  sum(s, exec::Space());
  set_masses(s);
  return s;
}

}  // namespace riven::contact_setting
