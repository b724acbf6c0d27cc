// Study files: what they mean, and what is said of those that are wrong.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "io/study/members.hpp"
#include "io/study/read_study.hpp"
#include "io/study/settings_text.hpp"
#include "io/study/take_result.hpp"

namespace riven::study {
namespace {

const std::string sent = RIVEN_SOURCE_DIR "/cases/scenes/sent.toml";

const std::string good = R"toml(scene = "sent"
set = ["output.frames=0"]
[timing]
repeats = 5
repeat_under = "3 s"
[[vary]]
key = "grid.cell"
refined = true
values = ["2 mm", "1 mm", "0.5 mm"]
[[vary]]
name = "transfer"
choice = [{ label = "FLIP", set = ["solver.transfer=flip"] },
          { label = "FMPM", set = ["solver.transfer=fmpm", "solver.order=2"] }]
[[vary]]
name = "contour"
key = "fracture.contour"
values = [4, 8]
[[result]]
name = "J"
column = "H last J"
take = "mean"
from = "0.2 ms"
reference = "13.4 kJ/m^2"
[[leave_out]]
name = "contact"
set = ["contact.law=ignored"]
)toml";

std::string changed(const std::string& from, const std::string& to) {
  std::string text = good;
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ReadStudy, EveryPart) {
  const Study s = parse_study(good, "J.toml");
  EXPECT_EQ(s.name, "J");
  EXPECT_EQ(s.repeats, 5);
  EXPECT_EQ(s.repeat_under, 3);
  EXPECT_TRUE(s.timing);
  ASSERT_EQ(s.axes.size(), 3u);
  EXPECT_EQ(s.refined(), std::optional<size_t>(0));
  EXPECT_EQ(s.axes[0].name, "grid.cell");
  EXPECT_EQ(s.axes[0].choices[1].label, "1 mm");
  EXPECT_DOUBLE_EQ(s.axes[0].choices[1].size, 1e-3);
  EXPECT_EQ(s.axes[0].choices[1].set, std::vector<std::string>{"grid.cell=\"1 mm\""});
  EXPECT_EQ(s.axes[2].choices[1].label, "8");
  ASSERT_EQ(s.results.size(), 1u);
  EXPECT_EQ(s.results[0].take, Take::mean);
  ASSERT_EQ(s.results[0].targets.size(), 1u);
  EXPECT_DOUBLE_EQ(s.results[0].targets[0].from, 2e-4);
  EXPECT_EQ(s.results[0].targets[0].reference.kind, Reference::Kind::value);
  EXPECT_FALSE(s.problem());
}

/// The transfers of the study as if they were problems.
std::string problems(const std::string& from, const std::string& to) {
  std::string text = changed(from, to);
  return text.replace(text.find("name = \"transfer\""), 0, "problem = true\n");
}

TEST(ReadStudy, ProblemsHaveTargetsOfTheirOwn) {
  const Study s =
      parse_study(problems("from = \"0.2 ms\"\nreference = \"13.4 kJ/m^2\"",
                           "from = [\"0.2 ms\", \"0.3 ms\"]\nreference = [\"1 J/m^2\", 2]\nscale = \"3 J/m^2\""),
                  "J.toml");
  EXPECT_EQ(s.problem(), std::optional<size_t>(1));
  ASSERT_EQ(s.results[0].targets.size(), 2u);
  const Target &one = s.results[0].targets[0], &two = s.results[0].targets[1];
  EXPECT_DOUBLE_EQ(one.from, 2e-4);
  EXPECT_DOUBLE_EQ(two.from, 3e-4);
  EXPECT_EQ(one.to, two.to);
  EXPECT_EQ(one.reference.value, "1 J/m^2");
  EXPECT_EQ(two.reference.value, "2");
  EXPECT_EQ(one.scale, "3 J/m^2");
  EXPECT_EQ(two.scale, "3 J/m^2");
  const std::string folder = testing::TempDir();
  for (const char* file : {"riven_a.csv", "riven_b.csv"})
    std::ofstream(folder + "/" + file) << "t [s],J [J/m^2]\n0,0\n";
  const std::string pair = problems("take = \"mean\"\nfrom = \"0.2 ms\"\nreference = \"13.4 kJ/m^2\"",
                                    "curve = [\"riven_a.csv\", \"riven_b.csv\"]");
  const Study curves = parse_study(pair, folder + "/J.toml");
  EXPECT_EQ(std::filesystem::path(curves.results[0].targets[1].reference.file).filename(), "riven_b.csv");
  EXPECT_NE(curves.results[0].targets[1].where.find("transfer FMPM"), std::string::npos);
  std::filesystem::remove(folder + "/riven_b.csv");
  EXPECT_THROW(parse_study(pair, folder + "/J.toml"), Error);
}

TEST(ReadStudy, ProblemsThatDoNotMatch) {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      parse_study(text, "J.toml");
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  const std::string three = complaint(problems("\"13.4 kJ/m^2\"", "[1, 2, 3]"));
  EXPECT_NE(three.find("result.0.reference"), std::string::npos) << three;
  EXPECT_NE(three.find("the list has 3 entries"), std::string::npos) << three;
  EXPECT_NE(three.find("2 choices of transfer"), std::string::npos) << three;
  const std::string no_axis = complaint(changed("\"13.4 kJ/m^2\"", "[1, 2]"));
  EXPECT_NE(no_axis.find("problem = true"), std::string::npos) << no_axis;
  const std::string second = complaint(problems("values = [4, 8]", "values = [4, 8]\nproblem = true"));
  EXPECT_NE(second.find("several axes are problems"), std::string::npos) << second;
  const std::string refined = complaint(changed("refined = true", "refined = true\nproblem = true"));
  EXPECT_NE(refined.find("vary.0.problem"), std::string::npos) << refined;
  for (const char* odd : {"[[1, 2], 3]", "[true, 3]", "[{ a = 1 }, 3]"}) {
    const std::string text = complaint(problems("\"13.4 kJ/m^2\"", odd));
    EXPECT_NE(text.find("result.0.reference"), std::string::npos) << text;
    EXPECT_NE(text.find("expected a text or a number"), std::string::npos) << text;
  }
  const std::string late = complaint(problems("from = \"0.2 ms\"", "from = [\"0.2 ms\", \"9 ms\"]\nto = \"1 ms\""));
  EXPECT_NE(late.find("result.0.to"), std::string::npos) << late;
}

struct WrongStudy {
  const char* name;
  const char *from, *to;
  const char *where, *what, *hint;
};

const WrongStudy wrong[] = {
    {"unknown_key", "refined =", "refind =", "J.toml:8: vary.0.refind", "unknown key", "'refined'"},
    {"empty_axis", "[4, 8]", "[]", "vary.2.values", "no choice", "one at least"},
    {"no_axis_choice", "key = \"fracture.contour\"\nvalues = [4, 8]\n", "", "vary.2", "either a key", "choice"},
    {"equal_choices", "[4, 8]", "[4, 4]", "vary.2.values", "two choices are called '4'", "of its own"},
    {"equal_axes", "name = \"contour\"", "name = \"transfer\"", "vary", "two of them are called 'transfer'",
     "of its own"},
    {"two_refined", "values = [4, 8]", "values = [4, 8]\nrefined = true", "vary", "several axes", "one"},
    {"no_size", "\"0.5 mm\"]", "\"fine\"]", "vary.0.values", "no size", "size"},
    {"no_reference", "reference = \"13.4 kJ/m^2\"\n", "", "result.0", "no reference", "extrapolated"},
    {"no_result", "[[result]]", "[[leave_out]]", "leave_out", "unknown key", ""},
    {"both_references", "reference =", "curve = \"a.csv\"\nreference =", "result.0.curve", "either", "one"},
    {"empty_window", "from = \"0.2 ms\"", "from = \"0.2 ms\"\nto = \"0.1 ms\"", "result.0.to", "ends before", "after"},
    {"unknown_take", "\"mean\"", "\"meen\"", "result.0.take", "unknown name", "'mean'"},
    {"nothing_to_extrapolate", "\"13.4 kJ/m^2\"", "\"extrapolated\"\n# ", "", "", ""},
};

class BadStudy : public testing::TestWithParam<WrongStudy> {};

TEST_P(BadStudy, SaysWhereAndWhatIsAllowed) {
  const WrongStudy& w = GetParam();
  if (std::string(w.name) == "nothing_to_extrapolate") {
    EXPECT_NO_THROW(parse_study(changed(w.from, w.to), "J.toml"));  // three cells are enough
    std::string two = changed(w.from, w.to);
    two.replace(two.find(", \"0.5 mm\""), 10, "");
    EXPECT_THROW(parse_study(two, "J.toml"), Error);
    return;
  }
  try {
    parse_study(changed(w.from, w.to), "J.toml");
    FAIL() << "read without an error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Exit::bad_input);
    EXPECT_NE(e.trouble().where.find(w.where), std::string::npos) << e.what();
    EXPECT_NE(e.trouble().what.find(w.what), std::string::npos) << e.what();
    EXPECT_NE((e.trouble().limit + e.trouble().suggestion).find(w.hint), std::string::npos) << e.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Study, BadStudy, testing::ValuesIn(wrong),
                         [](const auto& param) { return std::string(param.param.name); });

/// Members that differ in the contour alone share a run that reads both.
TEST(StudyMembers, ShareRunsThatOnlyReadOtherwise) {
  const Study s = parse_study(good, "J.toml");
  const Members m = expand(s, sent);
  ASSERT_EQ(m.members.size(), 3u * 2 * 2 + 2);
  EXPECT_EQ(m.runs.size(), 3u * 2 + 2);
  EXPECT_EQ(m.members[0].run, m.members[1].run);
  EXPECT_EQ(column_of(m.members[1], "H last J"), "H last reading 2 J");
  EXPECT_EQ(column_of(m.members[1], "kinetic"), "kinetic");
  EXPECT_EQ(column_of(m.members.back(), "H last J"), "H last J");
  EXPECT_EQ(m.runs[0].set.back(),
            "fracture.reading=[{ contour = 4, name = \"reading 1\" }, "
            "{ contour = 8, name = \"reading 2\" }]");
  EXPECT_NEAR(m.runs[2].work / m.runs[0].work, 8, 1e-9);  // half of the cell takes eight times the work
  for (size_t a = 0; a < m.runs.size(); ++a)
    for (size_t b = 0; b < a; ++b)
      EXPECT_NE(m.runs[a].hash, m.runs[b].hash);
}

/// Settings are TOML or text, as for --set.
TEST(StudyMembers, ReadByRulesThatAreTexts) {
  const Study s =
      parse_study(changed("key = \"fracture.contour\"\nvalues = [4, 8]",
                          "choice = [{ label = \"a\", set = [\"fracture.method=pijc\"] }, { label = \"b\", set = "
                          "[\"fracture.method=\\\"fijc\\\"\", \"fracture.area_integral=always\"] }]"),
                  "J.toml");
  const Members m = expand(s, sent);
  EXPECT_EQ(m.runs.size(), 3u * 2 + 2);
  EXPECT_TRUE(m.runs[0].refused.empty()) << m.runs[0].refused;
}

/// Settings that say what the scene does, and the same in other words, are the same run.
TEST(StudyMembers, ShareRunsOfTheSameScene) {
  const Study s = parse_study(changed("key = \"fracture.contour\"\nvalues = [4, 8]",
                                      "choice = [{ label = \"a\", set = [\"solver.cfl=0.4\"] }, { label = \"b\", set "
                                      "= [\"solver.cfl=0.40\"] }, { label = \"c\", set = [\"solver.cfl=0.3\"] }]"),
                              "J.toml");
  const Members m = expand(s, sent);
  EXPECT_EQ(m.members[0].run, m.members[1].run);
  EXPECT_NE(m.members[0].run, m.members[2].run);
  for (size_t a = 0; a < m.runs.size(); ++a)
    for (size_t b = 0; b < a; ++b)
      EXPECT_NE(m.runs[a].hash, m.runs[b].hash);
}

/// The same settings mean the same run, others another one.
TEST(StudyMembers, AreKnownByWhatTheyRun) {
  const auto hash = [](const std::string& text) { return expand(parse_study(text, "J.toml"), sent).runs[0].hash; };
  EXPECT_EQ(hash(good), hash(changed("repeats = 5", "repeats = 2")));
  EXPECT_NE(hash(good), hash(changed("output.frames=0", "output.frames=1")));
  EXPECT_NE(hash(good), hash(changed("values = [4, 8]", "values = [4, 6]")));
}

TEST(StudyMembers, SettingsThatCanNeverBeRightAreAMistake) {
  try {
    expand(parse_study(changed("\"fracture.contour\"", "\"fracture.contuor\""), "J.toml"), sent);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Exit::bad_input);
    EXPECT_NE(std::string(e.what()).find("'contour'"), std::string::npos) << e.what();
  }
  // an odd contour is wrong with every cell; a cell that does not fit the grid, with every transfer
  EXPECT_THROW(expand(parse_study(changed("[4, 8]", "[4, 7]"), "J.toml"), sent), Error);
  EXPECT_THROW(expand(parse_study(changed("\"1 mm\", \"0.5 mm\"", "\"1 mm\", \"0.7 mm\""), "J.toml"), sent), Error);
}

NumericTable history() {
  return {
      {"time", "H last J", "K"}, {"s", "J/m^2", "Pa m^0.5"}, {{0, 1, 2, 4}, {10, 20, 40, 40}, {1, 2, 3, 4}}, "h.csv"};
}

/// A result with one target, as it is taken from that history.
struct Wanted {
  Result result;
  Target target;

