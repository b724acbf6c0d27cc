#include "io/scene_reader.hpp"

namespace riven {

std::optional<GrowthRule> read_growth(const Table& parent) {
  if (!parent.has("growth"))
    return std::nullopt;
  const Table t = parent.table("growth", {"criterion", "toughness", "direction", "heading", "speed_limit"});
  GrowthRule rule;
  rule.criterion = t.choice("criterion", std::optional(rule.criterion));
  rule.toughness = rule.criterion == GrowthCriterion::k_max
                       ? t.toughness("toughness")
                       : t.quantity("toughness", dimension::energy_release, range::positive);
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
