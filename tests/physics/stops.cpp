// Runs that go wrong stop as unstable: which particle, where, which limit and what to try; and what was written before
// still opens. Told by the library's error and by the program's exit code.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/vtkhdf.hpp"
#include "tests/io/results_sample.hpp"
#include "tests/physics/scenes.hpp"
#include "tests/program.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using namespace test;

Scene resting_block() {
  Scene s = empty_scene(1. / 8, {{-0.5, -0.5}, {1.5, 1.5}});
  s.bodies = {body("block", Rectangle{{0, 0}, {1, 0.5}})};
  return s;
}

/// The error that ends a run within `steps`; a test failure when there is none.
Trouble trouble_of(Simulation& m, int steps) {
  try {
    for (int n = 0; n < steps; ++n) {
      m.step();
      m.take_stock();
    }
  } catch (const Error& e) {
    return e.trouble();
  }
  ADD_FAILURE() << "ran without an error";
  return {};
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// `id`: the particle that must be named, or -1 when any may be.
void expect_stop(const Trouble& t, const std::string& what, int id) {
  EXPECT_EQ(t.code, Exit::unstable);
  EXPECT_TRUE(holds(t.what, what)) << t.what;
  EXPECT_TRUE(holds(t.where, "step ")) << t.where;
  EXPECT_TRUE(holds(t.where, id < 0 ? "particle " : "particle " + std::to_string(id) + " ")) << t.where;
  EXPECT_TRUE(holds(t.where, ") m")) << t.where;
  EXPECT_FALSE(t.value.empty());
  EXPECT_FALSE(t.limit.empty());
  EXPECT_FALSE(t.suggestion.empty());
}

constexpr StressUpdate updates[] = {StressUpdate::usl, StressUpdate::musl, StressUpdate::usf, StressUpdate::usavg};

TEST(Stops, NameTheParticleThatLeavesTheGrid) {
  Scene s = resting_block();
  s.bodies[0].velocity = {40, 0};
  const ChosenSpace space;
  Simulation m(s, space);
  const Trouble t = trouble_of(m, 1000);
  expect_stop(t, "left the grid", -1);
  EXPECT_TRUE(holds(t.limit, "1.5")) << t.limit;
  EXPECT_TRUE(holds(t.suggestion, "[grid]")) << t.suggestion;
}

TEST(Stops, NameAParticleWithoutANumber) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const StressUpdate update : updates) {
      Scene s = resting_block();
      s.stress_update = update;
      const ChosenSpace space;
      Simulation m(s, space);
      for (int n = 0; n < 5; ++n)
        m.step();
      const int at = 37;
      m.state.particles.v[1][at] = bad;
      const Trouble t = trouble_of(m, 3);
      expect_stop(t, "not a number", -1);
      EXPECT_TRUE(holds(t.where, "step 5,") || holds(t.where, "step 6,")) << t.where;
    }
}

TEST(Stops, NameAParticleWhoseStressIsNotANumber) {
  for (const LawKind law : {LawKind::linear_elastic, LawKind::neo_hookean}) {
    Scene s = resting_block();
    s.materials = {solid(law)};
    const ChosenSpace space;
    Simulation m(s, space);
    m.state.particles.stress[0][12] = std::numeric_limits<double>::quiet_NaN();
    if (law == LawKind::neo_hookean)
      m.state.particles.F[0][12] = std::numeric_limits<double>::quiet_NaN();
    const Trouble t = trouble_of(m, 3);
    EXPECT_EQ(t.code, Exit::unstable);
    EXPECT_TRUE(holds(t.where, "particle ")) << t.where;
  }
}

TEST(Stops, NameTheParticleThatTurnsInsideOut) {
  for (const LawKind law : {LawKind::linear_elastic, LawKind::neo_hookean})
    for (const StressUpdate update : updates) {
      Scene s = resting_block();
      s.materials = {solid(law)};
      s.stress_update = update;
      const ChosenSpace space;
      Simulation m(s, space);
      int id;
      if (law == LawKind::neo_hookean) {
        m.state.particles.F[0][12] = -0.5;
        id = m.state.particles.id[12];
      } else {
        m.state.particles.J[12] = -0.5;
        id = m.state.particles.id[12];
      }
      const Trouble t = trouble_of(m, 1);
      expect_stop(t, "inside out", id);
      EXPECT_TRUE(holds(t.value, "det F = -0.5")) << t.value;
      EXPECT_EQ(t.limit, "det F > 0");
    }
}

