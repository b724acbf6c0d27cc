// Lines through errors and costs, limits that runs tend to, and which choices are worth their cost.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace riven::study {

/// Slope of the line of least squares through log y against log x: the order of convergence where x is the cell and y
/// the error. NaN with fewer than two different x, or where a y is not positive and finite.
double log_slope(const std::vector<double>& x, const std::vector<double>& y);

/// What values tend to as the size goes to zero.
struct Limit {
  double value = 0;
  double order = 0;
};

/// The order p of values at three sizes of which the largest and the smallest are `coarse` and `fine` times that in the
/// middle: ratio = (coarse^p - 1) / (1 - fine^p), of the differences between neighbours. Nothing where no order between
/// 0.3 and 6 has that ratio.
std::optional<double> order_of(double coarse, double fine, double ratio);

/// Richardson extrapolation (P.J. Roache, "Verification and Validation in Computational Science and Engineering", 1998,
/// section 5.10) of the three values that belong to the smallest sizes: value = limit + c size^order, whatever the
/// ratios of the sizes. Nothing where the values do not tend to anything like that with an order between 0.3 and 6.
std::optional<Limit> extrapolate(const std::vector<double>& sizes, const std::vector<double>& values);

/// The middle of what several methods tend to, and how far they are apart.
struct Consensus {
  double value = 0;
  double spread = 0;  ///< largest distance of the middle half of them from the value
  size_t count = 0;
};
std::optional<Consensus> agree(std::vector<double> limits);

/// A choice as the picture shows it.
struct Point {
  double cost = 0;   ///< s
  double error = 0;  ///< NaN: the run failed
};

/// Which points no other beats in both: ascending cost, descending error.
std::vector<size_t> pareto_front(const std::vector<Point>& points);

/// The point of least cost whose error is at most `tolerance`.
std::optional<size_t> cheapest(const std::vector<Point>& points, double tolerance);

}  // namespace riven::study
