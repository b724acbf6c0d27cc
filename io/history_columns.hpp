// What the columns of history.csv are called that no probe names.
#pragma once
#include <string>
#include <vector>

#include "core/plan/plan.hpp"
#include "io/history.hpp"

namespace riven {

/// The watched figures with a column of their own; energy and momentum are among the ledger's.
std::vector<Watched> watched(const Plan& plan);

/// Time and the quantities of a run as a whole; the energy of growth comes behind those of grips.
std::vector<HistoryColumn> quantity_columns(const Plan& plan);
inline HistoryColumn growth_column() {
  return {"fracture", "J"};
}

/// Is this the name of a quantity that some runs have? Those of grips and tips have spaces, which names in scenes have
/// not.
bool is_quantity(const std::string& name);

}  // namespace riven