TEST(Stops, NameTheFastestParticleWhenEnergyGrowsFromNothing) {
  Scene s = resting_block();
  s.bodies[0].spin = 1;
  const ChosenSpace space;
  Simulation m(s, space);
  m.take_stock();
  for (int n = 0; n < 5; ++n)
    m.step();
  m.take_stock();
  const int fastest = 20;
  m.state.particles.v[0][fastest] = 5;
  try {
    m.take_stock();
    FAIL() << "energy grew, and nothing was said";
  } catch (const Error& e) {
    expect_stop(e.trouble(), "energy grows", m.state.particles.id[fastest]);
    EXPECT_TRUE(holds(e.trouble().limit, "5 % (limits.energy_growth)")) << e.trouble().limit;
  }
}

/// Work of loads that rise as the third power of time rises as their eighth: what the last step has done is a third of
/// all there is.
TEST(Stops, AreNotOfLoadsThatRiseSmoothly) {
  for (const StressUpdate update : updates) {
    Scene s = resting_block();
    s.stress_update = update;
    const Rectangle all = std::get<Rectangle>(s.bodies[0].region);
    for (const bool right : {false, true}) {
      Load load = traction_on(right ? Load::Edge::right : Load::Edge::left, all);
      load.value[0] = TimeFunction{right ? 1e3 : -1e3, [](double t) { return t * t * t; }, ""};
      s.loads.push_back(load);
    }
    const ChosenSpace space;
    Simulation m(s, space);
    for (int n = 0; n < 40; ++n) {
      m.step();
      EXPECT_NO_THROW(m.take_stock()) << name_of(update) << ", step " << n;
    }
  }
}

/// A body at rest that is loaded at once: its first steps have more energy than the work that is booked with the moves.
TEST(Stops, LetLoadsBeginAtOnce) {
  Scene s = resting_block();
  s.transfer = Transfer::fmpm;
  s.order = 2;
  Load load;
  load.name = "right";
  load.kind = Load::Kind::traction;
  load.region = s.bodies[0].region;
  load.value[0] = constant(100);
  s.loads = {load};
  const ChosenSpace space;
  Simulation m(s, space);
  m.step();
  EXPECT_NO_THROW(m.take_stock());
  EXPECT_GT(m.state.ledger.energy.numerical(), m.plan.energy_growth * m.state.ledger.energy.largest);
  for (int n = 0; n < 20; ++n) {
    m.step();
    EXPECT_NO_THROW(m.take_stock());
  }
  EXPECT_LT(m.state.ledger.energy.numerical(), m.plan.energy_growth * m.state.ledger.energy.largest);
}

/// A grip whose weight on the last nodes of a body is but a rounding: the energy of these is none.
TEST(Stops, AreNotOfEnergiesOfRounding) {
  constexpr double mm = 1e-3;
  Scene s = empty_scene(mm, {{-4 * mm, -4 * mm}, {24 * mm, 24 * mm}});
  s.bodies = {body("plate", Rectangle{{0, 0}, {20 * mm, 20 * mm}})};
  for (const double lower : {21.0, 21.25, 21.5}) {
    Grip grip;
    grip.name = "away";
    grip.region = Rectangle{{0, lower * mm}, {20 * mm, 23 * mm}};
    grip.velocity[1] = constant(-1);
    s.grips = {grip};
    const ChosenSpace space;
    Simulation m(s, space);
    for (int n = 0; n < 5; ++n) {
      m.step();
      EXPECT_NO_THROW(m.take_stock()) << lower;
    }
    EXPECT_LT(std::abs(m.state.ledger.energy.relative_error()), 1e-6) << lower;
  }
}

