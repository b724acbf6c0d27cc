#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "tests/io/scene_text.hpp"

using namespace riven;
using namespace riven::test;

TEST(ReadScene, QuantitiesInSi) {
  const Scene s = read(good_scene);
  EXPECT_EQ(s.name, "plate");
  EXPECT_EQ(s.title, "plate");
  EXPECT_EQ(s.source_text, good_scene);
  EXPECT_DOUBLE_EQ(s.end_time, 2e-3);
  EXPECT_EQ(s.plane, Plane::stress);
  EXPECT_DOUBLE_EQ(s.cell, 5e-4);
  EXPECT_DOUBLE_EQ(s.grid.lower.x, -4e-3);
  EXPECT_DOUBLE_EQ(s.grid.upper.y, 0.104);
  ASSERT_EQ(s.materials.size(), 1u);
  EXPECT_DOUBLE_EQ(s.materials[0].E, 2.5e9);
  EXPECT_DOUBLE_EQ(s.materials[0].nu, 0.33);
  EXPECT_DOUBLE_EQ(s.materials[0].density, 1000);
  ASSERT_EQ(s.bodies.size(), 1u);
  EXPECT_EQ(s.bodies[0].material, 0);
  EXPECT_DOUBLE_EQ(std::get<Rectangle>(s.bodies[0].region).upper.y, 0.1);
  ASSERT_EQ(s.symmetry.size(), 1u);
  EXPECT_EQ(s.symmetry[0].axis, 0);
  EXPECT_EQ(s.symmetry[0].solid, +1);
  ASSERT_EQ(s.grips.size(), 1u);
  EXPECT_FALSE(s.grips[0].velocity[0]);
  ASSERT_TRUE(s.grips[0].velocity[1]);
  EXPECT_NEAR((*s.grips[0].velocity[1])(5e-4), std::sin(std::numbers::pi / 4), 1e-15);
  EXPECT_EQ(s.grips[0].velocity[1]->text, "1 m/s * (sin(pi*t/tr)), tr = 2 ms");
  ASSERT_EQ(s.cracks.size(), 1u);
  EXPECT_DOUBLE_EQ(s.cracks[0].points[1].x, 0.025);
  ASSERT_TRUE(s.cracks[0].contact);
  EXPECT_EQ(s.cracks[0].contact->law, ContactLaw::coulomb);
  EXPECT_DOUBLE_EQ(s.cracks[0].contact->friction, 0.3);
  EXPECT_EQ(s.contact.law, ContactLaw::frictionless);
}

