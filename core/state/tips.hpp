// Tips: the ends of cracks that lie in a solid, and what was found there last.
//
// K_I > 0 opens the crack. K_II > 0: the side to the left of the direction of growth slides that way against the other.
#pragma once
#include "core/math/vec.hpp"

namespace riven {

/// What a tip that runs goes by: sums along its way, in which what was before counts the less the farther it has run
/// since, and what it recalls at rest (tip_motion.hpp).
struct TipWay {
  double time = 0;          ///< s
  double release = 0;       ///< J s/m^2, of Tip::release over that time
  double length = 0;        ///< m, grown in it
  double ahead = 0;         ///< m, by which the tip has run beyond the end of its crack, which grows by segments
  double seen = 0;          ///< s, time up to which it was followed
  double mean[2] = {0, 0};  ///< J/m^2, of Tip::release, as a tip forgets in time, and the same of this
  double swing = 0;         ///< J^2/m^4, of the square by which it was off from what they said, at rest
  double known = 0;         ///< s, time up to which these have it
};

struct Tip {
  int crack = 0;
  bool last = false;     ///< which end of the crack's points it is
  bool open = true;      ///< false once it has left the solid or joined another crack
  bool grows = false;    ///< its crack has a rule by which to grow
  int body = 0;          ///< the one around it, index into Scene::bodies
  int material = 0;      ///< of that body, index into Scene::materials
  double length = 0;     ///< m, by which it has grown
  bool running = false;  ///< it has grown lately
  double speed = 0;      ///< m/s, mean over its last segments; 0 while it rests
  double released = 0;   ///< J, by its growth
  long due = 0;          ///< Clock::step at which it is checked for growth next
  double grew = 0;       ///< s, time at which it grew last
  double load = 0;       ///< how near it was to growth at its last check; see growth_load
  long checked = 0;      ///< Clock::step of that
  TipWay way;            ///< of a tip that runs
  /// of a tip that runs: checks since it grew last, and the means of drive_I and drive_II over these
  long checks = 0;
  double mean_I = 0, mean_II = 0;

  // the last evaluation of J
  long step = -1;            ///< Clock::step of it
  double J = 0;              ///< J/m^2, energy release rate along the crack; by K where FractureRules::method says
  double J1 = 0, J2 = 0;     ///< J/m^2, the integral along the grid's axes
  double K_I = 0, K_II = 0;  ///< Pa m^0.5, J shared out by the interaction integral where it holds, else by the opening
  double O_I = 0, O_II = 0;  ///< Pa m^0.5, J shared out by the opening of the crack behind the tip
  /// Pa m^0.5, what growth goes by: intensities of a tip at rest, for which K_Ic = sqrt(E' J_Ic). After a check of a
  /// tip that runs these are means: their proportion since it grew last, what they release over the last cells
  double drive_I = 0, drive_II = 0;
  double release = 0;  ///< J/m^2, that go with them
  /// Pa m^0.5, by the interaction integral; NaN where it cannot follow the faces in the contour
  double M_I = 0, M_II = 0;
  double reach[4] = {0, 0, 0, 0};  ///< cells from the tip to the contour: +x, +y, -x, -y
  bool adapted = false;            ///< the contour leaves out the tip of another crack, or a bend with pressed faces
  bool crossed = false;            ///< another crack crosses the contour
  bool sound = true;               ///< false: no contour was found that J can be trusted on (a warning was counted)
};

/// Something that happened at a tip; or to the whole run, of no crack then.
struct CrackEvent {
  enum class Kind {
    start,
    arrest,
    join,
    exit,
    meet,
    close,
    open,
    retry
  };  ///< close, open: faces, where contact waits for them; retry: the run went wrong and goes back
  Kind kind = Kind::start;
  long step = 0;
  double time = 0;  ///< s
  int crack = 0;
  bool last = false;  ///< which end
  Vec2 place;         ///< m
  int other = -1;     ///< the crack that was joined or met
  double J = 0;       ///< J/m^2
  double K_I = 0, K_II = 0;
  double speed = 0;  ///< m/s
  double load = 0;   ///< of the tip at its check
};

}  // namespace riven
