#include "io/history_columns.hpp"

#include <algorithm>

#include "core/scene/names.hpp"

namespace riven {

namespace {

/// The quantities of all runs that there may be.
std::vector<HistoryColumn> all_quantities() {
  Plan plan{};
  plan.cracks = plan.fracture = plan.contact = plan.constraints = plan.tractions = true;
  plan.transfer = Transfer::fmpm;
  plan.law = LawChoice::any;
  std::vector<HistoryColumn> list = quantity_columns(plan);
  list.push_back(growth_column());
  return list;
}

}  // namespace

std::vector<Watched> watched(const Plan& plan) {
  std::vector<Watched> list{Watched::compression, Watched::expansion, Watched::velocity_difference};
  if (plan.cracks)
    list.push_back(Watched::penetration);
  return list;
}

std::vector<HistoryColumn> quantity_columns(const Plan& plan) {
  std::vector<HistoryColumn> c{{"time", "s"},
                               {"dt", "s"},
                               {"kinetic", "J"},
                               {"strain", "J"},
                               {"external_work", "J"},
                               {"damping", "J"},
                               {"contact", "J"},
                               {"numerical", "J"},
                               {"momentum_error", ""},
                               {"momentum_x", "kg m/s"},
                               {"momentum_y", "kg m/s"},
                               {"angular_momentum", "kg m^2/s"},
                               {"angular_momentum_error", ""}};
  for (const Watched which : watched(plan))
    c.push_back({std::string(name_of(which)), which == Watched::velocity_difference ? "m/s" : ""});
  if (plan.constraints)
    c.push_back({"capture", "J"});
  if (plan.transfer != Transfer::flip)
    c.push_back({"transfer", "J"});
  if (plan.anchors_strains())
    c.push_back({"anchoring", "J"});
  if (plan.tractions)
    c.insert(c.end(), {{"cohesive", "J"}, {"debonding", "J"}});
  return c;
}

bool is_quantity(const std::string& name) {
  static const std::vector<HistoryColumn> quantities = all_quantities();
  return std::any_of(quantities.begin(), quantities.end(), [&](const HistoryColumn& c) { return c.name == name; });
}

}  // namespace riven