/// Grips that move off at once strain what they hold before they are booked with work.
TEST(Stops, LetGripsBeginAtOnce) {
  for (const StressUpdate update : {StressUpdate::musl, StressUpdate::usavg}) {
    Scene s = resting_block();
    s.transfer = Transfer::fmpm;
    s.order = 2;
    s.stress_update = update;
    s.cfl = 0.7;
    for (const double side : {-1., 1.}) {
      Grip g;
      g.name = side > 0 ? "top" : "bottom";
      g.region = side > 0 ? Rectangle{{0, 0.5}, {1, 0.625}} : Rectangle{{0, -0.125}, {1, 0}};
      g.velocity[1] = constant(-1e-3 * side);
      s.grips.push_back(g);
    }
    const ChosenSpace space;
    Simulation m(s, space);
    for (int step = 0; step < 20; ++step) {
      m.step();
      EXPECT_NO_THROW(m.take_stock()) << name_of(update) << ", step " << step;
    }
  }
}

/// What contact is said to take and the transfer to give back is no growth; what contact takes alone is.
TEST(Stops, LeaveWhatTheTransferGivesBackOutOfGrowth) {
  Scene s = resting_block();
  s.bodies[0].spin = 1;
  s.transfer = Transfer::fmpm;
  s.order = 2;
  const ChosenSpace space;
  Simulation m(s, space);
  m.step();
  m.state.clock.step = 1000;  // long after the start, when nothing more is allowed
  Energy& e = m.state.ledger.energy;
  m.take_stock();
  e.contact = 0.5 * e.total();
  EXPECT_THROW(m.take_stock(), Error);
  e.transfer = -e.contact;
  EXPECT_NO_THROW(m.take_stock());
  for (long i = 0; i < m.state.particles.count(); ++i)
    for (auto& v : m.state.particles.v)
      v[i] *= 1.1;
  EXPECT_THROW(m.take_stock(), Error);
}

/// Energy that contact gives, beyond what the transfer wears down at once, comes from nowhere although it is booked.
TEST(Stops, CountWhatContactMakes) {
  Scene s = resting_block();
  s.bodies[0].spin = 1;
  CrackLine& cut = s.cracks.emplace_back();
  cut.name = "cut";
  cut.points = {{0.2, 0.27}, {0.8, 0.27}};
  const ChosenSpace space;
  Simulation m(s, space);
  m.step();
  m.state.clock.step = 1000;
  Energy& e = m.state.ledger.energy;
  m.take_stock();
  e.contact = -0.15 * e.largest;
  EXPECT_NO_THROW(m.take_stock());
  e.contact = -0.25 * e.largest;
  expect_stop(trouble_of(m, 1), "contact makes energy", -1);
  e.transfer = -e.contact;
  EXPECT_NO_THROW(m.take_stock());
}

/// FMPM gives energy, too, in the first steps after a load that begins at once: none of that is contact's.
TEST(Stops, DoNotTakeTheTransferForContact) {
  Scene s = resting_block();
  s.transfer = Transfer::fmpm;
  s.order = 2;
  CrackLine& cut = s.cracks.emplace_back();
  cut.name = "cut";
  cut.points = {{0.2, 0.27}, {0.8, 0.27}};
  cut.traction = TractionSettings{};
  cut.traction->kind = TractionKind::pressure;
  cut.traction->pressure = TimeFunction{1, {}, ""};
  const ChosenSpace space;
  Simulation m(s, space);
  for (int step = 0; step < 20; ++step) {
    m.step();
    EXPECT_NO_THROW(m.take_stock()) << step;
  }
}

/// A block that flies at `speed` towards the wall of its grid, 50 mm away.
std::string write_scene(const sample::Folder& folder, const std::string& speed, const std::string& more = "") {
  std::string path = (folder / "scene.toml").string();
  std::ofstream(path) << R"toml(title = "flying block"
[solver]
time = "40 ms"
stress_update = "usavg"
[grid]
cell = "5 mm"
lower = ["-50 mm", "-50 mm"]
upper = ["100 mm", "100 mm"]
[[material]]
name = "rubber"
E = "1 MPa"
nu = 0.3
density = "1 g/cm^3"
[[body]]
name = "block"
material = "rubber"
rectangle = { lower = ["0 mm", "0 mm"], upper = ["50 mm", "25 mm"] }
velocity = [)toml" << '"'
                      << speed << R"toml(", "0 m/s"]
[output]
frames = 20
)toml" << more;
  return path;
}

