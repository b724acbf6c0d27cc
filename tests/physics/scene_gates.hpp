// What the tests of shipped scenes share: reading one with settings on top, and printing what was measured.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/crack_opening.hpp"
#include "io/read_scene.hpp"
#include "kernels/simulation.hpp"

namespace riven::gates {

/// A shipped scene with "key=value" settings on top.
inline Scene shipped(const std::string& name, const std::vector<std::string>& settings = {}) {
  return read_scene(std::string(RIVEN_SOURCE_DIR "/cases/scenes/") + name + ".toml", settings);
}

/// Prints a gate's figure, and keeps it in the test's record.
inline void report(const std::string& gate, double measured, const std::string& limit) {
  fmt::print("gate: {}, measured {:.4g}, limit {}\n", gate, measured, limit);
  std::string key = gate;
  std::replace_if(
      key.begin(), key.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  ::testing::Test::RecordProperty(key, fmt::format("{:.6g}", measured));
}

/// Position in the particle arrays of each stable id.
inline std::vector<int> by_id(const Particles<double, 2>& p) {
  std::vector<int> at(static_cast<size_t>(p.count()));
  for (int i = 0; i < p.count(); ++i)
    at[static_cast<size_t>(p.id[i])] = i;
  return at;
}

/// Does `run` before every call of the task with this label, or after it. The label must exist.
inline void insert_task(Simulation& m, const std::string& label, bool after, std::function<void(Simulation&)> run) {
  const auto at = std::find_if(m.tasks.begin(), m.tasks.end(), [&](const Task& t) { return t.label == label; });
  ASSERT_NE(at, m.tasks.end()) << label;
  m.tasks.insert(after ? at + 1 : at, Task{"test", "", std::move(run)});
}

/// Largest overlap of the faces of any crack, m.
inline double overlap(const Cracks& cracks) {
  double most = 0;
  for (const CrackOpening& o : crack_openings(cracks))
    most = std::max(most, -o.normal);
  return most;
}

}  // namespace riven::gates
