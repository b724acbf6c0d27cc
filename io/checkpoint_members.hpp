// How members of a simulation stand in a checkpoint; shared by what writes and what reads them.
#pragma once
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

#include "core/laws/traction.hpp"
#include "core/math/vec.hpp"
#include "kernels/each_member.hpp"

namespace riven::checkpoint {

/// Items of arrays as plain values, `count` for each.
template <class T>
struct Values {
  static constexpr bool pair = std::is_same_v<T, Vec2> || std::is_same_v<T, CohesiveHistory>;
  using Type = std::conditional_t<pair, double, T>;
  static constexpr std::size_t count = pair ? 2 : 1;
};
static_assert(sizeof(Vec2) == 2 * sizeof(double) && sizeof(CohesiveHistory) == 2 * sizeof(double));

template <class Array>
using ValuesOf = Values<std::remove_cvref_t<decltype(*std::declval<Array&>().data())>>;

inline std::string state_path(const std::string& name) {
  return "/state/" + name;
}

/// Group of the retry of this number.
inline std::string retry_path(std::size_t number) {
  return "/run/retries/" + std::to_string(number);
}

/// f(name, number) for each number that a member is made of.
template <class T, class F>
void each_number(const std::string& name, T& member, const F& f) {
  if constexpr (std::is_array_v<T>) {
    int n = 0;
    for (auto& part : member)
      each_number(name + "." + std::to_string(n++), part, f);
  } else if constexpr (std::is_same_v<T, Vec2>) {
    f(name + ".x", member.x);
    f(name + ".y", member.y);
  } else {
    f(name, member);
  }
}

/// The same for all members of a struct.
template <class Struct, class F>
void each_number_of(Struct& s, const F& f) {
  each_member(s, [&](const char* name, auto& member) { each_number(name, member, f); });
}

/// "time,step,.."
template <class Struct>
std::string columns_of(Struct& s) {
  std::string columns;
  each_number_of(s, [&](const std::string& name, auto&) { columns += (columns.empty() ? "" : ",") + name; });
  return columns;
}

}  // namespace riven::checkpoint
