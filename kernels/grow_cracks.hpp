// Lets cracks grow by the J and K of their tips (Nairn and Aimene, sections 3.5 to 3.7). Serial: few tips, rarely due.
//
// A tip is checked every n = max(1, floor(d_p / (c dt))) steps, d_p being the size of a particle and c the speed limit,
// and grows by at most one segment: of d_p, or of what the limit allows since the last one, so that a tip which grows
// at every check has the speed c and not more (for n = 1 that is c dt). A tip at rest grows when the criterion asks for
// it, and one that runs when it has gone by a segment at the speed that goes with what drives it (tip_motion.hpp). Its
// segment ends
//   exit   where no particle lies ahead: it leaves the solid, and is drawn on by two cells, as far as a path from a
//          particle to a node can reach; where that leads between the open faces of another crack, it joins that;
//   join   on the first crack that it crosses or would cross with half a particle more, or whose end lies within half a
//          particle of it; it is tied to that crack (extend_crack.hpp);
//   meet   at the tip of another crack that faces it, within a cell. No contour around one leaves out the other (note 2
//          of section 2.2.2), and J vanishes before they touch; so a tip that is running does not wait for it.
// A running tip for which no contour is left because the edge of the solid or another crack is in its way runs straight
// on. One that has not grown for twenty times as long as the limit needs for a segment, and is not driven to, has
// arrested.
//
// What growth releases, J times area, is booked in Energy::fracture.
#pragma once

namespace riven {

template <class Real>
class SimulationOf;

template <class Real>
void grow_cracks(SimulationOf<Real>&);

}  // namespace riven
