#include "io/scene_reader.hpp"

namespace riven {

void read_fracture(const Table& root, Scene& s) {
  FractureRules& f = s.fracture;
  f.asked = root.has("fracture");
  const Table t = root.table("fracture", {"method", "contour", "area_integral", "interaction_integral"});
  if (!f.asked)
    return;
  if (s.cracks.empty())
    root.refuse("fracture", "there is no crack whose J could be found", "", "leave the table out, or add a [[crack]]");
  f.method = t.choice("method", std::optional(f.method));
  f.contour = t.integer("contour", 2, 1000, f.contour);
  if (f.contour % 2 != 0)
    t.refuse("contour", fmt::format("a contour of {} cells has no node in its middle", f.contour), "an even number",
             fmt::format("contour = {}", f.contour + 1));
  f.area = t.choice("area_integral", std::optional(f.area));
  f.interaction = t.flag("interaction_integral", f.interaction);
}

}  // namespace riven
