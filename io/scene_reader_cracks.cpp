#include <filesystem>

#include "io/crack_file.hpp"
#include "io/scene_reader.hpp"
#include "io/text_file.hpp"

namespace riven {

namespace {

/// A coefficient that one law needs: from the table, else from the law around it if that is the same, else missing.
/// With any other law it would have no effect, so saying it is an error.
template <class Read>
double coefficient(const Table& t, const char* key, bool needed, ContactLaw law, bool inherited, double outer,
                   Read read) {
  if (t.has(key) && !needed)
    t.refuse(key, fmt::format("the contact law '{}' has no {}", name_of(law), key), "",
             fmt::format("law = \"{}\"",
                         name_of(std::string_view(key) == "friction" ? ContactLaw::coulomb : ContactLaw::interface)));
  if (!needed)
    return 0;
  return !t.has(key) && inherited ? outer : read();
}

ContactSettings read_contact(const Table& t, const ContactSettings& outer) {
  ContactSettings c;
  c.law = t.choice("law", std::optional(outer.law));
  const bool same = c.law == outer.law, coulomb = c.law == ContactLaw::coulomb;
  const bool interface = c.law == ContactLaw::interface;
  c.friction = coefficient(t, "friction", coulomb, c.law, same && coulomb && outer.friction > 0, outer.friction,
                           [&] { return t.number("friction", range::non_negative); });
  const auto stiffness = [&](const char* key, double of_outer) {
    return coefficient(t, key, interface, c.law, same && outer.normal_stiffness > 0, of_outer,
                       [&] { return t.quantity(key, dimension::interface_stiffness, range::non_negative); });
  };
  c.normal_stiffness = stiffness("normal_stiffness", outer.normal_stiffness);
  c.shear_stiffness = stiffness("shear_stiffness", outer.shear_stiffness);
  return c;
}

void read_rules(const Table& t, ContactRules& rules) {
  rules.when = t.choice("when", std::optional(rules.when));
  rules.detection = t.choice("detection", std::optional(rules.detection));
  rules.v_sep = t.number("v_sep", range::positive, rules.v_sep);
  rules.v_contact = t.number("v_contact", range::positive, rules.v_contact);
  if (rules.v_sep > rules.v_contact)
    t.refuse(t.has("v_sep") ? "v_sep" : "v_contact", "the faces would be apart and in contact at once",
             "v_sep at most v_contact");
}

/// The cracks of a file, each named after the entry and its row.
void read_rows(const Table& t, const CrackLine& like, Scene& s) {
  const std::string file = t.text("file"), where = t.where("file");
  const std::string path = (std::filesystem::path(s.source_path).parent_path() / file).string();
  if (!s.files.contains(file))
    s.files[file] = read_text_file(path, "the crack file", where);
  for (const CrackRow& row : parse_crack_file(s.files[file], path, where)) {
    CrackLine crack = like;
    crack.name += "_" + row.label;
    crack.points = {row.from, row.to};
    s.places["crack " + crack.name] = row.where + ": crack " + crack.name;
    s.cracks.push_back(std::move(crack));
  }
}

}  // namespace

void read_cracks(const Table& root, Scene& s) {
  const Table contact = root.table(
      "contact", {"law", "friction", "normal_stiffness", "shear_stiffness", "detection", "v_sep", "v_contact", "when"});
  s.contact = read_contact(contact, s.contact);
  read_rules(contact, s.contact_rules);
  s.growth = read_growth(root, s);
  const Table motion = root.table("cracks", {"motion", "surface_update"});
  s.crack_motion = motion.choice("motion", std::optional(s.crack_motion));
  s.surface_update = motion.choice("surface_update", std::optional(s.surface_update));
  size_t entry = 0;
  for (const Table& t : root.tables(
           "crack", {"name", "points", "origin", "file", "resolution", "contact", "traction", "growth", "grows"})) {
    CrackLine crack;
    crack.name = read_name(t, "crack", entry++);
    crack.resolution = t.quantity("resolution", dimension::length, range::positive, crack.resolution, "particle size");
    if (t.has("contact"))
      crack.contact =
          read_contact(t.table("contact", {"law", "friction", "normal_stiffness", "shear_stiffness"}), s.contact);
    if (t.has("traction"))
      crack.traction = read_traction(
          t.table("traction", {"kind", "rectangle", "disk", "polygon", "pressure", "strength", "toughness",
                               "shear_strength", "shear_toughness", "peak", "knee", "knee_strength", "decay"}));
    crack.growth = read_growth(t, s);
    crack.grows = t.flag("grows", true);
    if (crack.growth && !crack.grows)
      t.refuse("grows", "the crack has a rule for its growth and does not grow", "growth or grows = false");
    if (t.has("points") == t.has("file"))
      t.refuse(nullptr, t.has("file") ? "the crack has points and a file" : "the crack has no points", "points or file",
               "points = [[\"0 mm\", \"5 mm\"], [\"10 mm\", \"5 mm\"]]");
    if (t.has("file")) {
      if (t.has("origin"))
        t.refuse("origin", "a file says where its cracks are", "", "leave it out, or give points");
      read_rows(t, crack, s);
    } else {
      crack.points = t.points("points", 2);
      const Vec2 origin = t.vector("origin", dimension::length, {0, 0});
      for (Vec2& point : crack.points)
        point += origin;
      s.cracks.push_back(std::move(crack));
    }
  }
}

}  // namespace riven
