// What the runs of a study say: errors, costs, orders, and the cheapest settings.
#pragma once
#include "io/study/fits.hpp"
#include "io/study/store.hpp"
#include "io/study/take_result.hpp"

namespace riven::study {

/// All members that differ only along the refined axis; all members where there is none.
struct Method {
  std::string label;            ///< choices of the other axes
  std::vector<size_t> members;  ///< in the order of the refined axis
  bool failed = false;          ///< some of them
  /// The largest of the refined axis that is done as all smaller ones are; none: not even the smallest.
  std::optional<size_t> stands;
};

/// A method, as one result shows it.
struct MethodFit {
  double order = 0;  ///< error ~ size^order
  double cost = 0;   ///< seconds ~ size^-cost
};

/// One result over all members.
struct ResultReport {
  std::vector<Taken> taken;    ///< [members]
  std::vector<Point> points;   ///< [members] with the median of the wall times
  std::vector<Point> settled;  ///< [members] the same with the largest error of this and all finer members of a method:
                               ///< coarse runs that are right by chance are not taken for good ones
  std::vector<MethodFit> fits;  ///< [methods]
  std::vector<size_t> front;    ///< members on the Pareto front of `settled`, ascending cost
  std::string reference;        ///< in words
  /// Extrapolated references only.
  std::optional<Consensus> limit;
};

struct Assessment {
  std::vector<std::string> labels;  ///< [members] all choices
  std::vector<Method> methods;
  std::vector<ResultReport> results;  ///< [results]
};

/// Throws Error (bad_input) where a result cannot be taken from a run that is done: so that a mistake in a study shows
/// after its first run, not after the last.
void check_results(const Study& study, const Members& members, size_t run, const Store& store);

/// Throws Error (bad_input) where a result cannot be taken from runs that are done.
Assessment assess(const Study& study, const Members& members, const std::vector<Record>& records, const Store& store);

/// What a member sets beside what all members of the study do.
std::vector<std::string> settings_of(const Study& study, const Members& members, size_t member);

}  // namespace riven::study
