#include "kernels/trace_crossings.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/exec/atomic.hpp"
#include "core/exec/parallel.hpp"
#include "core/fracture/crossing.hpp"
#include "core/math/shape.hpp"
#include "kernels/local_tally.hpp"

namespace riven {

namespace {

/// Segments that one pass of the first test takes: one bit each.
constexpr int batch = 32;

/// Records of one task, handed over to the common array when full. Past its end nothing is written but the demand is
/// counted, so that the caller can make room and trace again.
class Recorder {
 public:
  Recorder(CrackFields& fields, long& records, long& chunks) : fields_(fields), records_(records), chunks_(chunks) {}

  void add(CrossingRecord record) {
    if (used_ == size)
      flush();
    record_[used_++] = record;
  }
  void flush() {
    if (used_ == 0)
      return;
    const long begin = exec::atomic_add(records_, long{used_}), chunk = exec::atomic_add(chunks_, 1L);
    if (begin + used_ <= fields_.records.size() && chunk < fields_.chunks.size()) {
      std::copy(record_, record_ + used_, fields_.records.data() + begin);
      fields_.chunks[chunk] = {begin, used_};
    }
    used_ = 0;
  }

 private:
  static constexpr int size = 512;
  CrackFields& fields_;
  long& records_;
  long& chunks_;
  int used_ = 0;
  CrossingRecord record_[size];
};

/// A list of segments, by their first points, ascending.
struct SegmentList {
  const int* segment;
  int count;
};

/// The nodes of one particle, and the path to each.
template <class Shape>
struct Paths {
  static constexpr int N = Shape::width;
  static constexpr int nodes = N * N;
  static constexpr int lanes = nodes <= 4 ? 4 : 16;
  Vec2 particle;
  int i, j;                     ///< first node
  alignas(64) float dx[lanes];  ///< from the particle to the nodes, in cells
  alignas(64) float dy[lanes];

  Paths(Vec2 p, int i0, int j0, const Lattice& lattice, double inv_h) : particle(p), i(i0), j(j0) {
    float x[N], y[N];
    for (int a = 0; a < N; ++a) {
      const Vec2 node = lattice.position(i + a, j + a);
      x[a] = static_cast<float>((node.x - p.x) * inv_h);
      y[a] = static_cast<float>((node.y - p.y) * inv_h);
    }
    for (int k = 0; k < lanes; ++k) {
      // lanes past the last node repeat it
      dx[k] = x[std::min(k, nodes - 1) % N];
      dy[k] = y[std::min(k, nodes - 1) / N];
    }
  }

  /// For each node, a bit for every segment (of at most `batch`) that may be crossed. With the corners of the
  /// signed areas relative to the particle, (12a) = d x a, (12b) = d x b, (ab1) = a x b, (ab2) = (ab1) + (12a) - (12b).
  /// Returns whether there is any.
  bool may_cross(SegmentList list, const Vec2* point, double inv_h, std::uint32_t* bits) const {
    for (int k = 0; k < lanes; ++k)
      bits[k] = 0;
    constexpr float reach = 2.f;  // bounds |dx| and |dy|, in cells
    alignas(64) float area_a[lanes] = {};
    int next = -1;
    float ax = 0, ay = 0;
    const auto relative = [&](int p, float& x, float& y) {
      x = static_cast<float>((point[p].x - particle.x) * inv_h);
      y = static_cast<float>((point[p].y - particle.y) * inv_h);
    };
    for (int s = 0; s < list.count; ++s) {
      const int segment = list.segment[s];
      if (segment != next) {
        relative(segment, ax, ay);
        for (int k = 0; k < lanes; ++k)
          area_a[k] = dx[k] * ay - dy[k] * ax;
      }
      next = segment + 1;
      float bx, by;
      relative(next, bx, by);
      const float from = ax * by - ay * bx;
      const float size = reach * (std::fabs(ax) + std::fabs(ay) + std::fabs(bx) + std::fabs(by)) + std::fabs(ax * by) +
                         std::fabs(ay * bx);
      const float rounding = 1e-6f * size;  // > 8 float roundings of every area below
      const float sign_from = from > rounding ? 1.f : from < -rounding ? -1.f : 0.f;
      const float far = rounding * size;  // beats the product of two areas unless both are beyond rounding
      const std::uint32_t bit = 1u << s;
      for (int k = 0; k < lanes; ++k) {
        const float a = area_a[k], b = dx[k] * by - dy[k] * bx, to = from + (a - b);
        const bool none = (a * b > far) | (sign_from * to > rounding);
        bits[k] |= none ? 0u : bit;
        area_a[k] = b;
      }
      ax = bx;
      ay = by;
    }
    std::uint32_t any = 0;
    for (int k = 0; k < lanes; ++k)
      any |= bits[k];
    return any != 0;
  }
};

template <class Shape, class Real>
class Tracer {
 public:
  Tracer(const Particles<Real, 2>& particles, const DomainSetting<Real, 2>* domains, const Lattice& lattice,
         const Cracks& cracks, CrackFields& fields, Recorder& recorder, LocalTally& tally)
      : particles_(particles),
        domains_(domains),
        lattice_(lattice),
        cracks_(cracks),
        fields_(fields),
        recorder_(recorder),
        tally_(tally) {}

