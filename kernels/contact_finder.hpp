// Whether the faces between two fields of a node touch: detection by volume, velocity or displacement (contact.hpp).
#pragma once
#include <algorithm>
#include <cstdint>

#include "core/laws/contact.hpp"
#include "kernels/contact_meetings.hpp"
#include "kernels/friction_around.hpp"
#include "kernels/prescribed_fields.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// What contact is found by.
template <class Real>
struct ContactFinder {
  ContactDetection by;
  double v_sep, v_contact;
  NodeSums<Real> sums;
  const NodeNormals* normals;
  const ThirdNormal* third_normals;
  const ContactArea* area;
  long flagged;
  double reach;        ///< m, gap beyond which nothing touches (displacement)
  double* pressed;     ///< CrackFields; null where none is kept
  const Vec2* slopes;  ///< ContactSums; null where none pressed, and in the momentum update
  bool noise;          ///< ContactSums
  FieldLinks* links;   ///< ContactSums; null where not asked for
  PrescribedFields prescribed;
  FrictionAround around;  ///< asks in the momentum update
  std::uint8_t* stuck;    ///< CrackFields; null where none is kept

  /// By what faces of a node that sees one crack pressed in the last momentum update, N s; 0 in that stage itself.
  RIVEN_INLINE double last(int node) const { return slopes ? pressed[node] : 0; }
  /// Has friction held them for so long that they go on as one?
  RIVEN_INLINE bool settled(int node) const { return stuck && stuck[node] >= FrictionAround::settled; }
  /// Notes whether it holds those that press in this update.
  RIVEN_INLINE void count_held(int node, bool held) const {
    if (stuck)
      stuck[node] = held ? static_cast<std::uint8_t>(std::min(stuck[node] + 1, 255)) : 0;
  }
  /// How their fields move apart in a solid that goes on across the faces, m/s across and along them.
  RIVEN_INLINE Vec2 apart(long index, const long* slot, const double* mass, const Meeting& m) const {
    const Vec2 w = -distance_of(m, sums.place, slot, mass) * slopes[index];
    return {dot(w, m.normal), dot(w, turned(m.normal))};
  }
};

/// An impulse is more than what rounding makes of faces that move as one.
RIVEN_INLINE bool acts(Vec2 impulse, double sum_of_momenta) {
  constexpr double rounding = 1e-10;
  return norm(impulse) > rounding * sum_of_momenta;
}

/// Whether two fields touch, and in what way.
enum class Touch { none, apart, bonds, sticks, pulls, pushes };

struct Verdict {
  Touch touch;
  ContactPair pair;  ///< pulls (without its responses) and pushes
  double gap;        ///< m
};

/// What detection says of a meeting of fields in these slots, with these masses.
template <class Real>
RIVEN_INLINE Verdict judge(const ContactFinder<Real>& found, const long* slot, const double* mass, double dt,
                           const Meeting& m, double relative_volume) {
  if (m.law.law == ContactLaw::ignored)
    return {Touch::none, {}, 0};
  if (m.law.law == ContactLaw::bonded)
    return {Touch::bonds, {}, 0};
  if (m.law.law == ContactLaw::interface) {
    Verdict v{Touch::pulls, {}, 0};
    v.pair.above = m.above;
    v.pair.below = m.below;
    v.pair.normal = m.normal;
    return v;
  }
  const bool by_volume = found.by == ContactDetection::volume;
  if (by_volume && relative_volume < found.v_sep)
    return {Touch::apart, {}, 0};
  const bool held = by_volume && relative_volume > found.v_contact;
  const double g = found.by == ContactDetection::displacement ? gap_of(m, found.sums.place, slot, mass) : 0;
  if (g > found.reach)
    return {Touch::apart, {}, g};
  if (m.law.law == ContactLaw::stick)
    return {held ? Touch::bonds : g <= 0 ? Touch::sticks : Touch::apart, {}, g};
  return {Touch::pushes, touching_pair(m.law, m.above, m.below, m.normal, g, dt, held), g};
}

}  // namespace RIVEN_SIDE

}  // namespace riven
