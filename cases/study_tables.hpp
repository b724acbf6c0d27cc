// A study as it is told in the terminal.
#pragma once
#include "io/study/run_members.hpp"
#include "io/study/write_study.hpp"

namespace riven {

/// The runs that the study takes: what is set in each on top of Study::set, and about how large each is.
void print_runs(const study::Study&, const study::Members&);

/// One line for a run that has ended: which, how it went, how long it took, and what is left.
void print_advance(const study::Advance& advance);

/// Orders and costs of the methods, the cheapest settings for each error, and what effects cost.
void print_study(const study::Study&, const study::Members&, const std::vector<study::Record>&,
                 const study::Assessment&);

}  // namespace riven
