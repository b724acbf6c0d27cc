// Which segments of cracks come near to which places of the lattice.
#pragma once
#include <cmath>

#include "core/exec/atomic.hpp"
#include "core/exec/scan.hpp"
#include "core/exec/sort_few.hpp"
#include "core/state/crack_fields.hpp"
#include "core/state/cracks.hpp"
#include "core/state/grid.hpp"

namespace riven {

/// For lattice place (i, j) the box [i + lower, i + upper] x [j + lower, j + upper], in cells.
struct Reach {
  double lower, upper;
  int border;  ///< places this near to the edge of the lattice are left out
};

/// A CSR of the segments whose distance to the box of a place is within the margin.
struct Bins {
  exec::Array<int>& index;    ///< [nodes] position in the lists, or -1
  exec::Array<int>& place;    ///< ascending
  exec::Array<int>& start;    ///< [places + 1]
  exec::Array<int>& segment;  ///< ascending within a place
};

inline namespace RIVEN_SIDE {

namespace detail {

/// The places that each segment comes near to.
struct PlacesOfSegment {
  Lattice lattice;
  const int* crack;
  const Vec2* point;
  Reach reach;

  /// f(place) for every place whose box meets segment k.
  template <class F>
  RIVEN_FN void each(long k, const F& f) const {
    if (crack[k] != crack[k + 1])
      return;
    const Vec2 a = in_cells(k), b = in_cells(k + 1), d = b - a;
    const double lower = reach.lower - CrackFields::margin, upper = reach.upper + CrackFields::margin;
    const int i0 = first(a.x < b.x ? a.x : b.x, upper), i1 = last(a.x < b.x ? b.x : a.x, lower, lattice.nx);
    const int j0 = first(a.y < b.y ? a.y : b.y, upper), j1 = last(a.y < b.y ? b.y : a.y, lower, lattice.ny);
    const double center = (lower + upper) / 2, reach_across = (upper - lower) / 2 * (std::fabs(d.x) + std::fabs(d.y));
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i)
        if (std::fabs(cross(d, Vec2{i + center, j + center} - a)) <= reach_across)
          f(j * lattice.nx + i);
  }

 private:
  RIVEN_FN Vec2 in_cells(long k) const { return (point[k] - lattice.origin) * (1 / lattice.h); }
  RIVEN_FN int first(double x, double upper) const {
    const int least = static_cast<int>(std::ceil(x - upper));
    return least < reach.border ? reach.border : least;
  }
  RIVEN_FN int last(double x, double lower, int n) const {
    const int most = static_cast<int>(std::floor(x - lower));
    return most > n - 1 - reach.border ? n - 1 - reach.border : most;
  }
};

/// Places that are used, and segments listed, up to a place.
struct PlacesUsed {
  int places = 0, segments = 0;
  RIVEN_FN PlacesUsed& operator+=(const PlacesUsed& o) { return places += o.places, segments += o.segments, *this; }
};

}  // namespace detail

/// All numbers become -1.
inline void fill_with_none(const exec::Space& space, exec::Array<int>& numbers, long n) {
  numbers.renew(n);
  exec::launch_some(space, n, exec::chunk, [at = exec::data_to_fill(numbers)] RIVEN_KERNEL(long i) { at[i] = -1; });
}

/// Fills `bins` with the segments between points (m) as the cracks join them.
inline void fill_bins(const exec::Space& space, const Lattice& lattice, const Cracks& cracks,
                      const exec::Array<Vec2>& points, Reach reach, Bins bins) {
  constexpr long segments_of_task = 64, places_of_task = 1024;
  const long nodes = lattice.nodes(), segments = points.empty() ? 0 : points.size() - 1;
  const detail::PlacesOfSegment places{lattice, exec::data(cracks.crack), exec::data(points), reach};
  fill_with_none(space, bins.index, nodes);
  int* const index = exec::data(bins.index);
  exec::launch_some(space, segments, segments_of_task,
                    [=] RIVEN_KERNEL(long k) { places.each(k, [&](int p) { exec::atomic_add(index[p], 1); }); });

  // index + 1 is now the count of each place
  const auto used = exec::begin_scan<detail::PlacesUsed>(space, nodes, [=] RIVEN_KERNEL(long p) {
    return detail::PlacesUsed{index[p] >= 0, index[p] + 1};
  });
  const int listed = used.total.places, total = used.total.segments;
  bins.place.renew(listed);
  bins.start.renew(listed + 1);
  bins.segment.renew(total);
  exec::Array<int> ends(listed);
  int *const place = exec::data_to_fill(bins.place), *const start = exec::data_to_fill(bins.start),
             *const segment = exec::data_to_fill(bins.segment), *const end = exec::data_to_fill(ends);
  exec::end_scan(used, [=] RIVEN_KERNEL(long p, const detail::PlacesUsed& before) {
    const int here = index[p] + 1;
    if (here == 0)
      return detail::PlacesUsed{};
    place[before.places] = static_cast<int>(p);
    start[before.places] = end[before.places] = before.segments;
    index[p] = before.places;
    return detail::PlacesUsed{1, here};
  });
  exec::launch(space, 1, [=] RIVEN_KERNEL(long) { start[listed] = total; });
  exec::launch_some(space, segments, segments_of_task, [=] RIVEN_KERNEL(long k) {
    places.each(k, [&](int p) { segment[exec::atomic_add(end[index[p]], 1)] = static_cast<int>(k); });
  });
  exec::launch_some(space, listed, places_of_task,
                    [=] RIVEN_KERNEL(long u) { exec::sort_few(segment + start[u], segment + start[u + 1]); });
}

}  // namespace RIVEN_SIDE

}  // namespace riven
