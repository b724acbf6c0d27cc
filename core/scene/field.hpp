// Quantities that vary over places: what a scene says of a body's first velocity, of loads, and of an exact solution.
#pragma once
#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/math/vec.hpp"

namespace riven {

/// A quantity over time in SI: value * shape(t). A constant has no shape.
struct TimeFunction {
  double value = 0;
  std::function<double(double)> shape;  ///< dimensionless, of t in s; empty means 1
  std::string text;                     ///< as written, for `riven plan`
  double operator()(double t) const { return shape ? value * shape(t) : value; }
};

/// out[i] = shape(X[i], Y[i], t) for n places; dimensionless. Several threads may call it at once.
using PlaceShape = std::function<void(double t, long n, const double* X, const double* Y, double* out)>;

/// Where particles start, m.
struct Places {
  std::vector<double> X, Y;
  void add(Vec2 p) {
    X.push_back(p.x);
    Y.push_back(p.y);
  }
  long count() const { return static_cast<long>(X.size()); }
};

/// A quantity over places and time in SI. A place is that where a particle starts, (X, Y) in m.
struct Field : TimeFunction {
  PlaceShape places;  ///< instead of `shape`; empty: the same everywhere

  Field() = default;
  Field(TimeFunction everywhere) : TimeFunction(std::move(everywhere)) {}
  Field(double value, PlaceShape shape) : places(std::move(shape)) { this->value = value; }

  /// The field at n places.
  void at(double t, long n, const double* X, const double* Y, double* out) const {
    if (!places) {
      std::fill(out, out + n, (*this)(t));
      return;
    }
    places(t, n, X, Y, out);
    for (long i = 0; i < n; ++i)
      out[i] *= value;
  }
  std::vector<double> at(double t, const Places& p) const {
    std::vector<double> out(p.X.size());
    at(t, p.count(), p.X.data(), p.Y.data(), out.data());
    return out;
  }
};

}  // namespace riven
