// The sums of contact_sums.hpp for one node, from the particles in the cells around it.
//
// Most nodes beside cracks never ask: faces that part do not touch, whatever their gap. So a node sums when it is first
// asked in a step, in the order of its particles: the same bits whoever asks, and when.
#pragma once
#include <algorithm>

#include "core/math/quad.hpp"
#include "core/math/shape.hpp"
#include "core/plan/plan.hpp"
#include "core/state/bodies.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/grid.hpp"
#include "core/state/particles.hpp"
#include "kernels/block.hpp"
#include "kernels/cell_rows.hpp"

namespace riven {

/// What contact knows of particles.
template <class Real>
struct ContactParticles {
  ShapeFunction shape;
  const Particles<Real, 2>& particles;
  const exec::Array<DomainSetting<Real, 2>>& domains;  ///< [bodies]
  const exec::Array<double>& specific_area;            ///< [bodies] first area, m^2 per kg: 1 / (density thickness)
  double drift;                                        ///< StepWatch::drift
};

/// Cells between a particle and a node that it sees, at most.
template <class Real>
double cells_seen(ShapeFunction shape, const exec::Array<DomainSetting<Real, 2>>& domains) {
  if (shape == ShapeFunction::bspline)
    return 1.5;
  double half = 0;
  if (shape == ShapeFunction::ugimp)
    for (const DomainSetting<Real, 2>& d : domains)
      half = std::max({half, double(d.axis[0].half), double(d.axis[1].half)});
  return 1 + half;
}

inline namespace RIVEN_SIDE {

/// The same as a kernel sees it, and where the sums of a node go; null where not asked for.
template <class Real>
struct NodeSums {
  ShapeFunction shape;
  Lattice lattice;
  Positions<Real> at;
  const double *X, *Y;
  const Real* mass;
  const double* J;
  const double* F[4];
  const std::uint8_t* body;
  const double* specific_area;
  const int* cell_start;        ///< Tiles::cell_start
  const std::uint32_t* fields;  ///< CrackFields::fields
  double reach;            ///< cells between a node and the place where a particle that it sees was sorted, at most
  double *place, *volume;  ///< ContactSums
  std::uint8_t* known;     ///< ContactSums

  /// Area of a particle over its first area.
  RIVEN_INLINE double area_ratio(long i) const { return J ? J[i] : F[0][i] * F[3][i] - F[1][i] * F[2][i]; }

  /// f(first, last) for the stretches of particles that were sorted into the cells around node (I, K).
  template <class Shape, class Visit>
  RIVEN_INLINE void each_stretch_around(int I, int K, const Visit& f) const {
    const int left = Shape::cell(I - reach), right = Shape::cell(I + reach);
    for (int j = Shape::cell(K - reach); j <= Shape::cell(K + reach); ++j)
      each_stretch_of_row(lattice, cell_start, j, left, right, f);
  }

  /// Asks for the particles around node (I, K), all at once: no pass before has left them near at hand.
  template <class Shape>
  RIVEN_INLINE void prefetch_around(int I, int K) const {
    each_stretch_around<Shape>(I, K, [&](int first, int last) RIVEN_LANE {
      for (int p = first; p < last; p += static_cast<int>(64 / sizeof(Real))) {
        exec::prefetch(at.x + p);
        exec::prefetch(at.y + p);
        exec::prefetch(mass + p);
        exec::prefetch(fields + p);
        if (place) {
          exec::prefetch(X + p);
          exec::prefetch(Y + p);
        }
      }
    });
  }

  /// f(particle, field, S) for all particles that node n has a weight S on.
  template <class Shape, class F>
  RIVEN_INLINE void each_particle_of(const NodeCracks& n, const F& f) const {
    const int I = n.node % lattice.nx, K = n.node / lattice.nx;
    prefetch_around<Shape>(I, K);
    Block<Real, Shape> w;
    each_stretch_around<Shape>(I, K, [&](int first, int last) RIVEN_LANE {
      for (; first < last; first += exec::lanes) {
        w.template weigh<false>(at, first);
        for (int k = 0; k < exec::lanes && k < last - first; ++k) {
          const int p = first + k, a = I - w.ix[k], b = K - w.iy[k];
          if (static_cast<unsigned>(a) >= Shape::width || static_cast<unsigned>(b) >= Shape::width)
            continue;
          f(p, CrackFields::field_of(fields[p], b * Shape::width + a), double(w.sx[a][k]) * double(w.sy[b][k]));
        }
      }
    });
  }

  template <class Shape>
  RIVEN_FN RIVEN_ONCE void sum_as(const NodeCracks& n) const {
    const Vec2 node = lattice.position(n.node);
    Quad<double> places[1 << most_held]{};
    double areas[1 << most_held]{};
    each_particle_of<Shape>(n, [&](int p, int field, double S) RIVEN_LANE {
      if (place)
        places[field] += (mass[p] * S) * Quad<double>{at.x[p] - node.x, at.y[p] - node.y, X[p] - node.x, Y[p] - node.y};
      if (volume)
        areas[field] += mass[p] * specific_area[body[p]] * area_ratio(p) * S;
    });
    for (int f = 0; f < n.fields(); ++f) {
      const long slot = f == 0 ? n.node : long{lattice.nodes()} + n.extra + f - 1;
      if (place)
        quad_at<double>(place + 4 * slot) = places[f];
      if (volume)
        volume[slot] = areas[f];
    }
  }

  /// Sees to it that the sums of node CrackFields::nodes[f], which is n, are known.
  RIVEN_INLINE void ask(long f, const NodeCracks& n) const {
    if (!known || known[f])
      return;
    known[f] = 1;
    switch (shape) {
      case ShapeFunction::linear: return sum_as<Linear>(n);
      case ShapeFunction::ugimp: return sum_as<UGimp>(n);
      case ShapeFunction::bspline: return sum_as<BSpline>(n);
    }
  }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
