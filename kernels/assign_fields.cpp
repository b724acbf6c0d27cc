#include "kernels/assign_fields.hpp"

#include <algorithm>
#include <climits>

#include "core/exec/atomic.hpp"
#include "core/exec/parallel.hpp"
#include "core/math/shape.hpp"
#include "kernels/trace_crossings.hpp"

namespace riven {

namespace {

enum Verdict : std::uint8_t { other_side = 4, third_crack = 8 };  // 1 and 2 are fields

Vec2 unit(const std::int64_t* fixed) {
  const Vec2 n{static_cast<double>(fixed[0]), static_cast<double>(fixed[1])};
  const double length = norm(n);
  return length > 0 ? n * (1 / length) : Vec2{};
}

/// Which cracks a node holds, and what a crossing of each entry means. Leaves the sums at zero for the next step.
void hold_cracks(CrackFields& fields, long f) {
  NodeCracks& node = fields.nodes[f];
  const int first = fields.candidate_start[f], last = fields.candidate_start[f + 1];
  int most[2] = {-1, -1}, count[2] = {0, 0};
  for (int c = first; c < last; ++c) {
    const int n = fields.tally[2 * c] + fields.tally[2 * c + 1];
    if (n > count[0]) {
      most[1] = most[0];
      count[1] = count[0];
      most[0] = c;
      count[0] = n;
    } else if (n > count[1]) {
      most[1] = c;
      count[1] = n;
    }
  }
  if (most[0] < 0 && node.crack[0] < 0)
    return;
  const int number = node.node;
  node = NodeCracks{};
  node.node = number;
  if (most[0] < 0)
    return;
  if (most[1] >= 0 && most[1] < most[0])
    std::swap(most[0], most[1]);
  for (int c = first; c < last; ++c)
    fields.verdict[2 * c] = fields.verdict[2 * c + 1] = third_crack;
  for (int m = 0; m < 2 && most[m] >= 0; ++m) {
    const int above = 2 * most[m], below = above + 1;
    const bool from_above = fields.tally[above] >= fields.tally[below];
    const std::int64_t* sum = fields.tally_normal.data() + 4L * (from_above ? above : below);
    node.crack[m] = fields.candidate[most[m]];
    node.side[m] = from_above ? Side::above : Side::below;
    node.normal[m] = unit(sum);
    node.normal0[m] = unit(sum + 2);
    fields.verdict[from_above ? above : below] = static_cast<std::uint8_t>(1 << m);
    fields.verdict[from_above ? below : above] = other_side;
  }
  for (int e = 2 * first; e < 2 * last; ++e) {
    if (fields.tally[e] == 0)
      continue;
    fields.tally[e] = 0;
    for (int c = 0; c < 4; ++c)
      fields.tally_normal[4L * e + c] = 0;
  }
}

/// Warnings of one kind: how many, and the first by particle number and neighbour.
struct Warnings {
  long count = 0;
  int id = INT_MAX;
  CrossingRecord record{};
  void add(int particle_id, const CrossingRecord& r) {
    ++count;
    keep_first(particle_id, r);
  }
  void keep_first(int particle_id, const CrossingRecord& r) {
    if (particle_id > id || (particle_id == id && r.neighbour >= record.neighbour))
      return;
    id = particle_id;
    record = r;
  }
};

struct BothWarnings {
  Warnings kind[2];
};

void clear_last(const exec::Space& space, long particles, CrackFields& fields) {
  if (fields.fields.size() != particles) {
    fields.fields.resize(particles);
    fields.fields.zero();
    return;
  }
  exec::launch(space, fields.chunk_count, [&](long c) {
    const RecordChunk chunk = fields.chunks[c];
    for (long r = chunk.begin; r < chunk.begin + chunk.count; ++r)
      std::atomic_ref<std::uint32_t>(fields.fields[fields.records[r].particle]).store(0, std::memory_order_relaxed);
  });
}

BothWarnings set_fields(CrackFields& fields, RecordChunk chunk, const int* id, bool shared) {
  BothWarnings warnings;
  std::uint32_t word = 0;
  const auto store = [&](int particle) {
    // the records of one particle may be in two chunks
    if (shared)
      std::atomic_ref<std::uint32_t>(fields.fields[particle]).fetch_or(word, std::memory_order_relaxed);
    else
      fields.fields[particle] |= word;
    word = 0;
  };
  for (long r = chunk.begin; r < chunk.begin + chunk.count; ++r) {
    const CrossingRecord& record = fields.records[r];
    if (r > chunk.begin && fields.records[r - 1].particle != record.particle)
      store(fields.records[r - 1].particle);
    if (!record.weighs)
      continue;
    const std::uint8_t verdict = fields.verdict[record.entry];
    if (verdict < other_side)
      word |= static_cast<std::uint32_t>(verdict) << (CrackFields::bits * record.neighbour);
    else
      warnings.kind[verdict == third_crack].add(id[record.particle], record);
  }
  store(fields.records[chunk.begin + chunk.count - 1].particle);
  return warnings;
}

}  // namespace

template <class Shape, class Real>
void determine_fields(const exec::Space& space, const Particles<Real, 2>& particles,
                      const DomainSetting<Real, 2>* domains, const Lattice& lattice, const Cracks& cracks,
                      CrackFields& fields) {
  clear_last(space, particles.count(), fields);
  trace_crossings<Shape, Real>(space, particles, domains, lattice, cracks, fields);
  exec::parallel_for(space, "assign fields", fields.nodes.size(), [&](long f) { hold_cracks(fields, f); });

  std::vector<BothWarnings> warned(static_cast<size_t>(fields.chunk_count));
  exec::parallel_tasks(space, "assign fields", fields.chunk_count, [&](long c) {
    warned[static_cast<size_t>(c)] = set_fields(fields, fields.chunks[c], particles.id.data(), space.threads() > 1);
  });
  long* const total[2] = {&fields.warning_both_sides, &fields.warning_third_crack};
  for (int kind = 0; kind < 2; ++kind) {
    Warnings all;
    for (const BothWarnings& w : warned) {
      all.count += w.kind[kind].count;
      all.keep_first(w.kind[kind].id, w.kind[kind].record);
    }
    if (all.count > 0 && *total[kind] == 0) {
      const auto it =
          std::upper_bound(fields.candidate_start.begin(), fields.candidate_start.end(), all.record.entry / 2);
      fields.warning_place[kind] = lattice.position(fields.nodes[it - fields.candidate_start.begin() - 1].node);
    }
    *total[kind] += all.count;
  }
}

#define RIVEN_DETERMINE(Shape, Real)                                                                        \
  template void determine_fields<Shape, Real>(const exec::Space&, const Particles<Real, 2>&,                \
                                              const DomainSetting<Real, 2>*, const Lattice&, const Cracks&, \
                                              CrackFields&);
RIVEN_DETERMINE(Linear, double)
RIVEN_DETERMINE(UGimp, double)
RIVEN_DETERMINE(BSpline, double)
RIVEN_DETERMINE(Linear, float)
RIVEN_DETERMINE(UGimp, float)
RIVEN_DETERMINE(BSpline, float)
#undef RIVEN_DETERMINE

}  // namespace riven
