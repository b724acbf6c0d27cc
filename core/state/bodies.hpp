// What kernels look up by a particle's body: its law and the size of its particles.
#pragma once
#include <cstdint>

#include "core/exec/array.hpp"
#include "core/math/shape.hpp"

namespace riven {

/// Per body, both axes' settings of the shape functions (the walls differ along the axes).
template <class Real, int Dim>
struct DomainSetting {
  AxisSetting<Real> axis[Dim];
};

/// A table indexed by body, taken by value into kernels. With one body nothing is looked up per particle.
template <class T>
struct BodyLookup {
  const T* table = nullptr;
  const std::uint8_t* body = nullptr;
  bool single = true;
  RIVEN_INLINE const T& of(long particle) const { return table[body[particle]]; }
};

}  // namespace riven
