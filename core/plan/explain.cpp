#include "core/plan/explain.hpp"

#include <algorithm>
#include <set>

#include "core/scene/names.hpp"
#include "core/state/make_tips.hpp"

namespace riven {

namespace {

std::string counted(size_t n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

std::string said(std::string_view key, const std::string& value) {
  return std::string(key) + " = " + value;
}

/// The laws of the faces, those of single cracks included.
std::string contact_laws(const Scene& s) {
  std::set<std::string> laws;
  for (const CrackLine& c : s.cracks)
    laws.emplace(name_of(c.contact.value_or(s.contact).law));
  std::string list;
  for (const std::string& law : laws)
    list += (list.empty() ? "" : ", ") + law;
  return list;
}

std::string why_contact(const Scene& s, const Plan& p) {
  if (!p.cracks)
    return "no crack, no faces";
  const bool by_default =
      std::any_of(s.defaults.begin(), s.defaults.end(), [](const auto& d) { return d.starts_with("contact.law"); });
  const std::string law = said("contact.law", contact_laws(s));
  if (p.contact_waits)
    return "waits, tried now and then until faces close: contact.when = auto; " + law;
  return p.contact ? "faces of cracks may close; " + law + (by_default ? ", by default" : "") : law;
}

std::string why_fracture(const Scene& s, const Plan& p) {
  if (p.growth)
    return s.fracture.asked ? "[fracture] asks for J and K, and growth needs them" : "growth needs J and K";
  if (p.fracture)
    return "[fracture] asks for J and K";
  return p.cracks ? "neither [fracture] nor growth asks for J and K" : "no crack, no tips";
}

std::string why_growth(const Scene& s, const Plan& p) {
  if (!p.growth)
    return p.cracks ? "no crack has a rule by which to grow" : "no crack";
  size_t growing = 0;
  for (size_t c = 0; c < s.cracks.size(); ++c)
    growing += growth_rule(s, static_cast<int>(c)) != nullptr;
  return counted(growing, "crack") + " may grow";
}

std::string why_tractions(const Scene& s) {
  const auto bearing =
      std::count_if(s.cracks.begin(), s.cracks.end(), [](const CrackLine& c) { return c.traction.has_value(); });
  return bearing == 0 ? "no crack bears a pressure or a cohesive law"
                      : "faces of " + counted(static_cast<size_t>(bearing), "crack") + " bear a pressure or a law";
}

std::string why_boundary(const Scene& s) {
  std::string why;
  for (const auto& [n, what] :
       {std::pair{s.grips.size(), "grip"}, {s.fixed.size(), "fixed line"}, {s.symmetry.size(), "symmetry plane"}})
    if (n > 0)
      why += (why.empty() ? "" : ", ") + counted(n, what);
  return why.empty() ? "no grip, fixed node or symmetry plane" : why;
}

std::string why_orders(const Scene& s, const Plan& p) {
  const std::string transfer(name_of(s.transfer));
  return p.higher_order() ? transfer + " of order " + std::to_string(p.order) : transfer + " has no orders";
}

}  // namespace

std::vector<EffectNote> explain(const Scene& s, const Plan& p) {
  const std::string update = said("solver.stress_update", std::string(name_of(p.update)));
  std::vector<EffectNote> notes{
      {"cracks", p.cracks, p.cracks ? counted(s.cracks.size(), "crack") : "no [[crack]]"},
      {"contact", p.contact, why_contact(s, p)},
      {"first gaps", p.first_gaps,
       p.first_gaps ? "solids start apart along a crack" : "no solids start apart along a crack"},
      {"imperfect interface", p.contact_area, p.contact_area ? "faces held by springs" : "no interface law"},
      {"J", p.fracture, why_fracture(s, p)},
      {"growth", p.growth, why_growth(s, p)},
      {"tractions", p.tractions, why_tractions(s)},
      {"boundary", p.constraints, why_boundary(s)},
      {"loads", p.loads, p.loads ? counted(s.loads.size(), "load") : "no [[load]]"},
      {"body force", p.body_force, p.body_force ? "[body_force]" : "no [body_force]"},
      {"grid damping", p.grid_damping, p.grid_damping ? "damping.grid" : "no damping.grid"},
      {"particle damping", p.particle_damping, p.particle_damping ? "damping.particle" : "no damping.particle"},
      {"gradients of velocity", p.affine, said("solver.affine", p.affine ? "true" : "false")},
      {"higher orders", p.higher_order() && p.order > 1, why_orders(s, p)},
      {"watched energy", p.watch_energy, p.watch_energy ? "solver.cfl is beyond 1" : "solver.cfl is at most 1"},
      {"second stress update", p.averaged(), update},
      {"second extrapolation", p.extrapolate_again(), update},
      {"deformation gradient", p.keeps_F(),
       !p.keeps_F() ? "neither a law nor J needs more than det F"
       : p.fracture ? "J needs displacement gradients"
                    : "a law needs it"},
      {"first positions", p.first_positions(),
       p.first_positions() ? "contact by displacement, J, a law beside cracks or a probe needs them"
                           : "nothing needs them"}};
  std::stable_partition(notes.begin(), notes.end(), [](const EffectNote& n) { return n.on; });
  return notes;
}

}  // namespace riven
