#include "perf/gate_scenes.hpp"

namespace riven::perf {

namespace {

GateScene block(const std::string& name, const std::function<void(Scene&)>& change = {}) {
  return {swirling(name, 40, change), swirling(name, 200, change), 5, 1};
}

}  // namespace

std::vector<GateScene> gate_scenes() {
  std::vector<GateScene> list{
      block("block"),
      block("block, usavg, fmpm(2)",
            [](Scene& s) {
              s.materials[0].law = LawKind::linear_elastic;
              s.stress_update = StressUpdate::usavg;
              s.transfer = Transfer::fmpm;
              s.order = 2;
            }),
      block("block, musl, pic, b-spline",
            [](Scene& s) {
              s.shape = ShapeFunction::bspline;
              s.stress_update = StressUpdate::musl;
              s.transfer = Transfer::pic;
              s.pic_fraction = 0.1;
            }),
      {pulled("two crossing cracks", sent_plate(2e-3)), pulled("two crossing cracks", sent_plate(0.5e-3)), 10, 1},
      {pulled("ten growing cracks", growing_plate(0.79375e-3)),
       pulled("ten growing cracks", growing_plate(0.396875e-3)), 40, 8},
      {pulled("many cracks", many_plate(25e-3)), pulled("many cracks", many_plate(100e-3)), 10, 1},
  };
  for (GateScene& g : list)
    g.counted.scene.deterministic = g.timed.scene.deterministic = true;
  return list;
}

}  // namespace riven::perf
