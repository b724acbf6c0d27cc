#include "io/study/advise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.hpp"
#include "core/math/median.hpp"
#include "io/format_length.hpp"
#include "io/study/fits.hpp"
#include "io/study/numeric_table.hpp"

namespace riven::study {

namespace {

constexpr double quick = 2e8;            ///< particle-steps that no rung of the ladder should exceed
constexpr double safety = 1.25;          ///< see the header
constexpr double least = 0.5, most = 2;  ///< orders that are believed; beyond, the nearer of them is taken
constexpr int samples = 200;             ///< times at which histories are compared

/// Edge of the smallest thing that cells must resolve, over the cells that it takes.
double coarsest_cell(const Scene& s) {
  double cell = std::numeric_limits<double>::infinity();
  for (const Body& b : s.bodies) {
    const Rectangle box = bounds(b.region);
    cell = std::min({cell, (box.upper.x - box.lower.x) / 8, (box.upper.y - box.lower.y) / 8});
  }
  for (const CrackLine& c : s.cracks) {
    double length = 0;
    for (size_t k = 1; k < c.points.size(); ++k)
      length += norm(c.points[k] - c.points[k - 1]);
    cell = std::min(cell, length / 4);
  }
  for (const Load& l : s.loads) {  // a particle at least
    const Rectangle box = bounds(l.region);
    cell = std::min({cell, 2 * (box.upper.x - box.lower.x), 2 * (box.upper.y - box.lower.y)});
  }
  return cell * (1 + 1e-9);
}

/// The rung whose cell is nearest to `cell`, among those between.
size_t nearest_rung(const std::vector<Rung>& rungs, size_t first, size_t end, double cell) {
  size_t best = first;
  for (size_t k = first; k < end; ++k)
    if (std::abs(std::log(rungs[k].cell / cell)) < std::abs(std::log(rungs[best].cell / cell)))
      best = k;
  return best;
}

/// One column at `samples` times, evenly up to the end.
std::vector<double> sampled(const NumericTable& t, size_t column) {
  const std::vector<double>&time = t.columns[0], &y = t.columns[column];
  std::vector<double> out;
  size_t k = 0;
  for (int n = 1; n <= samples; ++n) {
    const double at = time.back() * n / samples;
    while (k + 1 < time.size() && time[k] < at)
      ++k;
    const double part = k == 0 ? 1 : (at - time[k - 1]) / (time[k] - time[k - 1]);
    out.push_back(k == 0 ? y[0] : y[k - 1] + part * (y[k] - y[k - 1]));
  }
  return out;
}

/// The larger of the rms difference over all times and the difference of the means over the last quarter.
double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double squares = 0, late = 0;
  for (size_t k = 0; k < a.size(); ++k) {
    squares += (a[k] - b[k]) * (a[k] - b[k]);
    if (k >= 3 * a.size() / 4)
      late += a[k] - b[k];
  }
  const auto n = static_cast<double>(a.size());
  return std::max(std::sqrt(squares / n), 4 * std::abs(late) / n);
}

double largest(const std::vector<double>& y) {
  double most = 0;
  for (const double v : y)
    most = std::max(most, std::abs(v));
  return most;
}

/// Order and factor from the distances between three runs, over the scale.
ErrorLaw law_of(const std::string& column, const std::vector<Rung>& ladder, double d12, double d23) {
  ErrorLaw law{column};
  const double h1 = ladder[0].cell, h2 = ladder[1].cell, h3 = ladder[2].cell;
  law.measured = order_of(h1 / h2, h3 / h2, d12 / d23).value_or(std::numeric_limits<double>::quiet_NaN());
  law.sure = law.measured >= least && law.measured <= 1.25 * most;
  law.order = std::isnan(law.measured) ? (d12 > d23 ? most : 1) : std::clamp(law.measured, least, most);
  // where the middle run is right by chance, the distances do not shrink: the larger one then counts
  law.factor = std::max(d23 / (std::pow(h2, law.order) - std::pow(h3, law.order)),
                        law.sure ? 0 : d12 / (std::pow(h1, law.order) - std::pow(h2, law.order)));
  return law;
}

}  // namespace

double ErrorLaw::error(double cell) const {
  return factor * std::pow(cell, order);
}

