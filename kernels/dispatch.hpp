// From choices made at run time to kernels compiled for them: the one place, and the one table of what exists.
//
//   Real    double, float: of a whole simulation
//   shape   linear, uGIMP, B-spline
//   law     linear elastic (with or without the deformation gradient), neo-Hookean, both
//   flags   of one kernel each
//
// Whether a block of particles meets cracks is seen block by block: tiles.hpp.
#pragma once
#include <type_traits>

#include "core/error.hpp"
#include "core/laws/elastic.hpp"
#include "core/math/shape.hpp"
#include "core/plan/plan.hpp"

namespace riven {

template <class T>
struct Type {
  using type = T;
};

template <class Real>
inline constexpr Precision precision_of = sizeof(Real) == sizeof(double) ? Precision::as_double : Precision::as_float;

template <class F>
decltype(auto) with_precision(Precision precision, F&& f) {
#if RIVEN_FLOAT
  if (precision == Precision::as_float)
    return f(Type<float>{});
#endif
  if (precision != Precision::as_double)
    fail({Exit::bad_input, "this build has no single precision (RIVEN_FLOAT)", "solver.precision", {}, {}, {}});
  return f(Type<double>{});
}

template <class F>
decltype(auto) with_shape(ShapeFunction shape, F&& f) {
  switch (shape) {
    case ShapeFunction::linear: return f(Type<Linear>{});
    case ShapeFunction::bspline: return f(Type<BSpline>{});
    case ShapeFunction::ugimp: break;
  }
  return f(Type<UGimp>{});
}

template <class Real, class F>
decltype(auto) with_law(LawChoice law, F&& f) {
  switch (law) {
    case LawChoice::neo_hookean: return f(Type<NeoHookean<Real>>{});
    case LawChoice::linear_elastic_F: return f(Type<LinearElasticF<Real>>{});
    case LawChoice::any: return f(Type<AnyElastic<Real>>{});
    case LawChoice::linear_elastic: break;
  }
  return f(Type<LinearElastic<Real>>{});
}

template <class F>
decltype(auto) with_flag(bool flag, F&& f) {
  return flag ? f(std::true_type{}) : f(std::false_type{});
}

/// The same for several flags.
template <class F>
decltype(auto) with_flags(F&& f) {
  return f();
}
template <class F, class... More>
decltype(auto) with_flags(F&& f, bool flag, More... more) {
  return with_flag(flag, [&](auto one) -> decltype(auto) {
    return with_flags([&](auto... rest) -> decltype(auto) { return f(one, rest...); }, more...);
  });
}

/// Whether particles carry gradients of velocity: never with linear functions (make_plan).
template <class Shape, class F>
decltype(auto) with_affine(bool affine, F&& f) {
  if constexpr (!std::is_same_v<Shape, Linear>)
    if (affine)
      return f(std::true_type{});
  return f(std::false_type{});
}

}  // namespace riven
