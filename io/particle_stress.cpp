#include "io/particle_stress.hpp"

#include <cmath>

namespace riven {

double von_mises(const CauchyStress& s) {
  const double a = s.xx - s.yy, b = s.yy - s.zz, c = s.zz - s.xx;
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * s.xy * s.xy);
}

template <class Real>
ParticleStress<Real>::ParticleStress(const Particles<Real, 2>& particles, const Scene& scene)
    : particles_(particles), scene_(scene) {
  for (const Material& m : scene.materials)
    laws_.emplace_back(m, scene.plane);
}

template <class Real>
const Material& ParticleStress<Real>::material(long i) const {
  return scene_.materials[static_cast<std::size_t>(scene_.bodies[particles_.body[i]].material)];
}

template <class Real>
const AnyElastic<double>& ParticleStress<Real>::law(long i) const {
  return laws_[static_cast<std::size_t>(scene_.bodies[particles_.body[i]].material)];
}

template <class Real>
LawState<double> ParticleStress<Real>::state(long i) const {
  const auto& p = particles_;
  LawState<double> s;
  s.F = p.F[0].empty() ? Mat2<double>{1, 0, 0, 1} : Mat2<double>{p.F[0][i], p.F[1][i], p.F[2][i], p.F[3][i]};
  s.J = p.J.empty() ? det(s.F) : p.J[i];
  s.xx = p.stress[0][i];
  s.yy = p.stress[1][i];
  s.xy = p.stress[2][i];
  return s;
}

template <class Real>
double ParticleStress<Real>::volume_ratio(long i) const {
  const double J = state(i).J;
  return J * law(i).thickness_ratio(J);
}

template <class Real>
double ParticleStress<Real>::volume(long i) const {
  return particles_.mass[i] / material(i).density * volume_ratio(i);
}

template <class Real>
CauchyStress ParticleStress<Real>::cauchy(long i) const {
  const LawState<double> s = state(i);
  const double scale = material(i).density / volume_ratio(i);
  return {scale * s.xx, scale * s.yy, scale * law(i).stress_zz(s), scale * s.xy};
}

#define RIVEN_PARTICLE_STRESS(Real) template class ParticleStress<Real>;
RIVEN_EACH_REAL(RIVEN_PARTICLE_STRESS)
#undef RIVEN_PARTICLE_STRESS

}  // namespace riven
