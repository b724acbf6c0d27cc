// A scene in motion: its plan, its state, and the time step as a list of tasks.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/exec/space.hpp"
#include "core/state/state.hpp"
#include "kernels/apply_tractions.hpp"
#include "kernels/contact.hpp"
#include "kernels/fracture_step.hpp"

namespace riven {

template <class Real>
class SimulationOf;

/// One line of the step. `effect` is what asked for it, empty for what every step needs.
template <class Real>
struct TaskOf {
  std::string label;
  std::string effect;
  std::function<void(SimulationOf<Real>&)> run;
  std::function<bool(const SimulationOf<Real>&)> due{};  ///< steps without it pass it over; empty: none does
  long calls = 0;
  double seconds = 0;
};

/// Real: what particles and nodes hold, as the scene says (with_precision in dispatch.hpp).
template <class Real>
class SimulationOf {
 public:
  using Task = TaskOf<Real>;

  /// Scene and space must outlive the simulation. Throws Error (bad input).
  SimulationOf(const Scene& scene, const exec::Space& space);
  SimulationOf(Scene&&, const exec::Space&) = delete;

  /// Back to the first state.
  void begin();
  /// One time step: the tasks, in order. Throws Error (unstable) when the step went wrong.
  void step();
  bool finished() const { return state.clock.time >= scene.end_time * (1 - 1e-12); }
  /// Brings energies and momenta in the ledger up to date, and checks them.
  void take_stock();

  const Scene& scene;
  const exec::Space& space;
  const Plan plan;
  State<Real, 2> state;
  std::vector<Task> tasks;

  // contact's work space and what it did so far
  ContactSums contact_sums;
  ContactReport contact_before, contact_after, contact_again;
  ContactWatch contact_watch;
  FieldImpulses impulses;  ///< of contact and of bridges, in the step

  FractureReport fracture;
  TipBridges bridges;
  exec::Array<PointForces> point_forces;  ///< of tractions on faces

  Vec2 gravity() const;         ///< body force per mass in the middle of the step, m/s^2
  double grid_damping() const;  ///< 1/s
  double particle_damping() const;
  /// How much of contact's impulses before the momentum update reaches the particles.
  double early_impulse() const;
};

inline namespace RIVEN_SIDE {

/// The tasks of a step, as the plan asks. Printed by `riven plan` and, with times, at the end of a run.
template <class Real>
std::vector<TaskOf<Real>> assemble_step(const Scene&, const Plan&);

}  // namespace RIVEN_SIDE

using Simulation = SimulationOf<double>;
using Task = Simulation::Task;

}  // namespace riven