std::vector<Rung> choose_ladder(const Scene& scene, const std::vector<Rung>& rungs) {
  const double coarsest = coarsest_cell(scene);
  size_t first = 0;
  while (first < rungs.size() && rungs[first].cell > coarsest)
    ++first;
  if (first + 3 > rungs.size())
    fail({Exit::bad_input, "the scene has no three cells from which to extrapolate", scene.source_path + ": grid.cell",
          format_length(scene.cell),
          "edges of rectangular bodies and grips that stay between particles, and cracks of 4 cells or more, with "
          "larger or smaller cells",
          "a cell that divides the edges of the bodies and grips"});
  size_t finest = first + 2;
  while (finest + 1 < rungs.size() && rungs[finest + 1].work < quick)
    ++finest;
  const size_t middle = nearest_rung(rungs, first + 1, finest, 2 * rungs[finest].cell);
  return {rungs[nearest_rung(rungs, first, middle, 2 * rungs[middle].cell)], rungs[middle], rungs[finest]};
}

std::vector<std::string> asked_columns(const Scene& scene, const std::vector<std::string>& columns) {
  std::vector<std::string> asked;
  for (const Probe& p : scene.probes)
    asked.push_back(p.name);
  for (const std::string& c : columns)
    for (const char* end : {" first J", " last J", " first K_I", " last K_I", " first K_II", " last K_II"})
      if (c.ends_with(end))
        asked.push_back(c);
  return asked.empty() ? std::vector<std::string>{"kinetic", "strain", "external_work"} : asked;
}

std::vector<ErrorLaw> fit_errors(const std::vector<Rung>& ladder, const std::vector<std::string>& histories,
                                 const std::vector<std::string>& columns) {
  std::vector<NumericTable> tables;
  tables.reserve(histories.size());
  for (const std::string& file : histories)
    tables.push_back(read_numeric_table(file, "the history of a run"));
  std::map<std::string, double>
      scale;  // by unit: a result that is small beside its like need not be right to a per cent
  for (const std::string& c : columns) {
    const size_t k = tables.back().find(c, "--result");
    double& s = scale[tables.back().units[k]];
    s = std::max(s, largest(sampled(tables.back(), k)));
  }
  std::vector<ErrorLaw> laws;
  for (const std::string& c : columns) {
    std::vector<std::vector<double>> runs;
    runs.reserve(tables.size());
    for (const NumericTable& t : tables)
      runs.push_back(sampled(t, t.find(c, "--result")));
    const double s = scale[tables.back().units[tables.back().find(c, "--result")]];
    const double d12 = distance(runs[0], runs[1]) / s, d23 = distance(runs[1], runs[2]) / s;
    constexpr double rounding = 1e-9;  // what symmetry makes 0 is not in the last digits
    if (std::isfinite(d12) && std::isfinite(d23) && d23 > rounding)
      laws.push_back(law_of(c, ladder, d12, d23));
  }
  return laws;
}

CostLaw fit_costs(const std::vector<Record>& records) {
  const Record &a = records[records.size() - 2], &b = records.back();
  const auto per_step = [](const Record& r) { return median(r.wall) / static_cast<double>(r.steps); };
  const auto particles = [](const Record& r) { return static_cast<double>(r.particles); };
  CostLaw c;
  const double more = particles(b) - particles(a);
  c.per_work = std::max(0.0, (per_step(b) - per_step(a)) / more);
  c.per_step = std::max(0.0, per_step(b) - c.per_work * particles(b));
  if (c.per_step == 0)
    c.per_work = per_step(b) / particles(b);
  c.per_particle = std::max(0.0, static_cast<double>(b.memory - a.memory) / more);
  c.memory = std::max(0.0, static_cast<double>(b.memory) - c.per_particle * particles(b));
  return c;
}

Advice advise(const std::vector<Rung>& rungs, const std::vector<Rung>& ladder, const std::vector<Record>& records,
              const std::vector<ErrorLaw>& laws, double tolerance) {
  Advice a;
  for (const Rung& r : rungs) {
    if (r.cell > ladder.front().cell * (1 + 1e-9))
      continue;
    a.rung = r;
    a.error = 0;
    for (const ErrorLaw& law : laws)
      if (const double e = law.error(r.cell); e >= a.error) {
        a.error = e;
        a.column = law.column;
      }
    a.reached = safety * a.error <= tolerance;
    if (a.reached)
      break;
  }
  a.sure = std::all_of(laws.begin(), laws.end(), [&](const ErrorLaw& law) {
    return law.sure || safety * law.error(a.rung.cell) < 0.5 * tolerance;
  });
  const CostLaw cost = fit_costs(records);
  const double finer = ladder.back().cell / a.rung.cell;
  const double particles = static_cast<double>(records.back().particles) * finer * finer;
  a.seconds = static_cast<double>(records.back().steps) * finer * (cost.per_step + cost.per_work * particles);
  a.memory = cost.memory + cost.per_particle * particles;
  return a;
}

}  // namespace riven::study
