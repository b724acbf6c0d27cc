// What riven-perf throughput runs.
#include <fmt/format.h>

#include <string>
#include <utility>

#include "core/scene/names.hpp"
#include "perf/throughput.hpp"

namespace riven::perf {

namespace {

constexpr double many_edge = 100e-3;  ///< of the plate with 200 cracks

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
          swirling("affine", cells, [](Scene& s) { s.affine = true; }),
          swirling("affine, usavg", cells,
                   [](Scene& s) {
                     s.affine = true;
                     s.stress_update = StressUpdate::usavg;
                   }),
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

/// Blocks on the device, `across` cells wide and high, in both precisions.
std::vector<Entrant> on_device(const std::vector<std::pair<const char*, int>>& across,
                               const std::vector<ScatterKind>& scatters) {
  std::vector<Entrant> list;
  for (const auto& [name, cells] : across)
    for (const bool single : {false, true})
      for (const ScatterKind scatter : scatters)
        list.push_back(swirling(fmt::format("{}, {}, {}", name, single ? "float" : "double", name_of(scatter)), cells,
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

/// At full speed, and as slowly as the shipped scene is pulled, where tips mostly wait.
std::vector<Entrant> growing() {
  constexpr double cell = 0.396875e-3;
  std::vector<Entrant> list = pair_of(growing_plate(cell), "");
  for (Entrant& e : pair_of(growing_plate(cell, 0.105), ", slow"))
    list.push_back(std::move(e));
  return list;
}

/// The plate with 200 cracks with 16 million particles on the device, with USL as the block of that size beside it.
std::vector<Entrant> cracks_on_device() {
  const auto there = [](Scene& s) {
    s.exec = exec::Kind::cuda;
    s.scatter = ScatterKind::atomic;
  };
  Scene plate = many_plate(many_edge, many_edge / 2000);
  plate.stress_update = StressUpdate::usl;
  there(plate);
  std::vector<Entrant> list{swirling("block", 2000, there)};
  for (Entrant& e : pair_of(plate, ""))
    list.push_back(std::move(e));
  return list;
}

}  // namespace

std::vector<Group> throughput_groups() {
  constexpr double cell = 0.5e-3;
  using enum ScatterKind;
  return {
      {"block", "block without cracks, 160,000 particles: uGIMP, FLIP, USL, neo-Hookean", 20, 50, 9,
       [] { return std::vector{swirling("block", 200)}; }},
      {"large", "the same with 1,440,000 particles, beyond the caches", 10, 50, 3,
       [] { return std::vector{swirling("large", 600)}; }},
      {"methods", "stress updates, transfers, shape functions, scatter, space and precision on the block", 20, 50, 5,
       methods},
      {"sent", "plate with two crossing cracks (H and V), 80,000 particles, frictionless contact", 60, 10, 55,
       [] { return beside_plain(sent_plate(cell)); }},
      {"growing", "plate with ten growing cracks, 65,536 particles, J and K at every tip", 60, 5, 20, growing},
      {"many", "plate with 200 cracks, 160,000 particles, frictionless contact", 40, 8, 35,
       [] { return beside_plain(many_plate(many_edge)); }},
      {"thousand", "plate with 1,000 growing cracks, 4,000,000 particles, J and K at every tip", 60, 2, 15,
       [] { return pair_of(thousand_plate(), ""); }, true},
      {"device", "blocks without cracks of 1, 4 and 16 million particles on the device (--exec cuda)", 20, 45, 5,
       [] {
         return on_device({{"1 million", 500}, {"4 million", 1000}, {"16 million", 2000}}, {atomic, ordered});
       },
       true, true},
      {"device-large", "the same with 64 million particles", 20, 45, 3,
       [] {
         return on_device({{"64 million", 4000}}, {atomic});
       },
       true, true},
      {"device-cracks", "plate with 200 cracks on the device, 16,000,000 particles, frictionless contact, USL", 20, 45,
       5, cracks_on_device, true, true},
  };
}

}  // namespace riven::perf
