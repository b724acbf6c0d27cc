// States with closed-form fields, in no particular order, for the tests of what is written.
#pragma once
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "core/scene/scene.hpp"
#include "core/state/cracks.hpp"
#include "core/state/particles.hpp"

namespace riven::sample {

inline constexpr double cell = 1e-3, E_modulus = 2.5e9, nu = 0.3, density = 1200, fringe_constant = 8.89e-8;
inline constexpr double amplitude = 1e-4;  ///< m, of the displacement u_y = amplitude t sin(pi x / width)
inline constexpr int nx = 24, ny = 16;
inline constexpr double width = nx * cell / 2;

inline Scene scene() {
  Scene s;
  s.name = "sample";
  s.title = "A sheared plate with two cracks";
  s.cell = cell;
  s.end_time = 1;
  s.plane = Plane::strain;
  s.materials = {{"linear", LawKind::linear_elastic, E_modulus, nu, density}};
  s.bodies.resize(1);
  s.bodies[0].particles_per_cell = 2;
  s.cracks.resize(2);
  s.output.sidecar = Sidecar::vtp;
  s.output.precision = Precision::as_double;
  s.output.fields = {"fringe"};
  s.output.fringe_constant = fringe_constant;
  return s;
}

/// nx by ny particles less the last `removed` ids; u = (0, amplitude t sin(pi x0/width)), shear stress over density
/// to go with it, in the reverse order of the ids.
inline Particles<double, 2> particles(double t, int removed = 0) {
  Particles<double, 2> p;
  const int n = nx * ny - removed;
  for (auto* group : {p.x, p.v, p.x0})
    for (int axis = 0; axis < 2; ++axis)
      group[axis].resize(n);
  for (auto& a : p.stress)
    a.resize(n);
  for (auto& a : p.F)
    a.resize(n);
  p.mass.resize(n);
  p.body.resize(n);
  p.id.resize(n);
  for (int k = 0; k < n; ++k) {
    const int id = n - 1 - k;
    const int column = id % nx, row = id / nx;
    const double x = (column + 0.5) * cell / 2, y = (row + 0.5) * cell / 2;
    const double wave = std::numbers::pi / width, slope = amplitude * t * wave * std::cos(wave * x);
    p.id[k] = id;
    p.x0[0][k] = p.x[0][k] = x;
    p.x0[1][k] = y;
    p.x[1][k] = y + amplitude * t * std::sin(wave * x);
    p.v[1][k] = amplitude * std::sin(wave * x);
    p.F[0][k] = p.F[3][k] = 1;
    p.F[2][k] = slope;  // det F = 1
    p.stress[0][k] = 1e6 / density;
    p.stress[1][k] = 3e6 / density;
    p.stress[2][k] = E_modulus / (2 * (1 + nu)) * slope / density;
    p.mass[k] = density * cell * cell / 4 * 1e-3;
  }
  return p;
}

/// A straight horizontal crack of 5 points, opened by 2e-5 t and slid by 1e-5 t, and one at 45 degrees of 4 points
/// and `grown` more.
inline Cracks cracks(double t, int grown = 0) {
  Cracks c;
  const int points[2] = {5, 4 + grown};
  const double angle[2] = {0, std::numbers::pi / 4};
  const Vec2 first[2] = {{2e-3, 3e-3}, {7e-3, 3e-3}};
  const int n = points[0] + points[1];
  c.names = {"flat", "slanted"};
  c.contact.resize(2);
  c.start.resize(3);
  for (auto* a : {&c.plane, &c.upper, &c.lower, &c.plane0})
    a->resize(n);
  c.crack.resize(n);
  for (int k = 0, at = 0; k < 2; ++k) {
    const Vec2 along{std::cos(angle[k]), std::sin(angle[k])};
    for (int i = 0; i < points[k]; ++i, ++at) {
      c.crack[at] = k;
      c.plane[at] = c.plane0[at] = first[k] + (i * 0.8e-3) * along;
      const Vec2 half = (1e-5 * t) * turned(along) + (0.5e-5 * t) * along;
      c.upper[at] = c.plane[at] + half;
      c.lower[at] = c.plane[at] - half;
    }
    c.start[k + 1] = at;
  }
  return c;
}

/// A folder of the test's own, removed with the object.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "riven_test_XXXXXX").string();
    if (!mkdtemp(name.data()))
      std::abort();
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Hidden files that an interrupted write has left, under the folder and its children.
inline int leftovers(const std::filesystem::path& folder) {
  int n = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    n += entry.path().filename().string().starts_with(".") ? 1 : 0;
  return n;
}

}  // namespace riven::sample
