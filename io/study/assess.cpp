#include "io/study/assess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/median.hpp"

namespace riven::study {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// "cell 1 mm, transfer FLIP", with or without the refined axis.
std::string label_of(const Study& study, const Member& m, bool with_refined) {
  if (m.choice.empty())
    return m.left_out == "nothing" ? "as it is" : "without " + m.left_out;
  std::string label;
  for (size_t a = 0; a < study.axes.size(); ++a)
    if (with_refined || !study.axes[a].refined)
      label += (label.empty() ? "" : ", ") + study.axes[a].name + " " + study.axes[a].choices[m.choice[a]].label;
  return label;
}

std::vector<Method> methods_of(const Study& study, const Members& all) {
  std::vector<Method> methods;
  for (size_t k = 0; k < all.members.size(); ++k) {
    if (all.members[k].choice.empty())
      continue;
    const std::string label = label_of(study, all.members[k], false);
    auto known = std::find_if(methods.begin(), methods.end(), [&](const Method& m) { return m.label == label; });
    if (known == methods.end()) {
      known = methods.emplace(methods.end());
      known->label = label;
    }
    known->members.push_back(k);
  }
  return methods;
}

/// The larger error; that of a run that failed is larger than any.
double worse(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? none : std::max(a, b);
}

NumericTable history_of(const Store& store, const Run& run) {
  return read_numeric_table((store.results(run) / "history.csv").string(), "the history of a run");
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
    Assessment out;
    for (const Member& m : members_.members)
      out.labels.push_back(label_of(study_, m, true));
    out.methods = methods_of(study_, members_);
    for (Method& m : out.methods)
      find_stand(m);
    for (const Result& r : study_.results)
      out.results.push_back(report(r, out.methods));
    return out;
  }

 private:
  double size_of(size_t member) const {
    const size_t a = *study_.refined();
    return study_.axes[a].choices[members_.members[member].choice[a]].size;
  }

  void find_stand(Method& m) const {
    const auto done = [&](size_t k) { return records_[members_.members[k].run].done(); };
    m.failed = !std::all_of(m.members.begin(), m.members.end(), done);
    if (!study_.refined())
      return;
    for (const size_t k : m.members) {
      const bool stands =
          std::all_of(m.members.begin(), m.members.end(), [&](size_t o) { return size_of(o) > size_of(k) || done(o); });
      if (stands && (!m.stands || size_of(*m.stands) < size_of(k)))
        m.stands = k;
    }
  }

  ResultReport report(const Result& r, const std::vector<Method>& methods) const {
    ResultReport out;
    for (const Member& m : members_.members)
      out.taken.push_back(records_[m.run].done() ? take_result(r, column_of(m, r.column), histories_[m.run])
                                                 : Taken{none, none, ""});
    if (r.reference.kind == Reference::Kind::extrapolated)
      settle_limit(r, methods, out);
    else
      out.reference = r.reference.kind == Reference::Kind::curve ? r.reference.file : r.reference.value;
    for (size_t k = 0; k < members_.members.size(); ++k) {
      const Record& q = records_[members_.members[k].run];
      const bool shown = q.done() && !members_.members[k].choice.empty();
      out.points.push_back({q.wall.empty() ? none : median(q.wall), shown ? out.taken[k].error : none});
    }
    for (const Method& m : methods)
      out.fits.push_back(fit(m, out));
    settle_errors(methods, out);
    out.front = pareto_front(out.settled);
    return out;
  }

  /// What the methods tend to, each by itself, is what all of them are held against. A method that does not tend to
  /// anything yet has its say with its finest run.
  void settle_limit(const Result& r, const std::vector<Method>& methods, ResultReport& out) const {
    std::vector<double> limits;
    size_t extrapolated = 0;
    for (const Method& m : methods) {
      std::vector<double> sizes, values;
      for (const size_t k : m.members) {
        sizes.push_back(size_of(k));
        values.push_back(out.taken[k].value);
      }
      const std::optional<Limit> l = extrapolate(sizes, values);
      const auto finest = static_cast<size_t>(std::min_element(sizes.begin(), sizes.end()) - sizes.begin());
      extrapolated += l ? 1 : 0;
      if (l || std::isfinite(values[finest]))
        limits.push_back(l ? l->value : values[finest]);
    }
    out.limit = agree(limits);
    if (!out.limit) {
      out.reference = "nothing: no method got to its finest run";
      return;
    }
    for (size_t k = 0; k < out.taken.size(); ++k)
      if (std::isfinite(out.taken[k].value) && !members_.members[k].choice.empty())
        out.taken[k].error = relative_error(r, out.taken[k].value, out.limit->value, out.taken[k].unit);
    out.reference = fmt::format(
        "{:.6g}, the middle of {} methods of which {} could be extrapolated; half of them are within {:.2g} of it",
        out.limit->value, out.limit->count, extrapolated, out.limit->spread);
  }

  void settle_errors(const std::vector<Method>& methods, ResultReport& out) const {
    out.settled = out.points;
    if (!study_.refined())
      return;
    for (const Method& m : methods)
      for (const size_t k : m.members)
        for (const size_t finer : m.members)
          if (size_of(finer) < size_of(k))
            out.settled[k].error = worse(out.settled[k].error, out.points[finer].error);
  }

  MethodFit fit(const Method& m, const ResultReport& out) const {
    if (!study_.refined())
      return {none, none};
    std::vector<double> sizes, errors, costs;
    for (const size_t k : m.members)
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
};

}  // namespace

void check_results(const Study& study, const Members& members, size_t run, const Store& store) {
  const NumericTable history = history_of(store, members.runs[run]);
  for (const Member& m : members.members)
    if (m.run == run)
      for (const Result& r : study.results)
        take_result(r, column_of(m, r.column), history);
}

Assessment assess(const Study& study, const Members& members, const std::vector<Record>& records, const Store& store) {
  return Assessor(study, members, records, store).assess();
}

std::vector<std::string> settings_of(const Study& study, const Members& members, size_t member) {
  std::vector<std::string> set;
  const Member& m = members.members[member];
  for (size_t a = 0; a < m.choice.size(); ++a) {
    const std::vector<std::string>& own = study.axes[a].choices[m.choice[a]].set;
    set.insert(set.end(), own.begin(), own.end());
  }
  return set;
}

}  // namespace riven::study
