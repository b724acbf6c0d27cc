// The state as kernels see it: pointers and numbers, captured by value.
#pragma once
#include <type_traits>

#include "core/state/state.hpp"
#include "kernels/block.hpp"

namespace riven {

/// Particle arrays; null where the plan did not ask for an array.
template <class Real>
struct ParticleView {
  double *x, *y;
  Real *vx, *vy;
  double *Fxx, *Fxy, *Fyx, *Fyy, *J;
  Real *sxx, *syy, *sxy;
  Real* mass;
  Real *step_x, *step_y;
};

template <class Real>
ParticleView<Real> view(Particles<Real, 2>& p) {
  return {p.x[0].data(),      p.x[1].data(),      p.v[0].data(), p.v[1].data(),    p.F[0].data(),
          p.F[1].data(),      p.F[2].data(),      p.F[3].data(), p.J.data(),       p.stress[0].data(),
          p.stress[1].data(), p.stress[2].data(), p.mass.data(), p.step[0].data(), p.step[1].data()};
}

template <class Real>
Positions<Real> positions(const State<Real, 2>& s) {
  const Lattice& l = s.grid.lattice;
  return {s.particles.x[0].data(),
          s.particles.x[1].data(),
          l.origin.x,
          l.origin.y,
          1 / l.h,
          {s.domains.data(), s.particles.body.data(), s.domains.size() == 1}};
}

/// `shared`: several tiles may write to a slot at once.
inline CrossingSlots crossing_slots(const CrackFields& f, const Lattice& l, bool shared = false) {
  return {f.tile_marked.data(), f.crossing.data(), f.block_slots.data(), f.slots.data(), l.nodes(), shared};
}
template <class Real>
CrossingSlots crossing_slots(const State<Real, 2>& s, bool shared = false) {
  return crossing_slots(s.fields, s.grid.lattice, shared);
}

template <class Law, class Real>
const Law* law_table(const LawTables<Real>& t) {
  if constexpr (std::is_same_v<Law, LinearElastic<Real>>)
    return t.linear.data();
  else if constexpr (std::is_same_v<Law, LinearElasticF<Real>>)
    return t.linear_F.data();
  else if constexpr (std::is_same_v<Law, NeoHookean<Real>>)
    return t.neo.data();
  else
    return t.any.data();
}

template <class Law, class Real>
BodyLookup<Law> laws(const State<Real, 2>& s) {
  return {law_table<Law>(s.laws), s.particles.body.data(), s.domains.size() == 1};
}

}  // namespace riven
