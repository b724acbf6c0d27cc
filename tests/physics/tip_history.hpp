// What tests of J and K over time share: a run that keeps what was found at the tips, and running means of it.
#pragma once
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "core/scene/schedule.hpp"
#include "tests/physics/scene_gates.hpp"
#include "tests/spaces.hpp"

namespace riven::gates {

struct TipRow {
  double time = 0;  ///< s, of the row in the history
  std::vector<Tip> tips;
};
using TipHistory = std::vector<TipRow>;

/// Runs a scene and keeps its tips at every row of the history: one history for each set of rules, all found in the
/// same steps.
inline std::vector<TipHistory> run_with(Scene scene, const std::vector<FractureRules>& rules) {
  for (const FractureRules& r : rules)
    scene.readings.push_back({"", r});
  const test::ChosenSpace space;
  Simulation m(scene, space);
  std::vector<TipHistory> histories(rules.size());
  const Clock& c = m.state.clock;
  while (!m.finished()) {
    const double before = c.time;
    m.step();
    if (report_due(scene, before, c.time))
      for (size_t k = 0; k < rules.size(); ++k)
        histories[k].push_back({c.time, m.state.readings[k]});
  }
  return histories;
}

inline TipHistory run_tips(const Scene& scene) {
  return run_with(scene, {scene.fracture})[0];
}

/// A curve through points, straight between them.
class Curve {
 public:
  void add(double t, double y) {
    integral_.push_back(t_.empty() ? 0 : integral_.back() + 0.5 * (y + y_.back()) * (t - t_.back()));
    t_.push_back(t);
    y_.push_back(y);
  }
  double operator()(double t) const {
    const size_t i = before(t);
    return y_[i] + (y_[i + 1] - y_[i]) * (t - t_[i]) / (t_[i + 1] - t_[i]);
  }
  /// Mean from t - width / 2 to t + width / 2.
  double mean(double t, double width) const { return (integral(t + width / 2) - integral(t - width / 2)) / width; }

 private:
  size_t before(double t) const {
    const auto at = std::upper_bound(t_.begin(), t_.end() - 1, t) - t_.begin();
    return static_cast<size_t>(std::max<std::ptrdiff_t>(1, at)) - 1;
  }
  double integral(double t) const {
    const size_t i = before(t);
    return integral_[i] + 0.5 * (y_[i] + (*this)(t)) * (t - t_[i]);
  }
  std::vector<double> t_, y_, integral_;
};

/// One quantity of one tip over time.
inline Curve curve(const TipHistory& history, size_t tip, const std::function<double(const Tip&)>& of) {
  Curve c;
  for (const TipRow& row : history)
    c.add(row.time, of(row.tips[tip]));
  return c;
}

/// Two columns of a file with one line of headings, the first in us.
inline Curve reference(const std::string& name) {
  std::ifstream in(std::string(RIVEN_SOURCE_DIR "/tests/physics/") + name);
  EXPECT_TRUE(in) << name;
  Curve c;
  std::string line;
  std::getline(in, line);
  double t = 0, y = 0;
  char comma = 0;
  while (in >> t >> comma >> y)
    c.add(1e-6 * t, y);
  return c;
}

}  // namespace riven::gates
