// What the runs of a study say: errors, costs, orders, and the cheapest settings.
#pragma once
#include "io/study/fits.hpp"
#include "io/study/settings.hpp"
#include "io/study/take_result.hpp"

namespace riven::study {

/// A method, as one result shows it.
struct MethodFit {
  double order = 0;  ///< error ~ size^order
  double cost = 0;   ///< seconds ~ size^-cost
};

/// One result over all members. Where there are several problems, the error of a setting is the largest of them, and
/// its cost that of all of them: it has to do for each.
struct ResultReport {
  std::vector<Taken> taken;     ///< [members]
  std::vector<Point> points;    ///< [settings] with the medians of the wall times
  std::vector<Point> settled;   ///< [settings] the same with the largest error of this and all finer settings of a
                                ///< method: coarse runs that are right by chance are not taken for good ones
  std::vector<MethodFit> fits;  ///< [methods]
  std::vector<size_t> front;    ///< settings on the Pareto front of `settled`, ascending cost
  std::string reference;        ///< in words
  std::vector<std::optional<Consensus>> limits;  ///< [problems] of extrapolated references
};

struct Assessment {
  std::vector<std::string> labels;  ///< [members] all choices
  std::vector<Setting> settings;
  std::vector<Method> methods;
  std::vector<ResultReport> results;  ///< [results]
};

/// Throws Error (bad_input) where a result cannot be taken from a run that is done: so that a mistake in a study shows
/// after its first run, not after the last.
void check_results(const Study& study, const Members& members, size_t run, const Store& store);

/// Throws Error (bad_input) where a result cannot be taken from runs that are done.
Assessment assess(const Study& study, const Members& members, const std::vector<Record>& records, const Store& store);

}  // namespace riven::study
