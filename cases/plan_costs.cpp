#include "cases/plan_costs.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/exec/timers.hpp"
#include "core/math/median.hpp"
#include "core/plan/explain.hpp"
#include "io/require_memory.hpp"
#include "io/toml.hpp"
#include "kernels/dispatch.hpp"
#include "kernels/simulation.hpp"

namespace riven {

namespace {

/// Settings that turn an effect on where it is off, and off where it is on; empty: none do.
struct Toggle {
  const char* effect;
  std::vector<std::string> on, off;
};

const std::vector<Toggle>& toggles() {
  static const std::vector<Toggle> table{
      {"cracks", {}, {"crack=", "growth=", "fracture=", "probe="}},
      {"contact", {"contact.law=frictionless"}, {"contact.law=ignored"}},
      {"J", {"fracture.contour=4"}, {"fracture=", "growth="}},
      {"growth", {}, {"growth=", "fracture.contour=4"}},
      {"loads", {}, {"load="}},
      {"body force", {"body_force.x=0 m/s^2"}, {"body_force="}},
      {"grid damping", {"damping.grid=0 1/s"}, {"damping.grid="}},
      {"particle damping", {"damping.particle=0 1/s"}, {"damping.particle="}},
      {"gradients of velocity", {"solver.affine=true"}, {"solver.affine=false"}},
      {"higher orders", {"solver.transfer=fmpm", "solver.order=2"}, {"solver.order=1"}},
      {"second stress update", {"solver.stress_update=usavg"}, {"solver.stress_update=musl"}},
      {"second extrapolation", {"solver.stress_update=musl"}, {"solver.stress_update=usl"}}};
  return table;
}

/// One of the two scenes that take turns.
template <class Real>
struct Runner {
  explicit Runner(Scene s) : scene(std::move(s)), space(scene.exec, threads_of(scene)), simulation(scene, space) {}

  /// Seconds of a step, over some of them.
  double time(int steps) {
    const double start = exec::Stopwatch::now();
    for (int k = 0; k < steps && !simulation.finished(); ++k)
      simulation.step();
    return (exec::Stopwatch::now() - start) / steps;
  }

  Scene scene;
  exec::Space space;
  SimulationOf<Real> simulation;
};

/// Time of a step of `with` over that of `without`: the middle of some turns.
template <class Real>
double ratio(const Scene& with, const Scene& without) {
  constexpr int turns = 7;
  constexpr double turn = 0.05;  // s, as long as the steps of a turn should last
  Runner<Real> a(with), b(without);
  const int steps = std::clamp(static_cast<int>(turn / std::max(a.time(2), b.time(2))), 1, 200);
  std::vector<double> ratios;
  for (int k = 0; k < turns; ++k) {
    const double first = a.time(steps);
    ratios.push_back(first / b.time(steps));
  }
  return median(ratios);
}

/// The scene with some more settings, of which "table=" takes a table away where there is one; nothing where they do
/// not fit it.
std::optional<Scene> changed(SceneOptions options, const Scene& scene, const std::vector<std::string>& set) {
  const toml::table written = parse_toml(scene.source_text, scene.source_path);
  for (const std::string& s : set)
    if (s.back() != '=' || written.contains(s.substr(0, s.size() - 1)))
      options.set.push_back(s);
  try {
    Scene s = options.read();
    require_memory(s);
    return s;
  } catch (const Error&) {
    return std::nullopt;
  }
}

bool has(const Scene& s, const std::string& effect) {
  const std::vector<EffectNote> all = explain(s, make_plan(s));
  return std::any_of(all.begin(), all.end(), [&](const EffectNote& e) { return e.on && e.name == effect; });
}

}  // namespace

std::map<std::string, double> measure_costs(const SceneOptions& options) {
  std::map<std::string, double> costs;
  const Scene scene = options.read();
  for (const Toggle& t : toggles()) {
    const bool on = has(scene, t.effect);
    const std::vector<std::string>& set = on ? t.off : t.on;
    if (set.empty())
      continue;
    const std::optional<Scene> other = changed(options, scene, set);
    if (!other || has(*other, t.effect) == on)
      continue;
    try {
      with_precision(scene.precision, [&](auto real) {
        using Real = typename decltype(real)::type;
        costs[t.effect] = on ? ratio<Real>(scene, *other) - 1 : ratio<Real>(*other, scene) - 1;
      });
    } catch (const Error& e) {
      if (e.code() != Exit::unstable)  // a method that the scene does not stand has no cost
        throw;
    }
  }
  return costs;
}

}  // namespace riven
