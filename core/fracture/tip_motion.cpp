#include "core/fracture/tip_motion.hpp"

#include <algorithm>
#include <cmath>

namespace riven {

namespace {

constexpr double memory = 2;  ///< cells of its way that a tip goes by
/// Of the speed of waves, beyond which what a tip meets is not read well; at that speed itself none would ever slow.
constexpr double told_to = 0.9;

constexpr double most_offered = 2;   ///< what a tip is offered at most, over its release of the moment
constexpr double beyond_swings = 4;  ///< of their root mean square: what a tip at rest has not met before

/// What a tip takes its release for now.
double expected(const TipWay& way) {
  return 2 * way.mean[0] - way.mean[1];
}

/// It has met `release` in the mean since it was known last.
void recall(TipWay& way, double release, double memory, double now) {
  const double part = -std::expm1((way.known - now) / memory);
  way.mean[0] += part * (release - way.mean[0]);
  way.mean[1] += part * (way.mean[0] - way.mean[1]);
  way.known = now;
}

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

void start(TipWay& way, double release, double now) {
  if (way.known == 0)
    way.mean[0] = way.mean[1] = release;
  way.time = way.release = way.length = way.ahead = 0;
  way.seen = way.known = now;
}

void stop(TipWay& way, double toughness, double memory, double now) {
  if (way.time > 0)
    recall(way, mean_release(way), memory, now);
  if (expected(way) > toughness)  // what set it running long before is over
    way.mean[0] = way.mean[1] = toughness;
}

double offered_at_rest(TipWay& way, double release, double memory, double now) {
  const double off = std::max(0., release - expected(way));
  const bool news = off > beyond_swings * std::sqrt(way.swing);
  way.swing += -std::expm1((way.known - now) / memory) * (off * off - way.swing);
  recall(way, release, memory, now);
  return news ? release : std::clamp(expected(way), 0., most_offered * std::max(0., release));
}

}  // namespace riven
