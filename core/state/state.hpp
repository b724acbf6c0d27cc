// Everything that changes while a scene runs, and the tables that kernels look things up in.
#pragma once
#include <limits>
#include <vector>

#include "core/exec/array.hpp"
#include "core/laws/elastic.hpp"
#include "core/plan/plan.hpp"
#include "core/state/bodies.hpp"
#include "core/state/constraints.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"
#include "core/state/ledger.hpp"
#include "core/state/loads.hpp"
#include "core/state/monitors.hpp"
#include "core/state/particles.hpp"
#include "core/state/tips.hpp"

namespace riven {

/// Laws by body; one of the tables is filled, as the plan says.
template <class Real>
struct LawTables {
  exec::Array<LinearElastic<Real>> linear;
  exec::Array<LinearElasticF<Real>> linear_F;
  exec::Array<NeoHookean<Real>> neo;
  exec::Array<AnyElastic<Real>> any;
};

/// Least and largest det F and largest principal stretch when stock was taken last, and the chunks of particles
/// (exec::chunk) that hold them. Where F is not kept, det F stands for the stretch.
struct Deformation {
  double least_J = 1, largest_J = 1, stretch = 1;
  long least_J_chunk = 0, largest_J_chunk = 0, stretch_chunk = 0;
};

/// What the particle kernels saw in the last step, per tile and in all.
struct StepWatch {
  exec::Array<double> tile_move;    ///< [tiles] largest |dx| of a particle along an axis, m
  exec::Array<double> tile_J;       ///< [tiles] least det F
  exec::Array<double> tile_finite;  ///< [tiles] sum of |dx|: not finite if any particle's is not
  exec::Array<double> tile_worn;    ///< [tiles] J, taken by the transfer; of transfers that take some
  exec::Array<double> tile_apart;   ///< [tiles] largest difference of a particle's velocity and the grid's, m/s
  double largest_move = 0;          ///< m, this step
  double step_work = 0;             ///< J, external work of this step
  double least_J = 1;
  Deformation deformation;
  double velocity_difference = 0;  ///< m/s, along an axis, in the last step in which it was looked at
  double drift = 0;                ///< sum of largest_move since the particles were sorted, m
  long sorted_at = 0;              ///< Clock::step at which they were
};

struct Clock {
  long step = 0;
  double time = 0;           ///< s
  double dt = 0;             ///< s
  const char* limiter = "";  ///< what limits dt
  double stable_dt = 0;      ///< of the last measurement of speeds, before the run's end shortens it
  const char* stable_limiter = "";
  double measured_speed = 0;  ///< m/s, of the fastest particle when speeds were measured
  double dt_factor = 1;       ///< by which retries have multiplied dt

  double middle() const { return time + 0.5 * dt; }  ///< s, of the step
};

template <class Real, int Dim>
struct State {
  Particles<Real, Dim> particles;
  Grid<Real> grid;
  Cracks cracks;
  CrackFields fields;
  std::vector<Tip> tips;                   ///< where the plan asks for J
  std::vector<std::vector<Tip>> readings;  ///< [Scene::readings] the same tips with J and K by these rules
  std::vector<CrackEvent> events;          ///< so far, in order of time
  LawTables<Real> laws;
  exec::Array<DomainSetting<Real, Dim>> domains;  ///< [bodies]
  exec::Array<double> specific_area;              ///< [bodies] first area of particles, m^2 per kg
  exec::Array<double> thickness;                  ///< [bodies] first thickness, m
  Constraints constraints;
  Loads loads;
  StepWatch watch;
  Monitors monitors;
  Clock clock;
  Ledger ledger;
  double particle_mass = 0;  ///< the largest, kg
};

}  // namespace riven
