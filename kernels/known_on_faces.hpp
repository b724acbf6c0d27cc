// What faces of cracks out of line with a tip add to its interaction integrals. Of
//   int q [ W12 n_1 - (s1 n) . du2/dx_1 - (s2 n) . du1/dx_1 ] ds,   W12 = s1 : e2,
// with s1, u1 the actual fields, s2, u2 the known ones, x_1 along the heading and n out of the solid, the second term
// is nothing on a free face; on faces of another crack that are pressed together, on either side of which the known
// fields are the same, it cancels. The stress and the rotation w of the solid say all of du1: along and across the face
//   du1/ds = (e_ss, e_sn + w),  du1/dn = (e_sn - w, e_nn).
// With a tip that runs W12 has the energy of motion besides, rho c^2 du1/dx_1 . du2/dx_1.
// For curved cracks the same is found, in curved coordinates, by Gosz and Moran, Eng. Fract. Mech. 69 (2002) 299-319.
#pragma once
#include <algorithm>

#include "core/fracture/auxiliary_fields.hpp"
#include "kernels/crack_faces.hpp"
#include "kernels/own_faces.hpp"

namespace riven {

/// A segment of a crack in the domain of a tip.
struct FaceSegment {
  int k, crack;
  Vec2 middle, normal;  ///< m; normal of unit length, towards above
  double length;        ///< m
  double q;             ///< JWeight::q in its middle
  double turn;          ///< sine of the angle to the tip's heading; 2 for another crack

  /// The length of one of its faces along the normal out of the solid.
  Vec2 out(Side side) const { return (side == Side::above ? -length : length) * normal; }
};

/// Stresses in the frame of a face, Pa: along it, across, and shear.
struct FaceStress {
  double along = 0, across = 0, shear = 0;

  FaceStress(const FaceValues& values, Vec2 normal) {
    const double xx = values[face_stress], yy = values[face_stress + 1], xy = values[face_stress + 2];
    const double x = normal.x, y = normal.y;
    along = xx * y * y + yy * x * x - 2 * xy * x * y;
    across = xx * x * x + yy * y * y + 2 * xy * x * y;
    shear = (xx - yy) * x * y + xy * (y * y - x * x);
  }
  /// Of a free face.
  explicit FaceStress(double tension) : along(tension) {}
};

/// A free face: the tension along it is all that the solid bears there.
struct FreeFace {
  double kinetic, tension;  ///< Pa
  double rotation;          ///< against that of the tip
  double energy(double E) const { return std::max(0.0, kinetic) + tension * tension / (2 * E); }
};

class KnownOnFaces {
 public:
  KnownOnFaces(const Cracks& cracks, const OwnFaces& own, TipTask& task) : cracks_(cracks), own_(own), task_(task) {}

  /// Of another crack, by the values next to the face.
  void add_beside(const FaceSegment& s, Side side, const FaceValues& values, bool free) {
    if (!task_.interaction)
      return;
    const FaceStress stress(values, s.normal);
    add(s, s.out(side), free ? FaceStress(stress.along) : stress, values[face_rotation], sign_beside(s, side));
  }

  /// Of the tip's own crack. Particles that the tip has passed keep what cancels on the grid, and the faces themselves
  /// tell better how they have turned; but for those that another crack may have parted.
  void add_own(const FaceSegment& s, Side side, const FreeFace& face) {
    if (!task_.cut)
      return;
    const double left = BranchCut::sign_on_left(in_frame(s.middle - task_.domain.tip));
    add(s, s.out(side), FaceStress(face.tension), own_.meets_other(s.k) ? face.rotation : rotation(s.k, side),
        (side == Side::above) == task_.last ? left : -left);
  }

 private:
  Vec2 in_frame(Vec2 a) const { return {dot(a, task_.heading), cross(task_.heading, a)}; }

  /// The sign of the known fields next to a face of another crack, along which the cut may go on.
  double sign_beside(const FaceSegment& s, Side side) const {
    if (!task_.cut)
      return 1;
    const Vec2 r = in_frame(s.middle - task_.domain.tip);
    if (!is_on_way(s))
      return task_.cut->sign(r);
    const double left = BranchCut::sign_on_left(r);
    return (side == Side::above) == (task_.way.host_step < 0) ? left : -left;
  }

  bool is_on_way(const FaceSegment& s) const {
    const WayFromTip& way = task_.way;
    if (s.crack != way.host)
      return false;
    const Vec2 end = cracks_.plane[way.until];
    const int behind = way.host_first - (way.host_step > 0 ? 1 : 0);  // the segment that the tip's crack ends on
    if (s.k == behind)
      return dot(s.middle - end, cracks_.plane[way.host_first] - end) > 0;
    return way.host_step > 0 ? s.k > behind : s.k < behind;
  }

  /// Sine of the angle by which a face has turned more than the tip.
  double rotation(int k, Side side) const {
    const Vec2 first = cracks_.plane0[k + 1] - cracks_.plane0[k], R = task_.turn;
    const Vec2 laid{R.x * first.x - R.y * first.y, R.y * first.x + R.x * first.y};
    const exec::Array<Vec2>& face = side == Side::above ? cracks_.upper : cracks_.lower;
    return cross(laid, face[k + 1] - face[k]) / dot(laid, laid);
  }

  void add(const FaceSegment& face, Vec2 out_of_solid, FaceStress stress, double w, double sign) {
    const PlaneElasticity& solid = *task_.solid;
    const Vec2 n = in_frame(face.normal), s{n.y, -n.x}, out = in_frame(out_of_solid);
    const auto [along, across, shear] = stress;
    const double lateral = (3 - solid.kappa) / (1 + solid.kappa);  // nu, in plane strain nu / (1 - nu)
    const double e_ss = (along - lateral * across) / solid.E, e_nn = (across - lateral * along) / solid.E;
    const double e_sn = shear / (2 * solid.mu);
    const Vec2 slope = s.x * (e_ss * s + (e_sn + w) * n) + n.x * ((e_sn - w) * s + e_nn * n);  // du1/dx_1
    const double running = task_.running.speed / solid.shear_speed, inertia = solid.mu * running * running;
    const AuxiliaryFields known = auxiliary_fields(solid, task_.running, in_frame(face.middle - task_.domain.tip));
    for (int mode = 0; mode < 2; ++mode) {
      const AuxiliaryField& a = known.mode[mode];
      const auto strain = [&](Vec2 u, Vec2 v) {
        return a.exx * u.x * v.x + a.eyy * u.y * v.y + a.exy * (u.x * v.y + u.y * v.x);
      };
      const double work = along * strain(s, s) + across * strain(n, n) + 2 * shear * strain(s, n) +
                          inertia * (slope.x * a.dux_dx + slope.y * a.duy_dx);
      const Vec2 traction{a.sxx * out.x + a.sxy * out.y, a.sxy * out.x + a.syy * out.y};
      task_.sums.interaction[mode] += sign * face.q * (work * out.x - dot(traction, slope));
    }
  }

  const Cracks& cracks_;
  const OwnFaces& own_;
  TipTask& task_;
};

}  // namespace riven
