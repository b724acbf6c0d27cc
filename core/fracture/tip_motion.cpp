#include "core/fracture/tip_motion.hpp"

#include <algorithm>
#include <cmath>

namespace riven {

namespace {

constexpr double memory = 2;  ///< cells of its way that a tip goes by
/// Of the speed of waves, beyond which what a tip meets is not read well; at that speed itself none would ever slow.
constexpr double told_to = 0.9;

}  // namespace

void follow(TipWay& way, double release, double now) {
  const double since = now - way.seen;
  way.time += since;
  way.release += since * release;
  way.seen = now;
}

void pass(TipWay& way, double segment, double cell) {
  const double kept = std::exp(-segment / (memory * cell));
  way.time *= kept;
  way.release *= kept;
  way.length = kept * way.length + segment;
  // checks do not come exactly when the tip has gone by a segment
  way.ahead = std::max(way.ahead - segment, -0.5 * segment);
}

double mean_release(const TipWay& way) {
  return way.release / way.time;
}

double running_speed(const TipWay& way, double load, double wave, double limit) {
  if (!(load > 0))
    return 0;
  const double speed = std::min(way.length / way.time, told_to * wave);
  return std::clamp(wave - (wave - speed) / (load * load), 0.0, limit);
}

}  // namespace riven
