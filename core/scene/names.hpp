// The one table of names for every choice in a scene: used to read, to print and to suggest.
#pragma once
#include <array>
#include <string_view>
#include <utility>

#include "core/scene/scene.hpp"

namespace riven {

template <class E>
struct Names;  // specialised below: `table` pairs each value with its name in scenes

#define RIVEN_NAMES(E, ...)                                                                   \
  template <>                                                                                 \
  struct Names<E> {                                                                           \
    static constexpr auto table = std::to_array<std::pair<E, std::string_view>>(__VA_ARGS__); \
  };

RIVEN_NAMES(ShapeFunction,
            {{ShapeFunction::linear, "linear"}, {ShapeFunction::ugimp, "ugimp"}, {ShapeFunction::bspline, "bspline"}})
RIVEN_NAMES(Transfer,
            {{Transfer::flip, "flip"}, {Transfer::pic, "pic"}, {Transfer::xpic, "xpic"}, {Transfer::fmpm, "fmpm"}})
RIVEN_NAMES(StressUpdate, {{StressUpdate::usl, "usl"},
                           {StressUpdate::musl, "musl"},
                           {StressUpdate::usf, "usf"},
                           {StressUpdate::usavg, "usavg"}})
RIVEN_NAMES(Plane, {{Plane::strain, "strain"}, {Plane::stress, "stress"}})
RIVEN_NAMES(ScatterKind, {{ScatterKind::atomic, "atomic"}, {ScatterKind::ordered, "ordered"}})
RIVEN_NAMES(Precision, {{Precision::as_double, "double"}, {Precision::as_float, "float"}})
RIVEN_NAMES(LawKind, {{LawKind::linear_elastic, "linear_elastic"}, {LawKind::neo_hookean, "neo_hookean"}})
RIVEN_NAMES(CrackMotion, {{CrackMotion::surfaces, "surfaces"}, {CrackMotion::center_of_mass, "center_of_mass"}})
RIVEN_NAMES(SurfaceUpdate, {{SurfaceUpdate::xpic, "xpic"}, {SurfaceUpdate::flip, "flip"}, {SurfaceUpdate::pic, "pic"}})
RIVEN_NAMES(ContactLaw, {{ContactLaw::ignored, "ignored"},
                         {ContactLaw::bonded, "bonded"},
                         {ContactLaw::stick, "stick"},
                         {ContactLaw::frictionless, "frictionless"},
                         {ContactLaw::coulomb, "coulomb"},
                         {ContactLaw::interface, "interface"}})
RIVEN_NAMES(ContactDetection, {{ContactDetection::volume, "volume"},
                               {ContactDetection::velocity, "velocity"},
                               {ContactDetection::displacement, "displacement"}})
RIVEN_NAMES(ContactWhen, {{ContactWhen::always, "always"}, {ContactWhen::closing, "auto"}})
RIVEN_NAMES(TractionKind, {{TractionKind::pressure, "pressure"},
                           {TractionKind::triangular, "triangular"},
                           {TractionKind::trilinear, "trilinear"},
                           {TractionKind::exponential, "exponential"}})
RIVEN_NAMES(Sidecar, {{Sidecar::none, "none"}, {Sidecar::vtp, "vtp"}})
RIVEN_NAMES(JMethod, {{JMethod::pijc, "pijc"}, {JMethod::fijc, "fijc"}, {JMethod::fijc_adaptive, "fijc_adaptive"}})
RIVEN_NAMES(AreaTerm, {{AreaTerm::automatic, "automatic"}, {AreaTerm::never, "never"}, {AreaTerm::always, "always"}})
RIVEN_NAMES(GrowthCriterion, {{GrowthCriterion::k_max, "k_max"}, {GrowthCriterion::critical_j, "critical_j"}})
RIVEN_NAMES(GrowthDirection, {{GrowthDirection::hoop, "hoop"},
                              {GrowthDirection::self_similar, "self_similar"},
                              {GrowthDirection::fixed, "fixed"}})
RIVEN_NAMES(Load::Edge, {{Load::Edge::left, "left"},
                         {Load::Edge::right, "right"},
                         {Load::Edge::bottom, "bottom"},
                         {Load::Edge::top, "top"}})
RIVEN_NAMES(Load::Kind, {{Load::Kind::force, "force"},
                         {Load::Kind::traction, "traction"},
                         {Load::Kind::acceleration, "acceleration"}})
RIVEN_NAMES(Probe::Kind, {{Probe::Kind::crack_opening, "crack_opening"},
                          {Probe::Kind::displacement, "displacement"},
                          {Probe::Kind::velocity, "velocity"},
                          {Probe::Kind::stress, "stress"},
                          {Probe::Kind::reaction, "reaction"},
                          {Probe::Kind::travel, "travel"},
                          {Probe::Kind::mean_stress, "mean_stress"},
                          {Probe::Kind::displacement_error, "displacement_error"}})
RIVEN_NAMES(Watched, {{Watched::energy, "energy"},
                      {Watched::momentum, "momentum"},
                      {Watched::angular_momentum, "angular_momentum"},
                      {Watched::compression, "compression"},
                      {Watched::expansion, "expansion"},
                      {Watched::stretch, "stretch"},
                      {Watched::penetration, "penetration"},
                      {Watched::velocity_difference, "velocity_difference"}})
RIVEN_NAMES(exec::Kind, {{exec::Kind::serial, "serial"},
                         {exec::Kind::openmp, "openmp"},
                         {exec::Kind::stdpar, "stdpar"},
                         {exec::Kind::cuda, "cuda"}})
#undef RIVEN_NAMES

template <class E>
constexpr std::string_view name_of(E value) {
  for (const auto& [v, n] : Names<E>::table)
    if (v == value)
      return n;
  return "?";
}

}  // namespace riven
