// How a pass over particles has the stresses of a block updated: by the law of the plan. On the host through a pointer,
// followed once for each block of particles, so that a pass is compiled once for all laws. On a device, whose blocks
// are single particles, in line.
//
//   with_stress_rule<Averaged>(plan.law, s, f)   f(rule)
//       rule(first, count, gradient, dt, seen) updates particles first .. first + count - 1 (stress_update.hpp)
#pragma once
#include "kernels/dispatch.hpp"
#include "kernels/stress_update.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace detail {

template <class Law, bool Averaged, class Real>
struct StressByLaw {
  ParticleView<Real> particles;
  BodyLookup<Law> laws;

  RIVEN_INLINE void operator()(long first, int count, const GradientLanes<Real>& g, Real dt,
                               TileWatch<Real>& seen) const {
    update_stress_lanes<Averaged>(particles, first, count, g, dt, laws, seen);
  }
};

/// The same without its type; `rule` must outlive it.
template <class Real>
class StressByPointer {
 public:
  template <class Rule>
  explicit StressByPointer(const Rule& rule) : rule_(&rule), update_(update<Rule>) {}

  RIVEN_INLINE void operator()(long first, int count, const GradientLanes<Real>& g, Real dt,
                               TileWatch<Real>& seen) const {
    update_(rule_, first, count, g, dt, seen);
  }

 private:
  template <class Rule>
  static void update(const void* rule, long first, int count, const GradientLanes<Real>& g, Real dt,
                     TileWatch<Real>& seen) {
    const Rule own = *static_cast<const Rule*>(rule);  // what it writes cannot change where it writes
    own(first, count, g, dt, seen);
  }

  const void* rule_;
  void (*update_)(const void*, long, int, const GradientLanes<Real>&, Real, TileWatch<Real>&);
};

}  // namespace detail

template <bool Averaged, class Real, class F>
void with_stress_rule(LawChoice choice, State<Real, 2>& s, F&& f) {
  with_law<Real>(choice, [&](auto law) {
    using Law = typename decltype(law)::type;
    const detail::StressByLaw<Law, Averaged, Real> rule{view(s.particles), laws<Law>(s)};
#if defined(RIVEN_ON_DEVICE)
    f(rule);
#else
    f(detail::StressByPointer<Real>(rule));
#endif
  });
}

}  // namespace RIVEN_SIDE

}  // namespace riven
