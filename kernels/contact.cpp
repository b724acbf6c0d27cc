#include "kernels/contact.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "core/laws/contact_node.hpp"
#include "kernels/contact_meetings.hpp"
#include "kernels/field_motion.hpp"
#include "kernels/prescribed_fields.hpp"
#include "kernels/pressed_faces.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

template <class Real>
struct Detection {
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
  PrescribedFields prescribed;

  /// By what faces of a node that sees one crack pressed in the last momentum update, N s; 0 in that stage itself.
  RIVEN_INLINE double last(int node) const { return slopes ? pressed[node] : 0; }
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

enum class Touch { none, apart, bonds, sticks, pulls, pushes };

struct Verdict {
  Touch touch;
  ContactPair pair;  ///< pulls (without its responses) and pushes
  double gap;        ///< m
};

/// What detection says of a meeting of fields in these slots, with these masses.
template <class Real>
RIVEN_INLINE Verdict judge(const Detection<Real>& found, const long* slot, const double* mass, double dt,
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

/// The contact of a node that sees one crack, without an interface: the common case, and the same laws without the
/// search for a common solution. Does it act?
template <class Real, ContactStage stage>
RIVEN_INLINE bool one_contact(const FieldMotion<Real, stage>& motion, const ImpulseNotes& notes,
                              const Detection<Real>& found, double dt, const NodeCracks& n, long index,
                              const Lattice& lattice, const ContactSettings* laws, ContactReport& report) {
  const long slot[2] = {n.node, long{lattice.nodes()} + n.extra};
  const double mass[2] = {double(motion.mass[slot[0]]), double(motion.mass[slot[1]])};
  if (!(mass[0] > 0) || !(mass[1] > 0))
    return false;
  const Meeting m = meeting_across(n, {found.normals + index, nullptr}, laws, 0, 0, 1, 1);
  if (m.law.law == ContactLaw::ignored || found.prescribed.both_given(slot, m))
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
  bool touches = false;
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
    if (last > 0)
      r = hold(r, last, v.touch == Touch::sticks, reduced, across, found.apart(index, slot, mass, m));
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

/// The contacts of a node that holds so many cracks at most and may have several meetings, from its slots to its slots.
template <int cracks, class Real, ContactStage stage>
struct NodeContact {
  using Node = ContactNodeOf<cracks>;
  using Outcome = ContactOutcomeOf<cracks>;
  static constexpr int most_pairs = Node::most_pairs;

  const FieldMotion<Real, stage>& motion;
  const ImpulseNotes& notes;
  const Detection<Real>& found;
  const double dt;
  Node node{};
  long slot[Node::fields] = {};
  Meeting pair[most_pairs] = {};  ///< the meeting behind each of node.pair
  double gap[most_pairs] = {};
  double stick_gap[most_pairs] = {};
  ContactReport report{};

  RIVEN_INLINE void load(const NodeCracks& n, const Lattice& lattice) {
    for (int f = 0; f < n.fields(); ++f) {
      slot[f] = f == 0 ? n.node : long{lattice.nodes()} + n.extra + f - 1;
      node.mass[f] = motion.mass[slot[f]];
      if (node.mass[f] > 0)
        node.momentum[f] = motion.momentum_of(slot[f]);
    }
  }

  RIVEN_INLINE void add(const Meeting& m, const ContactPair& p, double g) {
    pair[node.pairs] = m;
    gap[node.pairs] = g;
    node.add(p);
  }

  /// The pair that already stands for the same crack between the same groups of fields, or -1.
  RIVEN_INLINE int find_same(const Meeting& m) const {
    for (int k = 0; k < node.pairs; ++k)
      if (pair[k].k == m.k && node.together(pair[k].above, m.above) && node.together(pair[k].below, m.below))
        return k;
    return -1;
  }

  /// Of two meetings across one crack that bonded fields make one, the first to close counts, and an interface has the
  /// area of both.
  RIVEN_INLINE void list(const Meeting& m, const Verdict& v) {
    switch (v.touch) {
      case Touch::none: return;
      case Touch::apart: ++report.apart; return;
      case Touch::bonds:
        node.bond(m.above, m.below);
        ++report.touching;
        return;
      case Touch::sticks:
        stick_gap[node.stickings] = v.gap;
        node.add(StickingPair{m.above, m.below, m.normal});
        return;
      case Touch::pulls:
      case Touch::pushes: break;
    }
    const int k = find_same(m);
    if (k < 0) {
      add(m, v.pair, v.gap);
    } else if (v.touch == Touch::pulls) {
      pair[k].share += m.share;
    } else if (v.gap < gap[k]) {
      gap[k] = v.gap;
      node.pair[k] = v.pair;
    }
  }

  RIVEN_INLINE void detect(const Meetings<cracks>& meetings, double relative_volume) {
    for (const Meeting& m : meetings)
      if (m.law.law == ContactLaw::bonded)
        list(m, judge(found, slot, node.mass, dt, m, relative_volume));
    for (const Meeting& m : meetings)
      if (!node.together(m.above, m.below) && !found.prescribed.both_given(slot, m))
        list(m, judge(found, slot, node.mass, dt, m, relative_volume));
  }

  /// Fields whose motion is prescribed do not give way, where they are firm. One that is prescribed in one component
  /// alone does, half-way: what it resists is not given to it.
  RIVEN_INLINE void hold_prescribed() {
    constexpr double heavy = 1e6;  // tolerances of the solution go by the sum of m |v|
    double all = 0;
    for (const double m : node.mass)
      all += m;
    for (int f = 0; f < Node::fields; ++f)
      if (node.mass[f] > 0 && found.prescribed.of(slot[f]) == 3 && firmness(node.mass[f], all) == 1) {
        node.mass[f] *= heavy;
        node.momentum[f] *= heavy;
      }
  }

  /// Velocity of a group of fields before the step's forces.
  RIVEN_INLINE Vec2 first_velocity(int f) const {
    Vec2 p;
    for (int g = 0; g < Node::fields; ++g)
      if (node.mass[g] > 0 && node.together(f, g))
        p += node.mass[g] * motion.first_velocity(slot[g], dt);
    return p * (1 / node.group_mass(f));
  }

  RIVEN_INLINE void respond(ContactPair& p, const Meeting& m, const ContactArea& a) const {
    const double factor = m.share * a.area * dt * dt / node.reduced_mass(m.above, m.below);
    const double across = factor * m.law.normal_stiffness, along = factor * m.law.shear_stiffness;
    if constexpr (stage == ContactStage::after) {
      const Vec2 n = m.normal, t = turned(n), u = first_velocity(m.above) - first_velocity(m.below);
      p.across = interface_response(across, dot(u, n), dot(a.opening, n), dt);
      p.along = interface_response(along, dot(u, t), dot(a.opening, t), dt);
    } else {
      p.across = interface_hold(across);
      p.along = interface_hold(along);
    }
  }

  RIVEN_INLINE void tally(const Outcome& out, double relative_volume) {
    report.capped += !out.converged;
    bool touched = false;
    for (int k = 0; k < node.pairs; ++k) {
      const bool push = out.lambda[k] != 0 || out.tau[k] != 0;
      report.touching += push;
      if (pair[k].law.law == ContactLaw::interface)
        continue;
      report.apart += !push;
      touched = touched || push;
      if (push) {
        report.penetration = std::max(report.penetration, -gap[k]);
        report.gap = std::max(report.gap, gap[k]);
      }
    }
    for (int i = 0; i < node.stickings; ++i) {
      ++(out.stuck[i] ? report.touching : report.apart);
      if (!out.stuck[i])
        continue;
      touched = true;
      report.penetration = std::max(report.penetration, -stick_gap[i]);
    }
    report.early = touched && relative_volume < found.v_sep;
  }

  /// Does any of them act?
  RIVEN_INLINE bool run(const NodeCracks& n, long index, const Lattice& lattice, const ContactSettings* laws) {
    load(n, lattice);
    const Meetings<cracks> meetings =
        find_meetings<cracks>(n, held_normals<cracks>(n, index, found.normals, found.third_normals), node.mass, laws);
    if (meetings.count == 0)
      return false;
    double volume = 1;
    found.sums.ask(index, n);
    if (found.sums.volume) {
      volume = 0;
      for (int f = 0; f < n.fields(); ++f)
        volume += found.sums.volume[slot[f]];
      volume = relative_volume(lattice, n.node, volume);
    }
    detect(meetings, volume);
    double momenta = 0;
    for (int f = 0; f < Node::fields; ++f)
      momenta += node.mass[f] > 0 ? norm(node.momentum[f]) : 0;
    hold_prescribed();
    for (int k = 0; k < node.pairs; ++k)
      if (pair[k].law.law == ContactLaw::interface)
        respond(node.pair[k], pair[k], found.area[entry_of(n, index, pair[k].k, found.flagged)]);
    const Outcome out = solve(node);
    tally(out, volume);
    bool acting = false;
    for (int f = 0; f < Node::fields; ++f) {
      if (!out.changed[f])
        continue;
      found.prescribed.give(motion, notes, index, n, slot[f], out.impulse[f], out.velocity[f], dt);
      acting = acting || acts(out.impulse[f], momenta);
    }
    return acting;
  }
};

/// The contacts of a node that holds three cracks: rare, and kept out of the way of the others.
template <class Real, ContactStage stage>
RIVEN_FN RIVEN_ONCE bool three_cracks(const FieldMotion<Real, stage>& motion, const ImpulseNotes& notes,
                                      const Detection<Real>& found, double dt, const NodeCracks& n, long index,
                                      const Lattice& lattice, const ContactSettings* laws, ContactReport& report) {
  NodeContact<3, Real, stage> here{motion, notes, found, dt};
  const bool acting = here.run(n, index, lattice, laws);
  report += here.report;
  return acting;
}

template <ContactStage stage, class Real>
void run(const exec::Space& space, const char* label, Grid<Real>& grid, CrackFields& fields, const Cracks& cracks,
         Detection<Real> found, double dt, ContactSums& sums, FieldImpulses& impulses, ContactReport& report) {
  const FieldMotion<Real, stage> motion(grid);
  std::uint8_t* touched = nullptr;
  if constexpr (stage == ContactStage::after) {
    sums.touched.resize(sums.keep_touched ? fields.nodes.size() : 0);
    sums.touched.zero();
    if (sums.keep_touched)
      touched = exec::data(sums.touched);
    if (fields.pressing > 0)
      fields.pressed.zero();
    fields.pressing = 0;
  } else if (found.pressed && fields.pressing > 0) {
    find_slopes(space, motion, grid.lattice, fields, sums.slopes);
    found.slopes = exec::data(std::as_const(sums.slopes));
  }
  const ImpulseNotes notes(impulses, grid.lattice);
  const NodeCracks* nodes = exec::data(fields.nodes);
  const std::uint8_t* held = exec::data(fields.held);
  const ContactSettings* laws = exec::data(cracks.contact);
  const Lattice lattice = grid.lattice;
  const long count = fields.nodes.size();
  constexpr long ahead = 8;
  const ContactReport found_now = exec::parallel_sum<ContactReport>(
      space, label, fields.nodes.size(),
      [=] RIVEN_KERNEL(long i, ContactReport& sum) {
        if (i + ahead < count && held[i + ahead] != 0) {
          const NodeCracks& next = nodes[i + ahead];
          exec::prefetch(found.normals + i + ahead);
          for (const long slot : {long{next.node}, long{lattice.nodes()} + next.extra}) {
            exec::prefetch(motion.mass + slot);
            exec::prefetch(motion.data + 4 * slot);
          }
        }
        if (held[i] == 0)
          return;
        const NodeCracks& n = nodes[i];
        bool acting = false;
        if (held[i] == 1 && laws[n.crack[0]].law != ContactLaw::interface) {
          acting = one_contact(motion, notes, found, dt, n, i, lattice, laws, sum);
        } else if (held[i] > 2) {
          acting = three_cracks(motion, notes, found, dt, n, i, lattice, laws, sum);
        } else {
          NodeContact<2, Real, stage> here{motion, notes, found, dt};
          acting = here.run(n, i, lattice, laws);
          sum += here.report;
        }
        if (touched)
          touched[i] = acting;
      },
      exec::few);
  fields.pressing += found_now.pressing;
  report += found_now;
}

}  // namespace

template <class Real>
void contact(const exec::Space& space, Grid<Real>& grid, CrackFields& fields, const Cracks& cracks,
             const ContactRules& rules, ContactStage stage, double dt, const ContactParticles<Real>& of,
             ContactSums& sums, FieldImpulses& impulses, ContactReport& report) {
  const auto any = [&](auto&& which) { return std::any_of(cracks.contact.begin(), cracks.contact.end(), which); };
  const bool interfaces = any([](const ContactSettings& c) { return c.law == ContactLaw::interface; });
  const bool parting = any([](const ContactSettings& c) {
    return c.law == ContactLaw::stick || c.law == ContactLaw::frictionless || c.law == ContactLaw::coulomb;
  });
  const bool by_volume = parting && rules.detection == ContactDetection::volume;
  const bool by_position = parting && rules.detection == ContactDetection::displacement;
  const bool positions = sums.place.size() == 4L * grid.slots(), volumes = sums.volume.size() == grid.slots();
  if ((by_position && !positions) || (by_volume && !volumes) ||
      (interfaces && sums.area.size() != 2 * fields.nodes.size() + fields.third_normals.size()) ||
      impulses.acted.size() != fields.nodes.size())
    fail({Exit::internal, "contact lacks the sums that its detection or its laws need", "contact", {}, {}, {}});
  fields.pressed.resize(by_position ? grid.lattice.nodes() : 0);
  const Detection<Real> found{
      .by = rules.detection,
      .v_sep = rules.v_sep,
      .v_contact = rules.v_contact,
      .sums = node_sums(of, grid.lattice, fields, sums),
      .normals = exec::data(fields.normals),
      .third_normals = exec::data(fields.third_normals),
      .area = exec::data(std::as_const(sums.area)),
      .flagged = fields.nodes.size(),
      .reach = 0.2 * grid.lattice.h,
      .pressed = by_position ? exec::data(fields.pressed) : nullptr,
      .slopes = nullptr,
      .prescribed = {sums.prescribed.empty() ? nullptr : exec::data(std::as_const(sums.prescribed)),
                     sums.prescribed.empty() ? nullptr : exec::data(sums.resisted), sums.early_impulse}};
  const auto act = [&](auto at, const char* label) {
    run<decltype(at)::value>(space, label, grid, fields, cracks, found, dt, sums, impulses, report);
  };
  using Stage = ContactStage;
  switch (stage) {
    case Stage::before: return act(std::integral_constant<Stage, Stage::before>{}, "contact before");
    case Stage::after: return act(std::integral_constant<Stage, Stage::after>{}, "contact after");
    case Stage::again: return act(std::integral_constant<Stage, Stage::again>{}, "contact again");
    case Stage::higher: return act(std::integral_constant<Stage, Stage::higher>{}, "contact higher");
  }
}

#define RIVEN_CONTACT(Real)                                                                                \
  template void contact(const exec::Space&, Grid<Real>&, CrackFields&, const Cracks&, const ContactRules&, \
                        ContactStage, double, const ContactParticles<Real>&, ContactSums&, FieldImpulses&, \
                        ContactReport&);
RIVEN_EACH_REAL(RIVEN_CONTACT)
#undef RIVEN_CONTACT

}  // namespace RIVEN_SIDE

}  // namespace riven
