// Cracks: polylines of massless particles, all cracks flattened into one set of arrays.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/exec/array.hpp"
#include "core/laws/traction.hpp"
#include "core/math/vec.hpp"
#include "core/scene/scene.hpp"

namespace riven {

/// The end of a crack that has joined another, or itself: a point of that crack's plane, with which it moves.
struct Junction {
  int crack = 0;
  bool last = false;  ///< which end of it
  int other = 0;      ///< the crack on which it lies
  int segment = 0;    ///< of that crack, counted from its first point
  double along = 0;   ///< from 0 to 1 between the ends of that segment
};

/// What the faces of one crack bear.
struct CrackTraction {
  TimeFunction pressure;
  TractionLaw law;
};

/// Crack c owns the points [start[c], start[c+1]); its segments join neighbouring points. Walking from the
/// first point to the last, "above" is the left-hand side: the signed area (p, a, b) of a particle p above the
/// segment a-b is positive. The normal points from above to below (Nairn 2003, section 2.2).
struct Cracks {
  std::vector<std::string> names;
  exec::Array<ContactSettings> contact;              ///< law of each crack
  exec::Array<int> start = exec::Array<int>(1);      ///< [cracks + 1]
  exec::Array<int> crack;                            ///< [points] which crack a point belongs to
  exec::Array<int> serial;                           ///< [points] in order of their making: stays with a point
  exec::Array<Vec2> plane;                           ///< [points] crack plane
  exec::Array<Vec2> upper, lower;                    ///< [points] surface positions, above and below
  exec::Array<Vec2> upper_velocity, lower_velocity;  ///< [points] XPIC(1) only
  bool velocities_known = false;                     ///< set by the first move; until then surfaces start with the grid
  exec::Array<Vec2> plane0;                          ///< [points] where the plane was when the point was made
  exec::Array<Vec2> density;  ///< [points] kg/m^3, above (x) and below (y); empty where bodies have the same
  exec::Array<Vec2> gap;      ///< [points] m, to the solids above (x) and below (y) at first (first_gaps.hpp)
  /// [points] of the segment that starts at a point: jump of displacement across an imperfect interface, along the
  /// segment's normal and along the segment, m (contact law `interface` only)
  exec::Array<Vec2> jump;
  exec::Array<double> in_solid;  ///< [points] share of that segment that lies in a body at first (`interface` only)
  std::vector<Junction> junctions;
  exec::Array<std::uint8_t> open;  ///< [2 cracks] first and last ends: 1 for tips seen so (crack_path.hpp)

  // tractions on faces; see tractions.hpp
  std::vector<CrackTraction> traction;    ///< of each crack; none where the plan has no tractions
  double lead = 0;                        ///< s, by which laws see the surfaces ahead (tractions.hpp)
  exec::Array<CohesiveHistory> cohesive;  ///< [points]; a point that is added starts with zeros
  exec::Array<Vec2> bearing;              ///< [points] thickness that bears the tractions, m, as a mean over
                                          ///< the half segments before (x) and after (y) the point

  /// The point at an end of a crack, and the one next to it.
  int end_point(int c, bool last) const { return last ? start[c + 1] - 1 : start[c]; }
  int next_to_end(int c, bool last) const { return end_point(c, last) + (last ? -1 : 1); }

  bool is_open(int c, bool last) const { return open[2 * c + last] != 0; }
  void set_open(int c, bool last, bool is) { open[2 * c + last] = is; }

  int count() const { return static_cast<int>(names.size()); }
  int points() const { return start[count()]; }

  /// f(array) for every array that holds one entry per point and exists; f takes them const or not, as the cracks are.
  template <class F>
  void each_point_array(F&& f) {
    each_point_array(*this, f);
  }
  template <class F>
  void each_point_array(F&& f) const {
    each_point_array(*this, f);
  }

 private:
  template <class Self, class F>
  static void each_point_array(Self& self, F&& f) {
    const auto some = [&](auto& a) {
      if (!a.empty())
        f(a);
    };
    some(self.crack);
    some(self.serial);
    for (auto* a : {&self.plane, &self.upper, &self.lower, &self.upper_velocity, &self.lower_velocity, &self.plane0,
                    &self.density, &self.gap, &self.jump})
      some(*a);
    some(self.in_solid);
    some(self.cohesive);
    some(self.bearing);
  }
};

/// Cuts each line of the scene into equal segments no longer than its resolution (m; where it says none,
/// `default_resolution`), keeping the given points unless they crowd on it, and lays the surfaces on it.
/// Throws Error (bad input) for a line without length.
Cracks make_cracks(const Scene& scene, double default_resolution);

}  // namespace riven
