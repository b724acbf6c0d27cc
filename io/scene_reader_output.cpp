#include <algorithm>

#include "io/scene_reader.hpp"

namespace riven {

namespace {

constexpr int most_frames = 1000000, most_steps = 1000000000;

/// Steps between checkpoints that a run goes back to: by steps, and not by time alone, so that it goes back to the same
/// one on any machine.
constexpr int retry_steps = 1000;

/// Which keys a kind of probe needs.
struct ProbeKeys {
  bool point, axis, component, exact;
};

ProbeKeys keys_of(Probe::Kind kind) {
  switch (kind) {
    case Probe::Kind::displacement:
    case Probe::Kind::velocity: return {true, true, false, false};
    case Probe::Kind::stress: return {true, false, true, false};
    case Probe::Kind::reaction:
    case Probe::Kind::travel: return {false, true, false, false};
    case Probe::Kind::mean_stress: return {false, false, true, false};
    case Probe::Kind::displacement_error: return {false, false, false, true};
    case Probe::Kind::crack_opening: break;
  }
  return {false, false, false, false};
}

Probe read_probe(const Table& t, size_t i, const Scene& s) {
  Probe p;
  p.name = read_name(t, "probe", i);
  p.kind = t.choice<Probe::Kind>("kind");
  const ProbeKeys keys = keys_of(p.kind);
  const auto unused = [&](const char* key, bool used) {
    if (t.has(key) && !used)
      t.refuse(key, fmt::format("a probe of kind {} has no {}", name_of(p.kind), key));
  };
  unused("point", keys.point);
  unused("axis", keys.axis);
  unused("component", keys.component);
  unused("exact_x", keys.exact);
  unused("exact_y", keys.exact);
  unused("over", keys.exact || p.kind == Probe::Kind::reaction || p.kind == Probe::Kind::travel);
  if (keys.point)
    p.point = t.vector("point", dimension::length);
  if (keys.axis)
    p.axis = static_cast<int>(t.one_of("axis", {"x", "y"}, 1));
  if (keys.component) {
    const size_t component = t.one_of("component", {"xx", "yy", "xy"}, 1);
    p.axis = component == 1 ? 1 : 0;
    p.axis2 = component == 0 ? 0 : 1;
  }
  if (keys.exact) {
    p.exact[0] = t.field("exact_x", dimension::length).value_or(Field{});
    p.exact[1] = t.field("exact_y", dimension::length).value_or(Field{});
    if (!t.has("exact_x") && !t.has("exact_y"))
      t.refuse(nullptr, "the exact displacement is missing", "exact_x, exact_y or both",
               "exact_x = { value = \"1 mm\", shape = \"sin(pi*X/L)*sin(w*t)\", L = \"1 m\", w = \"9 1/s\" }");
  }
  if (t.has("over"))
    p.over = t.quantity("over", p.kind == Probe::Kind::reaction ? dimension::area : dimension::length, range::positive);
  if (p.kind == Probe::Kind::crack_opening) {
    const auto names = names_of(s.cracks);
    p.target = names[t.one_of("target", names)];
  } else if (p.kind == Probe::Kind::reaction || p.kind == Probe::Kind::travel) {
    const auto names = names_of(s.grips);
    p.target = names[t.one_of("target", names)];
  } else if (t.has("target")) {
    t.refuse("target", fmt::format("a probe of kind {} has no target", name_of(p.kind)));
  }
  return p;
}

}  // namespace

void read_output(const Table& root, Scene& s) {
  const Table t = root.table("output", {"frames", "history_every", "sidecar", "precision", "fields", "fringe_constant",
                                        "checkpoint", "checkpoint_steps"});
  s.output.frames = t.integer("frames", 0, most_frames, s.output.frames);
  s.output.history_every =
      t.quantity("history_every", dimension::time, range::positive, s.output.history_every, "1/250 of solver.time");
  s.output.checkpoint_every =
      t.quantity("checkpoint", dimension::time, range::non_negative, s.output.checkpoint_every, "10 min");
  s.output.checkpoint_steps =
      t.integer("checkpoint_steps", 0, most_steps, s.limits.retries > 0 ? retry_steps : s.output.checkpoint_steps);
  s.output.sidecar = t.choice("sidecar", std::optional(s.output.sidecar));
  s.output.precision = t.choice("precision", std::optional(s.output.precision));
  s.output.fields = t.texts("fields");
  for (const std::string& field : s.output.fields)
    if (field != "fringe")
      t.refuse("fields", fmt::format("unknown field '{}'", shown(field)), "fringe",
               nearest(field, {"fringe"}).empty() ? "" : "did you mean 'fringe'?");
  if (t.has("fringe_constant"))
    s.output.fringe_constant = t.quantity("fringe_constant", dimension::stress_optic, range::positive);
  else if (!s.output.fields.empty())
    t.refuse("fringe_constant", "the fringe field needs its constant", "", "fringe_constant = \"0.0889 1/MPa\"");
  for (const Table& probe :
       root.tables("probe", {"name", "kind", "point", "axis", "component", "target", "over", "exact_x", "exact_y"}))
    s.probes.push_back(read_probe(probe, s.probes.size(), s));
}

}  // namespace riven
