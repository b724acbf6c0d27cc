// The contact of the two fields of a node that sees one crack (laws: core/laws/contact.hpp).
#pragma once
#include <algorithm>

#include "kernels/contact.hpp"
#include "kernels/contact_finder.hpp"
#include "kernels/pressed_faces.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

/// The contact of a node that sees one crack, without an interface: the common case, and the same laws without the
/// search for a common solution. Does it act?
template <class Real, ContactStage stage>
RIVEN_INLINE bool one_contact(const FieldMotion<Real, stage>& motion, const ImpulseNotes& notes,
                              const ContactFinder<Real>& found, double dt, const NodeCracks& n, long index,
                              const Lattice& lattice, const ContactSettings* laws, ContactReport& report) {
  const long slot[2] = {n.node, long{lattice.nodes()} + n.extra};
  const double mass[2] = {double(motion.mass[slot[0]]), double(motion.mass[slot[1]])};
  if (!(mass[0] > 0) || !(mass[1] > 0))
    return false;
  const Meeting m = meeting_across(n, {found.normals + index, nullptr}, laws, 0, 0, 1, 1);
  if (m.law.law == ContactLaw::ignored || found.prescribed.both_given(slot, m) ||
      (stage == ContactStage::higher && found.links && found.links[index].any()))
    return false;
  const Vec2 momentum[2] = {motion.momentum_of(slot[0]), motion.momentum_of(slot[1])};
  const int a = m.above, b = m.below;
  const double closing = dot(mass[b] * momentum[a] - mass[a] * momentum[b], m.normal);
  const double last = found.last(n.node);
  if (closing <= 0 && last == 0 && found.by != ContactDetection::volume && m.law.law != ContactLaw::bonded) {
    ++report.apart;  // faces that part do not touch, whatever their gap
    return false;
  }
  const double inverse[2] = {1 / mass[0], 1 / mass[1]};
  const Vec2 t = turned(m.normal), u = inverse[a] * momentum[a] - inverse[b] * momentum[b];
  const bool prescribed = (found.prescribed.of(slot[0]) | found.prescribed.of(slot[1])) != 0;
  const double un = dot(u, m.normal), of_both = mass[0] * mass[1] / (mass[0] + mass[1]);
  const Vec2 yielding = prescribed ? found.prescribed.yielding(slot, mass) : Vec2{};
  const Vec2 reduced = prescribed ? reduced_masses(yielding, m.normal) : Vec2{of_both, of_both};
  found.sums.ask(index, n);
  const double* area = found.sums.volume;
  const double volume = area ? relative_volume(lattice, n.node, area[slot[0]] + area[slot[1]]) : 1;
  const Verdict v = judge(found, slot, mass, dt, m, volume);
  const double momenta = norm(momentum[0]) + norm(momentum[1]), tiny = ContactNode::tolerance * momenta;
  Vec2 velocity[2], impulse[2];
  bool touches = false, sticks = true;
  double now = 0;
  if (v.touch == Touch::bonds || (v.touch == Touch::sticks && reduced.x * un > tiny)) {
    touches = true;
    now = v.touch == Touch::sticks ? reduced.x * un : 0;
    velocity[0] = velocity[1] = (momentum[0] + momentum[1]) * (1 / (mass[0] + mass[1]));
    for (int f = 0; f < 2; ++f)
      impulse[f] = mass[f] * (velocity[f] - momentum[f] * inverse[f]);
    if (prescribed) {
      impulse[b] = {inverse_or_none(yielding.x) * u.x, inverse_or_none(yielding.y) * u.y};
      impulse[a] = -impulse[b];
      for (int f = 0; f < 2; ++f)
        velocity[f] = (momentum[f] + impulse[f]) * inverse[f];
    }
  } else if (v.touch == Touch::pushes || (v.touch == Touch::sticks && last > 0)) {
    const Vec2 across{un, dot(u, t)};
    PairImpulse r{0, 0};
    if (v.touch == Touch::pushes)
      r = prescribed ? coupled_impulse(v.pair, yielding, across) : pair_impulse(v.pair, reduced, across);
    sticks = std::abs(r.tau) < v.pair.friction * std::abs(r.lambda);
    if (last > 0)
      r = hold(r, last, v.touch == Touch::sticks, found.noise && m.law.friction == 0, reduced, across,
               found.apart(index, slot, mass, m));
    now = r.lambda;
    touches = r.lambda != 0 || r.tau != 0;
    impulse[b] = r.lambda * m.normal + r.tau * t;
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
  }
  if (v.touch != Touch::bonds) {
    report.penetration = std::max(report.penetration, -v.gap);
    report.gap = std::max(report.gap, v.gap);
    report.early += volume < found.v_sep;
  }
  for (int f = 0; f < 2; ++f)
    found.prescribed.give(motion, notes, index, n, slot[f], impulse[f], velocity[f], dt);
  return acts(impulse[0], momenta);
}

}  // namespace RIVEN_SIDE

}  // namespace riven
