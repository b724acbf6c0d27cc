// Strain energy and stresses on the faces of cracks, for the integrals along them: values of particles on one side,
// carried on to the face.
//
// At a node i near the crack the particles of one velocity field are on one side of it. The linear field
//   f(x) = c + g . (x - x_i),   sum a_p S_ip (f_p - f(x_p))^2 + ridge |g|^2 -> min,
// takes their values on to the face, where the average of the field (Nairn and Aimene, eq. 5) would give the value half
// a cell inside the solid. At a point of the face the fields of the nodes of its cell are averaged by N_i(x) and the
// area of particles behind each.
#pragma once
#include <array>

#include "core/exec/config.hpp"
#include "core/math/vec.hpp"

namespace riven {

/// What is asked for on a face, and where in FaceValues it begins.
inline constexpr int face_stress = 0;                   ///< [xx yy xy], Pa
inline constexpr int face_kinetic = 3;                  ///< kinetic energy per first volume, Pa, where it counts
inline constexpr int face_rotation = 4;                 ///< against that of the tip
inline constexpr int face_energy = 5;                   ///< kinetic with the strain energy, Pa
inline constexpr int face_eshelby = 6;                  ///< Eshelby's tensor [11 12 21 22], rows K, columns j, Pa
inline constexpr int face_cheap = 5, face_values = 10;  ///< how many need no strain energy, and in all
using FaceValues = std::array<double, face_values>;

/// Sums for the fits of one velocity field of one node, for its first values; offsets are from the node, in cells.
struct FieldFit {
  double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;  ///< in cells
  FaceValues f{}, fx{}, fy{};

  /// Adds weight * (value at offset r) of the fitted field to `to`, for the first `count` values.
  void evaluate(Vec2 r, double weight, size_t count, FaceValues& to) const;
};

}  // namespace riven