  void trace(long p) {
    const Vec2 x{double(particles_.x[0][p]), double(particles_.x[1][p])};
    const Real X = place(particles_.x[0][p], lattice_.origin.x), Y = place(particles_.x[1][p], lattice_.origin.y);
    const int i = Shape::cell(X), j = Shape::cell(Y);
    // a particle that has left the grid is reported by those who move it
    if (i < 1 || j < 1 || i > lattice_.nx - 2 || j > lattice_.ny - 2)
      return;
    const int cell = fields_.cell_index[static_cast<long>(j) * lattice_.nx + i];
    if (cell < 0)
      return;
    const int first = fields_.cell_start[cell], last = fields_.cell_start[cell + 1];
    const double inv_h = 1 / lattice_.h;
    constexpr int before = Shape::width == 3;
    const Paths<Shape> paths(x, i - before, j - before, lattice_, inv_h);
    for (Node& n : node_)
      n = Node{};
    bool any = false;
    for (int s = first; s < last; s += batch) {
      const SegmentList list{fields_.cell_segment.data() + s, std::min(batch, last - s)};
      if (!paths.may_cross(list, cracks_.plane.data(), inv_h, bits_))
        continue;
      any = true;
      for (int k = 0; k < Paths<Shape>::nodes; ++k)
        if (bits_[k])
          test(p, X, Y, paths, k, list);
    }
    if (!any)
      return;
    for (int k = 0; k < Paths<Shape>::nodes; ++k)
      finish(p, X, Y, paths, k);
  }

 private:
  /// What is known of the path to one node: the crack in hand, its crossings, and their normals turned along the path.
  struct Node {
    int crack = -1;
    CrossingSum sum;
    std::int64_t normal[4] = {0, 0, 0, 0};
  };

  Real place(Real x, double origin) const { return (x - Real(origin)) * Real(1 / lattice_.h); }

  void test(long p, Real X, Real Y, const Paths<Shape>& paths, int k, SegmentList list) {
    const Vec2 node = lattice_.position(paths.i + k % Shape::width, paths.j + k / Shape::width);
    for (std::uint32_t bits = bits_[k]; bits; bits &= bits - 1) {
      const int segment = list.segment[std::countr_zero(bits)], crack = cracks_.crack[segment];
      const int c = crossing(paths.particle, node, cracks_.plane.data() + segment, segment == cracks_.start[crack],
                             segment + 2 == cracks_.start[crack + 1]);
      if (c == 0)
        continue;
      if (crack != node_[k].crack) {
        finish(p, X, Y, paths, k);
        node_[k] = Node{};
        node_[k].crack = crack;
      }
      node_[k].sum.add(c);
      for (int m = 0; m < 4; ++m)
        node_[k].normal[m] += c * fields_.segment_normal[4L * segment + m];
    }
  }

