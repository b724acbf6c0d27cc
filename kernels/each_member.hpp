// What a simulation is beside its scene: all that the next step or the results go by, and that is no function of the
// scene and of the rest. Whoever stores a simulation, and whoever takes one up again, goes by this list.
//
// Not in it, as each step makes it anew: the grid, contact's sums, bridges, forces on points, extremes
// of det F. Crossings of particles and cracks are not either: found from nothing they are the same
// (trace_crossings.hpp), once the lists are that go by where the cracks were when they were hashed. make_derived
// (make_derived.hpp) makes what is left.
//
// A visitor has
//   fixed(name, array)      numbers, vectors or histories, as many as the scene asks for
//   growing(name, array)    the same, as many as there are by now
//   records(name, list)     structs, fixed in number; grown_records(name, list) those that become more
//   record(name, struct)
// and takes structs apart by each_member(struct, f), which calls f(name, member) for numbers, flags, enums, vectors and
// small arrays of these.
#pragma once
#include <string>

#include "core/scene/names.hpp"
#include "kernels/simulation.hpp"

namespace riven {

template <class F>
void each_member(Clock& c, F&& f) {
  f("step", c.step);
  f("time", c.time);
  f("dt", c.dt);
  f("stable_dt", c.stable_dt);
  f("measured_speed", c.measured_speed);
  f("dt_factor", c.dt_factor);
}

template <class F>
void each_member(StepWatch& w, F&& f) {
  f("largest_move", w.largest_move);
  f("step_work", w.step_work);
  f("least_J", w.least_J);
  f("velocity_difference", w.velocity_difference);
  f("drift", w.drift);
  f("sorted_at", w.sorted_at);
}

template <class F>
void each_member(Monitor& m, F&& f) {
  f("value", m.value);
  f("worst", m.worst);
  f("place", m.place);
  f("beyond", m.beyond);
  f("first", m.first);
  f("first_place", m.first_place);
}

template <class F>
void each_member(Energy& e, F&& f) {
  f("kinetic", e.kinetic);
  f("strain", e.strain);
  f("cohesive", e.cohesive);
  f("external_work", e.external_work);
  f("damping", e.damping);
  f("contact", e.contact);
  f("capture", e.capture);
  f("transfer", e.transfer);
  f("anchoring", e.anchoring);
  f("fracture", e.fracture);
  f("debonding", e.debonding);
  f("first", e.first);
  f("largest", e.largest);
}

template <class F>
void each_member(Momentum& p, F&& f) {
  f("linear", p.linear);
  f("angular", p.angular);
  f("first", p.first);
  f("first_angular", p.first_angular);
  f("impulse", p.impulse);
  f("torque_impulse", p.torque_impulse);
  f("torque_size", p.torque_size);
  f("scale", p.scale);
  f("angular_scale", p.angular_scale);
}

template <class F>
void each_member(ConstraintOwner& o, F&& f) {
  f("work", o.work);
  f("travel", o.travel);
  f("reaction", o.reaction);
  f("mean_impulse", o.mean.impulse);
  f("mean_time", o.mean.time);
  f("mean_value", o.mean.value);
  f("mean_averaged", o.mean.averaged);
}

template <class F>
void each_member(Junction& j, F&& f) {
  f("crack", j.crack);
  f("last", j.last);
  f("other", j.other);
  f("segment", j.segment);
  f("along", j.along);
}

template <class F>
void each_member(Tip& t, F&& f) {
  f("crack", t.crack);
  f("last", t.last);
  f("open", t.open);
  f("grows", t.grows);
  f("body", t.body);
  f("material", t.material);
  f("length", t.length);
  f("running", t.running);
  f("speed", t.speed);
  f("released", t.released);
  f("due", t.due);
  f("grew", t.grew);
  f("load", t.load);
  f("checked", t.checked);
  f("way_time", t.way.time);
  f("way_release", t.way.release);
  f("way_length", t.way.length);
  f("way_ahead", t.way.ahead);
  f("way_seen", t.way.seen);
  f("way_mean", t.way.mean[0]);
  f("way_mean_again", t.way.mean[1]);
  f("way_swing", t.way.swing);
  f("way_known", t.way.known);
  f("checks", t.checks);
  f("mean_I", t.mean_I);
  f("mean_II", t.mean_II);
  f("step", t.step);
  f("J", t.J);
  f("J1", t.J1);
  f("J2", t.J2);
  f("K_I", t.K_I);
  f("K_II", t.K_II);
  f("O_I", t.O_I);
  f("O_II", t.O_II);
  f("drive_I", t.drive_I);
  f("drive_II", t.drive_II);
  f("release", t.release);
  f("M_I", t.M_I);
  f("M_II", t.M_II);
  f("reach", t.reach);
  f("adapted", t.adapted);
  f("crossed", t.crossed);
  f("sound", t.sound);
}

template <class F>
void each_member(CrackEvent& e, F&& f) {
  f("kind", e.kind);
  f("step", e.step);
  f("time", e.time);
  f("crack", e.crack);
  f("last", e.last);
  f("place", e.place);
  f("other", e.other);
  f("J", e.J);
  f("K_I", e.K_I);
  f("K_II", e.K_II);
  f("speed", e.speed);
  f("load", e.load);
}

template <class F>
void each_member(Cracks& c, F&& f) {
  f("velocities_known", c.velocities_known);
  f("lead", c.lead);
}

template <class F>
void each_member(CrackFields& w, F&& f) {
  f("warning_both_sides", w.warning_both_sides);
  f("warning_fourth_crack", w.warning_fourth_crack);
  f("pressing", w.pressing);
  f("warning_place", w.warning_place);
}

template <class F>
void each_member(ContactReport& r, F&& f) {
  f("touching", r.touching);
  f("apart", r.apart);
  f("early", r.early);
  f("capped", r.capped);
  f("capped_node", r.capped_node);
  f("penetration", r.penetration);
  f("gap", r.gap);
}

template <class F>
void each_member(ContactWatch& w, F&& f) {
  f("on", w.on);
  f("closed", w.closed);
  f("last", w.last);
  f("place", w.place);
  f("crack", w.crack);
}

template <class F>
void each_member(FractureReport& r, F&& f) {
  f("in_cell", r.in_cell);
  f("drawn_in", r.drawn_in);
  f("unsound", r.unsound);
  f("evaluations", r.evaluations);
  f("crossed", r.crossed);
  f("bent", r.bent);
  f("mixed", r.mixed);
  f("cut", r.cut);
  f("place", r.place);
}

template <class Real, class F>
void each_member(TaskOf<Real>& t, F&& f) {
  f("calls", t.calls);
  f("seconds", t.seconds);
}

template <class Real, class Visitor>
void visit_particles(Particles<Real, 2>& p, Visitor& f) {
  const auto all = [&](const char* name, auto& arrays) {
    int n = 0;
    for (auto& a : arrays)
      f.fixed("particles/" + std::string(name) + std::to_string(n++), a);
  };
  all("position", p.x);
  all("velocity", p.v);
  all("F", p.F);
  f.fixed("particles/det_F", p.J);
  all("stress", p.stress);
  f.fixed("particles/mass", p.mass);
  all("velocity_gradient", p.C);
  all("first_position", p.x0);
  all("closed_position", p.closed);
  f.fixed("particles/body", p.body);
  f.fixed("particles/id", p.id);
  f.fixed("particles/tile_start", p.tiles.start);
  f.fixed("particles/cell_start", p.tiles.cell_start);
}

template <class Visitor>
void visit_cracks(Cracks& c, CrackFields& fields, Visitor& f) {
  f.record("cracks/known", c);
  f.fixed("cracks/start", c.start);
  f.fixed("cracks/open", c.open);
  f.growing("cracks/crack", c.crack);
  f.growing("cracks/serial", c.serial);
  f.growing("cracks/plane", c.plane);
  f.growing("cracks/upper", c.upper);
  f.growing("cracks/lower", c.lower);
  f.growing("cracks/upper_velocity", c.upper_velocity);
  f.growing("cracks/lower_velocity", c.lower_velocity);
  f.growing("cracks/first_plane", c.plane0);
  f.growing("cracks/density", c.density);
  f.growing("cracks/gap", c.gap);
  f.growing("cracks/jump", c.jump);
  f.growing("cracks/in_solid", c.in_solid);
  f.growing("cracks/cohesive", c.cohesive);
  f.growing("cracks/bearing", c.bearing);
  f.grown_records("cracks/junctions", c.junctions);
  f.growing("cracks/hashed", fields.hashed);
  f.growing("cracks/pressed", fields.pressed);
  f.growing("cracks/stuck", fields.stuck);
  f.record("cracks/warnings", fields);
}

template <class Real, class Visitor>
void each_member(SimulationOf<Real>& m, Visitor&& f) {
  State<Real, 2>& s = m.state;
  f.record("clock", s.clock);
  f.record("watch", s.watch);
  for (const auto& [which, name] : Names<Watched>::table)
    f.record("monitors/" + std::string(name), s.monitors[static_cast<size_t>(which)]);
  f.record("energy", s.ledger.energy);
  f.record("momentum", s.ledger.momentum);
  visit_particles(s.particles, f);
  visit_cracks(s.cracks, s.fields, f);
  f.records("tips", s.tips);
  for (size_t k = 0; k < s.readings.size(); ++k)
    f.records("readings/" + std::to_string(k), s.readings[k]);
  f.grown_records("events", s.events);
  f.records("constraints", s.constraints.owners);
  for (GripBlock& g : s.constraints.grips)
    f.fixed("grips/" + std::to_string(g.owner), g.points);
  f.record("contact/before", m.contact_before);
  f.record("contact/after", m.contact_after);
  f.record("contact/again", m.contact_again);
  f.record("contact/watch", m.contact_watch);
  f.record("fracture", m.fracture);
  f.records("tasks", m.tasks);
}

}  // namespace riven
