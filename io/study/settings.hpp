// How the members of a study belong together: ways to solve its problems, and these along the refined axis.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/study/store.hpp"

namespace riven::study {

/// One way to solve: the members that differ in nothing but the problem.
struct Setting {
  std::string label;            ///< choices of all axes but that of problems
  std::vector<size_t> members;  ///< [problems]
};

/// The settings that differ only along the refined axis; all by themselves where there is none.
struct Method {
  std::string label;             ///< choices of the other axes
  std::vector<size_t> settings;  ///< in the order of the refined axis
  bool failed = false;           ///< some of them, in one problem at least
  /// The largest of the refined axis that is done as all smaller ones are; none: not even the smallest.
  std::optional<size_t> stands;
};

/// "cell 1 mm, transfer FLIP"; of what leaves an effect out, "without contact".
std::string label_of(const Study& study, const Member& member);

/// Of the members that leave nothing out, in their order.
std::vector<Setting> settings_of(const Study& study, const Members& members);

std::vector<Method> methods_of(const Study& study, const Members& members, const std::vector<Setting>& settings,
                               const std::vector<Record>& records);

/// Which choice of an axis the members of a setting have; not of the axis of problems.
const Choice& choice_of(const Study& study, const Members& members, const Setting& setting, size_t axis);

/// What a setting sets beside what all members of the study do, the problem left out.
std::vector<std::string> keys_of(const Study& study, const Members& members, const Setting& setting);

}  // namespace riven::study