TEST(ReadScene, EveryPart) {
  const Scene s = read(changed("\"104 mm\"", "\"134 mm\"") + R"toml(
[[material]]
name = "rubber"
law = "neo_hookean"
E = "0.1 MPa"
nu = 0.49
density = "1.5 g/cm^3"
[[body]]
name = "disk"
material = "rubber"
disk = { center = ["25 mm", "120 mm"], radius = "10 mm" }
holes = [ { disk = { center = ["25 mm", "120 mm"], radius = "2 mm" } } ]
particles_per_cell = 3
thickness = "6 mm"
velocity = ["1000 mm/s", "-2 m/s"]
spin = "60 rpm"
[[fix]]
name = "ground"
box = { lower = ["0 mm", "0 mm"], upper = ["50 mm", "0 mm"] }
velocity_y = "0 m/s"
[[load]]
name = "pull"
kind = "traction"
rectangle = { lower = ["49 mm", "0 mm"], upper = ["50 mm", "10 mm"] }
edge = "right"
traction_x = "5 MPa"
[[load]]
kind = "force"
polygon = [["0 mm", "0 mm"], ["1 mm", "0 mm"], ["0 mm", "1 mm"]]
force_y = { value = "0.4 mN", shape = "min(t/ramp, 1)", ramp = "10 us" }
[body_force]
y = "-9.81 m/s^2"
[damping]
grid = "80 1/ms"
[contact]
law = "interface"
normal_stiffness = "2 MPa/mm"
shear_stiffness = "1 MPa/mm"
detection = "volume"
v_sep = 0.8
[cracks]
motion = "center_of_mass"
surface_update = "pic"
[[crack]]
name = "cohesive"
points = [["10 mm", "10 mm"], ["20 mm", "20 mm"]]
contact = { law = "frictionless" }
[crack.traction]
kind = "trilinear"
strength = "30 MPa"
toughness = "0.6 N/mm"
shear_toughness = "1.5 kJ/m^2"
peak = 0.1
knee = 0.4
disk = { center = ["20 mm", "20 mm"], radius = "9 mm" }
[[crack]]
name = "pressed"
points = [["30 mm", "10 mm"], ["40 mm", "20 mm"]]
contact = { law = "stick" }
traction = { kind = "pressure", pressure = { value = "5 MPa", shape = "(1-cos(pi*t/tr))/2", tr = "1 ms" } }
[[probe]]
name = "mouth"
kind = "crack_opening"
target = "edge"
[[probe]]
name = "s"
kind = "stress"
point = ["1 mm", "2 mm"]
component = "xy"
[[probe]]
name = "pull_force"
kind = "reaction"
target = "top"
over = "50 mm^2"
[output]
frames = 7
history_every = "1 us"
sidecar = "vtp"
precision = "double"
fields = ["fringe"]
fringe_constant = "0.0889 1/MPa"
[limits]
energy_growth = 0.1
retries = 3
retry_cfl = 0.8
[limits.warn]
compression = 2
velocity_difference = "5 mm/ms"
[limits.stop]
penetration = 0.5
)toml");
  EXPECT_EQ(s.materials[1].law, LawKind::neo_hookean);
  const Body& b = s.bodies[1];
  EXPECT_EQ(b.material, 1);
  EXPECT_DOUBLE_EQ(std::get<Disk>(b.region).radius, 0.01);
  ASSERT_EQ(b.holes.size(), 1u);
  EXPECT_EQ(b.particles_per_cell, 3);
  EXPECT_DOUBLE_EQ(b.thickness, 6e-3);
  EXPECT_DOUBLE_EQ(b.velocity.x, 1);
  EXPECT_DOUBLE_EQ(b.velocity.y, -2);
  EXPECT_DOUBLE_EQ(b.spin, 2 * std::numbers::pi);
  ASSERT_EQ(s.fixed.size(), 1u);
  EXPECT_FALSE(s.fixed[0].velocity[0]);
  EXPECT_EQ((*s.fixed[0].velocity[1])(1), 0);
  ASSERT_EQ(s.loads.size(), 2u);
  EXPECT_EQ(s.loads[0].edge, Load::Edge::right);
  EXPECT_DOUBLE_EQ(s.loads[0].value[0](0), 5e6);
  EXPECT_EQ(s.loads[0].value[1](0), 0);
  EXPECT_EQ(s.loads[1].name, "load_1");
  EXPECT_DOUBLE_EQ(s.loads[1].value[1](5e-6), 2e-4);
  EXPECT_FALSE(s.body_force[0]);
  EXPECT_DOUBLE_EQ((*s.body_force[1])(0), -9.81);
  EXPECT_DOUBLE_EQ((*s.grid_damping)(0), 8e4);
  EXPECT_FALSE(s.particle_damping);
  EXPECT_EQ(s.contact.law, ContactLaw::interface);
  EXPECT_DOUBLE_EQ(s.contact.normal_stiffness, 2e9);
  EXPECT_DOUBLE_EQ(s.contact.shear_stiffness, 1e9);
  EXPECT_EQ(s.contact_rules.detection, ContactDetection::volume);
  EXPECT_FALSE(s.cracks[0].traction);
  const TractionSettings &cohesive = s.cracks[1].traction.value(), &pressed = s.cracks[2].traction.value();
  EXPECT_EQ(cohesive.kind, TractionKind::trilinear);
  EXPECT_DOUBLE_EQ(cohesive.strength, 30e6);
  EXPECT_DOUBLE_EQ(cohesive.shear_strength, 30e6);
  EXPECT_DOUBLE_EQ(cohesive.toughness, 600);
  EXPECT_DOUBLE_EQ(cohesive.shear_toughness, 1500);
  EXPECT_EQ(cohesive.peak, 0.1);
  EXPECT_EQ(cohesive.knee, 0.4);
  EXPECT_EQ(cohesive.knee_strength, 0.25);
  EXPECT_DOUBLE_EQ(std::get<Disk>(cohesive.region.value()).radius, 9e-3);
  EXPECT_EQ(pressed.kind, TractionKind::pressure);
  EXPECT_FALSE(pressed.region);
  EXPECT_NEAR(pressed.pressure(0.5e-3), 2.5e6, 1e-9);
  EXPECT_DOUBLE_EQ(s.contact_rules.v_sep, 0.8);
  EXPECT_DOUBLE_EQ(s.contact_rules.v_contact, 1.1);
  EXPECT_EQ(s.crack_motion, CrackMotion::center_of_mass);
  EXPECT_EQ(s.surface_update, SurfaceUpdate::pic);
  ASSERT_EQ(s.probes.size(), 3u);
  EXPECT_EQ(s.probes[0].target, "edge");
  EXPECT_EQ(s.probes[1].axis, 0);
  EXPECT_EQ(s.probes[1].axis2, 1);
  EXPECT_EQ(s.probes[2].axis, 1);
  EXPECT_DOUBLE_EQ(s.probes[2].over, 5e-5);
  EXPECT_EQ(s.output.frames, 7);
  EXPECT_DOUBLE_EQ(s.output.history_every, 1e-6);
  EXPECT_EQ(s.output.sidecar, Sidecar::vtp);
  EXPECT_EQ(s.output.precision, Precision::as_double);
  EXPECT_DOUBLE_EQ(s.output.fringe_constant, 0.0889e-6);
  EXPECT_EQ(s.limits.energy_growth, 0.1);
  EXPECT_EQ(s.limits.warn, (Thresholds{0.02, 1e-9, 0.05, 2, 5, 1.3, 0.25, 5}));
  EXPECT_EQ(s.limits.stop, (Thresholds{no_limit, no_limit, no_limit, no_limit, no_limit, no_limit, 0.5, no_limit}));
  EXPECT_EQ(s.limits.retries, 3);
  EXPECT_EQ(s.limits.retry_cfl, 0.8);
  EXPECT_EQ(s.output.checkpoint_steps, 1000) << "to go back to";
}

