// A scene that is right, to be read as it is or with one thing made wrong.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "io/check_scene.hpp"
#include "io/read_scene.hpp"

namespace riven::test {

inline const std::string good_scene = R"toml(title = "plate"
[solver]
time = "2 ms"
plane = "stress"
[grid]
cell = "0.5 mm"
lower = ["-4 mm", "-4 mm"]
upper = ["54 mm", "104 mm"]
[[material]]
name = "pmma"
E = "2500 MPa"
nu = 0.33
density = "1 g/cm^3"
[[body]]
name = "plate"
material = "pmma"
rectangle = { lower = ["0 mm", "0 mm"], upper = ["50 mm", "100 mm"] }
[[symmetry]]
axis = "x"
position = "0 mm"
solid = "above"
[[grip]]
name = "top"
rectangle = { lower = ["0 mm", "100 mm"], upper = ["50 mm", "101 mm"] }
velocity_y = { value = "1 m/s", shape = "sin(pi*t/tr)", tr = "2 ms" }
[[crack]]
name = "edge"
points = [["-1 mm", "50 mm"], ["25 mm", "50 mm"]]
contact = { law = "coulomb", friction = 0.3 }
)toml";

/// good_scene with `from` replaced by `to`; both must make a difference.
inline std::string changed(const std::string& from, const std::string& to) {
  std::string text = good_scene;
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  Scene s = parse_scene(text, "plate.toml", overrides);
  check_scene(s);
  return s;
}

/// The error that a scene gives; a test failure when it gives none.
inline Trouble trouble_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read(text, overrides);
  } catch (const Error& e) {
    return e.trouble();
  }
  ADD_FAILURE() << "read without an error:\n" << text;
  return {};
}

}  // namespace riven::test
