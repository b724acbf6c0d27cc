// The state as kernels see it: pointers and numbers, captured by value.
#pragma once
#include <type_traits>

#include "core/state/state.hpp"
#include "kernels/scatter.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Particle arrays; null where the plan did not ask for an array.
template <class Real>
struct ParticleView {
  double *x, *y;
  Real *vx, *vy;
  double *Fxx, *Fxy, *Fyx, *Fyy, *J;
  Real *sxx, *syy, *sxy;
  Real* mass;
};

template <class Real>
ParticleView<Real> view(Particles<Real, 2>& p) {
  return {exec::data(p.x[0]), exec::data(p.x[1]),      exec::data(p.v[0]),      exec::data(p.v[1]),
          exec::data(p.F[0]), exec::data(p.F[1]),      exec::data(p.F[2]),      exec::data(p.F[3]),
          exec::data(p.J),    exec::data(p.stress[0]), exec::data(p.stress[1]), exec::data(p.stress[2]),
          exec::data(p.mass)};
}

/// The same to be read.
template <class Real>
struct ParticleReads {
  const double *x, *y;
  const Real *vx, *vy;
  const double *Fxx, *Fxy, *Fyx, *Fyy, *J;
  const Real *sxx, *syy, *sxy;
  const Real* mass;
};

template <class Real>
ParticleReads<Real> reads(const Particles<Real, 2>& p) {
  return {exec::data(p.x[0]), exec::data(p.x[1]),      exec::data(p.v[0]),      exec::data(p.v[1]),
          exec::data(p.F[0]), exec::data(p.F[1]),      exec::data(p.F[2]),      exec::data(p.F[3]),
          exec::data(p.J),    exec::data(p.stress[0]), exec::data(p.stress[1]), exec::data(p.stress[2]),
          exec::data(p.mass)};
}

template <class Real>
Positions<Real> positions(const State<Real, 2>& s) {
  const Lattice& l = s.grid.lattice;
  return {exec::data(s.particles.x[0]),
          exec::data(s.particles.x[1]),
          l.origin.x,
          l.origin.y,
          1 / l.h,
          {exec::data(s.domains), exec::data(s.particles.body), s.domains.size() == 1}};
}

/// Whether particles that follow each other still have the same nodes by four: most are in the middle of the cell that
/// they were sorted by, a quarter of it from its edges.
template <class Real>
bool in_cells(const State<Real, 2>& s) {
  return s.watch.drift < 0.25 * s.grid.lattice.h;
}

/// `shared`: several tiles may write to a slot at once.
inline CrossingSlots crossing_slots(const CrackFields& f, const Lattice& l, bool shared = false) {
  return {exec::data(f.tile_marked),
          exec::data(f.crossing),
          exec::data(f.block_slots),
          exec::data(f.slots),
          l.nodes(),
          shared};
}
template <class Real>
CrossingSlots crossing_slots(const State<Real, 2>& s, bool shared = false) {
  return crossing_slots(s.fields, s.grid.lattice, shared);
}

template <class Law, class Real>
const Law* law_table(const LawTables<Real>& t) {
  if constexpr (std::is_same_v<Law, LinearElastic<Real>>)
    return exec::data(t.linear);
  else if constexpr (std::is_same_v<Law, LinearElasticF<Real>>)
    return exec::data(t.linear_F);
  else if constexpr (std::is_same_v<Law, NeoHookean<Real>>)
    return exec::data(t.neo);
  else
    return exec::data(t.any);
}

template <class Law, class Real>
BodyLookup<Law> laws(const State<Real, 2>& s) {
  return {law_table<Law>(s.laws), exec::data(s.particles.body), s.domains.size() == 1};
}

}  // namespace RIVEN_SIDE

}  // namespace riven
