#include "io/scene_reader.hpp"

namespace riven {

namespace {

/// The rule's own toughness; 0 where every body has a material that says it.
double read_toughness(const Table& t, GrowthCriterion criterion, const Scene& s) {
  const bool by_K = criterion == GrowthCriterion::k_max;
  if (t.has("toughness"))
    return by_K ? t.toughness("toughness") : t.quantity("toughness", dimension::energy_release, range::positive);
  const char* const own = by_K ? "K_Ic" : "J_Ic";
  for (const Body& b : s.bodies) {
    const Material& m = s.materials[static_cast<size_t>(b.material)];
    if (!((by_K ? m.K_Ic : m.J_Ic) > 0))
      t.refuse("toughness", fmt::format("missing key 'toughness', and material '{}' has no {}", m.name, own), "",
               fmt::format("add toughness = \"1 {}\", or {} to each material", by_K ? "MPa m^0.5" : "J/m^2", own));
  }
  return 0;
}

}  // namespace

std::optional<GrowthRule> read_growth(const Table& parent, const Scene& s) {
  if (!parent.has("growth"))
    return std::nullopt;
  const Table t = parent.table("growth", {"criterion", "toughness", "direction", "heading", "speed_limit"});
  GrowthRule rule;
  rule.criterion = t.choice("criterion", std::optional(rule.criterion));
  rule.toughness = read_toughness(t, rule.criterion, s);
  rule.direction = t.choice("direction", std::optional(rule.direction));
  if (rule.direction == GrowthDirection::fixed)
    rule.heading = t.heading("heading");
  else if (t.has("heading"))
    t.refuse("heading", fmt::format("the direction '{}' has no heading", name_of(rule.direction)), "",
             "direction = \"fixed\"");
  rule.speed_limit = t.quantity("speed_limit", dimension::speed, range::positive, rule.speed_limit, "Rayleigh speed");
  return rule;
}

}  // namespace riven
