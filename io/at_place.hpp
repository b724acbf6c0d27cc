// Errors of what reads a text, with the place where the text stands.
#pragma once
#include <string>
#include <utility>

#include "core/error.hpp"

namespace riven {

/// read(), whose Error gets the place that it does not have yet.
template <class F>
auto at_place(const std::string& where, const F& read) {
  try {
    return read();
  } catch (const Error& e) {
    Trouble t = e.trouble();
    if (t.where.empty())
      t.where = where;
    fail(std::move(t));
  }
}

}  // namespace riven
