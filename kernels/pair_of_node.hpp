// The two fields of a node that sees one crack, without an interface, and how they meet.
#pragma once
#include "kernels/contact_finder.hpp"
#include "kernels/field_motion.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

template <class Real, ContactStage stage>
struct PairOfNode {
  long slot[2];
  double mass[2];
  Vec2 momentum[2];
  Meeting meeting;
  double last;        ///< ContactFinder
  Vec2 u;             ///< m/s, of the upper field as seen from the lower one,
  Vec2 across;        ///< and its components along the normal and the tangent
  bool prescribed;    ///< the motion of one is, at least in part
  Vec2 yielding;      ///< then: see PrescribedFields
  Vec2 reduced_mass;  ///< kg, of the motions across and along
  double volume;      ///< relative_volume()
  Verdict verdict;

  /// False where nothing acts between them; faces that part are counted.
  RIVEN_INLINE bool find(const FieldMotion<Real, stage>& motion, const ContactFinder<Real>& found, double dt,
                         const NodeCracks& n, long index, const Lattice& lattice, const ContactSettings* laws,
                         long& apart) {
    slot[0] = n.node;
    slot[1] = long{lattice.nodes()} + n.extra;
    mass[0] = double(motion.mass[slot[0]]);
    mass[1] = double(motion.mass[slot[1]]);
    if (!(mass[0] > 0) || !(mass[1] > 0))
      return false;
    const Meeting& m = meeting = meeting_across(n, {found.normals + index, nullptr}, laws, 0, 0, 1, 1);
    if (m.law.law == ContactLaw::ignored || found.prescribed.both_given(slot, m) ||
        (stage == ContactStage::higher && found.links && found.links[index].any()))
      return false;
    momentum[0] = motion.momentum_of(slot[0]);
    momentum[1] = motion.momentum_of(slot[1]);
    const double closing = dot(mass[m.below] * momentum[m.above] - mass[m.above] * momentum[m.below], m.normal);
    last = found.last(n.node);
    if (closing <= 0 && last == 0 && found.by != ContactDetection::volume && m.law.law != ContactLaw::bonded) {
      ++apart;  // faces that part do not touch, whatever their gap
      return false;
    }
    u = (1 / mass[m.above]) * momentum[m.above] - (1 / mass[m.below]) * momentum[m.below];
    across = {dot(u, m.normal), dot(u, turned(m.normal))};
    prescribed = (found.prescribed.of(slot[0]) | found.prescribed.of(slot[1])) != 0;
    yielding = prescribed ? found.prescribed.yielding(slot, mass) : Vec2{};
    const double of_both = mass[0] * mass[1] / (mass[0] + mass[1]);
    reduced_mass = prescribed ? reduced_masses(yielding, m.normal) : Vec2{of_both, of_both};
    found.sums.ask(index, n);
    const double* area = found.sums.volume;
    volume = area ? relative_volume(lattice, n.node, area[slot[0]] + area[slot[1]]) : 1;
    verdict = judge(found, slot, mass, dt, m, volume);
    return true;
  }

  /// The impulse of faces that push, by what this node knows.
  RIVEN_INLINE PairImpulse by_law() const {
    return prescribed ? coupled_impulse(verdict.pair, yielding, across)
                      : pair_impulse(verdict.pair, reduced_mass, across);
  }
  /// The impulse along the faces that keeps them from sliding.
  RIVEN_INLINE double to_stick() const { return reduced_mass.y * across.y; }
};

}  // namespace RIVEN_SIDE

}  // namespace riven
