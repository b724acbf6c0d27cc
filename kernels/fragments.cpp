#include "kernels/fragments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/laws/contact.hpp"
#include "kernels/crack_step.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/field_slots.hpp"
#include "kernels/sort_particles.hpp"

namespace riven {

namespace {

/// Sets that are joined two at a time. The least number of a set stands for it.
class Sets {
 public:
  explicit Sets(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), size_t{0}); }

  size_t size() const { return parent_.size(); }
  size_t of(size_t i) {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(size_t a, size_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<size_t> parent_;
};

/// The slots of a particle's fields at the four corners of its cell. The other nodes that it sees are left out: beyond
/// the edge of a solid there are some that see past the end of a crack that has cut it.
template <class Shape, class Real>
class Corners {
 public:
  explicit Corners(const State<Real, 2>& s) : s_(s), slots_(s.fields, s.grid.lattice.nodes()) {}

  std::array<size_t, 4> of(int p) const {
    const Lattice& l = s_.grid.lattice;
    const DomainSetting<Real, 2>& d = s_.domains[s_.particles.body[p]];
    const double X = (s_.particles.x[0][p] - l.origin.x) / l.h, Y = (s_.particles.x[1][p] - l.origin.y) / l.h;
    const int i = static_cast<int>(std::floor(X)), j = static_cast<int>(std::floor(Y));
    const int m = i - Shape::axis(X, d.axis[0]).base, n = j - Shape::axis(Y, d.axis[1]).base;
    const std::uint32_t word = s_.fields.fields.empty() ? 0 : s_.fields.fields[p];
    const auto slot = [&](int a, int b) {
      const int field = CrackFields::field_of(word, (n + b) * Shape::width + m + a);
      return static_cast<size_t>(slots_.of((j + b) * l.nx + i + a, field));
    };
    return {slot(0, 0), slot(1, 0), slot(0, 1), slot(1, 1)};
  }

 private:
  const State<Real, 2>& s_;
  FieldSlots slots_;
};

/// Joins what lies on either side of cracks that hold their faces together.
template <class Real>
void join_across(const State<Real, 2>& s, Sets& sets) {
  const CrackFields& fields = s.fields;
  const FieldSlots slots(fields, s.grid.lattice.nodes());
  for (int i = 0; i < fields.nodes.size(); ++i) {
    const NodeCracks& n = fields.nodes[i];
    for (int k = 0; k < fields.held[i]; ++k)
      for (int f = 0; f < n.fields() && holds_together(s.cracks.contact[n.crack[k]].law); ++f)
        sets.join(static_cast<size_t>(slots.of(n.node, f)), static_cast<size_t>(slots.of(n.node, f ^ 1 << k)));
  }
}

template <class Shape, class Real>
std::vector<Fragment> fragments(const State<Real, 2>& s) {
  const Corners<Shape, Real> corners(s);
  Sets sets(static_cast<size_t>(s.grid.lattice.nodes() + s.fields.extra_slots));
  for (int p = 0; p < s.particles.count(); ++p) {
    const auto at = corners.of(p);
    for (const size_t slot : at)
      sets.join(at[0], slot);
  }
  join_across(s, sets);
  std::vector<Fragment> by_set(sets.size());
  for (int p = 0; p < s.particles.count(); ++p) {
    Fragment& f = by_set[sets.of(corners.of(p)[0])];
    const double mass = s.particles.mass[p];
    f.mass += mass;
    f.centre += mass * Vec2{s.particles.x[0][p], s.particles.x[1][p]};
    ++f.particles;
  }
  std::erase_if(by_set, [](const Fragment& f) { return f.particles == 0; });
  for (Fragment& f : by_set)
    f.centre = (1 / f.mass) * f.centre;
  std::stable_sort(by_set.begin(), by_set.end(), [](const Fragment& a, const Fragment& b) { return a.mass > b.mass; });
  return by_set;
}

}  // namespace

template <class Real>
std::vector<Fragment> find_fragments(SimulationOf<Real>& m) {
  if (sort_due(m.plan, m.state))
    sort_particles(m.space, m.plan, m.state);
  if (m.plan.cracks) {
    hash_if_due(m);
    find_fields(m);
  }
  return with_shape(m.plan.shape, [&](auto shape) { return fragments<typename decltype(shape)::type>(m.state); });
}

#define RIVEN_FRAGMENTS(Real) template std::vector<Fragment> find_fragments(SimulationOf<Real>&);
RIVEN_EACH_REAL(RIVEN_FRAGMENTS)
#undef RIVEN_FRAGMENTS

}  // namespace riven
