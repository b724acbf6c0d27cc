// What faces of cracks out of line with a tip add to its interaction integrals. Of
//   int q [ W12 n_1 - (s1 n) . du2/dx_1 - (s2 n) . du1/dx_1 ] ds,   W12 = s1 : e2,
// with s1, u1 the actual fields, s2, u2 the known ones, x_1 along the heading and n out of the solid, the second term
// is what a face bears times the slope of the known motion, and nothing on a free one; on faces of another crack that
// are pressed together, on either side of which the known fields are the same, it cancels. The stress and the rotation
// w of the solid say all of du1: along and across the face
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
  /// Of a face under this tension along it that bears `traction` where it is the upper one, and the opposite where it
  /// is the lower one; of a free one without.
  explicit FaceStress(double tension, Vec2 traction = {}, Vec2 normal = {})
      : along(tension), across(-dot(traction, normal)), shear(dot(traction, turned(normal))) {}
};

/// The strains and the slopes along the normal that go with them: du/dn = (e_sn - w, e_nn).
struct FaceStrain {
  double ss, nn, sn;
  FaceStrain(const FaceStress& s, const PlaneElasticity& solid) {
    const double lateral = (3 - solid.kappa) / (1 + solid.kappa);  // nu, in plane strain nu / (1 - nu)
    ss = (s.along - lateral * s.across) / solid.E;
    nn = (s.across - lateral * s.along) / solid.E;
    sn = s.shear / (2 * solid.mu);
  }
  /// (s n) . du/dn, Pa.
  double work_across(const FaceStress& s, double w) const { return s.across * nn + s.shear * (sn - w); }
};

/// An open face: the solid bears the tension along it, and what the face itself bears.
struct OpenFace {
  double kinetic;  ///< Pa
  FaceStress stress;
  double rotation;  ///< against that of the tip

  /// W + K - (s n) . du/dn, Pa: what goes through the face along its normal.
  double through(const PlaneElasticity& solid) const {
    const FaceStrain e(stress, solid);
    const double strain = 0.5 * (stress.along * e.ss + stress.across * e.nn) + stress.shear * e.sn;
    return std::max(0.0, kinetic) + strain - e.work_across(stress, rotation);
  }
};

class KnownOnFaces {
 public:
  KnownOnFaces(const Cracks& cracks, const OwnFaces& own, TipTask& task) : cracks_(cracks), own_(own), task_(task) {}

  /// Of another crack. `borne`: Pa, traction of a law on the upper face.
  void add_beside(const FaceSegment& s, Side side, const FaceStress& stress, Vec2 borne, double w) {
    if (task_.interaction)
      add(s, s.out(side), stress, (side == Side::above ? s.length : -s.length) * borne, w, sign_beside(s, side));
  }

  /// Of the tip's own crack. Particles that the tip has passed keep what cancels on the grid, and the faces themselves
  /// tell better how they have turned; but for those that another crack may have parted. `borne`: Pa, traction on the
  /// upper face of a segment, unless own_faces.hpp counts what that does.
  void add_own(const FaceSegment& s, Side side, const OpenFace& face, Vec2 borne) {
    if (!task_.cut)
      return;
    const double left = BranchCut::sign_on_left(in_frame(s.middle - task_.domain.tip));
    add(s, s.out(side), face.stress, (side == Side::above ? s.length : -s.length) * borne,
        own_.meets_other(s.k) ? face.rotation : rotation(s.k, side),
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
    const Vec2 laid = task_.turn_with_tip(cracks_.plane0[k + 1] - cracks_.plane0[k]);
    const exec::Array<Vec2>& face = side == Side::above ? cracks_.upper : cracks_.lower;
    return cross(laid, face[k + 1] - face[k]) / dot(laid, laid);
  }

  /// `force`: N/m, what acts on the face.
  void add(const FaceSegment& face, Vec2 out_of_solid, const FaceStress& stress, Vec2 force, double w, double sign) {
    const PlaneElasticity& solid = *task_.solid;
    const Vec2 n = in_frame(face.normal), s{n.y, -n.x}, out = in_frame(out_of_solid), acts = in_frame(force);
    const FaceStrain e(stress, solid);
    const Vec2 slope = s.x * (e.ss * s + (e.sn + w) * n) + n.x * ((e.sn - w) * s + e.nn * n);  // du1/dx_1
    const double running = task_.running.speed / solid.shear_speed, inertia = solid.mu * running * running;
    const AuxiliaryFields known = auxiliary_fields(solid, task_.running, in_frame(face.middle - task_.domain.tip));
    for (int mode = 0; mode < 2; ++mode) {
      const AuxiliaryField& a = known.mode[mode];
      const auto strain = [&](Vec2 u, Vec2 v) {
        return a.exx * u.x * v.x + a.eyy * u.y * v.y + a.exy * (u.x * v.y + u.y * v.x);
      };
      const Vec2 known_slope{a.dux_dx, a.duy_dx};
      const double work = stress.along * strain(s, s) + stress.across * strain(n, n) + 2 * stress.shear * strain(s, n) +
                          inertia * dot(slope, known_slope);
      const Vec2 traction{a.sxx * out.x + a.sxy * out.y, a.sxy * out.x + a.syy * out.y};
      task_.sums.interaction[mode] += sign * face.q * (work * out.x - dot(acts, known_slope) - dot(traction, slope));
    }
  }

  const Cracks& cracks_;
  const OwnFaces& own_;
  TipTask& task_;
};

}  // namespace riven