  /// Records the crack in hand of node k if it is crossed, unless the particle does not weigh on the node.
  void finish(long p, Real X, Real Y, const Paths<Shape>& paths, int k) {
    Node& n = node_[k];
    const Side side = n.sum.side();
    if (side == Side::none)
      return;
    const DomainSetting<Real, 2>& domain = domains_[particles_.body[p]];
    const auto ax = Shape::axis(X, domain.axis[0]), ay = Shape::axis(Y, domain.axis[1]);
    if (ax.s[k % Shape::width] == Real(0) || ay.s[k / Shape::width] == Real(0))
      return;
    const long node = static_cast<long>(paths.j + k / Shape::width) * lattice_.nx + paths.i + k % Shape::width;
    const int f = fields_.node_index[node];
    int at = fields_.candidate_start[f];
    while (fields_.candidate[at] != n.crack)
      ++at;
    const int entry = 2 * at + (side == Side::below);
    if (n.sum.net < 0)
      for (std::int64_t& m : n.normal)
        m = -m;
    recorder_.add({static_cast<int>(p), k, entry});
    tally_.add(entry, n.normal);
  }

  const Particles<Real, 2>& particles_;
  const DomainSetting<Real, 2>* domains_;
  const Lattice& lattice_;
  const Cracks& cracks_;
  CrackFields& fields_;
  Recorder& recorder_;
  LocalTally& tally_;
  Node node_[Paths<Shape>::nodes];
  alignas(64) std::uint32_t bits_[Paths<Shape>::lanes];
};

/// Unit normals of all segments, from above to below, in fixed point.
void segment_normals(const exec::Space& space, const Cracks& cracks, CrackFields& fields) {
  const long points = cracks.points();
  fields.segment_normal.resize(4 * points);
  exec::launch(space, (points + exec::chunk - 1) / exec::chunk, [&](long c) {
    for (long k = c * exec::chunk; k < std::min(points - 1, (c + 1) * exec::chunk); ++k) {
      std::int64_t* to = fields.segment_normal.data() + 4 * k;
      for (const Vec2* at : {cracks.plane.data() + k, cracks.plane0.data() + k}) {
        const Vec2 d = at[1] - at[0];
        const double length = norm(d), scale = length > 0 ? CrackFields::unit / length : 0;
        *to++ = static_cast<std::int64_t>(d.y * scale);
        *to++ = static_cast<std::int64_t>(-d.x * scale);
      }
    }
  });
}

}  // namespace

template <class Shape, class Real>
void trace_crossings(const exec::Space& space, const Particles<Real, 2>& particles,
                     const DomainSetting<Real, 2>* domains, const Lattice& lattice, const Cracks& cracks,
                     CrackFields& fields) {
  const exec::Stopwatch watch(space.timers(), "trace crossings");
  segment_normals(space, cracks, fields);
  for (;;) {
    long records = 0, chunks = 0;
    const TallyTarget target{fields.tally.data(), fields.tally_normal.data(), space.threads() > 1};
    exec::launch(space, fields.marked_tiles.size(), [&](long m) {
      const int tile = fields.marked_tiles[m];
      const long first = particles.tiles.start[tile], last = particles.tiles.start[tile + 1];
      if (first == last)
        return;
      Recorder recorder(fields, records, chunks);
      LocalTally tally(target);
      Tracer<Shape, Real> tracer(particles, domains, lattice, cracks, fields, recorder, tally);
      for (long p = first; p < last; ++p)
        tracer.trace(p);
      recorder.flush();
      tally.flush();
    });
    fields.chunk_count = chunks;
    if (records <= fields.records.size() && chunks <= fields.chunks.size())
      return;
    fields.records.resize(records + records / 4);
    fields.chunks.resize(chunks + chunks / 4);
    fields.tally.zero();
    fields.tally_normal.zero();
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
