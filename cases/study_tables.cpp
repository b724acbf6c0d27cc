#include "cases/study_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "io/progress.hpp"

namespace riven {

using namespace study;

namespace {

/// A number in so many places, or a dash where there is none.
std::string shown(double x, const char* format = "{:.2f}") {
  return std::isfinite(x) ? fmt::format(fmt::runtime(format), x) : "-";
}

std::string percent(double x) {
  return std::isfinite(x) ? fmt::format("{:.2g} %", 100 * x) : "-";
}

size_t longest(const std::vector<std::string>& texts) {
  size_t most = 0;
  for (const std::string& t : texts)
    most = std::max(most, t.size());
  return most;
}

/// The labels of the methods below that of their column.
std::vector<std::string> method_column(const Assessment& a) {
  std::vector<std::string> labels{"method"};
  for (const Method& m : a.methods)
    labels.push_back(m.label);
  return labels;
}

void print_methods(const Study& s, const Assessment& a, const ResultReport& r) {
  if (!s.refined() || a.methods.empty())
    return;
  const std::string& size = s.axes[*s.refined()].name;
  const size_t width = longest(method_column(a));
  fmt::print("\n  {:<{}}  {:>10}  {:>10}   {}error from the coarsest to the finest {}\n", "method", width, "order",
             "cost", s.problem() ? "largest " : "", size);
  for (size_t k = 0; k < a.methods.size(); ++k) {
    fmt::print("  {:<{}}  {:>10}  {:>10}  ", a.methods[k].label, width, shown(r.fits[k].order), shown(r.fits[k].cost));
    for (const size_t m : a.methods[k].settings)
      fmt::print(" {:>8}", percent(r.points[m].error));
    fmt::print("\n");
  }
  fmt::print("  (order: error ~ {0}^order; cost: seconds ~ {0}^-cost)\n", size);
}

/// The error of each setting in each problem.
void print_problems(const Study& s, const Assessment& a, const ResultReport& r) {
  if (!s.problem())
    return;
  const Axis& axis = s.axes[*s.problem()];
  std::vector<std::string> labels{"error by " + axis.name};
  for (const Setting& setting : a.settings)
    labels.push_back(setting.label);
  const size_t width = longest(labels);
  fmt::print("\n  {:<{}}", labels.front(), width);
  for (const Choice& c : axis.choices)
    fmt::print("  {:>{}}", c.label, std::max<size_t>(8, c.label.size()));
  fmt::print("\n");
  for (const Setting& setting : a.settings) {
    fmt::print("  {:<{}}", setting.label, width);
    for (size_t p = 0; p < axis.choices.size(); ++p)
      fmt::print("  {:>{}}", percent(r.taken[setting.members[p]].error),
                 std::max<size_t>(8, axis.choices[p].label.size()));
    fmt::print("\n");
  }
}

/// Along which of the refined axis the methods run to their end, where some do not.
void print_stands(const Study& s, const Members& members, const Assessment& a) {
  if (!s.refined() || std::none_of(a.methods.begin(), a.methods.end(), [](const Method& m) { return m.failed; }))
    return;
  const size_t width = longest(method_column(a));
  fmt::print("\n{:<{}}  runs to its end up to {}\n", "method", width, s.axes[*s.refined()].name);
  for (const Method& m : a.methods)
    fmt::print("{:<{}}  {}\n", m.label, width,
               m.stands ? choice_of(s, members, a.settings[*m.stands], *s.refined()).label : "none");
}

void print_cheapest(const Assessment& a, const ResultReport& r) {
  fmt::print("\n  cheapest setting within\n");
  for (const double tolerance : tolerances) {
    const std::optional<size_t> k = cheapest(r.settled, tolerance);
    fmt::print(
        "  {:>5.0f} %  {}\n", 100 * tolerance,
        k ? fmt::format("{}: {}, error {}, {} at most when finer", a.settings[*k].label, format_time(r.points[*k].cost),
                        percent(r.points[*k].error), percent(r.settled[*k].error))
          : "none of these");
  }
}

void print_result(const Study& s, const Assessment& a, const Result& result, const ResultReport& r) {
  if (a.methods.empty())
    return;
  std::string unit;
  for (const Taken& t : r.taken)
    unit = unit.empty() ? t.unit : unit;
  fmt::print("\n{}: {} [{}], held against {}\n", result.name, result.column, unit, r.reference);
  print_problems(s, a, r);
  print_methods(s, a, r);
  print_cheapest(a, r);
}

void print_failures(const Members& members, const std::vector<Record>& records) {
  for (size_t r = 0; r < records.size(); ++r)
    if (!records[r].done())
      fmt::print("\n{}: {}\n  {}\n", members.runs[r].label, records[r].status,
                 records[r].message.substr(0, records[r].message.find('\n')));
}

/// How many of the runs that are done warned, and the first of their warnings.
void print_warnings(const Members& members, const std::vector<Record>& records) {
  const auto warned = [](const Record& r) { return r.done() && r.message.find("warning: ") != std::string::npos; };
  const auto first = std::find_if(records.begin(), records.end(), warned);
  if (first == records.end())
    return;
  const std::string warning = first->message.substr(first->message.find("warning: "));
  fmt::print("\n{} of {} runs warned, as that with {}:\n  {}\n  (all in runs/*/messages.txt)\n",
             std::count_if(records.begin(), records.end(), warned), records.size(),
             members.runs[static_cast<size_t>(first - records.begin())].label, warning.substr(0, warning.find('\n')));
}

void print_left_out(const Study& s, const Members& members, const std::vector<Record>& records, const Assessment& a) {
  const std::vector<LeftOutReport> all = report_left_out(s, members, records, a);
  if (all.empty())
    return;
  std::vector<std::string> names{"without"};
  for (const LeftOutReport& l : all)
    names.push_back(l.name);
  const size_t width = longest(names);
  fmt::print("\n{:<{}}  {:>12}", "without", width, "saves");
  for (const Result& r : s.results)
    fmt::print("  {:>16}", r.name);
  fmt::print("\n");
  for (const LeftOutReport& l : all) {
    fmt::print("{:<{}}  {:>12}", l.name, width, percent(l.cost));
    for (const double change : l.changes)
      fmt::print("  {:>16}", std::isfinite(change) ? fmt::format("{:+.2g} %", 100 * change) : "-");
    fmt::print("\n");
  }
  const Member& whole = *std::find_if(members.members.begin(), members.members.end(),
                                      [](const Member& m) { return m.left_out == "nothing"; });
  fmt::print("\nshare of the steps, by the effect that asks for it\n");
  for (const auto& [effect, share] : records[whole.run].shares)
    fmt::print("  {:<24} {:>6.1f} %\n", effect.empty() ? "the plain step" : effect, 100 * share);
}

}  // namespace

void print_advance(const Advance& a) {
  fmt::print(stderr, "{} of {}  {}: {} after {}; {} left\n", a.done, a.all, a.run->label, a.record->status,
             format_duration(a.record->wall.back()), format_duration(a.seconds_left));
}

void print_runs(const Study& s, const Members& members) {
  std::vector<std::string> labels{"run"};
  for (const Run& r : members.runs)
    labels.push_back(r.label);
  const size_t width = longest(labels);
  fmt::print("{}: {} runs of {}\n", s.title, members.runs.size(), s.scene);
  if (!s.set.empty())
    fmt::print("all with {}\n", fmt::join(s.set, ", "));
  fmt::print("\n{:<{}}  {:>10}  {:>10}  set\n", "run", width, "particles", "steps");
  for (const Run& r : members.runs) {
    const std::vector<std::string> own(r.set.begin() + static_cast<ptrdiff_t>(s.set.size()), r.set.end());
    if (r.refused.empty())
      fmt::print("{:<{}}  {:>10.0f}  {:>10.0f}  {}\n", r.label, width, r.particles, r.work / r.particles,
                 fmt::join(own, ", "));
    else
      fmt::print("{:<{}}  {:>10}  {:>10}  {}\n", r.label, width, "refused", "-", fmt::join(own, ", "));
  }
  fmt::print("(particles and steps: about; steps as from the speed of waves)\n");
}

void print_study(const Study& s, const Members& members, const std::vector<Record>& records, const Assessment& a) {
  fmt::print("{}\n", s.title);
  for (size_t r = 0; r < s.results.size(); ++r)
    print_result(s, a, s.results[r], a.results[r]);
  print_left_out(s, members, records, a);
  print_stands(s, members, a);
  print_failures(members, records);
  print_warnings(members, records);
}

}  // namespace riven
