// Plates that are pulled, held until J is steady, and then asked for J with any contour: J has no part in the motion
// of cracks that do not grow, so that one run answers for all contours and methods.
#pragma once
#include <cmath>
#include <deque>
#include <limits>

#include "tests/physics/scene_gates.hpp"

namespace riven::gates {

/// Time in which the ends of the plates move, s.
constexpr double ramp = 0.204e-3;

/// How J came to rest.
struct Rest {
  double J = 0;      ///< J/m^2
  double drift = 0;  ///< largest less smallest J within the last quarter of the ramp, over J
  double hold = 0;   ///< s, time for which the ends had been held
};

class Plate {
 public:
  explicit Plate(const std::string& scene, std::vector<std::string> settings = {}) : Plate(shipped(scene, settings)) {}
  explicit Plate(const Scene& scene) : scene_(scene), m_(scene_, space_) {
    scene_.end_time = std::numeric_limits<double>::max();  // the loads are functions of time alone
  }

  /// Holds the ends until J of the first tip changes by less than 0.1 % within a quarter of the ramp, for at most three
  /// times the ramp. With 0.3 % a plate whose halves creep to their places is taken to rest with 2 % still to go.
  Rest hold() {
    constexpr double steady = 0.001, window = ramp / 4;
    scene_.output.history_every = ramp / 40;
    std::deque<std::pair<double, double>> record;
    long seen = -1;
    for (;;) {
      m_.step();
      const Tip& tip = m_.state.tips.front();
      const double t = m_.state.clock.time;
      if (tip.step == seen || t < ramp)
        continue;
      seen = tip.step;
      record.emplace_back(t, tip.J);
      while (record.front().first < t - window * (1 + 1e-9))
        record.pop_front();
      double low = tip.J, high = tip.J;
      for (const auto& [time, J] : record) {
        low = std::min(low, J);
        high = std::max(high, J);
      }
      rest_ = {tip.J, (high - low) / std::abs(tip.J), t - ramp};
      if (t < ramp + window)
        continue;
      if (rest_.drift < steady || t > 4 * ramp)
        return rest_;
    }
  }
  const Rest& rest() const { return rest_; }

  /// J of a tip with the contour and method asked for; takes a step.
  Tip tip(int contour, JMethod method = JMethod::fijc_adaptive, size_t which = 0) {
    scene_.fracture.contour = contour;
    scene_.fracture.method = method;
    if (m_.state.clock.step == 0)
      m_.step();
    scene_.output.history_every = m_.state.clock.dt / 8;
    m_.step();
    return m_.state.tips[which];
  }

  /// Least opening of a crack's faces, m; below zero where they overlap.
  double least_opening(int crack) const {
    const Cracks& c = m_.state.cracks;
    const std::vector<CrackOpening> all = crack_openings(c);
    double least = std::numeric_limits<double>::infinity();
    for (int k = c.start[crack]; k < c.start[crack + 1]; ++k)
      least = std::min(least, all[static_cast<size_t>(k)].normal);
    return least;
  }

  Simulation& simulation() { return m_; }

 private:
  exec::Space space_{exec::Kind::serial, 1};
  Scene scene_;
  Simulation m_;
  Rest rest_;
};

/// Compares J of a tip with its reference, to within `limit` of it.
inline void expect_J(const std::string& what, double J, double reference, double limit) {
  const double off = J / reference - 1;
  report(fmt::format("{}: J = {:.1f} J/m^2 beside {:.1f}, off by", what, J, reference), off, fmt::format("{}", limit));
  EXPECT_LT(std::abs(off), limit) << what;
}

inline void print(const std::string& what, const Rest& rest) {
  fmt::print("{}: J moved by {:.2f} % in the last quarter of the ramp, after a hold of {:.2f} ramps\n", what,
             100 * rest.drift, rest.hold / ramp);
}

}  // namespace riven::gates
