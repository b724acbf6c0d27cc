// The contact of the two fields of a node that sees one crack (laws: core/laws/contact.hpp).
#pragma once
#include <algorithm>

#include "kernels/contact.hpp"
#include "kernels/pair_of_node.hpp"
#include "kernels/pressed_faces.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// What keeps the faces of a node that sees one crack from overlapping and from sliding, if they bear friction and
/// press on each other in this update; else 0 (friction_around.hpp).
template <class Real>
RIVEN_INLINE Vec2 friction_asked(const FieldMotion<Real, ContactStage::after>& motion, const ContactFinder<Real>& found,
                                 double dt, const NodeCracks& n, long index, const Lattice& lattice,
                                 const ContactSettings* laws) {
  if (!(friction_of(laws[n.crack[0]]) > 0))
    return {};
  PairOfNode<Real, ContactStage::after> pair;
  long apart = 0;
  if (!pair.find(motion, found, dt, n, index, lattice, laws, apart) || pair.verdict.touch != Touch::pushes)
    return {};
  const PairImpulse r = pair.by_law();
  return r.lambda > 0 ? Vec2{r.lambda, pair.prescribed ? r.tau : pair.to_stick()} : Vec2{};
}

/// The contact of a node that sees one crack, without an interface: the common case, and the same laws without the
/// search for a common solution. Does it act?
template <class Real, ContactStage stage>
RIVEN_INLINE bool one_contact(const FieldMotion<Real, stage>& motion, const ImpulseNotes& notes,
                              const ContactFinder<Real>& found, double dt, const NodeCracks& n, long index,
                              const Lattice& lattice, const ContactSettings* laws, ContactReport& report) {
  PairOfNode<Real, stage> pair;
  if (!pair.find(motion, found, dt, n, index, lattice, laws, report.apart))
    return false;
  const Meeting& m = pair.meeting;
  const Verdict& v = pair.verdict;
  const auto& mass = pair.mass;
  const auto& momentum = pair.momentum;
  const double last = pair.last;
  const int a = m.above, b = m.below;
  const double inverse[2] = {1 / mass[0], 1 / mass[1]};
  const double momenta = norm(momentum[0]) + norm(momentum[1]), tiny = ContactNode::tolerance * momenta;
  const double closing = pair.reduced_mass.x * pair.across.x;
  const bool pushes = v.touch == Touch::pushes, settled = pushes && last > 0 && found.settled(n.node);
  const bool sticky = v.touch == Touch::sticks || settled;
  Vec2 velocity[2], impulse[2];
  bool touches = false, sticks = true, held = false;
  double now = 0;
  if (v.touch == Touch::bonds || (sticky && v.gap <= 0 && closing > tiny)) {
    touches = true;
    now = sticky ? closing : 0;
    velocity[0] = velocity[1] = (momentum[0] + momentum[1]) * (1 / (mass[0] + mass[1]));
    for (int f = 0; f < 2; ++f)
      impulse[f] = mass[f] * (velocity[f] - momentum[f] * inverse[f]);
    if (pair.prescribed) {
      impulse[b] = {inverse_or_none(pair.yielding.x) * pair.u.x, inverse_or_none(pair.yielding.y) * pair.u.y};
      impulse[a] = -impulse[b];
      for (int f = 0; f < 2; ++f)
        velocity[f] = (momentum[f] + impulse[f]) * inverse[f];
    }
  } else if (pushes || (v.touch == Touch::sticks && last > 0)) {
    PairImpulse r = pushes ? pair.by_law() : PairImpulse{0, 0};
    const double mu = friction_of(m.law);
    if (found.around.asked && r.lambda != 0 && mu > 0 && !pair.prescribed) {
      const Stairs stairs = stairs_of(m, found.sums.place, pair.slot, pair.mass);
      if (const FrictionBounds bounds = found.around.borne(n, index, 0, mu, stairs, lattice); !bounds.none()) {
        const double to_stick = pair.to_stick();
        r.tau = bounds.within(to_stick, r.lambda);
        held = r.tau == to_stick;
      }
    }
    sticks = held || std::abs(r.tau) < mu * std::abs(r.lambda);
    if (last > 0)
      r = hold(r, last, sticky, sticky || (found.noise && m.law.friction == 0), pair.reduced_mass, pair.across,
               found.apart(index, pair.slot, mass, m));
    now = r.lambda;
    touches = r.lambda != 0 || r.tau != 0;
    impulse[b] = r.lambda * m.normal + r.tau * turned(m.normal);
    impulse[a] = -impulse[b];
    for (int f = 0; f < 2; ++f)
      velocity[f] = (momentum[f] + impulse[f]) * inverse[f];
  }
  ++(touches ? report.touching : report.apart);
  if (!touches)
    return false;
  if (stage == ContactStage::after && found.links)
    found.links[index].link_two(sticks);
  if (stage == ContactStage::after && found.pressed && now > 0) {
    found.pressed[n.node] = now;
    ++report.pressing;
    found.count_held(n.node, held);
  }
  if (v.touch != Touch::bonds) {
    report.penetration = std::max(report.penetration, -v.gap);
    report.gap = std::max(report.gap, v.gap);
    report.early += pair.volume < found.v_sep;
  }
  for (int f = 0; f < 2; ++f)
    found.prescribed.give(motion, notes, index, n, pair.slot[f], impulse[f], velocity[f], dt);
  return acts(impulse[0], momenta);
}

}  // namespace RIVEN_SIDE

}  // namespace riven
