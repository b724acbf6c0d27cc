// Stresses of particles as people know them: Cauchy, in Pa, with the part out of the plane.
#pragma once
#include <vector>

#include "core/laws/elastic.hpp"
#include "core/scene/scene.hpp"
#include "core/state/particles.hpp"

namespace riven {

struct CauchyStress {
  double xx = 0, yy = 0, zz = 0, xy = 0;
};
double von_mises(const CauchyStress& s);

/// Looks at the particles as they are when it is asked; particles and scene must outlive it.
template <class Real>
class ParticleStress {
 public:
  ParticleStress(const Particles<Real, 2>& particles, const Scene& scene);
  CauchyStress cauchy(long particle) const;
  /// det F with the change of thickness.
  double volume_ratio(long particle) const;
  /// Present volume, m^3.
  double volume(long particle) const;

 private:
  const Material& material(long particle) const;
  const AnyElastic<double>& law(long particle) const;
  LawState<double> state(long particle) const;

  const Particles<Real, 2>& particles_;
  const Scene& scene_;
  std::vector<AnyElastic<double>> laws_;  ///< by material
};

}  // namespace riven
