// Readers of the parts of a scene; each takes the root table and fills its members of the Scene. Later parts refer to
// earlier ones by name: the order is that of this file.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "io/keys.hpp"

namespace riven {

void read_solver(const Table& root, Scene& s);      ///< [solver], [grid], [limits]
void read_bodies(const Table& root, Scene& s);      ///< [[material]], [[body]], [[grip]]
void read_conditions(const Table& root, Scene& s);  ///< [[fix]], [[symmetry]], [[load]], [body_force], [damping]
void read_cracks(const Table& root, Scene& s);      ///< [contact], [growth], [cracks], [[crack]]
void read_fracture(const Table& root, Scene& s);    ///< [fracture]
void read_output(const Table& root, Scene& s);      ///< [output], [[probe]]

/// The table `growth` of this one, if there is one; its toughness may be that of the materials of all bodies.
std::optional<GrowthRule> read_growth(const Table& t, const Scene& s);

/// [crack.traction]
TractionSettings read_traction(const Table& t);

/// The one of rectangle, disk and polygon that the table has.
Region read_region(const Table& t);

/// The entry's `name`, or "kind_index"; remembers its place as "kind name".
std::string read_name(const Table& t, const std::string& kind, size_t index);

/// Names of the parts, for choices among them.
template <class Part>
std::vector<std::string> names_of(const std::vector<Part>& parts) {
  std::vector<std::string> names;
  names.reserve(parts.size());
  for (const Part& p : parts)
    names.push_back(p.name);
  return names;
}

}  // namespace riven
