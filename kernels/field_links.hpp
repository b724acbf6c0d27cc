// Which fields of a node go together in the terms of higher orders (link_fields.hpp).
#pragma once
#include <cstdint>

#include "core/exec/config.hpp"

namespace riven {

struct FieldLinks {
  std::uint32_t code = 0;  ///< of two fields: 1 across their crack, 3 along it, too; of several: their groups

  RIVEN_INLINE bool any() const { return code != 0; }
  RIVEN_INLINE void link_two(bool sticks) { code = sticks ? 3 : 1; }
  RIVEN_INLINE bool stick() const { return code == 3; }
  RIVEN_INLINE bool groups() const { return code & several; }

  /// group[f]: the first field that f goes with.
  template <int fields>
  RIVEN_INLINE void link_groups(const int (&group)[fields]) {
    static_assert(fields <= 8);
    bool any = false;
    code = 0;
    for (int f = 0; f < fields; ++f) {
      any = any || group[f] != f;
      code |= static_cast<std::uint32_t>(group[f]) << 3 * f;
    }
    code = any ? code | several : 0;
  }
  RIVEN_INLINE int group(int f) const { return static_cast<int>(code >> 3 * f & 7); }

 private:
  static constexpr std::uint32_t several = 1u << 31;
};

}  // namespace riven
