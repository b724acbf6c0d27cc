// What riven-perf throughput runs.
#include <string>
#include <utility>

#include "core/scene/names.hpp"
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
          transferred("fmpm(4)", Transfer::fmpm, 4),
          transferred("xpic(2)", Transfer::xpic, 2),
          swirling("linear, musl", cells,
                   [](Scene& s) {
                     // USL divides by the tiny masses of nodes at the free edge and turns a particle inside out
                     s.shape = ShapeFunction::linear;
                     s.stress_update = StressUpdate::musl;
                   }),
          swirling("bspline", cells, [](Scene& s) { s.shape = ShapeFunction::bspline; }),
          swirling("atomic", cells, [](Scene& s) { s.scatter = ScatterKind::atomic; }),
          swirling("stdpar", cells, [](Scene& s) { s.exec = exec::Kind::stdpar; }),
          swirling("float", cells, [](Scene& s) { s.precision = Precision::as_float; })};
}

/// Blocks of 1, 4 and 16 million particles on the device, in both precisions and both scatters.
std::vector<Entrant> on_device() {
  std::vector<Entrant> list;
  for (const auto& [name, cells] : {std::pair{"1 million", 500}, {"4 million", 1000}, {"16 million", 2000}})
    for (const bool single : {false, true})
      for (const ScatterKind scatter : {ScatterKind::atomic, ScatterKind::ordered})
        list.push_back(
            swirling(std::string(name) + (single ? ", float, " : ", double, ") + std::string(name_of(scatter)), cells,
                     [=](Scene& s) {
                       s.exec = exec::Kind::cuda;
                       s.scatter = scatter;
                       s.precision = single ? Precision::as_float : Precision::as_double;
                     }));
  return list;
}

/// A plate without and with its cracks.
std::vector<Entrant> pair_of(const Scene& plate, const std::string& suffix) {
  Scene without = plate;
  without.cracks.clear();
  std::vector<Entrant> pair{pulled("no cracks" + suffix, without), pulled("cracks" + suffix, plate)};
  pair[1].without_cracks = pair[0].name;
  return pair;
}

/// The same as it stands (two stress updates a step) and with USL, whose cheaper step leaves the cracks a greater
/// share; not for cracks that grow, beside which USL turns particles inside out.
std::vector<Entrant> beside_plain(const Scene& plate) {
  std::vector<Entrant> list = pair_of(plate, "");
  Scene usl = plate;
  usl.stress_update = StressUpdate::usl;
  for (Entrant& e : pair_of(usl, ", usl"))
    list.push_back(std::move(e));
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
      {"methods", "stress updates, transfers, shape functions, scatter, space and precision on the block", 20, 50, 5,
       methods},
      {"sent", "plate with two crossing cracks (H and V), 80,000 particles, frictionless contact", 60, 10, 55,
       [] { return beside_plain(sent_plate(cell)); }},
      {"growing", "plate with ten growing cracks, 65,536 particles, J and K at every tip", 60, 5, 20,
       [] { return pair_of(growing_plate(0.396875e-3), ""); }},
      {"many", "plate with 200 cracks, 160,000 particles, frictionless contact", 40, 8, 35,
       [] { return beside_plain(many_plate(edge)); }},
      {"device", "blocks without cracks of 1, 4 and 16 million particles on the device (--exec cuda)", 10, 20, 3,
       on_device, true},
      {"thousand", "plate with 1,000 growing cracks, 4,000,000 particles, J and K at every tip", 60, 2, 15,
       [] { return pair_of(thousand_plate(), ""); }, true},
  };
}

}  // namespace riven::perf
