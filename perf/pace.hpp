// Times that mean the same on a busy machine and on an idle one: ratios to a calibration that takes turns with the
// scene.
#pragma once
#include <string>

#include "perf/calibration.hpp"
#include "perf/cost.hpp"
#include "perf/gate_scenes.hpp"

namespace riven::perf {

/// Processor time of each task on one thread, per particle and step, in millionths of a calibration round. With
/// `slowed`, the task of that label passes over the particles once more than it needs to, which is how the gate is
/// shown to catch such a thing.
SceneCost measure_pace(const GateScene& scene, Calibration& calibration, const std::string& slowed = "");

}  // namespace riven::perf
