#include "io/tip_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/fracture/growth.hpp"
#include "core/state/make_tips.hpp"

namespace riven {

namespace {

std::size_t shown_tips(const std::vector<Tip>& tips) {
  return std::min(tips.size(), most_tip_columns);
}

std::string name_of(const Tip& tip, const Cracks& cracks) {
  return cracks.names[static_cast<std::size_t>(tip.crack)] + " " + end_name(tip.last) + " ";
}

/// How near a tip is to growth; 0 where there is none any more. For one that has grown: at its last check.
double load_of(const Scene& scene, const Tip& t) {
  if (!t.open || !t.grows)
    return 0;
  return t.length > 0 ? t.load : growth_load(growth_rule_at(scene, t), t);
}

}  // namespace

std::vector<HistoryColumn> tip_columns(const std::vector<Tip>& tips, const Cracks& cracks) {
  std::vector<HistoryColumn> columns;
  for (std::size_t i = 0; i < shown_tips(tips); ++i) {
    const std::string tip = name_of(tips[i], cracks);
    columns.insert(columns.end(), {{tip + "x", "m"},
                                   {tip + "y", "m"},
                                   {tip + "length", "m"},
                                   {tip + "J", "J/m^2"},
                                   {tip + "K_I", "Pa m^0.5"},
                                   {tip + "K_II", "Pa m^0.5"},
                                   {tip + "speed", "m/s"}});
    if (tips[i].grows)
      columns.push_back({tip + "load", ""});
  }
  return columns;
}

void add_tip_values(const Scene& scene, const std::vector<Tip>& tips, const Cracks& cracks, std::vector<double>& row) {
  for (std::size_t i = 0; i < shown_tips(tips); ++i) {
    const Tip& t = tips[i];
    const Vec2 x = cracks.plane[cracks.end_point(t.crack, t.last)];
    row.insert(row.end(), {x.x, x.y, t.length, t.J, t.K_I, t.K_II, t.speed});
    if (t.grows)
      row.push_back(load_of(scene, t));
  }
}

std::vector<HistoryColumn> reading_columns(const FractureReading& reading, const std::vector<Tip>& tips,
                                           const Cracks& cracks) {
  std::vector<HistoryColumn> columns;
  for (std::size_t i = 0; i < shown_tips(tips); ++i) {
    const std::string tip = name_of(tips[i], cracks) + reading.name + " ";
    columns.insert(columns.end(), {{tip + "J", "J/m^2"}, {tip + "K_I", "Pa m^0.5"}, {tip + "K_II", "Pa m^0.5"}});
  }
  return columns;
}

void add_reading_values(const std::vector<Tip>& tips, std::vector<double>& row) {
  for (std::size_t i = 0; i < shown_tips(tips); ++i)
    row.insert(row.end(), {tips[i].J, tips[i].K_I, tips[i].K_II});
}

std::vector<Summary::Tip> summarize_tips(const Scene& scene, const std::vector<Tip>& tips, const Cracks& cracks) {
  std::vector<Summary::Tip> list;
  for (const Tip& t : tips) {
    const Vec2 x = cracks.plane[cracks.end_point(t.crack, t.last)];
    Summary::Tip s;
    s.crack = cracks.names[static_cast<std::size_t>(t.crack)];
    s.end = end_name(t.last);
    s.state = !t.open ? "closed" : t.running ? "running" : "resting";
    s.x = x.x;
    s.y = x.y;
    s.length = t.length;
    s.J = t.J;
    s.J1 = t.J1;
    s.J2 = t.J2;
    s.K_I = t.K_I;
    s.K_II = t.K_II;
    s.O_I = t.O_I;
    s.O_II = t.O_II;
    s.M_I = t.M_I;
    s.M_II = t.M_II;
    s.speed = t.speed;
    s.load = load_of(scene, t);
    if (t.step >= 0)
      s.contour = fmt::format("{:.3g} x {:.3g} cells", t.reach[0] + t.reach[2], t.reach[1] + t.reach[3]);
    s.adapted = t.adapted;
    list.push_back(s);
  }
  return list;
}

}  // namespace riven
