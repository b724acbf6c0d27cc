#include "io/study/fits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/math/median.hpp"

namespace riven::study {

namespace {

constexpr double least_order = 0.3, greatest_order = 6;

/// (a - b) / (b - c) for values at sizes of which each is `coarse`, 1 and `fine` times that of the middle.
double ratio_of_order(double order, double coarse, double fine) {
  return (std::pow(coarse, order) - 1) / (1 - std::pow(fine, order));
}

}  // namespace

double log_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0;
  for (size_t k = 0; k < x.size(); ++k) {
    if (!(y[k] > 0 && std::isfinite(y[k])))
      return none;
    mean_x += std::log(x[k]) / n;
    mean_y += std::log(y[k]) / n;
  }
  double xx = 0, xy = 0;
  for (size_t k = 0; k < x.size(); ++k) {
    const double d = std::log(x[k]) - mean_x;
    xx += d * d;
    xy += d * (std::log(y[k]) - mean_y);
  }
  return xx > 0 ? xy / xx : none;
}

std::optional<double> order_of(double coarse, double fine, double ratio) {
  // the ratio grows with the order
  double low = least_order, high = greatest_order;
  if (!(ratio_of_order(low, coarse, fine) <= ratio && ratio <= ratio_of_order(high, coarse, fine)))
    return std::nullopt;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (ratio_of_order(middle, coarse, fine) < ratio ? low : high) = middle;
  }
  return low;
}

std::optional<Limit> extrapolate(const std::vector<double>& sizes, const std::vector<double>& values) {
  std::vector<size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return sizes[a] > sizes[b]; });
  std::erase_if(order, [&](size_t k) { return !std::isfinite(values[k]); });
  if (order.size() < 3)
    return std::nullopt;
  const size_t a = order[order.size() - 3], b = order[order.size() - 2], c = order[order.size() - 1];
  const double coarse = sizes[a] / sizes[b], fine = sizes[c] / sizes[b];
  const double ratio = (values[a] - values[b]) / (values[b] - values[c]);
  const std::optional<double> p = order_of(coarse, fine, ratio);
  if (!p)
    return std::nullopt;
  const double power = std::pow(fine, *p);
  return Limit{values[c] - (values[b] - values[c]) * power / (1 - power), *p};
}

std::optional<Consensus> agree(std::vector<double> limits) {
  if (limits.empty())
    return std::nullopt;
  Consensus all{median(limits), 0, limits.size()};
  std::sort(limits.begin(), limits.end(),
            [&](double a, double b) { return std::abs(a - all.value) < std::abs(b - all.value); });
  all.spread = std::abs(limits[(limits.size() - 1) / 2] - all.value);
  return all;
}

std::vector<size_t> pareto_front(const std::vector<Point>& points) {
  std::vector<size_t> order;
  for (size_t k = 0; k < points.size(); ++k)
    if (std::isfinite(points[k].error))
      order.push_back(k);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost : points[a].error < points[b].error;
  });
  std::vector<size_t> front;
  for (const size_t k : order)
    if (front.empty() || points[k].error < points[front.back()].error)
      front.push_back(k);
  return front;
}

std::optional<size_t> cheapest(const std::vector<Point>& points, double tolerance) {
  const std::vector<size_t> front = pareto_front(points);
  const auto good = std::find_if(front.begin(), front.end(), [&](size_t k) { return points[k].error <= tolerance; });
  return good == front.end() ? std::nullopt : std::optional(*good);
}

}  // namespace riven::study
