#include "io/scene_reader.hpp"

namespace riven {

namespace {

FixedNodes read_fix(const Table& t, size_t i) {
  FixedNodes f;
  f.name = read_name(t, "fix", i);
  if (!t.has("box"))
    t.refuse("box", "missing key 'box'", "", "box = { lower = [\"0 mm\", \"0 mm\"], upper = [\"0 mm\", \"9 mm\"] }");
  const Table box = t.table("box", {"lower", "upper"});
  f.box = {box.vector("lower", dimension::length), box.vector("upper", dimension::length)};
  if (f.box.lower.x > f.box.upper.x || f.box.lower.y > f.box.upper.y)
    box.refuse("upper", "the box is upside down", "upper at least lower in x and y");
  f.velocity[0] = t.function("velocity_x", dimension::speed);
  f.velocity[1] = t.function("velocity_y", dimension::speed);
  if (!f.velocity[0] && !f.velocity[1])
    t.refuse(nullptr, "fixed nodes need a velocity", "velocity_x, velocity_y or both", "velocity_y = \"0 m/s\"");
  return f;
}

SymmetryPlane read_symmetry(const Table& t, size_t i) {
  SymmetryPlane p;
  p.axis = static_cast<int>(t.one_of("axis", {"x", "y"}));
  p.position = t.quantity("position", dimension::length, range::any);
  p.solid = t.one_of("solid", {"above", "below"}) == 0 ? +1 : -1;
  t.remember(fmt::format("symmetry {}", i));
  return p;
}

/// How a kind of load names its two components, and what they are.
struct LoadKeys {
  const char* component[2];
  const Dimension& dimension;
};

LoadKeys keys_of(Load::Kind kind) {
  switch (kind) {
    case Load::Kind::force: return {{"force_x", "force_y"}, dimension::force};
    case Load::Kind::traction: return {{"traction_x", "traction_y"}, dimension::stress};
    case Load::Kind::acceleration: break;
  }
  return {{"acceleration_x", "acceleration_y"}, dimension::acceleration};
}

Load read_load(const Table& t, size_t i) {
  Load load;
  load.name = read_name(t, "load", i);
  load.kind = t.choice<Load::Kind>("kind");
  load.region = read_region(t);
  const LoadKeys mine = keys_of(load.kind);
  for (const auto& [kind, name] : Names<Load::Kind>::table)
    for (const int axis : {0, 1})
      if (const char* other = keys_of(kind).component[axis]; kind != load.kind && t.has(other))
        t.refuse(other, fmt::format("a load of kind {} has no such component", name_of(load.kind)),
                 fmt::format("{}, {}", mine.component[0], mine.component[1]),
                 fmt::format("did you mean '{}'?", mine.component[axis]));
  if (!t.has(mine.component[0]) && !t.has(mine.component[1]))
    t.refuse(nullptr, "the load has no value", fmt::format("{}, {} or both", mine.component[0], mine.component[1]));
  for (const int axis : {0, 1})
    load.value[axis] = t.field(mine.component[axis], mine.dimension).value_or(Field{});
  if (load.kind == Load::Kind::traction)
    load.edge = t.choice<Load::Edge>("edge");
  else if (t.has("edge"))
    t.refuse("edge", fmt::format("a load of kind {} has no edge", name_of(load.kind)), "", "kind = \"traction\"");
  return load;
}

}  // namespace

void read_conditions(const Table& root, Scene& s) {
  for (const Table& t : root.tables("fix", {"name", "box", "velocity_x", "velocity_y"}))
    s.fixed.push_back(read_fix(t, s.fixed.size()));
  for (const Table& t : root.tables("symmetry", {"axis", "position", "solid"}))
    s.symmetry.push_back(read_symmetry(t, s.symmetry.size()));
  for (const Table& t :
       root.tables("load", {"name", "kind", "rectangle", "disk", "polygon", "edge", "force_x", "force_y", "traction_x",
                            "traction_y", "acceleration_x", "acceleration_y"}))
    s.loads.push_back(read_load(t, s.loads.size()));
  const Table gravity = root.table("body_force", {"x", "y"});
  s.body_force[0] = gravity.function("x", dimension::acceleration);
  s.body_force[1] = gravity.function("y", dimension::acceleration);
  const Table damping = root.table("damping", {"grid", "particle"});
  const auto read_rate = [&](const char* key) {
    std::optional<TimeFunction> rate = damping.function(key, dimension::rate);
    if (rate && !rate->shape && rate->value < 0)
      damping.refuse(key, "damping that is negative drives the bodies on", "0 or more");
    return rate;
  };
  s.grid_damping = read_rate("grid");
  s.particle_damping = read_rate("particle");
}

}  // namespace riven
