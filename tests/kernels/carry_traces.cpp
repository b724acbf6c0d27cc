// What is kept of traces over the hash that growing cracks call for.
#include "kernels/carry_traces.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tests/kernels/crack_scene.hpp"
#include "tests/kernels/driven_growth.hpp"

namespace riven {
namespace {

using namespace driven_growth;

/// What was kept from step to step, and over the hash that growth calls for, is what would be found afresh: fields of
/// particles, counts of nodes, and what these mean.
TEST(CarryTraces, LeavesFieldsAsTheyWouldBeFoundAfresh) {
  Driven run(plate({crack("edge", {{-1, 8}, {6, 8}}), crack("in its way", {{14, 4}, {17, 9}})}), open);
  long crossing = 0, carried = 0, behind = 0;
  for (int n = 0; n < 200; ++n) {
    const auto& s = run.m.state;
    run.steps(1);
    CrackFields kept = s.fields, fresh;
    const bool grown = hash_due(Driven::serial(), s.grid.lattice, s.cracks, s.fields);
    if (grown)
      hash_cracks<UGimp>(Driven::serial(), s.grid.lattice, s.cracks, kept);
    determine_fields<UGimp>(Driven::serial(), s.particles, s.domains.data(), s.grid.lattice, s.cracks, kept,
                            s.watch.tile_move.data());
    hash_cracks<UGimp>(Driven::serial(), s.grid.lattice, s.cracks, fresh);
    determine_fields<UGimp>(Driven::serial(), s.particles, s.domains.data(), s.grid.lattice, s.cracks, fresh);
    for (long i = 0; i < s.particles.count(); ++i) {
      ASSERT_EQ(kept.fields[i], fresh.fields[i]) << n;
      crossing += fresh.fields[i] != 0;
    }
    if (!grown)
      continue;  // the lists were made at other times
    carried += kept.order == s.fields.order;
    for (long k = 0; k < fresh.nodes.size(); ++k) {
      ASSERT_EQ(kept.nodes[k].behind, fresh.nodes[k].behind) << n;
      behind += fresh.nodes[k].behind != 0;
    }
    ASSERT_EQ(kept.tally.size(), fresh.tally.size()) << n;
    for (long e = 0; e < fresh.tally.size(); ++e) {
      ASSERT_EQ(kept.tally[e], fresh.tally[e]) << n;
      ASSERT_EQ(kept.verdict[e], fresh.verdict[e]) << n;
    }
  }
  EXPECT_GT(crossing, 1000);
  EXPECT_GT(carried, 20);
  EXPECT_GT(behind, 0);  // once the one has joined the other
}

/// Growth has those particles traced again that are near the new segment.
TEST(CarryTraces, LeavesOthersUntraced) {
  Driven run(plate({crack("edge", {{-1, 8}, {6, 8}}), crack("inner", {{4, 14}, {22, 15}})}), open);
  const auto& s = run.m.state;
  long grown = 0, few = 0;
  for (int n = 0; n < 60; ++n) {
    run.steps(1);
    if (!hash_due(Driven::serial(), s.grid.lattice, s.cracks, s.fields))
      continue;
    ++grown;
    CrackFields kept = s.fields;
    hash_cracks<UGimp>(Driven::serial(), s.grid.lattice, s.cracks, kept);
    determine_fields<UGimp>(Driven::serial(), s.particles, s.domains.data(), s.grid.lattice, s.cracks, kept,
                            s.watch.tile_move.data());
    long traced = 0, known = 0;
    std::map<int, Vec2> place;
    crack_scene::each_known(s.fields, s.particles.tiles, [&](int p, const CrossingMemory& m) { place[p] = m.x; });
    crack_scene::each_known(kept, s.particles.tiles, [&](int p, const CrossingMemory& m) {
      if (m.known == Known::nowhere)
        return;
      ++known;
      traced += !(place.count(p) != 0 && norm(m.x - place[p]) == 0);
    });
    EXPECT_GT(traced, 0);
    few += traced < known / 3;
  }
  EXPECT_GT(grown, 3);
  EXPECT_GE(few, grown - 1);  // when the records run out of room, all are traced again
}

}  // namespace
}  // namespace riven