  Wanted(Take take, double from, double to)
      : target{from, to, {Reference::Kind::value, "0.03 kJ/m^2", ""}, "", "J.toml:9: result.0"} {
    result.take = take;
  }
  Taken taken(const std::string& column = "H last J") const { return take_result(result, target, column, history()); }
};

TEST(StudyResults, AreTakenFromAWindow) {
  const double all = 1e9;
  EXPECT_EQ(Wanted(Take::end, 0, all).taken().value, 40);
  EXPECT_EQ(Wanted(Take::end, 0, 1).taken().value, 20);
  EXPECT_EQ(Wanted(Take::largest, 0, 1).taken().value, 20);
  EXPECT_EQ(Wanted(Take::smallest, 1, all).taken().value, 20);
  EXPECT_DOUBLE_EQ(Wanted(Take::rms, 1, all).taken().value, std::sqrt((1000 + 2 * 1600) / 3.));
  EXPECT_EQ(Wanted(Take::mean, 1, all).taken().value, (30 + 2 * 40) / 3.);
  const Taken t = Wanted(Take::mean, 0, 1).taken();
  EXPECT_EQ(t.value, 15);
  EXPECT_DOUBLE_EQ(t.error, 0.5);
  EXPECT_THROW(Wanted(Take::end, 5, all).taken(), Error);
  EXPECT_THROW(Wanted(Take::end, 0, all).taken("H last I"), Error);
  Wanted other(Take::end, 0, all);
  other.target.reference.value = "3 MPa";
  EXPECT_THROW(other.taken(), Error);
  other.target.reference.value = "2 Pa m^0.5";
  EXPECT_DOUBLE_EQ(other.taken("K").error, 1);
  other.target.reference.value = "0";
  EXPECT_THROW(other.taken("K"), Error);
  other.target.reference.value = "2 Pa m^0.5";
  other.target.scale = "8 Pa m^0.5";
  EXPECT_DOUBLE_EQ(other.taken("K").error, 0.25);
  for (const char* scale : {"-8 Pa m^0.5", "0 Pa m^0.5"}) {
    other.target.scale = scale;
    EXPECT_THROW(other.taken("K"), Error) << scale;
  }
  other.target.scale = "";
  other.target.reference.value = "inf";
  EXPECT_THROW(other.taken("K"), Error);
}

TEST(StudyResults, AreHeldAgainstCurvesInTheirUnits) {
  const std::string file = testing::TempDir() + "/riven_curve.csv";
  std::ofstream(file) << "# of the closed form\n\"t, of the load [ms]\",J (kJ/m^2)\n500,0.015\n3000,0.050\n9000,1\n";
  Wanted curve(Take::curve, 0, 8);
  curve.target.reference = {Reference::Kind::curve, "", file};
  const Taken t = curve.taken();  // 15 and 40 beside 15 and 50
  EXPECT_NEAR(t.value, 10 / std::sqrt(2.), 1e-12);
  EXPECT_NEAR(t.error, t.value / 50, 1e-14);
  curve.target.from = 3.5;
  EXPECT_THROW(curve.taken(), Error);  // it has no point there
  curve.target.from = 0;
  curve.target.to = 10;
  EXPECT_THROW(curve.taken(), Error);  // it goes on to 9 s, the run to 4
  std::ofstream(file) << "t [ms],J [kJ/m^2]\n500,0.015\n4000.0000000000005,0.050\n";
  EXPECT_NEAR(curve.taken().value, 10 / std::sqrt(2.), 1e-9) << "a rounding later than the run ends";
  curve.target.reference.file += ".none";
  EXPECT_THROW(curve.taken(), Error);
}

TEST(StudySettings, StandInASceneAsToml) {
  EXPECT_EQ(settings_as_toml({"grid.cell=1 mm", "solver.order=2", "solver.transfer=fmpm", "grip.top.name=a"}),
            "\n[grid]\ncell = \"1 mm\"\n\n[solver]\norder = 2\ntransfer = \"fmpm\"\n# grip.top.name=a\n");
  EXPECT_EQ(as_command("sent", {"grid.lower=[\"it's\"]"}), "riven run sent --set 'grid.lower=[\"it'\\''s\"]'");
}

}  // namespace
}  // namespace riven::study
