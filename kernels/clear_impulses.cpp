#include "kernels/field_impulses.hpp"

namespace riven {

void clear_impulses(const CrackFields& fields, FieldImpulses& impulses) {
  impulses.acted.resize(fields.nodes.size());
  impulses.acted.zero();
  impulses.given.resize(FieldImpulses::stages * (fields.nodes.size() + fields.extra_slots));
}

}  // namespace riven
