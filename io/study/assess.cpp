#include "io/study/assess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/median.hpp"

namespace riven::study {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The larger error; that of a run that failed is larger than any.
double worse(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? none : std::max(a, b);
}

NumericTable history_of(const Store& store, const Run& run) {
  return read_numeric_table((store.results(run) / "history.csv").string(), "the history of a run");
}

/// Of a result, for the problem of a member; for what leaves an effect out, the first.
const Target& target_of(const Study& study, const Result& r, const Member& m) {
  return r.targets[study.problem() && !m.choice.empty() ? m.choice[*study.problem()] : 0];
}

class Assessor {
 public:
  Assessor(const Study& study, const Members& members, const std::vector<Record>& records, const Store& store)
      : study_(study), members_(members), records_(records), histories_(members.runs.size()) {
    for (size_t r = 0; r < members.runs.size(); ++r)
      if (records[r].done())
        histories_[r] = history_of(store, members.runs[r]);
  }

  Assessment assess() {
    for (const Member& m : members_.members)
      out_.labels.push_back(label_of(study_, m));
    out_.settings = settings_of(study_, members_);
    out_.methods = methods_of(study_, members_, out_.settings, records_);
    for (const Result& r : study_.results)
      out_.results.push_back(report(r));
    return std::move(out_);
  }

 private:
  double size_of(size_t setting) const {
    return choice_of(study_, members_, out_.settings[setting], *study_.refined()).size;
  }

  ResultReport report(const Result& r) const {
    ResultReport out;
    for (const Member& m : members_.members) {
      out.taken.push_back(records_[m.run].done()
                              ? take_result(r, target_of(study_, r, m), column_of(m, r.column), histories_[m.run])
                              : Taken{none, none, ""});
      if (study_.problem() && m.choice.empty())  // the scene as it is need be none of the problems
        out.taken.back().error = none;
    }
    out.limits.resize(study_.problems());
    std::vector<std::string> references;
    for (size_t p = 0; p < study_.problems(); ++p)
      references.push_back(settle_reference(r, p, out));
    out.reference = in_words(references);
    for (const Setting& s : out_.settings)
      out.points.push_back(point_of(s, out));
    for (const Method& m : out_.methods)
      out.fits.push_back(fit(m, out));
    settle_errors(out);
    out.front = pareto_front(out.settled);
    return out;
  }

  /// One for all problems where they have the same.
  std::string in_words(const std::vector<std::string>& references) const {
    if (std::count(references.begin(), references.end(), references[0]) == static_cast<long>(references.size()))
      return references[0];
    const Axis& axis = study_.axes[*study_.problem()];
    std::string list;
    for (size_t p = 0; p < references.size(); ++p)
      list += fmt::format("{}{} {}: {}", p ? "; " : "", axis.name, axis.choices[p].label, references[p]);
    return list;
  }

  /// What the result of a problem is held against, in words; errors follow where it is found by extrapolation.
  std::string settle_reference(const Result& r, size_t problem, ResultReport& out) const {
    const Reference& reference = r.targets[problem].reference;
    switch (reference.kind) {
      case Reference::Kind::extrapolated: return settle_limit(r, problem, out);
      case Reference::Kind::curve: return reference.file;
      default: return reference.value;
    }
  }

  /// What the methods tend to, each by itself, is what all of them are held against. A method that does not tend to
  /// anything yet has its say with its finest run.
  std::string settle_limit(const Result& r, size_t problem, ResultReport& out) const {
    std::vector<double> limits;
    size_t extrapolated = 0;
    for (const Method& m : out_.methods) {
      std::vector<double> sizes, values;
      for (const size_t k : m.settings) {
        sizes.push_back(size_of(k));
        values.push_back(out.taken[out_.settings[k].members[problem]].value);
      }
      const std::optional<Limit> l = extrapolate(sizes, values);
      const auto finest = static_cast<size_t>(std::min_element(sizes.begin(), sizes.end()) - sizes.begin());
      extrapolated += l ? 1 : 0;
      if (l || std::isfinite(values[finest]))
        limits.push_back(l ? l->value : values[finest]);
    }
    const std::optional<Consensus>& limit = out.limits[problem] = agree(limits);
    if (!limit)
      return "nothing: no method got to its finest run";
    for (const Setting& s : out_.settings)
      if (Taken& t = out.taken[s.members[problem]]; std::isfinite(t.value))
        t.error = relative_error(r.targets[problem], t.value, limit->value, t.unit);
    const std::string what =
        extrapolated > 0
            ? fmt::format("the middle of {} methods of which {} could be extrapolated", limit->count, extrapolated)
            : fmt::format(
                  "the middle of the finest runs of {} methods, of which none could be "
                  "extrapolated: the finest has no error by this",
                  limit->count);
    return fmt::format("{:.6g}, {}; half of them are within {:.2g} of it", limit->value, what, limit->spread);
  }

  Point point_of(const Setting& s, const ResultReport& out) const {
    Point p{0, 0};
    for (const size_t m : s.members) {
      const Record& q = records_[members_.members[m].run];
      p.cost += q.wall.empty() ? none : median(q.wall);
      p.error = worse(p.error, out.taken[m].error);
    }
    return p;
  }

  void settle_errors(ResultReport& out) const {
    out.settled = out.points;
    if (!study_.refined())
      return;
    for (const Method& m : out_.methods)
      for (const size_t k : m.settings)
        for (const size_t finer : m.settings)
          if (size_of(finer) < size_of(k))
            out.settled[k].error = worse(out.settled[k].error, out.points[finer].error);
  }

  MethodFit fit(const Method& m, const ResultReport& out) const {
    if (!study_.refined())
      return {none, none};
    std::vector<double> sizes, errors, costs;
    for (const size_t k : m.settings)
      if (std::isfinite(out.points[k].error)) {
        sizes.push_back(size_of(k));
        errors.push_back(out.points[k].error);
        costs.push_back(out.points[k].cost);
      }
    return {log_slope(sizes, errors), -log_slope(sizes, costs)};
  }

  const Study& study_;
  const Members& members_;
  const std::vector<Record>& records_;
  std::vector<NumericTable> histories_;  ///< [runs] empty where the run is not done
  Assessment out_;
};

}  // namespace

void check_results(const Study& study, const Members& members, size_t run, const Store& store) {
  const NumericTable history = history_of(store, members.runs[run]);
  for (const Member& m : members.members)
    if (m.run == run)
      for (const Result& r : study.results)
        take_result(r, target_of(study, r, m), column_of(m, r.column), history);
}

Assessment assess(const Study& study, const Members& members, const std::vector<Record>& records, const Store& store) {
  return Assessor(study, members, records, store).assess();
}

}  // namespace riven::study
