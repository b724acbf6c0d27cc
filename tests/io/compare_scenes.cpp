// A run goes on with the scene that it began with; what may change is told from what may not.
#include "io/compare_scenes.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/io/small_run.hpp"

namespace riven {
namespace {

using test::small;

Trouble difference(const std::vector<std::string>& settings, const std::string& cracks = test::small_cracks) {
  try {
    require_same_scene(small(), small(settings, cracks));
  } catch (const Error& e) {
    return e.trouble();
  }
  return {.code = Exit::done};
}

TEST(CompareScenes, TimeOutputThreadsAndSpaceMayChange) {
  EXPECT_EQ(difference({}).code, Exit::done);
  EXPECT_EQ(difference({"solver.time=1 s", "solver.threads=2", "solver.exec=serial", "output.frames=7",
                        "output.checkpoint_steps=3", "output.sidecar=vtp"})
                .code,
            Exit::done);
  EXPECT_NO_THROW(require_same_scene(small({"output.frames=7"}), small()));
}

TEST(CompareScenes, TheFirstKeysThatDifferAreNamed) {
  const Trouble one = difference({"material.solid.nu=0.25"});
  EXPECT_EQ(one.code, Exit::bad_input);
  EXPECT_NE(one.what.find("material.0.nu"), std::string::npos) << one.what;
  EXPECT_NE(one.value.find("0.25"), std::string::npos) << one.value;
  EXPECT_NE(one.value.find("0.3"), std::string::npos) << one.value;
  const Trouble some = difference({"solver.cfl=0.1", "contact.law=stick", "body.0.particles_per_cell=3"});
  for (const char* key : {"solver.cfl", "contact.law", "body.0.particles_per_cell"})
    EXPECT_NE(some.what.find(key), std::string::npos) << some.what;
  const Trouble many = difference({"material.0.nu=0.1", "material.0.E=2 GPa", "body.0.spin=1 rad/s", "grid.cell=0.5 mm",
                                   "solver.cfl=0.1", "solver.plane=stress", "solver.order=3"});
  EXPECT_NE(many.what.find("and 2 more"), std::string::npos) << many.what;
}

TEST(CompareScenes, FilesCountByTheirContents) {
  const Trouble t = difference({}, "x0_mm,y0_mm,x1_mm,y1_mm\n1.3,4.2,6.1,4.7\n");
  EXPECT_EQ(t.code, Exit::bad_input);
  EXPECT_NE(t.what.find("file cracks.csv"), std::string::npos) << t.what;
}

}  // namespace
}  // namespace riven
