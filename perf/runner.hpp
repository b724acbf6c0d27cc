// A scene of the performance suite in motion.
#pragma once
#include <functional>
#include <string>

#include "core/exec/space.hpp"
#include "kernels/simulation.hpp"
#include "perf/scenes.hpp"

namespace riven::perf {

class Runner {
 public:
  /// Makes the state, with the entrant's first velocities. Throws Error.
  Runner(const Entrant& entrant, exec::Kind kind, int threads);
  Runner(const Runner&) = delete;  // the simulation refers to the scene
  Runner& operator=(const Runner&) = delete;

  void run(int steps);

  /// Does one task of a step: calls `work` once, and measures it as it likes.
  using Measure = std::function<void(const Task& task, size_t index, const std::function<void()>& work)>;
  /// Lets `measure` do the tasks of all further steps.
  void measure_tasks(const Measure& measure);

  /// Lets the task of that label end with a pass over all particles that nobody needs. False if there is no such task.
  bool slow_down(const std::string& label);

  const Entrant& entrant() const { return entrant_; }
  const exec::Space& space() const { return space_; }
  Simulation& simulation() { return m_; }
  long particles() const { return m_.state.particles.count(); }

 private:
  Entrant entrant_;
  exec::Space space_;
  Simulation m_;
};

}  // namespace riven::perf
