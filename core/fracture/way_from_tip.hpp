// How a crack leads away from its tip and out of the tip's domain: along its own points, and those of the crack that it
// ends on.
#pragma once
#include <algorithm>

#include "core/fracture/j_domain.hpp"
#include "core/math/vec.hpp"
#include "core/state/cracks.hpp"
#include "core/state/tips.hpp"

namespace riven {

struct WayFromTip {
  /// The point of the tip's crack to which it runs away from the tip: the first that is farther than all of the domain,
  /// the last that is farther than those before, or the other end. Beyond it the crack may come back.
  int until = 0;
  int host = -1;                      ///< the crack that it goes on along and out of the domain, or -1
  int host_first = 0, host_last = 0;  ///< points of that one, the first next to the end of the tip's
  int host_step = 1;                  ///< 1, or -1 where these go down

  static WayFromTip of(const Cracks& cracks, const Tip& tip, const JDomain& domain) {
    const int step = tip.last ? -1 : 1, other = cracks.end_point(tip.crack, !tip.last);
    const Walk walk{cracks, domain};
    WayFromTip way;
    double distance = 0;
    way.until = walk.from(cracks.end_point(tip.crack, tip.last), other, step, distance);
    if (way.until == other && !walk.left(other))
      for (const Junction& j : cracks.junctions)
        if (j.crack == tip.crack && j.last != tip.last && j.other != tip.crack)
          way.go_on_along(j, walk, distance);
    return way;
  }

  /// f(point) from the tip on.
  template <class F>
  void each(const Cracks& cracks, const Tip& tip, const F& f) const {
    each_between(cracks.end_point(tip.crack, tip.last), until, tip.last ? -1 : 1, f);
    if (host >= 0)
      each_between(host_first, host_last, host_step, f);
  }

 private:
  template <class F>
  static void each_between(int first, int last, int step, const F& f) {
    for (int k = first;; k += step) {
      f(k);
      if (k == last)
        return;
    }
  }

  struct Walk {
    const Cracks& cracks;
    const JDomain& domain;

    double distance2(int k) const {
      const Vec2 r = cracks.plane[k] - domain.tip;
      return dot(r, r);
    }
    bool left(int k) const { return !(domain.weight(cracks.plane[k] - domain.tip) > 0); }
    /// From point k on to the last that is farther than those before; `farthest2`: m^2, of the farthest yet.
    int from(int k, int last, int step, double& farthest2) const {
      const double x = std::max(domain.outer(right), domain.outer(Edge::left));
      const double y = std::max(domain.outer(top), domain.outer(bottom)), far2 = x * x + y * y;
      while (k != last && farthest2 < far2 && distance2(k + step) > farthest2) {
        k += step;
        farthest2 = distance2(k);
      }
      return k;
    }
  };

  void go_on_along(const Junction& j, const Walk& walk, double distance2) {
    const int segment = walk.cracks.end_point(j.other, false) + j.segment;
    for (const int step : {-1, 1}) {
      const int first = segment + (step > 0 ? 1 : 0);
      double farthest2 = walk.distance2(first);
      if (farthest2 < (1 - 1e-6) * distance2)  // the end may lie on that point
        continue;
      const int last = walk.from(first, walk.cracks.end_point(j.other, step > 0), step, farthest2);
      if (!walk.left(last))
        continue;
      host = j.other;
      host_first = first;
      host_last = last;
      host_step = step;
      return;
    }
  }
};

}  // namespace riven
