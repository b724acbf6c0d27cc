#include "io/what_helps.hpp"

#include <algorithm>

namespace riven {

namespace {

/// A remedy that is a setting, by the words with which advice begins.
struct Setting {
  std::string_view words;
  bool (*is_so)(const Scene&);
};

constexpr Setting settings[] = {
    {"solver.stress_update = \"usavg\"",
     [](const Scene& s) { return s.stress_update == StressUpdate::usavg || s.stress_update == StressUpdate::musl; }},
    {"solver.shape = \"ugimp\"", [](const Scene& s) { return s.shape == ShapeFunction::ugimp; }},
    {"solver.transfer = \"flip\"", [](const Scene& s) { return s.transfer == Transfer::flip; }},
    {"solver.transfer = \"fmpm\" or \"xpic\"",
     [](const Scene& s) { return s.transfer == Transfer::fmpm || s.transfer == Transfer::xpic; }},
    {"solver.transfer = \"fmpm\", or", [](const Scene& s) { return s.transfer == Transfer::fmpm; }},
    {"a solver.order of 4 or less",
     [](const Scene& s) { return s.order <= 4 || (s.transfer != Transfer::fmpm && s.transfer != Transfer::xpic); }},
    {"law = \"neo_hookean\"",
     [](const Scene& s) {
       return std::all_of(s.materials.begin(), s.materials.end(),
                          [](const Material& m) { return m.law == LawKind::neo_hookean; });
     }},
    {"contact.law = \"ignored\"",
     [](const Scene& s) {
       return s.cracks.empty() || s.contact.law == ContactLaw::ignored || s.contact.law == ContactLaw::interface;
     }},
    {"a contact.law that",
     [](const Scene& s) {
       return std::none_of(s.cracks.begin(), s.cracks.end(), [&](const CrackLine& c) {
         return c.contact.value_or(s.contact).law == ContactLaw::ignored;
       });
     }},
    {"contact.detection = \"displacement\"",
     [](const Scene& s) { return s.contact_rules.detection == ContactDetection::displacement; }},
};

}  // namespace

std::string what_helps(std::string_view advice, const Scene& scene) {
  constexpr std::string_view between = "; ";
  std::string left;
  while (!advice.empty()) {
    const std::string_view remedy = advice.substr(0, advice.find(between));
    advice.remove_prefix(std::min(advice.size(), remedy.size() + between.size()));
    if (std::any_of(std::begin(settings), std::end(settings),
                    [&](const Setting& s) { return remedy.starts_with(s.words) && s.is_so(scene); }))
      continue;
    left += left.empty() ? "" : between;
    left += remedy;
  }
  return left;
}

}  // namespace riven
