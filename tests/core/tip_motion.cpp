// How fast tips run, against the equation of motion that the law comes from.
#include "core/fracture/tip_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace riven {
namespace {

constexpr double wave = 900, cell = 1e-3, segment = 0.5e-3;

/// The way of a tip, in steady motion with the given speed and release, by checks of the given interval.
TipWay steady(double speed, double release, double interval) {
  TipWay way;
  double now = 0, at = 0;
  for (int k = 0; k < 400; ++k) {
    now += interval;
    at += speed * interval;
    follow(way, release, now);
    for (; at >= segment; at -= segment)
      pass(way, segment, cell);
  }
  return way;
}

TEST(TipMotion, KeepsASpeedAtWhichTheToughnessIsTakenUp) {
  for (const double speed : {90., 450., 800.}) {
    const TipWay way = steady(speed, 120, 0.05e-6);
    EXPECT_NEAR(mean_release(way), 120, 1e-9);
    EXPECT_NEAR(running_speed(way, 1, wave, wave), speed, 0.13 * speed);  // as it is between two segments
  }
}

TEST(TipMotion, GoesToTheSpeedAtWhichTheReleaseWouldBeTheToughness) {
  const TipWay way = steady(300, 120, 0.01e-6);
  const double speed = way.length / way.time;
  // 1 - v' / c = (1 - v / c) / load^2
  EXPECT_NEAR(running_speed(way, std::sqrt(2.), wave, wave), wave - (wave - speed) / 2, 1e-9);
  EXPECT_NEAR(running_speed(way, std::sqrt(0.9), wave, wave), wave - (wave - speed) / 0.9, 1e-9);
  EXPECT_EQ(running_speed(way, std::sqrt(0.5), wave, wave), 0);
  EXPECT_EQ(running_speed(way, 0, wave, wave), 0);
  EXPECT_EQ(running_speed(way, 2, wave, 200), 200);
  EXPECT_LT(running_speed(way, 1e6, wave, wave), wave + 1e-9);
}

// dl/dt = c (1 - Gamma / G_0), G_0 Gamma (1 + t / T): l = c (t - T log(1 + t / T)), a tip that swings by half with
// each cell.
TEST(TipMotion, FollowsTheEquationOfMotionThroughSwings) {
  constexpr double T = 4e-6, step = 0.02e-6;
  TipWay way;
  double at = 0, now = 0, grew = 0, speed = 0;
  while (now < 20e-6) {
    now += step;
    const double offered = 1 + now / T, swing = 1 + 0.5 * std::sin(2 * std::numbers::pi * at / cell);
    follow(way, (1 - speed / wave) * offered * swing, now);
    const double on = step * running_speed(way, std::sqrt(mean_release(way)), wave, wave);
    way.ahead += on;
    if (way.ahead + 0.5 * on >= segment) {
      at += segment;
      pass(way, segment, cell);
      speed = segment / (now - grew);
      grew = now;
    }
  }
  EXPECT_NEAR(at, wave * (now - T * std::log1p(now / T)), 1.5 * cell);
}

// A load that rises steadily and shakes: the tip goes by what rises.
TEST(TipMotion, GoesByWhatRisesAtRestAndNotByWhatSwings) {
  constexpr double step = 2e-6, forgets = 220e-6, period = 90e-6;
  TipWay way;
  start(way, 50, step);
  double worst = 0, now = step, offered = 0;
  while (now < 5e-3) {
    now += step;
    const double rises = 50 + 1e4 * now;
    offered = offered_at_rest(way, rises + 15 * std::sin(2 * std::numbers::pi * now / period), forgets, now);
    if (now > 2e-3)
      worst = std::max(worst, std::abs(offered - rises));
  }
  EXPECT_LT(worst, 3.5);
  // a wave
  now += step;
  EXPECT_EQ(offered_at_rest(way, 250, forgets, now), 250);
  // nothing is offered by a tip that shuts
  for (int k = 0; k < 1000; ++k)
    offered = offered_at_rest(way, -20, forgets, now += step);
  EXPECT_EQ(offered, 0);
}

TEST(TipMotion, RecallsTheMeanOfItsWayOnceItStops) {
  TipWay way;
  start(way, 80, 1e-6);
  follow(way, 100, 501e-6);
  TipWay at_once = way, later = way;
  stop(at_once, 200, 10e-6, 501e-6);
  EXPECT_NEAR(offered_at_rest(at_once, 100, 10e-6, 501.1e-6), 100, 1e-6);
  stop(later, 200, 10e-3, 501e-6);  // hardly longer than it has known since it started
  EXPECT_NEAR(later.mean[0], 80 + 20 * -std::expm1(-0.05), 1e-9);
  TipWay blind;  // never followed
  start(blind, 80, 1e-6);
  stop(blind, 200, 10e-6, 20e-6);
  EXPECT_EQ(blind.mean[0], 80);
  // what set it running is over
  stop(later = way, 60, 10e-3, 501e-6);
  EXPECT_LE(offered_at_rest(later, 30, 10e-3, 502e-6), 60);
  EXPECT_EQ(offered_at_rest(later, 70, 10e-3, 503e-6), 70);
}

TEST(TipMotion, OffersLittleToATipThatIsLetGo) {
  TipWay way;
  start(way, 300, 1e-6);
  follow(way, 330, 21e-6);
  stop(way, 333, 200e-6, 21e-6);
  EXPECT_NEAR(offered_at_rest(way, 5, 200e-6, 22e-6), 10, 1e-12);
  EXPECT_EQ(offered_at_rest(way, -5, 200e-6, 23e-6), 0);
}

// At the speed of waves itself 1 - v / c vanishes.
TEST(TipMotion, SlowsFromTheSpeedOfWavesWhereLittleDrivesIt) {
  const TipWay way = steady(wave, 120, 0.01e-6);
  EXPECT_NEAR(running_speed(way, 1, wave, wave), 0.9 * wave, 1e-9);
  EXPECT_EQ(running_speed(way, 0.3, wave, wave), 0);
}

TEST(TipMotion, ForgetsWhatLiesCellsBehind) {
  TipWay way = steady(300, 120, 0.01e-6);
  for (int k = 0; k < 40; ++k) {
    follow(way, 60, way.seen + segment / 300);
    pass(way, segment, cell);
  }
  EXPECT_NEAR(mean_release(way), 60, 0.01);
  EXPECT_GE(way.ahead, -0.5 * segment);
}

}  // namespace
}  // namespace riven
