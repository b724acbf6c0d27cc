// A scene of the performance suite in motion, in whatever precision it asks for.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/exec/space.hpp"
#include "perf/scenes.hpp"

namespace riven::perf {

/// What a task has taken so far.
struct TaskRecord {
  std::string label, effect;
  double seconds = 0;
};

/// How a run stands.
struct Standing {
  long particle_bytes = 0, other_bytes = 0;  ///< of the arrays
  double momentum_error = 0;                 ///< see Momentum::error
  double energy_error = 0;                   ///< see Energy::relative_error
};

class Runner {
 public:
  explicit Runner(Entrant entrant) : entrant_(std::move(entrant)) {}
  virtual ~Runner() = default;
  Runner(const Runner&) = delete;  // the simulation refers to the scene
  Runner& operator=(const Runner&) = delete;

  virtual void run(int steps) = 0;

  /// Does one task of a step: calls `work` once, and measures it as it likes. `index`: in tasks().
  using Measure = std::function<void(size_t index, const std::function<void()>& work)>;
  /// Lets `measure` do the tasks of all further steps.
  virtual void measure_tasks(const Measure& measure) = 0;

  /// Lets the task of that label end with a pass over all particles that nobody needs. False if there is no such task.
  virtual bool slow_down(const std::string& label) = 0;

  virtual long particles() const = 0;
  virtual int threads() const = 0;
  virtual std::vector<TaskRecord> tasks() const = 0;
  /// What has been launched, by its own label, in order of first use; what tasks do around it is not in it.
  virtual std::vector<TaskRecord> kernels() const = 0;
  virtual long contacts() const = 0;  ///< pairs of fields that touched after the update, so far
  virtual long crack_points() const = 0;
  virtual Standing standing() = 0;
  const Entrant& entrant() const { return entrant_; }

 protected:
  const Entrant entrant_;
};

/// Makes the state, with the entrant's first velocities. Throws Error.
std::unique_ptr<Runner> make_runner(const Entrant& entrant, exec::Kind kind, int threads);

}  // namespace riven::perf
