#include "io/probes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/exec/parallel.hpp"
#include "io/crack_opening.hpp"
#include "io/particle_stress.hpp"

namespace riven {

namespace {

/// Id of the particle nearest to a point.
template <class Real>
int nearest_particle(const Particles<Real, 2>& p, Vec2 point) {
  double least = std::numeric_limits<double>::infinity();
  int id = 0;
  for (long i = 0; i < p.count(); ++i) {
    const Vec2 d = Vec2{p.x[0][i], p.x[1][i]} - point;
    if (dot(d, d) < least || (dot(d, d) == least && p.id[i] < id)) {
      least = dot(d, d);
      id = p.id[i];
    }
  }
  return id;
}

template <class Real>
long position_of(const Particles<Real, 2>& p, int id) {
  return std::find(p.id.begin(), p.id.end(), id) - p.id.begin();
}

double component(const CauchyStress& s, const Probe& p) {
  return p.axis != p.axis2 ? s.xy : p.axis == 0 ? s.xx : s.yy;
}

/// Volume times Cauchy stress is mass times what particles keep, Kirchhoff stress over first density.
template <class Real>
double mean_stress(const SimulationOf<Real>& m, const Probe& probe) {
  struct Sums {
    double stress = 0, volume = 0;
    Sums& operator+=(const Sums& o) {
      stress += o.stress;
      volume += o.volume;
      return *this;
    }
  };
  const auto& p = m.state.particles;
  const ParticleStress of(p, m.scene);
  const auto& kept = p.stress[probe.axis != probe.axis2 ? 2 : probe.axis];
  const Sums sums = exec::parallel_reduce<Sums>(m.space, "probes", p.count(), [&](long i) {
    return Sums{double(p.mass[i]) * kept[i], of.volume(i)};
  });
  return sums.stress / sums.volume;
}

/// Root mean square, over all particles, of the distance between their displacement and the exact one.
template <class Real>
double displacement_error(const SimulationOf<Real>& m, const Probe& probe) {
  constexpr long block = 512;
  const auto& p = m.state.particles;
  const long n = p.count(), blocks = (n + block - 1) / block;
  std::vector<double> squares(static_cast<size_t>(blocks));
  exec::parallel_tasks(m.space, "probes", blocks, [&](long b) {
    const long first = b * block, count = std::min(block, n - first);
    double exact[2][block], sum = 0;
    for (const int axis : {0, 1})
      probe.exact[axis].at(m.state.clock.time, count, p.x0[0].data() + first, p.x0[1].data() + first, exact[axis]);
    for (long k = 0; k < count; ++k)
      for (const int axis : {0, 1}) {
        const double u = p.x[axis][first + k] - p.x0[axis][first + k] - exact[axis][k];
        sum += u * u;
      }
    squares[static_cast<size_t>(b)] = sum;
  });
  double sum = 0;
  for (const double s : squares)
    sum += s;
  return std::sqrt(sum / static_cast<double>(n)) / probe.over;
}

template <class Real>
double read_one(const SimulationOf<Real>& m, const Probe& probe, int target) {
  const auto& p = m.state.particles;
  const auto axis = static_cast<size_t>(probe.axis);
  switch (probe.kind) {
    case Probe::Kind::crack_opening: return extreme_opening(m.scene, m.state.cracks, target);
    case Probe::Kind::displacement: {
      const long i = position_of(p, target);
      return p.x[axis][i] - p.x0[axis][i];
    }
    case Probe::Kind::velocity: return p.v[axis][position_of(p, target)];
    case Probe::Kind::stress: return component(ParticleStress(p, m.scene).cauchy(position_of(p, target)), probe);
    case Probe::Kind::reaction: {
      const Vec2 r = m.state.constraints.owners[static_cast<size_t>(target)].mean.value;
      return (axis == 0 ? r.x : r.y) / probe.over;
    }
    case Probe::Kind::travel: {
      const Vec2 t = m.state.constraints.owners[static_cast<size_t>(target)].travel;
      return (axis == 0 ? t.x : t.y) / probe.over;
    }
    case Probe::Kind::mean_stress: return mean_stress(m, probe);
    case Probe::Kind::displacement_error: return displacement_error(m, probe);
  }
  return 0;
}

const char* unit(const Probe& p) {
  switch (p.kind) {
    case Probe::Kind::crack_opening:
    case Probe::Kind::displacement: return "m";
    case Probe::Kind::velocity: return "m/s";
    case Probe::Kind::stress:
    case Probe::Kind::mean_stress: return "Pa";
    case Probe::Kind::reaction: return p.over == 1 ? "N" : "Pa";
    case Probe::Kind::travel:
    case Probe::Kind::displacement_error: return p.over == 1 ? "m" : "1";
  }
  return "";
}

}  // namespace

template <class Real>
Probes::Probes(const SimulationOf<Real>& m) : scene_(m.scene) {
  const auto named = [](const auto& list, const std::string& name) {
    const auto at = std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
    return static_cast<int>(at - list.begin());
  };
  for (const Probe& p : m.scene.probes)
    switch (p.kind) {
      case Probe::Kind::crack_opening: target_.push_back(named(m.scene.cracks, p.target)); break;
      case Probe::Kind::reaction:
      case Probe::Kind::travel: target_.push_back(named(m.state.constraints.owners, p.target)); break;
      case Probe::Kind::mean_stress:
      case Probe::Kind::displacement_error: target_.push_back(0); break;
      default: target_.push_back(nearest_particle(m.state.particles, p.point));
    }
}

std::vector<HistoryColumn> Probes::columns() const {
  std::vector<HistoryColumn> list;
  for (const Probe& p : scene_.probes)
    list.push_back({p.name, unit(p)});
  return list;
}

template <class Real>
std::vector<double> Probes::read(const SimulationOf<Real>& m) const {
  std::vector<double> values;
  for (size_t i = 0; i < target_.size(); ++i)
    values.push_back(read_one(m, m.scene.probes[i], target_[i]));
  return values;
}

#define RIVEN_PROBES(Real)                            \
  template Probes::Probes(const SimulationOf<Real>&); \
  template std::vector<double> Probes::read(const SimulationOf<Real>&) const;
RIVEN_EACH_REAL(RIVEN_PROBES)
#undef RIVEN_PROBES

}  // namespace riven