TEST(ReadScene, WhatIsNotSaidIsListedWithItsDefault) {
  const Scene s = read(good_scene);
  const auto said = [&](const std::string& line) {
    return std::find(s.defaults.begin(), s.defaults.end(), line) != s.defaults.end();
  };
  EXPECT_TRUE(said("solver.cfl = 0.4"));
  EXPECT_TRUE(said("solver.stress_update = usavg"));
  EXPECT_TRUE(said("solver.thickness = 0.001 m"));
  EXPECT_TRUE(said("solver.precision = double"));
  EXPECT_TRUE(said("solver.dt_max = none"));
  EXPECT_TRUE(said("body.0.particles_per_cell = 2"));
  EXPECT_TRUE(said("contact.law = frictionless"));
  EXPECT_TRUE(said("cracks.surface_update = xpic"));
  EXPECT_TRUE(said("output.frames = 20"));
  EXPECT_FALSE(said("solver.plane = strain")) << "it was said: stress";
  EXPECT_EQ(s.places.at("grid.cell"), "plate.toml:6: grid.cell");
  EXPECT_EQ(s.places.at("crack edge"), "plate.toml:26: crack.0");
}

TEST(ReadScene, DeterministicMeansOrderedScatter) {
  EXPECT_EQ(read(good_scene, {"solver.deterministic=true"}).scatter, ScatterKind::ordered);
  EXPECT_EQ(read(good_scene, {"solver.scatter=atomic"}).scatter, ScatterKind::atomic);
  const Trouble t = trouble_of(good_scene, {"solver.deterministic=true", "solver.scatter=atomic"});
  EXPECT_NE(t.what.find("deterministic"), std::string::npos);
}

TEST(ReadScene, PrecisionIsDoubleUnlessSaid) {
  EXPECT_EQ(read(good_scene).precision, Precision::as_double);
  EXPECT_EQ(read(good_scene, {"solver.precision=float"}).precision, Precision::as_float);
}

TEST(ReadScene, PointsOfACrackMayStartFromAnOrigin) {
  const Scene s = read(good_scene, {"crack.edge.origin=[\"2 mm\", \"-3 mm\"]"});
  EXPECT_DOUBLE_EQ(s.cracks[0].points[0].x, 0.001);
  EXPECT_DOUBLE_EQ(s.cracks[0].points[1].x, 0.027);
  EXPECT_DOUBLE_EQ(s.cracks[0].points[1].y, 0.047);
  const Trouble t = trouble_of(changed("points = [[\"-1 mm\", \"50 mm\"], [\"25 mm\", \"50 mm\"]]",
                                       "file = \"some.csv\"\norigin = [\"2 mm\", \"0 mm\"]"));
  EXPECT_NE(t.where.find("crack.0.origin"), std::string::npos) << t.where;
}

