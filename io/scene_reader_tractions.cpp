#include "io/scene_reader.hpp"

namespace riven {

namespace {

constexpr Range share{0, 1, true, true};

/// Keys that say nothing for this kind.
void refuse_foreign_keys(const Table& t, TractionKind kind) {
  const auto only = [&](bool belongs, std::initializer_list<const char*> keys, const char* kinds) {
    for (const char* key : keys)
      if (!belongs && t.has(key))
        t.refuse(key, fmt::format("a traction of kind '{}' has no {}", name_of(kind), key), kinds);
  };
  const bool pressure = kind == TractionKind::pressure;
  only(pressure, {"pressure"}, "kind = \"pressure\"");
  only(!pressure, {"strength", "toughness", "shear_strength", "shear_toughness", "peak"},
       "kind = \"triangular\", \"trilinear\" or \"exponential\"");
  only(kind == TractionKind::trilinear, {"knee", "knee_strength"}, "kind = \"trilinear\"");
  only(kind == TractionKind::exponential, {"decay"}, "kind = \"exponential\"");
}

}  // namespace

TractionSettings read_traction(const Table& t) {
  TractionSettings s;
  s.kind = t.choice<TractionKind>("kind");
  refuse_foreign_keys(t, s.kind);
  if (t.has("rectangle") || t.has("disk") || t.has("polygon"))
    s.region = read_region(t);
  if (s.kind == TractionKind::pressure) {
    if (!t.has("pressure"))
      t.refuse("pressure", "missing key 'pressure'", "", "pressure = \"5 MPa\"");
    s.pressure = *t.function("pressure", dimension::stress);
    return s;
  }
  s.strength = t.quantity("strength", dimension::stress, range::positive);
  s.toughness = t.quantity("toughness", dimension::energy_release, range::positive);
  s.shear_strength = t.quantity("shear_strength", dimension::stress, range::positive, s.strength, "strength");
  s.shear_toughness =
      t.quantity("shear_toughness", dimension::energy_release, range::positive, s.toughness, "toughness");
  s.peak = t.number("peak", share, s.peak);
  if (s.kind == TractionKind::trilinear) {
    s.knee = t.number("knee", share, s.knee);
    s.knee_strength = t.number("knee_strength", Range{0, 1}, s.knee_strength);
    if (s.knee <= s.peak)
      t.refuse(t.has("knee") ? "knee" : "peak", "the knee of the softening curve comes before its peak",
               "knee greater than peak");
  }
  if (s.kind == TractionKind::exponential)
    s.decay = t.number("decay", Range{0, 100, true, false}, s.decay);
  return s;
}

}  // namespace riven
