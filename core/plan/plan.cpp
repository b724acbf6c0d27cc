#include "core/plan/plan.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/scene/names.hpp"
#include "core/state/first_gaps.hpp"
#include "core/state/make_tips.hpp"

namespace riven {

namespace {

LawChoice law_choice(const Scene& scene, bool gradients) {
  bool linear = false, neo = false;
  for (const Body& b : scene.bodies) {
    const LawKind law = scene.materials[static_cast<size_t>(b.material)].law;
    linear |= law == LawKind::linear_elastic;
    neo |= law == LawKind::neo_hookean;
  }
  if (neo)
    return linear ? LawChoice::any : LawChoice::neo_hookean;
  return gradients ? LawChoice::linear_elastic_F : LawChoice::linear_elastic;
}

/// B-splines are folded at the walls only; a mirror inside the grid would need mirrored ghost nodes.
void require_walls_for_bsplines(const Scene& scene) {
  if (scene.shape != ShapeFunction::bspline)
    return;
  for (size_t i = 0; i < scene.symmetry.size(); ++i) {
    const SymmetryPlane& s = scene.symmetry[i];
    const double lower = s.axis == 0 ? scene.grid.lower.x : scene.grid.lower.y;
    const double upper = s.axis == 0 ? scene.grid.upper.x : scene.grid.upper.y;
    const double wall = s.solid > 0 ? lower : upper;
    if (std::abs(s.position - wall) > 1e-6 * scene.cell)
      fail({Exit::bad_input, "with B-splines a symmetry plane must be a wall of the grid",
            place(scene, "symmetry " + std::to_string(i)), std::to_string(s.position) + " m",
            std::to_string(wall) + " m", "let the grid end at the plane, or use shape = \"ugimp\""});
  }
}

/// Linear functions have no moments at a node, where gradients would be without bound.
void require_moments(const Scene& scene) {
  if (scene.affine && scene.shape == ShapeFunction::linear)
    fail({Exit::bad_input, "linear functions carry no gradients of velocity", place(scene, "solver.affine"), "true",
          "false with shape = \"linear\"", "shape = \"ugimp\" or \"bspline\""});
}

}  // namespace

Plan make_plan(const Scene& scene) {
  require_walls_for_bsplines(scene);
  require_moments(scene);
  Plan p;
  p.shape = scene.shape;
  p.transfer = scene.transfer;
  p.order = scene.transfer == Transfer::xpic || scene.transfer == Transfer::fmpm ? scene.order : 1;
  p.affine = scene.affine;
  p.update = scene.stress_update;
  p.scatter = scene.deterministic ? ScatterKind::ordered : scene.scatter;
  p.watch_energy = scene.cfl > 1;
  p.energy_growth = scene.limits.energy_growth.value_or(p.watch_energy ? 0.01 : 0.05);
  p.cracks = !scene.cracks.empty();
  if (p.cracks) {
    p.contact_waits = scene.contact_rules.when == ContactWhen::closing;
    for (const CrackLine& c : scene.cracks) {
      const ContactLaw law = c.contact.value_or(scene.contact).law;
      if (law == ContactLaw::ignored)
        continue;
      p.contact = true;
      p.contact_area |= law == ContactLaw::interface;
      if (law == ContactLaw::bonded)
        continue;
      p.contact_slides |= law != ContactLaw::interface;
      p.contact_volume |= scene.contact_rules.detection == ContactDetection::volume;
      p.contact_position |=
          scene.contact_rules.detection == ContactDetection::displacement || law == ContactLaw::interface;
    }
  }
  p.contact_waits &= p.contact;
  p.first_gaps = p.cracks && starts_apart(scene);
  for (int c = 0; c < static_cast<int>(scene.cracks.size()); ++c)
    p.growth |= growth_rule(scene, c) != nullptr;
  p.fracture = p.growth || (p.cracks && scene.fracture.asked);
  p.law = law_choice(scene, p.fracture);
  for (const CrackLine& c : scene.cracks) {
    p.tractions |= c.traction.has_value();
    p.cohesive |= c.traction && c.traction->kind != TractionKind::pressure;
  }
  p.grips = !scene.grips.empty();
  p.constraints = p.grips || !scene.fixed.empty() || !scene.symmetry.empty();
  p.loads = !scene.loads.empty();
  p.body_force = scene.body_force[0] || scene.body_force[1];
  p.grid_damping = scene.grid_damping.has_value();
  p.particle_damping = scene.particle_damping.has_value();
  p.displacement_probe = std::any_of(scene.probes.begin(), scene.probes.end(), [](const Probe& q) {
    return q.kind == Probe::Kind::displacement || q.kind == Probe::Kind::displacement_error;
  });
  return p;
}

std::vector<std::string> Plan::effects() const {
  std::vector<std::string> names;
  auto say = [&](bool on, const char* name) {
    if (on)
      names.emplace_back(name);
  };
  say(cracks, "cracks");
  say(contact, contact_waits ? "contact when faces close" : "contact");
  say(first_gaps, "first gaps");
  say(contact_area, "imperfect interface");
  say(fracture, "J");
  say(growth, "growth");
  say(tractions, "tractions");
  say(grips, "grips");
  say(constraints && !grips, "fixed nodes");
  say(loads, "loads");
  say(body_force, "body force");
  say(grid_damping, "grid damping");
  say(particle_damping, "particle damping");
  say(affine, "gradients of velocity");
  say(higher_order() && order > 1, "higher orders");
  say(watch_energy, "watched energy");
  return names;
}

}  // namespace riven
