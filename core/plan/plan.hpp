// What a scene calls for: decided once, before the first step. Effects that are not in the plan have no task, no array
// and no branch in the kernels that run.
#pragma once
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace riven {

enum class LawChoice { linear_elastic, linear_elastic_F, neo_hookean, any };

struct Plan {
  // one choice each, made outside of the loops
  ShapeFunction shape;
  LawChoice law;
  Transfer transfer;
  int order;  ///< of XPIC or FMPM; 1 elsewhere
  StressUpdate update;
  ScatterKind scatter;

  double energy_growth;  ///< largest part of the largest energy that may come from nowhere
  /// The time step is beyond that in which a wave runs through a cell, where no method is sure to be stable: energy is
  /// looked at in every step, and what the transfer takes out hides nothing of what grows.
  bool watch_energy;
  bool worked_on() const { return loads || constraints || body_force || tractions; }  ///< energy comes from outside

  // effects
  bool cracks = false;
  bool contact = false;           ///< some crack's faces may touch
  bool contact_slides = false;    ///< and slide: neither bonded nor held by an interface
  bool contact_volume = false;    ///< detection by volume, or interpenetration statistics, asks for nodal volumes
  bool contact_position = false;  ///< detection by displacement, or an interface law, asks for positions
  bool first_gaps = false;        ///< solids that meet across a crack start apart (displacement)
  bool contact_waits = false;     ///< contact.when = "auto": tried now and then until faces touch
  bool contact_area = false;      ///< an interface law asks for the length of crack at each node
  bool fracture = false;          ///< J and K at every tip
  bool growth = false;            ///< some crack grows
  bool tractions = false;         ///< some crack's faces bear a pressure or a cohesive law
  bool cohesive = false;          ///< the latter
  bool grips = false;
  bool constraints = false;  ///< any prescribed grid velocity: grips, fixed nodes, symmetry
  bool affine = false;       ///< particles carry the gradient of their velocity
  bool loads = false;
  bool body_force = false;
  bool grid_damping = false;
  bool particle_damping = false;

  bool stress_before() const { return update == StressUpdate::usf || update == StressUpdate::usavg; }
  bool stress_after() const { return update != StressUpdate::usf; }
  bool averaged() const { return update == StressUpdate::usavg; }
  bool extrapolate_again() const { return update == StressUpdate::musl || update == StressUpdate::usavg; }
  /// Cracks move as particles do, which move by the velocities that strain, before the step and extrapolated again.
  /// What particles take from the grid goes through them once more before it strains: moved by the grid's own
  /// velocities, rows of particles at loaded edges would creep while their stress stands, and with FLIP, where the grid
  /// comes to rest there, a solid under tension would begin to swing by itself, by e in some 10,000 steps at a strain
  /// of 0.5 %. Faces that may slide, and what is around them, keep to the grid's own: contact, which is found by
  /// displacements, makes these the same on both sides. Moved otherwise, J of faces that are pressed together is off by
  /// a tenth.
  bool cracks_move_again() const { return extrapolate_again() && !contact_slides; }
  bool higher_order() const { return transfer == Transfer::xpic || transfer == Transfer::fmpm; }
  /// From the third order on, a product with the full mass matrix costs less than passes over the particles; gradients
  /// of velocity are not in it.
  bool full_mass() const { return higher_order() && order > 2 && !affine; }
  bool keeps_F() const { return law != LawChoice::linear_elastic; }
  bool keeps_J() const { return law == LawChoice::linear_elastic; }
  bool needs_contact_sums() const { return contact_volume || contact_position || contact_area; }
  /// Faces are held to the particles beside them (anchor_cracks.hpp), which tells who knows their stretch.
  bool anchors() const { return cracks && keeps_F(); }
  /// So are strains (anchor_strains.hpp), where J asks for them.
  bool anchors_strains() const { return fracture && anchors(); }
  bool first_positions() const { return contact_position || displacement_probe || anchors(); }
  bool displacement_probe = false;

  std::vector<std::string> effects() const;  ///< names of what is on, for the header and summary.json
};

/// Throws Error (bad input) for combinations that no kernel serves.
Plan make_plan(const Scene& scene);

}  // namespace riven