TEST(ReadScene, CracksFromAFile) {
  const auto folder = std::filesystem::temp_directory_path() / ("riven_cracks_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto put = [&](const char* name, const std::string& text) { std::ofstream(folder / name) << text; };
  put("plain.csv", "\xEF\xBB\xBFx0_mm,y0_mm,x1_mm,y1_mm\n10,10,20,10\n\n30,30,31.5,32\n");
  put("labelled.csv", "# ends\r\ncrack,x_start (mm),y_start (mm),x_end (mm),y_end (mm)\r\n7,10,10,20,10\r\n");
  put("outside.csv", "x0_mm,y0_mm,x1_mm,y1_mm\n10,10,20,10\n51,30,52,30\n");
  put("short.csv", "x0_mm,y0_mm,x1_mm,y1_mm\n10,10,20\n");
  put("word.csv", "x0_mm,y0_mm,x1_mm,y1_mm\n10,10,20,ten\n");
  put("unitless.csv", "x0,y0,x1,y1\n10,10,20,10\n");
  put("column.csv", "x0_mm,y0_mm,x1_mm,yy1_mm\n10,10,20,10\n");
  put("empty.csv", "x0_mm,y0_mm,x1_mm,y1_mm\n");
  const auto scene = [&](const std::string& file) {
    put("scene.toml", changed("points = [[\"-1 mm\", \"50 mm\"], [\"25 mm\", \"50 mm\"]]", "file = \"" + file + "\""));
    return (folder / "scene.toml").string();
  };
  const auto trouble = [&](const std::string& file) {
    try {
      read_scene(scene(file));
    } catch (const Error& e) {
      return e.trouble();
    }
    return Trouble{Exit::done, "", "", "", "", ""};
  };

  const Scene plain = read_scene(scene("plain.csv"));
  ASSERT_EQ(plain.cracks.size(), 2u);
  EXPECT_EQ(plain.cracks[1].name, "edge_2");
  EXPECT_DOUBLE_EQ(plain.cracks[1].points[1].x, 0.0315);
  EXPECT_DOUBLE_EQ(plain.cracks[1].contact->friction, 0.3);
  const Scene labelled = read_scene(scene("labelled.csv"));
  ASSERT_EQ(labelled.cracks.size(), 1u);
  EXPECT_EQ(labelled.cracks[0].name, "edge_7");
  EXPECT_DOUBLE_EQ(labelled.cracks[0].points[0].y, 0.01);

  EXPECT_NE(trouble("outside.csv").where.find("outside.csv:3"), std::string::npos);
  EXPECT_NE(trouble("short.csv").what.find("3 values"), std::string::npos);
  EXPECT_NE(trouble("word.csv").where.find("word.csv:2"), std::string::npos);
  EXPECT_NE(trouble("unitless.csv").what.find("no unit"), std::string::npos);
  EXPECT_NE(trouble("column.csv").suggestion.find("y1"), std::string::npos);
  EXPECT_EQ(trouble("empty.csv").code, Exit::bad_input);
  const Trouble missing = trouble("none.csv");
  EXPECT_EQ(missing.code, Exit::file);
  EXPECT_NE(missing.where.find("scene.toml:28: crack.0.file"), std::string::npos) << missing.where;
  EXPECT_NE(missing.value.find("none.csv"), std::string::npos);
  EXPECT_EQ(trouble(".").code, Exit::file);
  std::filesystem::remove_all(folder);
}

TEST(ReadScene, TextsAndCommentsMayGoBeyondAscii) {
  EXPECT_EQ(read(changed("title = \"plate\"", "title = \"\"\"Ri\u00df \\\n  \"\"\" # \u00b5m \"")).title, "Ri\u00df ");
  EXPECT_EQ(read(changed("title = \"plate\"", "title = 'a\u00b5\\' # \"")).title, "a\u00b5\\");
  EXPECT_DOUBLE_EQ(read(changed("cell = \"0.5 mm\"", "cell = \"500 \u00b5m\"")).cell, 5e-4);
}

TEST(ReadScene, ShippedScenesAreRight) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(RIVEN_SOURCE_DIR "/cases/scenes")) {
    if (entry.path().extension() != ".toml")
      continue;
    EXPECT_NO_THROW(read_scene(entry.path().string())) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0);
}

