#include "kernels/trace_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/exec/parallel.hpp"
#include "kernels/tracer.hpp"

namespace riven {

namespace {

/// Unit normals of all segments, from above to below, in fixed point; and the move of the points since the last trace.
void follow_cracks(const exec::Space& space, const Cracks& cracks, CrackFields& fields) {
  const long points = cracks.points(), chunks = (points + exec::chunk - 1) / exec::chunk;
  fields.segment_normal.resize(4 * points);
  if (fields.traced.size() != points)
    fields.traced = cracks.plane;
  std::vector<double> moved(static_cast<size_t>(chunks));
  exec::launch(space, chunks, [&](long c) {
    const long end = std::min(points, (c + 1) * exec::chunk);
    double most2 = 0;
    for (long k = c * exec::chunk; k < end; ++k) {
      const Vec2 move = cracks.plane[k] - fields.traced[k];
      most2 = std::max(most2, dot(move, move));
      fields.traced[k] = cracks.plane[k];
      if (k + 1 == points)
        continue;
      std::int64_t* to = fields.segment_normal.data() + 4 * k;
      for (const Vec2* at : {cracks.plane.data() + k, cracks.plane0.data() + k}) {
        const Vec2 d = at[1] - at[0];
        const double length = norm(d), scale = length > 0 ? CrackFields::unit / length : 0;
        *to++ = static_cast<std::int64_t>(d.y * scale);
        *to++ = static_cast<std::int64_t>(-d.x * scale);
      }
    }
    moved[static_cast<size_t>(c)] = std::sqrt(most2);
  });
  if (!moved.empty())
    fields.travel += *std::max_element(moved.begin(), moved.end());
}

/// Makes the arrays of the last trace those to be read, and of at least the same size those to be written.
void turn_over(long particles, CrackFields& fields) {
  ++fields.stamp;
  fields.memory.resize(particles);
  fields.records.swap(fields.last_records);
  if (fields.records.size() < fields.last_records.size())
    fields.records.resize(fields.last_records.size());
}

}  // namespace

template <class Shape, class Real>
void trace_crossings(const exec::Space& space, const Particles<Real, 2>& particles,
                     const DomainSetting<Real, 2>* domains, const Lattice& lattice, const Cracks& cracks,
                     CrackFields& fields) {
  const exec::Stopwatch watch(space.timers(), "trace crossings");
  follow_cracks(space, cracks, fields);
  turn_over(particles.count(), fields);
  for (;;) {
    long records = 0, chunks = 0;
    const TraceInput<Real> input{particles, domains, lattice, cracks};
    const TallyTarget target{fields.tally.data(), fields.tally_normal.data(), space.threads() > 1};
    exec::launch(space, fields.marked_tiles.size(), [&](long m) {
      const int tile = fields.marked_tiles[m];
      const long first = particles.tiles.start[tile], last = particles.tiles.start[tile + 1];
      if (first == last)
        return;
      Recorder recorder(fields, records, chunks);
      LocalTally tally(target);
      Tracer<Shape, Real>(input, fields, recorder, tally).trace(first, last);
      recorder.flush();
      tally.flush();
    });
    fields.chunk_count = chunks;
    if (records <= fields.records.size() && chunks <= fields.chunks.size())
      return;
    // start afresh with room enough: memories may already point into what was not written
    fields.records.resize(records + records / 4);
    fields.chunks.resize(chunks + chunks / 4);
    fields.tally.zero();
    fields.tally_normal.zero();
    fields.stamp += 2;
  }
}

#define RIVEN_TRACE(Shape, Real)                                                                           \
  template void trace_crossings<Shape, Real>(const exec::Space&, const Particles<Real, 2>&,                \
                                             const DomainSetting<Real, 2>*, const Lattice&, const Cracks&, \
                                             CrackFields&);
RIVEN_TRACE(Linear, double)
RIVEN_TRACE(UGimp, double)
RIVEN_TRACE(BSpline, double)
RIVEN_TRACE(Linear, float)
RIVEN_TRACE(UGimp, float)
RIVEN_TRACE(BSpline, float)
#undef RIVEN_TRACE

}  // namespace riven
