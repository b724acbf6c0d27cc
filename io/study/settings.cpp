#include "io/study/settings.hpp"

#include <algorithm>

namespace riven::study {

namespace {

/// The choices of the axes that are not left out, in words: "cell 1 mm, transfer FLIP".
template <class LeftOut>
std::string label_without(const Study& study, const Member& m, const LeftOut& left_out) {
  std::string label;
  for (size_t a = 0; a < study.axes.size(); ++a)
    if (!left_out(study.axes[a]))
      label += (label.empty() ? "" : ", ") + study.axes[a].name + " " + study.axes[a].choices[m.choice[a]].label;
  return label;
}

/// The entry with this label, made if there is none.
template <class Labelled>
Labelled& labelled(std::vector<Labelled>& list, const std::string& label) {
  const auto known = std::find_if(list.begin(), list.end(), [&](const Labelled& l) { return l.label == label; });
  if (known != list.end())
    return *known;
  list.emplace_back().label = label;
  return list.back();
}

/// Where no axis tells entries apart there is one, without a label.
template <class Labelled>
void name_the_only(std::vector<Labelled>& list) {
  if (list.size() == 1 && list[0].label.empty())
    list[0].label = "as it is";
}

}  // namespace

std::string label_of(const Study& study, const Member& m) {
  if (m.choice.empty())
    return m.left_out == "nothing" ? "as it is" : "without " + m.left_out;
  return label_without(study, m, [](const Axis&) { return false; });
}

std::vector<Setting> settings_of(const Study& study, const Members& all) {
  std::vector<Setting> settings;
  for (size_t k = 0; k < all.members.size(); ++k)
    if (const Member& m = all.members[k]; !m.choice.empty())
      labelled(settings, label_without(study, m, [](const Axis& a) { return a.problem; })).members.push_back(k);
  name_the_only(settings);
  return settings;
}

std::vector<Method> methods_of(const Study& study, const Members& all, const std::vector<Setting>& settings,
                               const std::vector<Record>& records) {
  std::vector<Method> methods;
  for (size_t k = 0; k < settings.size(); ++k) {
    const Member& first = all.members[settings[k].members.front()];
    labelled(methods, label_without(study, first, [](const Axis& a) { return a.problem || a.refined; }))
        .settings.push_back(k);
  }
  name_the_only(methods);
  const auto done = [&](size_t setting) {
    const std::vector<size_t>& members = settings[setting].members;
    return std::all_of(members.begin(), members.end(), [&](size_t m) { return records[all.members[m].run].done(); });
  };
  for (Method& m : methods) {
    m.failed = !std::all_of(m.settings.begin(), m.settings.end(), done);
    if (!study.refined())
      continue;
    const auto size = [&](size_t k) { return choice_of(study, all, settings[k], *study.refined()).size; };
    for (const size_t k : m.settings) {
      const bool stands =
          std::all_of(m.settings.begin(), m.settings.end(), [&](size_t o) { return size(o) > size(k) || done(o); });
      if (stands && (!m.stands || size(*m.stands) < size(k)))
        m.stands = k;
    }
  }
  return methods;
}

const Choice& choice_of(const Study& study, const Members& all, const Setting& setting, size_t axis) {
  return study.axes[axis].choices[all.members[setting.members.front()].choice[axis]];
}

std::vector<std::string> keys_of(const Study& study, const Members& all, const Setting& setting) {
  std::vector<std::string> set;
  for (size_t a = 0; a < study.axes.size(); ++a)
    if (!study.axes[a].problem) {
      const std::vector<std::string>& own = choice_of(study, all, setting, a).set;
      set.insert(set.end(), own.begin(), own.end());
    }
  return set;
}

}  // namespace riven::study
