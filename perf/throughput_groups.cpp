// What riven-perf throughput runs.
#include "perf/throughput.hpp"

namespace riven::perf {

namespace {

std::vector<Entrant> methods() {
  constexpr int cells = 200;
  const auto updated = [&](const char* name, StressUpdate update) {
    return swirling(name, cells, [=](Scene& s) { s.stress_update = update; });
  };
  const auto transferred = [&](const char* name, Transfer transfer, int order) {
    return swirling(name, cells, [=](Scene& s) {
      s.transfer = transfer;
      s.order = order;
      s.pic_fraction = transfer == Transfer::pic ? 0.1 : 0;
    });
  };
  return {updated("usl flip", StressUpdate::usl),
          updated("musl", StressUpdate::musl),
          updated("usf", StressUpdate::usf),
          updated("usavg", StressUpdate::usavg),
          transferred("pic 0.1", Transfer::pic, 1),
          transferred("fmpm(1)", Transfer::fmpm, 1),
          transferred("fmpm(2)", Transfer::fmpm, 2),
          transferred("xpic(2)", Transfer::xpic, 2),
          swirling("linear, musl", cells,
                   [](Scene& s) {
                     // USL divides by the tiny masses of nodes at the free edge and turns a particle inside out
                     s.shape = ShapeFunction::linear;
                     s.stress_update = StressUpdate::musl;
                   }),
          swirling("bspline", cells, [](Scene& s) { s.shape = ShapeFunction::bspline; }),
          swirling("atomic", cells, [](Scene& s) { s.scatter = ScatterKind::atomic; })};
}

/// A plate with and without its cracks, as it stands (two stress updates a step) and with USL, whose cheaper step
/// leaves the cracks a greater share.
std::vector<Entrant> beside_plain(const Scene& plate) {
  std::vector<Entrant> list;
  for (const auto& [suffix, update] : {std::pair{"", plate.stress_update}, std::pair{", usl", StressUpdate::usl}}) {
    Scene with = plate;
    with.stress_update = update;
    Scene without = with;
    without.cracks.clear();
    const std::string plain = std::string("no cracks") + suffix;
    list.push_back(pulled(plain, without));
    list.push_back(pulled(std::string("cracks") + suffix, with));
    list.back().without_cracks = plain;
  }
  return list;
}

}  // namespace

std::vector<Group> throughput_groups() {
  constexpr double cell = 0.5e-3, edge = 100e-3;
  return {
      {"block", "block without cracks, 160,000 particles: uGIMP, FLIP, USL, neo-Hookean", 20, 50, 9,
       [] { return std::vector{swirling("block", 200)}; }},
      {"large", "the same with 1,440,000 particles, beyond the caches", 10, 50, 3,
       [] { return std::vector{swirling("large", 600)}; }},
      {"methods", "stress updates, transfers, shape functions and scatter on the block", 20, 50, 5, methods},
      {"sent", "plate with two crossing cracks (H and V), 80,000 particles, frictionless contact", 60, 10, 55,
       [] { return beside_plain(sent_plate(cell)); }},
      {"growing", "plate with ten growing cracks, 65,536 particles, J and K at every tip", 60, 10, 55,
       [] { return beside_plain(growing_plate(0.396875e-3)); }},
      {"many", "plate with 200 cracks, 160,000 particles, frictionless contact", 40, 8, 35,
       [] { return beside_plain(many_plate(edge)); }},
  };
}

}  // namespace riven::perf
