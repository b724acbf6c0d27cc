// How fast a tip runs, by the energy release rate that it meets on its way.
//
// Where a tip at rest would be offered G_0, one that runs with speed v takes up
//   G = g(v) G_0,   g(v) ~ 1 - v / c_R,
// c_R being the Rayleigh speed, and it runs as fast as lets G be its toughness Gamma (Freund, Dynamic Fracture
// Mechanics, 1990, sections 6.4 and 7.4). G_0 is known in an unbounded solid alone; but a tip that has run with v of
// late, and has taken up G, would take up Gamma at the speed v' of
//   1 - v' / c_R = (1 - v / c_R) Gamma / G,
// and where v' = v the release is the toughness, whatever g is. G swings by 40 % and more with each cell that a tip
// opens, so G and v are means over the last cells of its way, in time, each cell weighing exp(-1 / memory) of the next.
// Of a tip that grows whenever its release, by itself or as a mean since it grew last, is above the toughness the
// swings choose the times: it takes up 1.2 to 1.3 times its toughness.
//
// A step wave on a half-plane crack in an unbounded solid, where dl/dt = g^-1(Gamma / G_0(t)) is known, on a way of 4.5
// mm (18 cells) at up to 0.75 c_R: within 0.2 to 0.4 mm all along, as the means lag, and 0.3 mm at the end, with
// contours of 4 and 8 cells, 2 to 4 particles along a cell, cells of 0.25 and 0.5 mm, half the time step, FLIP, FMPM(2)
// and FMPM(4). In strips that hold 1.08 and 1.25 of the toughness (Marder, Phys. Rev. Lett. 66 (1991) 2484-2487) the
// tip gathers speed as it should within 7 and 1 %.
//
// A tip that has stopped goes by its release as it forgets in time. Each segment shakes the specimen, and a tip that
// started anew whenever the release of a moment is above the toughness would take up less than that in slow stable
// growth. By the mean it is 0.95 to 1.02 after some segments in a double cantilever beam whose arms are drawn apart at
// 10 and 20 mm/s, and 0.9 to 1.05 at 40 (cells of 1 mm). That is a mean of means,
//   m' = (G - m) / T,   n' = (m - n) / T,   2 m - n,
// which lags behind no load that rises steadily. What is beyond all swings so far, such as a wave, counts at once. A
// tip is offered no more than twice its release of the moment: one that has been let go altogether stays where it is.
#pragma once
#include "core/state/tips.hpp"

namespace riven {

/// The tip has met `release` (J/m^2) from when it was followed last until `now` (s).
void follow(TipWay& way, double release, double now);

/// Its crack has grown by a segment (m) on a grid of the given cell size.
void pass(TipWay& way, double segment, double cell);

/// J/m^2, what it has met on the last cells of its way; not known before it has been followed.
double mean_release(const TipWay& way);

/// The speed at which the tip would take up its toughness, m/s: 0 to `limit`. `load`: root of what it has met over that
/// (growth_load); `wave`: the Rayleigh speed, or a greater one by which it is to be limited.
double running_speed(const TipWay& way, double load, double wave, double limit);

/// The tip begins to run.
void start(TipWay& way, double release, double now);

/// It stops, as it is offered less than `toughness` (J/m^2). A tip at rest forgets within `memory` (s).
void stop(TipWay& way, double toughness, double memory, double now);

/// J/m^2, what drives a tip that has stopped and meets `release`: without what swings, unless it is beyond that.
double offered_at_rest(TipWay& way, double release, double memory, double now);

}  // namespace riven
