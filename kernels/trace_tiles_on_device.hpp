// trace_tiles.hpp on a device: a team takes a tile, and each of its threads one particle after the other.
#pragma once
#include "core/exec/parallel.hpp"
#include "kernels/tracer.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// Sees to all particles of the first `marked` marked tiles.
template <class Shape, class Real>
void trace_tiles(const exec::Space& space, long marked, const TraceInput<Real>& input, const CrossingStore& records) {
  constexpr int threads = 64;
  using Trace = Tracer<Shape, Real>;
  exec::launch_teams(space, marked, threads, threads * sizeof(double),
                     [=] RIVEN_KERNEL(const exec::Team& team, long m) {
                       TileTrace& tile = input.tiles[m];
                       const int* start = input.tile_start + input.lists.marked_tiles[m];
                       double* least = team.shared<double>();
                       team.each(1, [&](long) { Trace(input, records).follow(m); });
                       if (!Trace(input, records).due(tile))
                         return;
                       team.each_thread([&](int t) {
                         Trace trace(input, records);
                         least[t] = Trace::never;
                         for (long p = start[0] + t; p < start[1]; p += threads) {
                           double& limit = input.limit[p + tile.known];
                           if (trace.all_due(tile) || !(tile.path < limit))
                             limit = trace.keep(tile, p);
                           least[t] = limit < least[t] ? limit : least[t];
                         }
                       });
                       team.each(1, [&](long) {
                         tile.limit = *std::min_element(least, least + threads);
                         tile.turned = 0;
                       });
                     });
}

}  // namespace RIVEN_SIDE

}  // namespace riven
