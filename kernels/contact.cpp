#include "kernels/contact.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "kernels/contact_of_pair.hpp"
#include "kernels/contact_of_several.hpp"
#include "kernels/pressed_faces.hpp"

namespace riven {

inline namespace RIVEN_SIDE {

namespace {

bool any_crack(const Cracks& cracks, auto&& which) {
  return std::any_of(cracks.contact.begin(), cracks.contact.end(), which);
}

bool bears_friction(const Cracks& cracks) {
  return any_crack(cracks, [](const ContactSettings& c) { return friction_of(c) > 0; });
}

/// The contacts of a node that holds three cracks: rare, and kept out of the way of the others.
template <class Real, ContactStage stage>
RIVEN_FN RIVEN_ONCE bool three_cracks(const FieldMotion<Real, stage>& motion, const ImpulseNotes& notes,
                                      const ContactFinder<Real>& found, double dt, const NodeCracks& n, long index,
                                      const Lattice& lattice, const ContactSettings* laws, ContactReport& report) {
  NodeContact<3, Real, stage> here{motion, notes, found, dt};
  const bool acting = here.run(n, index, lattice, laws);
  report += here.report;
  return acting;
}

/// What such a node asks of friction; see NodeContact::ask.
template <class Real>
RIVEN_FN RIVEN_ONCE void three_ask(const FieldMotion<Real, ContactStage::after>& motion, const ImpulseNotes& notes,
                                   const ContactFinder<Real>& found, double dt, const NodeCracks& n, long index,
                                   const Lattice& lattice, const ContactSettings* laws, Vec2* asked) {
  NodeContact<3, Real, ContactStage::after>{motion, notes, found, dt}.ask(n, index, lattice, laws, asked);
}

/// What any node asks.
template <class Real>
RIVEN_FN void friction_asked_of(int held, const FieldMotion<Real, ContactStage::after>& motion,
                                const ImpulseNotes& notes, const ContactFinder<Real>& found, double dt,
                                const NodeCracks& n, long index, const Lattice& lattice, const ContactSettings* laws,
                                Vec2* asked) {
  if (held > 2)
    three_ask(motion, notes, found, dt, n, index, lattice, laws, asked);
  else if (held == 2)
    NodeContact<2, Real, ContactStage::after>{motion, notes, found, dt}.ask(n, index, lattice, laws, asked);
  else if (held == 1)
    asked[entry_of(n, index, 0, found.flagged)] = friction_asked(motion, found, dt, n, index, lattice, laws);
}

/// Asks all nodes for the friction that holds their faces, and forgets where these have not pressed on each other.
template <class Real>
void ask_for_friction(const exec::Space& space, const FieldMotion<Real, ContactStage::after>& motion,
                      const ImpulseNotes& notes, const ContactFinder<Real>& found, double dt, const CrackFields& fields,
                      const Lattice& lattice, const ContactSettings* laws, exec::Array<Vec2>& asked) {
  asked.renew(entries_of(fields));
  Vec2* out = exec::data(asked);
  const NodeCracks* nodes = exec::data(fields.nodes);
  const std::uint8_t* held = exec::data(fields.held);
  exec::parallel_for(space, "friction asked for", fields.nodes.size(), [=] RIVEN_KERNEL(long i) {
    const NodeCracks& n = nodes[i];
    friction_asked_of(held[i], motion, notes, found, dt, n, i, lattice, laws, out);
    if (found.stuck && found.pressed[n.node] == 0)
      found.stuck[n.node] = 0;
  });
}

template <ContactStage stage, class Real>
void run(const exec::Space& space, const char* label, Grid<Real>& grid, CrackFields& fields, const Cracks& cracks,
         ContactFinder<Real> found, double dt, ContactSums& sums, FieldImpulses& impulses, ContactReport& report) {
  const FieldMotion<Real, stage> motion(grid);
  const ContactSettings* laws = exec::data(cracks.contact);
  const Lattice lattice = grid.lattice;
  const ImpulseNotes notes(impulses, grid.lattice);
  std::uint8_t* touched = nullptr;
  if constexpr (stage == ContactStage::after) {
    sums.touched.resize(sums.keep_touched ? fields.nodes.size() : 0);
    sums.touched.zero();
    if (sums.keep_touched)
      touched = exec::data(sums.touched);
    if (bears_friction(cracks)) {
      ask_for_friction(space, motion, notes, found, dt, fields, lattice, laws, sums.asked);
      found.around = {exec::data(std::as_const(sums.asked)), exec::data(fields.node_index), exec::data(fields.nodes),
                      exec::data(fields.held), found.flagged};
    }
    if (fields.pressing > 0)
      fields.pressed.zero();
    fields.pressing = 0;
    if (found.links)
      sums.links.zero();
  } else if (found.pressed && fields.pressing > 0) {
    find_slopes(space, motion, grid.lattice, fields, sums.slopes);
    found.slopes = exec::data(std::as_const(sums.slopes));
  }
  const NodeCracks* nodes = exec::data(fields.nodes);
  const std::uint8_t* held = exec::data(fields.held);
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
  const bool interfaces = any_crack(cracks, [](const ContactSettings& c) { return c.law == ContactLaw::interface; });
  const bool parting = any_crack(cracks, [](const ContactSettings& c) { return keeps_apart(c.law); });
  const bool by_volume = parting && rules.detection == ContactDetection::volume;
  const bool by_position = parting && rules.detection == ContactDetection::displacement;
  const bool positions = sums.place.size() == 4L * grid.slots(), volumes = sums.volume.size() == grid.slots();
  if ((by_position && !positions) || (by_volume && !volumes) ||
      (interfaces && sums.area.size() != entries_of(fields)) || impulses.acted.size() != fields.nodes.size())
    fail({Exit::internal, "contact lacks the sums that its detection or its laws need", "contact", {}, {}, {}});
  fields.pressed.resize(by_position ? grid.lattice.nodes() : 0);
  fields.stuck.resize(by_position && bears_friction(cracks) ? grid.lattice.nodes() : 0);
  if (sums.keep_links)
    sums.links.resize(fields.nodes.size());
  const ContactFinder<Real> found{.by = rules.detection,
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
                                  .noise = sums.noise,
                                  .links = sums.keep_links ? exec::data(sums.links) : nullptr,
                                  .prescribed = prescribed_fields(sums),
                                  .around = {},
                                  .stuck = fields.stuck.empty() ? nullptr : exec::data(fields.stuck)};
  const auto act = [&](auto at, const char* label) {
    run<decltype(at)::value>(space, label, grid, fields, cracks, found, dt, sums, impulses, report);
  };
  using Stage = ContactStage;
  switch (stage) {
    case Stage::before: return act(std::integral_constant<Stage, Stage::before>{}, "contact before");
    case Stage::after: return act(std::integral_constant<Stage, Stage::after>{}, "contact after");
    case Stage::again: return act(std::integral_constant<Stage, Stage::again>{}, "contact again");
    case Stage::higher: return act(std::integral_constant<Stage, Stage::higher>{}, "contact higher");
    case Stage::term: break;  // has no gap to close: see link_fields.hpp
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
