// Tips of cracks in history.csv and summary.json.
#pragma once
#include <vector>

#include "core/scene/scene.hpp"
#include "core/state/cracks.hpp"
#include "core/state/tips.hpp"
#include "io/history.hpp"
#include "io/summary.hpp"

namespace riven {

/// Tips that have columns of their own in history.csv; what comes of more is in summary.json.
constexpr std::size_t most_tip_columns = 50;

inline const char* end_name(bool last) {
  return last ? "last" : "first";
}

std::vector<HistoryColumn> tip_columns(const std::vector<Tip>& tips, const Cracks& cracks);
/// What the columns say now.
void add_tip_values(const Scene& scene, const std::vector<Tip>& tips, const Cracks& cracks, std::vector<double>& row);

/// J and K of one of the scene's readings: "crack last NAME J".
std::vector<HistoryColumn> reading_columns(const FractureReading& reading, const std::vector<Tip>& tips,
                                           const Cracks& cracks);
void add_reading_values(const std::vector<Tip>& tips, std::vector<double>& row);

std::vector<Summary::Tip> summarize_tips(const Scene& scene, const std::vector<Tip>& tips, const Cracks& cracks);

}  // namespace riven