/// A shape that names places is a field of its body's places, others are functions of time; constants of the scene
/// serve all of them, those of a shape stand before them.
TEST(SceneRead, FieldsAndConstants) {
  const Scene s = read(changed("material = \"pmma\"", R"toml(material = "pmma"
velocity_x = { value = "2 m/s", shape = "k*X/L + Y" }
velocity_y = "1 m/s")toml") +
                       R"toml([[load]]
kind = "acceleration"
rectangle = { lower = ["0 mm", "0 mm"], upper = ["9 mm", "9 mm"] }
acceleration_x = { value = "1 m/s^2", shape = "X*t*k", k = 5 }
acceleration_y = { value = "1 m/s^2", shape = "k*t/L" }
[[probe]]
name = "wrong"
kind = "displacement_error"
exact_y = { value = "1 mm", shape = "Y/L" }
over = "2 mm"
[constants]
L = "50 mm"
k = 3
)toml");
  const double X[] = {0.05, 0.1}, Y[] = {0, 0.5};
  double v[2];
  ASSERT_TRUE(s.bodies[0].velocity_field[0]);
  s.bodies[0].velocity_field[0]->at(0, 2, X, Y, v);
  EXPECT_DOUBLE_EQ(v[0], 6);
  EXPECT_DOUBLE_EQ(v[1], 13);
  s.bodies[0].velocity_field[1]->at(0, 2, X, Y, v);
  EXPECT_DOUBLE_EQ(v[1], 1);
  const Load& load = s.loads[0];
  EXPECT_EQ(load.kind, Load::Kind::acceleration);
  ASSERT_TRUE(load.value[0].places);
  load.value[0].at(2, 2, X, Y, v);
  EXPECT_DOUBLE_EQ(v[0], 0.5);
  EXPECT_DOUBLE_EQ(v[1], 1);
  EXPECT_FALSE(load.value[1].places);
  EXPECT_DOUBLE_EQ(load.value[1](0.5), 30);
  EXPECT_FALSE(s.probes[0].exact[0].places);
  EXPECT_EQ(s.probes[0].exact[0](1), 0);
  s.probes[0].exact[1].at(0, 2, X, Y, v);
  EXPECT_DOUBLE_EQ(v[1], 0.01);
  EXPECT_DOUBLE_EQ(s.probes[0].over, 2e-3);
}

TEST(SceneRead, ContactMayWait) {
  EXPECT_EQ(read(good_scene).contact_rules.when, ContactWhen::always);
  EXPECT_EQ(read(good_scene + "[contact]\nwhen = \"auto\"\n").contact_rules.when, ContactWhen::closing);
}

TEST(SceneRead, RulesOfGrowth) {
  const Scene plain = read(good_scene);
  EXPECT_FALSE(plain.growth);
  EXPECT_FALSE(plain.cracks[0].growth);
  EXPECT_TRUE(plain.cracks[0].grows);
  const Scene s = read(good_scene +
                       R"toml([crack.growth]
criterion = "critical_j"
toughness = "0.1 N/mm"
direction = "fixed"
heading = [3, -4]
speed_limit = "500 m/s"
[[crack]]
points = [["5 mm", "5 mm"], ["9 mm", "5 mm"]]
grows = false
[growth]
toughness = "0.5 MPa sqrt(m)"
)toml");
  ASSERT_TRUE(s.growth);
  EXPECT_EQ(s.growth->criterion, GrowthCriterion::k_max);
  EXPECT_DOUBLE_EQ(s.growth->toughness, 0.5e6);
  EXPECT_EQ(s.growth->direction, GrowthDirection::hoop);
  EXPECT_EQ(s.growth->speed_limit, 0);
  ASSERT_TRUE(s.cracks[0].growth);
  const GrowthRule& own = *s.cracks[0].growth;
  EXPECT_EQ(own.criterion, GrowthCriterion::critical_j);
  EXPECT_DOUBLE_EQ(own.toughness, 100);
  EXPECT_EQ(own.direction, GrowthDirection::fixed);
  EXPECT_NEAR(own.heading.x, 0.6, 1e-15);
  EXPECT_NEAR(own.heading.y, -0.8, 1e-15);
  EXPECT_DOUBLE_EQ(own.speed_limit, 500);
  EXPECT_FALSE(s.cracks[1].grows);
}

TEST(SceneRead, ToughnessOfMaterials) {
  EXPECT_EQ(read(good_scene).materials[0].K_Ic, 0);
  std::string text = good_scene;
  const std::string density = "density = ";
  text.insert(text.find(density), "K_Ic = \"0.9 MPa m^0.5\"\nJ_Ic = \"0.3 N/mm\"\n");
  const Scene s = read(text + "[growth]\n");
  EXPECT_DOUBLE_EQ(s.materials[0].K_Ic, 0.9e6);
  EXPECT_DOUBLE_EQ(s.materials[0].J_Ic, 300);
  ASSERT_TRUE(s.growth);
  EXPECT_EQ(s.growth->toughness, 0);
}
