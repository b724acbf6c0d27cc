// One way to fail: what went wrong, where, with which value, against which limit, and what to try.
#pragma once
#include <optional>
#include <stdexcept>
#include <string>

#include "core/math/vec.hpp"

namespace riven {

/// Exit codes of the program; the same meaning in every command.
enum class Exit : int { done = 0, internal = 1, bad_input = 2, unstable = 3, file = 4, interrupted = 5 };

/// The parts of an error message. Empty parts are left out of the text, and may be left out of an initialiser.
struct Trouble {
  Exit code = Exit::internal;
  std::string what{};           ///< one sentence: what is wrong
  std::string where{};          ///< file and line and key, or step, time and particle
  std::string value{};          ///< the offending value
  std::string limit{};          ///< what is allowed
  std::string suggestion{};     ///< what to try, or the nearest valid name
  std::optional<Vec2> place{};  ///< m, in the scene, where it has one; not in the text
};

class Error : public std::runtime_error {
 public:
  explicit Error(Trouble t) : std::runtime_error(text(t)), trouble_(std::move(t)) {}
  const Trouble& trouble() const { return trouble_; }
  Exit code() const { return trouble_.code; }

 private:
  static std::string text(const Trouble& t) {
    std::string s = t.where.empty() ? t.what : t.where + ": " + t.what;
    if (!t.value.empty())
      s += "\n  value:   " + t.value;
    if (!t.limit.empty())
      s += "\n  allowed: " + t.limit;
    if (!t.suggestion.empty())
      s += "\n  try:     " + t.suggestion;
    return s;
  }
  Trouble trouble_;
};

[[noreturn]] inline void fail(Trouble t) {
  throw Error(std::move(t));
}

}  // namespace riven
