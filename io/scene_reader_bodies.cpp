#include <algorithm>
#include <cctype>

#include "io/scene_reader.hpp"

namespace riven {

namespace {

constexpr int most_per_cell = 16;

Material read_material(const Table& t, size_t i) {
  Material m;
  m.name = t.text("name");
  read_name(t, "material", i);
  m.law = t.choice("law", std::optional(m.law));
  m.E = t.quantity("E", dimension::stress, range::positive);
  m.nu = t.number("nu", Range{-1, 0.5, true, true});
  m.density = t.quantity("density", dimension::density, range::positive);
  if (t.has("K_Ic"))
    m.K_Ic = t.toughness("K_Ic");
  if (t.has("J_Ic"))
    m.J_Ic = t.quantity("J_Ic", dimension::energy_release, range::positive);
  return m;
}

Body read_body(const Table& t, size_t i, const std::vector<std::string>& materials) {
  Body b;
  b.name = read_name(t, "body", i);
  b.material = static_cast<int>(t.one_of("material", materials));
  b.region = read_region(t);
  for (const Table& hole : t.tables("holes", {"rectangle", "disk", "polygon"}))
    b.holes.push_back(read_region(hole));
  b.particles_per_cell = t.integer("particles_per_cell", 1, most_per_cell, b.particles_per_cell);
  b.thickness = t.quantity("thickness", dimension::length, range::positive, b.thickness, "solver.thickness");
  b.velocity = t.vector("velocity", dimension::speed, b.velocity);
  b.velocity_field[0] = t.field("velocity_x", dimension::speed);
  b.velocity_field[1] = t.field("velocity_y", dimension::speed);
  for (const char* component : {"velocity_x", "velocity_y"})
    if (t.has(component) && t.has("velocity"))
      t.refuse(component, "the first velocity is said twice", "velocity, or velocity_x and velocity_y");
  b.spin = t.quantity("spin", dimension::angular_velocity, range::any, b.spin);
  return b;
}

Grip read_grip(const Table& t, size_t i) {
  Grip g;
  g.name = read_name(t, "grip", i);
  g.region = read_region(t);
  g.particles_per_cell = t.integer("particles_per_cell", 1, most_per_cell, g.particles_per_cell);
  g.velocity[0] = t.function("velocity_x", dimension::speed);
  g.velocity[1] = t.function("velocity_y", dimension::speed);
  if (!g.velocity[0] && !g.velocity[1])
    t.refuse(nullptr, "a grip needs a velocity", "velocity_x, velocity_y or both", "velocity_y = \"0 m/s\" holds it");
  return g;
}

}  // namespace

std::string read_name(const Table& t, const std::string& kind, size_t index) {
  constexpr size_t longest = 64;
  const std::string name = t.text("name", fmt::format("{}_{}", kind, index));
  const bool plain = std::all_of(name.begin(), name.end(),
                                 [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
  if (!plain || name.size() > longest)
    t.refuse("name", "a name has a character that it cannot have, or too many",
             fmt::format("letters, digits, _ and -, at most {}", longest));
  t.remember(kind + " " + name);
  return name;
}

Region read_region(const Table& t) {
  const int said = t.has("rectangle") + t.has("disk") + t.has("polygon");
  if (said != 1)
    t.refuse(nullptr, said == 0 ? "the region is missing" : "the region is said twice", "rectangle, disk or polygon",
             "rectangle = { lower = [\"0 mm\", \"0 mm\"], upper = [\"1 mm\", \"1 mm\"] }");
  if (t.has("polygon"))
    return Polygon{t.points("polygon", 3)};
  if (t.has("disk")) {
    const Table d = t.table("disk", {"center", "radius"});
    return Disk{d.vector("center", dimension::length), d.quantity("radius", dimension::length, range::positive)};
  }
  const Table r = t.table("rectangle", {"lower", "upper"});
  const Rectangle box{r.vector("lower", dimension::length), r.vector("upper", dimension::length)};
  if (!(box.lower.x < box.upper.x && box.lower.y < box.upper.y))
    r.refuse("upper", "the rectangle has no area", "upper greater than lower in x and y");
  return box;
}

void read_bodies(const Table& root, Scene& s) {
  const auto materials = root.tables("material", {"name", "law", "E", "nu", "density", "K_Ic", "J_Ic"});
  for (const Table& t : materials)
    s.materials.push_back(read_material(t, s.materials.size()));
  const auto names = names_of(s.materials);
  for (const Table& t :
       root.tables("body", {"name", "material", "rectangle", "disk", "polygon", "holes", "particles_per_cell",
                            "thickness", "velocity", "velocity_x", "velocity_y", "spin"}))
    s.bodies.push_back(read_body(t, s.bodies.size(), names));
  for (const Table& t :
       root.tables("grip", {"name", "rectangle", "disk", "polygon", "particles_per_cell", "velocity_x", "velocity_y"}))
    s.grips.push_back(read_grip(t, s.grips.size()));
}

}  // namespace riven
