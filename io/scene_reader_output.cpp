#include <algorithm>

#include "io/scene_reader.hpp"

namespace riven {

namespace {

constexpr int most_frames = 1000000;

/// Which keys a kind of probe needs.
struct ProbeKeys {
  bool point, axis, component;
};

ProbeKeys keys_of(Probe::Kind kind) {
  switch (kind) {
    case Probe::Kind::displacement:
    case Probe::Kind::velocity: return {true, true, false};
    case Probe::Kind::stress: return {true, false, true};
    case Probe::Kind::reaction:
    case Probe::Kind::travel: return {false, true, false};
    case Probe::Kind::mean_stress: return {false, false, true};
    case Probe::Kind::crack_opening: break;
  }
  return {false, false, false};
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
  unused("over", p.kind == Probe::Kind::reaction || p.kind == Probe::Kind::travel);
  if (keys.point)
    p.point = t.vector("point", dimension::length);
  if (keys.axis)
    p.axis = static_cast<int>(t.one_of("axis", {"x", "y"}, 1));
  if (keys.component) {
    const size_t component = t.one_of("component", {"xx", "yy", "xy"}, 1);
    p.axis = component == 1 ? 1 : 0;
    p.axis2 = component == 0 ? 0 : 1;
  }
  if (p.kind == Probe::Kind::crack_opening) {
    const auto names = names_of(s.cracks);
    p.target = names[t.one_of("target", names)];
  } else if (p.kind == Probe::Kind::reaction || p.kind == Probe::Kind::travel) {
    const auto names = names_of(s.grips);
    p.target = names[t.one_of("target", names)];
    if (t.has("over"))
      p.over = t.quantity("over", p.kind == Probe::Kind::travel ? dimension::length : dimension::area, range::positive);
  } else if (t.has("target")) {
    t.refuse("target", fmt::format("a probe of kind {} has no target", name_of(p.kind)));
  }
  return p;
}

}  // namespace

void read_output(const Table& root, Scene& s) {
  const Table t = root.table("output", {"frames", "history_every", "sidecar", "fields", "fringe_constant"});
  s.output.frames = t.integer("frames", 0, most_frames, s.output.frames);
  s.output.history_every =
      t.quantity("history_every", dimension::time, range::positive, s.output.history_every, "1/500 of solver.time");
  s.output.sidecar = t.choice("sidecar", std::optional(s.output.sidecar));
  s.output.fields = t.texts("fields");
  for (const std::string& field : s.output.fields)
    if (field != "fringe")
      t.refuse("fields", fmt::format("unknown field '{}'", shown(field)), "fringe",
               nearest(field, {"fringe"}).empty() ? "" : "did you mean 'fringe'?");
  if (t.has("fringe_constant"))
    s.output.fringe_constant = t.quantity("fringe_constant", dimension::stress_optic, range::positive);
  else if (!s.output.fields.empty())
    t.refuse("fringe_constant", "the fringe field needs its constant", "", "fringe_constant = \"0.0889 1/MPa\"");
  for (const Table& probe : root.tables("probe", {"name", "kind", "point", "axis", "component", "target", "over"}))
    s.probes.push_back(read_probe(probe, s.probes.size(), s));
}

}  // namespace riven
