#include <algorithm>

#include "io/scene_reader.hpp"

namespace riven {

namespace {

/// What is not said stays as it is in `f`.
void read_rules(const Table& t, FractureRules& f) {
  f.method = t.choice("method", std::optional(f.method));
  f.contour = t.integer("contour", 2, 1000, f.contour);
  if (f.contour % 2 != 0)
    t.refuse("contour", fmt::format("a contour of {} cells has no node in its middle", f.contour), "an even number",
             fmt::format("contour = {}", f.contour + 1));
  f.area = t.choice("area_integral", std::optional(f.area));
  f.interaction = t.flag("interaction_integral", f.interaction);
}

}  // namespace

void read_fracture(const Table& root, Scene& s) {
  FractureRules& f = s.fracture;
  f.asked = root.has("fracture");
  const Table t = root.table("fracture", {"method", "contour", "area_integral", "interaction_integral", "reading"});
  if (!f.asked)
    return;
  if (s.cracks.empty())
    root.refuse("fracture", "there is no crack whose J could be found", "", "leave the table out, or add a [[crack]]");
  read_rules(t, f);
  for (const Table& r : t.tables("reading", {"name", "method", "contour", "area_integral", "interaction_integral"})) {
    FractureReading reading{r.text("name"), f};
    read_rules(r, reading.rules);
    if (std::any_of(s.readings.begin(), s.readings.end(), [&](const auto& q) { return q.name == reading.name; }))
      r.refuse("name", "two readings have this name", "a name of its own for each");
    s.readings.push_back(std::move(reading));
  }
}

}  // namespace riven
