// summary.json: how a run went and what came out of it, for people and for programs.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/math/vec.hpp"
#include "core/state/cracks.hpp"
#include "io/retry.hpp"
#include "kernels/fragments.hpp"

namespace riven {

/// Everything in SI. Numbers that are not finite become null.
struct Summary {
  struct Task {
    std::string label;
    std::string effect;  ///< that the task belongs to; empty for the plain step
    long calls = 0;
    double seconds = 0;
  };
  struct Energy {
    double kinetic = 0, strain = 0, cohesive = 0, external_work = 0, damping = 0, contact = 0;  ///< J
    double fracture = 0, debonding = 0;                                                         ///< J
    double capture = 0;         ///< J, lost as bodies were caught by prescribed motion
    double numerical = 0;       ///< J, gained (+) or lost (-) by the scheme
    double transfer = 0;        ///< J, the part of that loss that PIC, XPIC and FMPM take
    double anchoring = 0;       ///< J, the part of it that holding strains to where particles are takes
    double largest = 0;         ///< J, largest energy or work of the run
    double relative_error = 0;  ///< numerical + transfer + anchoring, what is left unexplained, over the largest
  };
  struct Warning {
    std::string kind;
    long count = 0;
    Vec2 first_place;  ///< m; NaN where none is known
    std::string advice;
  };
  struct Watched {
    std::string figure;
    double worst = 0;
    std::string unit;
    Vec2 place;  ///< m
  };
  struct Tip {
    std::string crack;
    std::string end;    ///< "first" or "last"
    std::string state;  ///< "resting", "running" or "closed"
    double x = 0, y = 0;
    double length = 0;  ///< m, by which it has grown
    double J = 0, J1 = 0, J2 = 0;
    double K_I = 0, K_II = 0;  ///< J shared out by the interaction integral where it holds, else by the opening
    double O_I = 0, O_II = 0;  ///< J shared out by the opening of the crack
    double M_I = 0, M_II = 0;  ///< by the interaction integral
    double speed = 0;
    double load = 0;       ///< how near it is to growth (growth_load); 0 where it does not grow
    std::string contour;   ///< "4 x 4 cells"; empty before the first evaluation
    bool adapted = false;  ///< the contour leaves out the tip of another crack, or a bend with pressed faces
  };
  struct Value {
    std::string name;
    double value = 0;
    std::string unit;
  };
  struct Crack {
    std::string name;
    double max_opening = 0;  ///< m, normal
    double length = 0;       ///< m, along the plane
    double grown = 0;        ///< m, of that length
  };
  struct Reaction {
    std::string grip;
    Vec2 force;  ///< N, on the body, averaged since the row of the history before
  };

  std::string scene, title;
  std::string status;   ///< "done", "unstable", "interrupted" or "failed"
  std::string message;  ///< why it stopped early; empty when it is done
  long steps = 0;
  double time = 0;  ///< s
  double wall_seconds = 0;
  long particles = 0;
  double particle_steps_per_second = 0;
  long peak_memory_bytes = 0;  ///< set-up and output included
  int threads = 1;
  std::string exec, scatter, precision;
  std::vector<std::string> effects;
  std::vector<Task> tasks;
  std::vector<Task> between_steps;  ///< monitors and output, since the run began or was taken up again
  Energy energy;
  double momentum_error = 0, angular_momentum_error = 0;
  std::vector<Warning> warnings;
  std::vector<Watched> watched;
  std::vector<Retry> retries;
  std::vector<Tip> tips;
  std::vector<Value> probes;
  std::vector<Crack> cracks;
  std::vector<Fragment> fragments;  ///< where cracks grow and the run is done: of all solids, the heaviest first
  std::vector<Reaction> reactions;
};

/// Opening, length and growth of every crack as it is now.
std::vector<Summary::Crack> summarize_cracks(const Cracks& cracks, const std::vector<Tip>& tips);

/// The file appears whole or not at all. Throws Error (file).
void write_summary(const std::filesystem::path& path, const Summary& summary);

}  // namespace riven
