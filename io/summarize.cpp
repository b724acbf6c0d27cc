#include "io/summarize.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/scene/names.hpp"
#include "core/state/monitors.hpp"
#include "io/peak_memory.hpp"
#include "io/tip_report.hpp"
#include "io/what_helps.hpp"

namespace riven {

namespace {

template <class Real>
std::vector<Summary::Warning> warnings(const SimulationOf<Real>& m) {
  std::vector<Summary::Warning> list;
  const auto say = [&](const char* kind, long count, Vec2 place, std::string_view advice) {
    if (count > 0)
      list.push_back({kind, count, place, what_helps(advice, m.scene)});
  };
  const CrackFields& f = m.state.fields;
  say("a node sees one crack from both sides", f.warning_both_sides, f.warning_place[0],
      "smaller cells where a crack turns back on itself, or its faces overlap");
  say("a node sees more than three cracks", f.warning_fourth_crack, f.warning_place[1],
      "smaller cells, or fewer cracks there: the fourth parts nothing at this node");
  ContactReport contact = m.contact_before;
  contact += m.contact_after;
  contact += m.contact_again;
  say("faces in contact at a node did not settle: what they exchange there is not exact", contact.capped,
      contact.capped > 0 ? m.state.grid.lattice.position(contact.capped_node) : nowhere,
      "smaller cells, or fewer cracks there; less friction");
  for (const auto& [which, name] : Names<Watched>::table) {
    const Monitor& watched = monitor(m.state.monitors, which);
    say(text_of(which).what, watched.beyond, watched.first_place, text_of(which).advice);
  }
  const FractureReport& j = m.fracture;
  say("two crack tips are too near to each other for a J contour between them", j.in_cell, j.place[0],
      "smaller cells; J there is that of both");
  say("a J contour left the solid and was drawn in", j.drawn_in, j.place[1],
      "nothing, if the tip has two cells of solid around it; else a smaller fracture.contour, or smaller cells");
  say("a tip is so near to an edge that no J contour lies in the solid, as where a crack cuts through", j.unsound,
      j.place[2], "nothing, if the crack is about to cut through; else smaller cells");
  say("a bend next to the tip is sharp or has faces pressed together: J and K are not resolved there", j.bent,
      j.place[3], "smaller cells, until the bend is a few of them away");
  say("another crack crosses, or the tip's own begins on it, less than 1.5 cells behind a tip: J and K are not "
      "resolved there",
      j.cut, j.place[5], "smaller cells");
  say("a crack grew to where its J contour takes in another material or thickness: J and K are no longer those of its "
      "tip alone",
      j.mixed, j.place[4], "a smaller fracture.contour; smaller cells");
  return list;
}

}  // namespace

template <class Real>
Summary summarize(const SimulationOf<Real>& m, double wall_seconds) {
  const auto& s = m.state;
  const Energy& e = s.ledger.energy;
  Summary out;
  out.scene = m.scene.name;
  out.title = m.scene.title;
  out.steps = s.clock.step;
  out.time = s.clock.time;
  out.wall_seconds = wall_seconds;
  out.particles = s.particles.count();
  out.particle_steps_per_second = static_cast<double>(out.particles) * static_cast<double>(out.steps) / wall_seconds;
  out.peak_memory_bytes = peak_memory();
  out.threads = m.space.threads();
  out.exec = exec::name(m.space.kind());
  out.scatter = name_of(m.plan.scatter);
  out.precision = name_of(m.scene.precision);
  out.effects = m.plan.effects();
  for (const TaskOf<Real>& t : m.tasks)
    out.tasks.push_back({t.label, t.effect, t.calls, t.seconds});
  out.energy = {e.kinetic,   e.strain,  e.cohesive,    e.external_work, e.damping,   e.contact, e.fracture,
                e.debonding, e.capture, e.numerical(), e.transfer,      e.anchoring, e.largest, e.relative_error()};
  out.momentum_error = s.ledger.momentum.error();
  out.angular_momentum_error = s.ledger.momentum.angular_error();
  out.warnings = warnings(m);
  for (const auto& [which, name] : Names<Watched>::table)
    if (which != Watched::penetration || m.plan.cracks) {
      const Monitor& watched = monitor(s.monitors, which);
      out.watched.push_back({std::string(name), watched.worst, text_of(which).unit, watched.place});
    }
  out.tips = summarize_tips(m.scene, s.tips, s.cracks);
  out.cracks = summarize_cracks(s.cracks, s.tips);
  for (const ConstraintOwner& o : s.constraints.owners)
    out.reactions.push_back({o.name, o.mean.value});
  return out;
}

#define RIVEN_SUMMARIZE(Real) template Summary summarize(const SimulationOf<Real>&, double);
RIVEN_EACH_REAL(RIVEN_SUMMARIZE)
#undef RIVEN_SUMMARIZE

}  // namespace riven
