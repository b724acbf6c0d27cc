// Instructions of each task, counted by valgrind's callgrind: the same on an idle and on a busy machine.
#pragma once
#include <filesystem>
#include <string>

#include "perf/cost.hpp"

namespace riven::perf {

/// The program that is counted: riven-perf built for x86-64-v3, since valgrind 3.19 does not know AVX-512.
std::filesystem::path counted_program();

/// Runs `program` under callgrind on so many counted scenes of the gate, several at once, and reads what each task
/// took, in instructions per particle and step. `slowed` as in measure_pace(). Throws Error (file) where valgrind or
/// the program is missing.
Costs count_instructions(const std::filesystem::path& program, size_t scenes, const std::string& slowed = "");

/// What `program` does under callgrind: steps of the scene of this number, each task ending in a dump that bears its
/// name.
void step_for_callgrind(size_t number, const std::string& slowed);

}  // namespace riven::perf
