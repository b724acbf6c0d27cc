// Tips: the ends of cracks that lie in a solid, and what was found there last.
#pragma once

namespace riven {

struct Tip {
  int crack = 0;
  bool last = false;    ///< which end of the crack's points it is
  bool open = true;     ///< false once it has left the solid or joined another crack
  int material = 0;     ///< of the solid around it, index into Scene::materials
  double length = 0;    ///< m, by which it has grown
  double speed = 0;     ///< m/s, at which it grew last; 0 once it has arrested
  double released = 0;  ///< J, by its growth

  // the last evaluation of J
  long step = -1;               ///< Clock::step of it
  double J = 0;                 ///< J/m^2, energy release rate along the crack
  double J1 = 0, J2 = 0;        ///< J/m^2, along the grid's axes
  double K_I = 0, K_II = 0;     ///< Pa m^0.5, J shared out by the opening of the crack behind the tip
  double M_I = 0, M_II = 0;     ///< Pa m^0.5, by the interaction integral; NaN where another crack is in the contour
  int reach[4] = {0, 0, 0, 0};  ///< cells from the node nearest to the tip to the contour: +x, +y, -x, -y
  bool adapted = false;         ///< the contour leaves out the tip of another crack
  bool crossed = false;         ///< another crack crosses the contour
  bool sound = true;            ///< false: no contour was found that J can be trusted on (a warning was counted)
};

}  // namespace riven