TEST(StopsOfTheProgram, LeaveFramesHistoryAndSummaryBehind) {
  const sample::Folder folder;
  const std::string out = (folder / "out").string();
  const Outcome o = riven("run " + write_scene(folder, "3 m/s") + " --quiet --threads 1 -o " + out, folder);
  EXPECT_EQ(o.code, 3) << o.errors;
  for (const char* part : {"a particle left the grid", "particle ", " m: ", "value:", "allowed:", "try:"})
    EXPECT_TRUE(holds(o.errors, part)) << part << " is missing in\n" << o.errors;
  const auto frames = list_frames(std::filesystem::path(out) / "frames", "particles");
  // 50 mm at 3 m/s: 17 of 40 ms, so eight frames after the first, and the last state
  EXPECT_GE(frames.size(), 9u);
  double last = -1;
  for (const auto& frame : frames) {
    const TimedPolyData data = read_vtkhdf(frame);
    EXPECT_EQ(data.data.points.size(), 3u * 200u) << frame;
    EXPECT_GT(data.time, last);
    last = data.time;
  }
  EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(out) / "particles.vtkhdf"));
  EXPECT_FALSE(sample::text_of(std::filesystem::path(out) / "history.csv").empty());
  const auto summary = nlohmann::json::parse(sample::text_of(std::filesystem::path(out) / "summary.json"));
  EXPECT_EQ(summary.at("status"), "unstable");
  // the foremost particles stand a quarter of a cell behind the block's edge; they are outside a cell and a half behind
  // the wall, which is seen when they are sorted again, within a cell
  const double cell = 5e-3, outside = (0.05 + 1.75 * cell) / 3, sort = cell / 3;
  EXPECT_NEAR(summary.at("time").get<double>(), outside + sort / 2, 0.51 * sort);
}

TEST(StopsOfTheProgram, UnstableTimeStepsEndWithExitThree) {
  const sample::Folder folder;
  const std::string out = (folder / "out").string();
  const Outcome o = riven("run " + write_scene(folder, "0.5 m/s") + " --quiet --threads 1 --set solver.cfl=1.9 --set " +
                              "'body.block.spin=\"20 rad/s\"' -o " + out,
                          folder);
  EXPECT_EQ(o.code, 3) << o.errors;
  EXPECT_TRUE(holds(o.errors, "particle ")) << o.errors;
  EXPECT_TRUE(holds(o.errors, "solver.cfl")) << o.errors;
  EXPECT_FALSE(list_frames(std::filesystem::path(out) / "frames", "particles").empty());
}

TEST(StopsOfTheProgram, BadInputIsTwoAndAFolderThatCannotBeIsFour) {
  const sample::Folder folder;
  const std::string scene = write_scene(folder, "0.1 m/s");
  const std::string out = (folder / "out").string();
  EXPECT_EQ(riven("run " + scene + " --quiet --set 'solver.time=\"0.1 ms\"' -o " + out, folder).code, 0);
  const Outcome key = riven("run " + write_scene(folder, "0.1 m/s", "fremes = 3\n") + " -o " + out, folder);
  EXPECT_EQ(key.code, 2);
  EXPECT_TRUE(holds(key.errors, "fremes")) << key.errors;
  EXPECT_EQ(riven("run " + write_scene(folder, "0.1 kg") + " -o " + out, folder).code, 2);
  EXPECT_EQ(riven("run no_such_scene", folder).code, 2);
  EXPECT_EQ(riven("run " + scene + " --no-such-option", folder).code, 2);
  EXPECT_EQ(riven("no_such_command", folder).code, 2);
  std::ofstream(folder / "file") << "not a folder";
  const std::string good = write_scene(folder, "0.1 m/s");
  const Outcome file = riven("run " + good + " --quiet -o " + (folder / "file").string() + "/inside", folder);
  EXPECT_EQ(file.code, 4) << file.errors;
  EXPECT_TRUE(holds(file.errors, "inside")) << file.errors;
}

TEST(StopsOfTheProgram, AFolderNamedLikeAShippedSceneIsNoScene) {
  const sample::Folder folder;
  std::filesystem::create_directories(folder / "two_disks");
  std::filesystem::create_directories(folder / "results");
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const Outcome shipped = riven("check two_disks", folder), other = riven("check results", folder);
  std::filesystem::current_path(here);
  EXPECT_EQ(shipped.code, 0) << shipped.errors;
  EXPECT_EQ(other.code, 4);
  EXPECT_TRUE(holds(other.errors, "not a file")) << other.errors;
}

}  // namespace
}  // namespace riven
