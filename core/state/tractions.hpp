// Tractions on the faces of cracks, point by point.
#pragma once
#include "core/scene/scene.hpp"
#include "core/state/cracks.hpp"

namespace riven {

/// Directions of a crack at one of its points, of unit length: from its first point to its last, and towards above.
struct CrackFrame {
  Vec2 along, left;
};

CrackFrame crack_frame(const Cracks&, int point);

/// Opening of the faces at a point, m: upper less lower, in the directions of the crack, with the gap at first.
FacePair face_opening(const Cracks&, int point);

/// Has a segment, from a point to the next, become more than twice as long as it first was? It spans the opening of
/// another crack then, and has no solid beside it.
inline bool is_torn(const Cracks& cracks, int segment) {
  constexpr double torn = 2;
  return norm(cracks.plane[segment + 1] - cracks.plane[segment]) >
         torn * norm(cracks.plane0[segment + 1] - cracks.plane0[segment]);
}

/// The same as laws see it: half a step ahead where the surfaces move by the mean of a step's velocities. A spring k
/// between masses m that pulls with the opening at the start of such a step gains energy in every step, (w dt)^2/2 of
/// what it holds, w^2 = k/m; with the opening half a step later it moves by the leapfrog scheme, which keeps energy
/// while w dt < 2.
FacePair law_opening(const Cracks&, int point);

/// Area of one face that bears the tractions of a point, m^2, with the present lengths of the segments around it; 0 on
/// a crack without tractions, outside of the bodies and outside of the region that the scene gives.
double face_area(const Cracks&, int point);

/// Traction on the upper face at a point, Pa; the lower face bears the opposite one.
Vec2 traction_on(const Cracks&, int point);

/// W_Z, J/m^2: what the tractions at a point can give back when the faces close. For a cohesive law that is the energy
/// which damage has left, >= 0; for a pressure P the potential of the load, -P times the normal opening. The traction t
/// on the upper face does the work t . d delta, so dW_Z = -t . d delta at constant damage.
///
/// In J: with faces from x_0 to the tip inside of the contour, J = J_contour + J_T,
///   J_T = -int_x0^tip t . (d delta/dx) dx = int_0^delta(x_0) t . d delta = -W_Z(x_0)
/// without damage. (This is eq. 11 of Nairn and Aimene with T the traction on the upper face.) A pressure raises J by P
/// times the opening at x_0; a cohesive zone, which takes up energy, lowers it. With damage -W_Z(x_0) leaves in J what
/// the zone has dissipated, and -(W_Z + dissipated_energy) takes that out, too: what is left is the J of the tip
/// itself.
double stored_energy(const Cracks&, int point);

/// Taken by the damage of a cohesive law at a point so far, J/m^2.
double dissipated_energy(const Cracks&, int point);

/// Sum of the stored energies of all cohesive laws, J.
double cohesive_energy(const Cracks&);

/// Gives the cracks of the scene their laws, and their points what lies in a body there.
void lay_tractions(const Scene&, Cracks&);

/// Lets the new segment at an end of a crack that has grown bear its law where it lies, by first positions, in the
/// region that the scene gives to that. Without a region it bears what the end did.
void lay_traction_at_end(const Scene&, int crack, bool last, Cracks&);

}  // namespace riven
