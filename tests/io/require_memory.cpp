// What a scene takes is known before it is there, and too much of it is refused.
#include "io/require_memory.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/plan/predict_memory.hpp"
#include "core/state/make_state.hpp"
#include "kernels/dispatch.hpp"
#include "tests/io/small_run.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

/// The prediction over the bytes of all arrays.
double predicted_over_actual(const std::vector<std::string>& more) {
  std::vector<std::string> settings{"grid.cell=0.04 mm"};
  settings.insert(settings.end(), more.begin(), more.end());
  const Scene s = test::small(settings);
  double actual = 0;
  with_precision(s.precision, [&](auto real) {
    const test::ChosenSpace space;
    SimulationOf<typename decltype(real)::type> m(s, space);
    m.step();  // with the arrays that the first step makes
    for (const ArrayReport& a : list_arrays(m.state))
      actual += static_cast<double>(a.bytes);
  });
  return predict_memory(s, make_plan(s)).bytes / actual;
}

TEST(RequireMemory, PredictsTheArraysOfAScene) {
  const std::vector<std::vector<std::string>> choices{
      {},
      {"solver.precision=float"},
      {"solver.stress_update=usl", "solver.transfer=fmpm", "solver.order=1"},
      {"solver.transfer=fmpm", "solver.order=2"},
      {"material.solid.law=neo_hookean", "contact.law=ignored"},
      {"fracture.contour=4"},
  };
  for (const auto& choice : choices) {
    const double ratio = predicted_over_actual(choice);
    EXPECT_GT(ratio, 0.9) << (choice.empty() ? "" : choice.front());
    EXPECT_LT(ratio, 1.1) << (choice.empty() ? "" : choice.front());
  }
}

TEST(RequireMemory, RefusesWithBothFigures) {
  const Scene s = test::small();
  const MemoryNeed need = predict_memory(s, make_plan(s));
  EXPECT_NO_THROW(require_memory(s, need.peak()));
  EXPECT_THROW(require_memory(s, need.bytes), Error);  // sorting and results take more
  try {
    require_memory(s, 20e3);
    ADD_FAILURE() << "was taken";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Exit::bad_input);
    EXPECT_NE(e.trouble().value.find("kB for about 256 particles"), std::string::npos) << e.what();
    EXPECT_EQ(e.trouble().limit, "20.0 kB");
  }
  EXPECT_GT(available_memory(), 1e6);
}

}  // namespace
}  // namespace riven
