#include "io/toml_text.hpp"
#include "tests/io/scene_text.hpp"

using namespace riven;
using namespace riven::test;

TEST(Overrides, ReplaceAndAdd) {
  const Scene s = read(good_scene, {"solver.cfl=0.3", "solver.time=3 ms", "body.0.velocity=[\"1 m/s\", \"0 m/s\"]",
                                    "body.plate.particles_per_cell=4", "damping.grid=80 1/ms", "solver.plane=strain",
                                    "crack.edge.points.1.0=26 mm", "output.frames=3"});
  EXPECT_DOUBLE_EQ(s.cfl, 0.3);
  EXPECT_DOUBLE_EQ(s.end_time, 3e-3);
  EXPECT_DOUBLE_EQ(s.bodies[0].velocity.x, 1);
  EXPECT_EQ(s.bodies[0].particles_per_cell, 4);
  EXPECT_DOUBLE_EQ((*s.grid_damping)(0), 8e4);
  EXPECT_EQ(s.plane, Plane::strain);
  EXPECT_DOUBLE_EQ(s.cracks[0].points[1].x, 0.026);
  EXPECT_EQ(s.output.frames, 3);
}

TEST(Overrides, TakeAwayWhatHasNoValue) {
  const Scene s = read(good_scene, {"crack.edge.contact=", "symmetry=", "solver.plane=", "grip.top="});
  EXPECT_FALSE(s.cracks[0].contact);
  EXPECT_TRUE(s.symmetry.empty());
  EXPECT_TRUE(s.grips.empty());
  EXPECT_EQ(s.plane, Plane::strain);
  EXPECT_TRUE(read(good_scene, {"crack="}).cracks.empty());
  const Trouble t = trouble_of(good_scene, {"solver.plnae="});
  EXPECT_NE(t.what.find("no key 'plnae' to take away"), std::string::npos) << t.what;
  EXPECT_NE(t.suggestion.find("'plane'"), std::string::npos) << t.suggestion;
  EXPECT_NE(trouble_of(good_scene, {"damping.grid="}).what.find("no key 'damping'"), std::string::npos);
  EXPECT_NE(trouble_of(good_scene, {"grip.tip="}).what.find("no entry 'tip'"), std::string::npos);
}

TEST(Overrides, SourceTextHoldsThem) {
  const Scene s = read(good_scene, {"solver.cfl=0.3", "title=other"});
  const Scene again = read(s.source_text);
  EXPECT_EQ(again.title, "other");
  EXPECT_EQ(again.cfl, s.cfl);
  EXPECT_EQ(again.cell, s.cell);
  EXPECT_EQ(again.cracks[0].points[1].x, s.cracks[0].points[1].x);
}

TEST(TomlText, ReadsBackAsTheSameDocument) {
  const toml::table document = parse_toml(R"toml(
a = -9223372036854775808
b = [1e-300, -inf, 3.0, 1e300, -0.0, 0.1, 1e22]
"odd key \n\"" = 'quote " back \ tab	'
c = { d = [{ e = [] }, 1], "" = {} }
when = 1979-05-27T07:32:00.999-07:00
day = 1979-05-27
[solver]
s = "µ \u0000 \u007f"
[[body]]
[[body]]
x = true
)toml",
                                          "a.toml");
  const toml::table again = parse_toml(toml_text(document), "b.toml");
  EXPECT_EQ(document, again) << toml_text(document);
  EXPECT_EQ(toml_value(*again.get("c")), "{ \"\" = {  }, d = [{ e = [] }, 1] }");
}

TEST(Overrides, UnknownPathIsRefusedWithTheNearest) {
  const auto message = [](const std::string& setting) {
    const Trouble t = trouble_of(good_scene, {setting});
    EXPECT_EQ(t.code, Exit::bad_input);
    EXPECT_NE(t.where.find("--set " + setting), std::string::npos) << t.where;
    return t.what + " / " + t.suggestion;
  };
  EXPECT_EQ(message("solver.cfll=0.3"), "unknown key 'cfll' / did you mean 'cfl'?");
  EXPECT_EQ(message("solvr.cfl=0.3"), "unknown table 'solvr' / did you mean 'solver'?");
  EXPECT_EQ(message("body.plte.spin=1 rad/s"), "there is no entry 'plte' / did you mean 'plate'?");
  EXPECT_NE(message("body.1.spin=1 rad/s").find("no entry '1'"), std::string::npos);
  EXPECT_EQ(message("load.0.kind=traction"), "there is no array 'load' / --set 'load=[{...}]' makes one");
  EXPECT_NE(message("solver.plane.x=1").find("'plane' has no keys below it"), std::string::npos);
  EXPECT_NE(message("solver.cfl=many").find("expected a number"), std::string::npos);
  EXPECT_NE(message("solver.time=3 mm").find("not a unit of time"), std::string::npos);
  EXPECT_NE(message("=3").find("needs a key"), std::string::npos);
  EXPECT_NE(message("solver.cfl").find("needs a key"), std::string::npos);
  EXPECT_NE(message("solver..cfl=1").find("path"), std::string::npos);
  EXPECT_EQ(trouble_of(good_scene, {"a.a.a.a.a.a.a.a.a=1"}).limit, "at most 8 names joined by dots");
}

TEST(Overrides, OneSettingIsOneKey) {
  const Trouble t = trouble_of(good_scene, {"solver.cfl=0.3\nplane=\"strain\""});
  EXPECT_NE(t.what.find("expected a number"), std::string::npos) << "not two keys: a text that is no number";
}
