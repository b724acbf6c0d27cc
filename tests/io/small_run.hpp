// A run of a few particles with a crack from a file, to be stored and taken up again.
#pragma once
#include <string>
#include <vector>

#include "io/check_scene.hpp"
#include "io/read_scene.hpp"
#include "kernels/simulation.hpp"
#include "tests/spaces.hpp"

namespace riven::test {

inline const std::string small_scene = R"toml(title = "small"
[solver]
time = "20 us"
deterministic = true
[grid]
cell = "1 mm"
lower = ["-2 mm", "-2 mm"]
upper = ["10 mm", "10 mm"]
[[material]]
name = "solid"
E = "1 GPa"
nu = 0.3
density = "1 g/cm^3"
[[body]]
name = "block"
material = "solid"
rectangle = { lower = ["0 mm", "0 mm"], upper = ["8 mm", "8 mm"] }
velocity = ["5 m/s", "0 m/s"]
spin = "100 rad/s"
[[crack]]
name = "crack"
file = "cracks.csv"
[output]
frames = 4
)toml";

inline const std::string small_cracks = "x0_mm,y0_mm,x1_mm,y1_mm\n1.3,4.2,6.1,4.6\n";

inline Scene small(const std::vector<std::string>& overrides = {}, const std::string& cracks = small_cracks) {
  Scene s = parse_scene(small_scene, "small.toml", overrides, {{"cracks.csv", cracks}});
  check_scene(s);
  return s;
}

/// A simulation with all that it needs.
struct SmallRun {
  explicit SmallRun(const std::vector<std::string>& overrides = {}) : scene(small(overrides)), m(scene, space) {}
  void steps(int n) {
    for (; n > 0; --n)
      m.step();
  }
  const Scene scene;
  const ChosenSpace space;
  Simulation m;
};

}  // namespace riven::test
