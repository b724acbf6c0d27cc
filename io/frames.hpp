// Frames: the state of a run as files to open in ParaView. Everything in SI.
#pragma once
#include <filesystem>
#include <utility>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/state/cracks.hpp"
#include "core/state/particles.hpp"
#include "io/poly_data.hpp"

namespace riven {

/// Particles as vertices, in the order of their ids. Point arrays:
///   id, body, material;
///   size [m]                first edge of the square that the particle stands for;
///   velocity [m/s], displacement [m] (where the first positions are kept): x y 0;
///   stress [Pa]             Cauchy, in VTK's order xx yy zz xy yz xz;
///   von_mises [Pa], J       volume ratio, thickness included;
///   deformation_gradient    F11 F12 F21 F22 (where it is kept);
///   fringe                  cos(k sqrt((sxx - syy)^2 + 4 sxy^2)), k the scene's fringe constant (where asked for;
///                           isochromatic fringes, Nairn 2003, eq. 23).
/// The arrays are made when they are written: particles and scene must outlive them, and stay as they are.
template <class Real>
PolyData particle_poly(const Particles<Real, 2>& particles, const Scene& scene);

/// One line per crack, through the points of its plane. Point arrays:
///   crack; first_position [m]; upper, lower [m] positions of the surfaces; opening [m] = upper - lower;
///   normal_opening [m]      along the crack's left-hand normal, positive where the crack is open;
///   sliding [m]             along the direction from the first point to the last.
/// Cell arrays: crack.
PolyData crack_poly(const Cracks& cracks);

/// Writes numbered frames into `folder`/frames, each whole or not at all, and joins them at the end.
class FrameWriter {
 public:
  /// A run that begins anew removes the frames of an older run in the same folder; one that is taken up again keeps
  /// the first of them, those of these times. Throws Error (file).
  FrameWriter(std::filesystem::path folder, const Scene& scene, std::vector<double> times = {});
  template <class Real>
  void write(double time, const Particles<Real, 2>& particles, const Cracks& cracks);
  /// Makes particles.vtkhdf and cracks.vtkhdf.
  void finish() const;
  /// Of all frames so far, s.
  const std::vector<double>& times() const { return times_; }

 private:
  void write_one(const std::string& prefix, PolyData data, double time) const;
  void write_indices() const;

  std::filesystem::path folder_;
  const Scene& scene_;
  std::vector<double> times_;
};

/// Copies the first frames of one folder of results to another one, in place of those that are there; nothing when both
/// are the same. Frames that are missing are left out. Throws Error (file).
void bring_frames(const std::filesystem::path& from, const std::filesystem::path& to, int count);

/// Joins the frames of a finished or killed run. Returns how many frames of particles there were.
int assemble_frames(const std::filesystem::path& folder);

}  // namespace riven
