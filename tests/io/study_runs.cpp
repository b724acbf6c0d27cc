// Studies from the first run to the tables: what fails stays a point, what is done is not done again, whatever happens.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "io/child.hpp"
#include "io/folder_lock.hpp"
#include "tests/program.hpp"

namespace riven {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A bar that is pulled at both ends; with CFL numbers of which the last is beyond what is stable.
class StudyRuns : public testing::Test {
 protected:
  StudyRuns() : out_((folder_ / "out").string()) {
    std::ofstream((folder_ / "bar.toml").string()) << R"toml(title = "bar"
[solver]
time = "0.2 ms"
stress_update = "usl"
transfer = "fmpm"
order = 1
[grid]
cell = "2 mm"
lower = ["-8 mm", "-8 mm"]
upper = ["48 mm", "16 mm"]
[[material]]
name = "soft"
E = "100 MPa"
nu = 0.3
density = "1 g/cm^3"
[[body]]
name = "bar"
material = "soft"
rectangle = { lower = ["0 mm", "0 mm"], upper = ["40 mm", "8 mm"] }
[[load]]
name = "right"
kind = "traction"
rectangle = { lower = ["0 mm", "0 mm"], upper = ["40 mm", "8 mm"] }
edge = "right"
traction_x = { value = "0.1 MPa", shape = "sin(pi*t/tr)", tr = "0.2 ms" }
[damping]
grid = "1000 1/s"
[output]
frames = 0
)toml";
  }

  std::string write(const std::string& more = "", const std::string& cells = R"("4 mm", "2 mm", "1 mm")") const {
    std::string path = (folder_ / "cells.toml").string();
    std::ofstream(path) << "title = \"cells\"\nscene = \"bar.toml\"\n" + more + R"toml(
[timing]
repeats = 2
threads = 1
[[vary]]
name = "cell"
key = "grid.cell"
refined = true
values = [)toml" << cells
                        << R"toml(]
[[vary]]
name = "cfl"
key = "solver.cfl"
values = [0.4, 1.9]
[[result]]
name = "work"
column = "external_work"
take = "largest"
reference = "extrapolated"
[[leave_out]]
name = "damping"
set = ["damping.grid=0 1/s"]
)toml";
    return path;
  }

  Json study() const {
    std::ifstream in(out_ + "/study.json");
    return Json::parse(in);
  }

  /// When each record was written last.
  std::map<std::string, fs::file_time_type> records() const {
    std::map<std::string, fs::file_time_type> times;
    if (fs::is_directory(out_ + "/runs"))
      for (const auto& run : fs::directory_iterator(out_ + "/runs"))
        if (fs::exists(run.path() / "record.json"))
          times[run.path().filename().string()] = fs::last_write_time(run.path() / "record.json");
    return times;
  }

  /// Programs that write to the study's folder.
  int writing() const {
    int count = 0;
    for (const auto& process : fs::directory_iterator("/proc")) {
      std::ifstream in(process.path() / "cmdline");
      const std::string words{std::istreambuf_iterator<char>(in), {}};
      count += words.find(out_) != std::string::npos ? 1 : 0;
    }
    return count;
  }

  std::string call(const std::string& more = "") const {
    return "study '" + (folder_ / "cells.toml").string() + "' --quiet -o '" + out_ + "' " + more;
  }

  const sample::Folder folder_;
  const std::string out_;
};

TEST_F(StudyRuns, ShowWhatFailsAndDoNothingTwice) {
  write();
  const Outcome first = riven(call(), folder_);
  ASSERT_EQ(first.code, 0) << first.errors;
  const Json s = study();
  ASSERT_EQ(s["members"].size(), 8u);
  for (const Json& m : s["members"]) {
    const bool stable = m["label"].get<std::string>().find("1.9") == std::string::npos;
    EXPECT_EQ(m["status"], stable ? "done" : "unstable") << m;
    EXPECT_EQ(m["wall_seconds"].size(), stable ? 2u : 1u) << "what fails is not repeated";
    EXPECT_EQ(m["results"]["work"]["value"].is_number(), stable);
    EXPECT_EQ(m["message"].get<std::string>().empty(), stable);
  }
  const Json& result = s["results"][0];
  EXPECT_GT(result["limits"][0]["value"].get<double>(), 0);
  for (const Json& c : result["cheapest"])
    if (!c["setting"].is_null()) {
      const Json& of = s["settings"][c["setting"].get<size_t>()]["members"];
      ASSERT_EQ(of.size(), 1u);
      EXPECT_EQ(s["members"][of[0].get<size_t>()]["status"], "done");
    }
  EXPECT_GT(s["left_out"][0]["changes"]["work"].get<double>(), 0.01) << "the bar moves further without damping";
  EXPECT_TRUE(fs::exists(out_ + "/study.csv"));
  EXPECT_TRUE(fs::exists(out_ + "/work.png"));

  const auto before = records();
  EXPECT_EQ(riven(call(), folder_).code, 0);
  EXPECT_EQ(records(), before);
  EXPECT_EQ(study(), s);

  write("", R"("4 mm", "2 mm", "1 mm", "0.8 mm")");
  EXPECT_EQ(riven(call(), folder_).code, 0);
  auto after = records();
  EXPECT_EQ(after.size(), before.size() + 2);
  for (const auto& [run, time] : before)
    EXPECT_EQ(after[run], time) << run;
}

/// The setting that is said to come within a tolerance does so when it is run.
TEST_F(StudyRuns, WhatIsSaidToBeWithinAToleranceIs) {
  write();
  const Outcome o = riven(call("--no-timing --within 20%"), folder_);
  ASSERT_EQ(o.code, 0) << o.errors;
  const size_t command = o.output.find("riven run bar.toml ");
  ASSERT_NE(command, std::string::npos) << o.output;
  const size_t begin = command + std::string("riven run bar.toml ").size();
  const std::string settings = o.output.substr(begin, o.output.find('\n', begin) - begin);
  const std::string again = (folder_ / "again").string();
  ASSERT_EQ(riven("run '" + (folder_ / "bar.toml").string() + "' --quiet -o '" + again + "' " + settings, folder_).code,
            0);
  std::ifstream in(again + "/history.csv");
  std::string line;
  double work = 0;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream row(line);
    std::string cell;
    for (int k = 0; k <= 4; ++k)
      std::getline(row, cell, ',');
    work = std::max(work, std::stod(cell));
  }
  EXPECT_NEAR(work / study()["results"][0]["limits"][0]["value"].get<double>(), 1, 0.2);
  const Outcome none = riven(call("--no-timing --within 1e-9"), folder_);
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.errors.find("no setting"), std::string::npos) << none.errors;
}

/// A larger damping is another problem here, with a result of its own: what is drawn and said is of both.
TEST_F(StudyRuns, ShowEachProblemAndHowGoodASettingIsInAll) {
  std::ofstream((folder_ / "cells.toml").string()) << R"toml(scene = "bar.toml"
[timing]
repeats = 1
threads = 1
[[vary]]
name = "damping"
key = "damping.grid"
values = ["1000 1/s", "20000 1/s"]
problem = true
[[vary]]
name = "cell"
key = "grid.cell"
refined = true
values = ["4 mm", "2 mm", "1 mm"]
[[result]]
name = "work"
column = "external_work"
take = "largest"
reference = "extrapolated"
)toml";
  ASSERT_EQ(riven(call(), folder_).code, 0);
  const Json s = study();
  ASSERT_EQ(s["settings"].size(), 3u);
  const Json& result = s["results"][0];
  ASSERT_EQ(result["limits"].size(), 2u);
  EXPECT_GT(result["limits"][0]["value"].get<double>(), 1.1 * result["limits"][1]["value"].get<double>());
  for (size_t k = 0; k < 3; ++k) {
    double largest = 0, seconds = 0;
    for (const Json& number : s["settings"][k]["members"]) {
      const Json& m = s["members"][number.get<size_t>()];
      largest = std::max(largest, m["results"]["work"]["error"].get<double>());
      seconds += m["wall_seconds"][0].get<double>();
    }
    EXPECT_GT(largest, 0);
    EXPECT_EQ(result["settings"][k]["error"].get<double>(), largest);
    EXPECT_NEAR(result["settings"][k]["cost"].get<double>(), seconds, 1e-9);
  }
  EXPECT_TRUE(fs::exists(out_ + "/work.png"));
  EXPECT_TRUE(fs::exists(out_ + "/work_problems.png"));
  const Outcome setting = riven(call("--within 50%"), folder_);
  EXPECT_EQ(setting.code, 0) << setting.errors;
  EXPECT_EQ(setting.output.find("damping"), std::string::npos) << setting.output;
  EXPECT_NE(setting.output.find("cell = "), std::string::npos) << setting.output;
}

/// Killed while it runs, a study goes on where it was, and no run of it is left behind.
TEST_F(StudyRuns, GoOnWhereTheyWereKilled) {
  write();
  for (const size_t killed_at : {1u, 3u, 6u}) {
    Children children;
    const pid_t study =
        children.start({RIVEN_PROGRAM, "study", (folder_ / "cells.toml").string(), "-o", out_}, folder_ / "log.txt");
    while (records().size() < killed_at || writing() < 2)  // the study, and a run of it
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(study, SIGKILL);
    EXPECT_EQ(children.wait().signal, SIGKILL);
    const auto kept = records();
    for (int n = 0; n < 10 && writing() > 0; ++n)  // a run by itself would take longer
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(writing(), 0);
    EXPECT_EQ(records(), kept);
  }
  const auto before = records();
  ASSERT_EQ(riven(call("--no-timing"), folder_).code, 0);
  auto after = records();
  EXPECT_EQ(after.size(), 8u);
  for (const auto& [run, time] : before)
    EXPECT_EQ(after[run], time);
  EXPECT_EQ(study()["members"].size(), 8u);
}

/// Asked to stop, a study asks its runs to, says what is done, and goes on from there the next time.
TEST_F(StudyRuns, StopWhenAskedTo) {
  write();
  Children children;
  const pid_t study =
      children.start({RIVEN_PROGRAM, "study", (folder_ / "cells.toml").string(), "-o", out_}, folder_ / "log.txt");
  while (records().size() < 3 || writing() < 2)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(study, SIGTERM);
  EXPECT_EQ(children.wait().code, 5);
  EXPECT_EQ(writing(), 0);
  const std::string said = sample::text_of(folder_ / "log.txt");
  EXPECT_NE(said.find("interrupted by SIGTERM: "), std::string::npos) << said;
  EXPECT_NE(said.find(" of 8 runs are done, and kept"), std::string::npos) << said;
  const auto before = records();
  EXPECT_LT(before.size(), 8u);
  ASSERT_EQ(riven(call("--no-timing"), folder_).code, 0);
  const auto after = records();
  EXPECT_EQ(after.size(), 8u);
  long kept = 0;
  for (const auto& [run, time] : before)
    kept += after.at(run) == time;
  EXPECT_GE(kept, 3);
}

/// The run under way would go on for long: it ends at once, and says that it was interrupted, as it is told to.
TEST_F(StudyRuns, HandAStopToTheRunUnderWay) {
  write("set = [\"solver.time=5 s\"]\n");
  Children children;
  const pid_t study =
      children.start({RIVEN_PROGRAM, "study", (folder_ / "cells.toml").string(), "-o", out_}, folder_ / "log.txt");
  const auto under_way = [&] {
    if (fs::is_directory(out_ + "/runs"))
      for (const auto& run : fs::directory_iterator(out_ + "/runs"))
        if (fs::exists(run.path() / "history.csv") && !fs::exists(run.path() / "record.json"))
          return run.path();
    return fs::path();
  };
  fs::path run;
  while ((run = under_way()).empty() || records().empty())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(study, SIGTERM);  // the study alone
  EXPECT_EQ(children.wait().code, 5);
  EXPECT_EQ(writing(), 0);
  EXPECT_EQ(Json::parse(sample::text_of(run / "record.json"))["status"], "interrupted");
  EXPECT_EQ(Json::parse(sample::text_of(run / "summary.json"))["status"], "interrupted");
}

/// A run that takes longer than the study may: it goes on from where it was, and its time adds up.
TEST_F(StudyRuns, GoOnWithTheRunThatWasUnderWay) {
  write("set = [\"solver.time=5 s\"]\n");
  fs::path run;
  const auto computes = [&](const fs::path& folder) {
    return fs::exists(folder / ".lock") && fs::exists(folder / "history.csv") && !fs::exists(folder / "summary.json");
  };
  const auto under_way = [&] {
    if (fs::is_directory(out_ + "/runs"))
      for (const auto& of : fs::directory_iterator(out_ + "/runs"))
        if (computes(of.path()) && !records().empty())  // one that is unstable has ended
          run = of.path();
    return !run.empty();
  };
  long steps = 0;
  double seconds = 0;
  for (int slot = 0; slot < 3; ++slot) {
    Children children;
    const pid_t study =
        children.start({RIVEN_PROGRAM, "study", (folder_ / "cells.toml").string(), "-o", out_}, folder_ / "log.txt");
    while (slot == 0 ? !under_way() : !computes(run))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(slot == 0 ? 1000 : 20));
    kill(study, SIGTERM);
    EXPECT_EQ(children.wait().code, 5);
    const Json record = Json::parse(sample::text_of(run / "record.json"));
    EXPECT_EQ(record["status"], "interrupted") << sample::text_of(folder_ / "log.txt");
    EXPECT_GT(record["steps"].get<long>(), steps);
    EXPECT_GT(record["wall_seconds"].at(0).get<double>(), seconds);
    steps = record["steps"];
    seconds = record["wall_seconds"].at(0);
  }
}

/// What is asked for is listed, and neither done nor written.
TEST_F(StudyRuns, AreListedBeforeTheyAreDone) {
  write("set = [\"output.frames=1\"]\n");
  const Outcome o = riven(call("--dry-run"), folder_);
  ASSERT_EQ(o.code, 0) << o.errors;
  EXPECT_FALSE(fs::exists(out_));
  EXPECT_NE(o.output.find("cells: 8 runs of bar.toml\nall with output.frames=1\n"), std::string::npos) << o.output;
  EXPECT_EQ(o.output.find("output.frames"), o.output.rfind("output.frames"));
  std::map<std::string, std::string> rows;  // by what is set
  std::istringstream lines(o.output);
  for (std::string line; std::getline(lines, line);)
    if (const size_t at = line.find("grid.cell="); at != std::string::npos)
      rows[line.substr(at)] = line;
  ASSERT_EQ(rows.size(), 6u) << o.output;
  const std::string& fine = rows.at("grid.cell=\"1 mm\", solver.cfl=0.4");
  EXPECT_TRUE(fine.starts_with("cell 1 mm, cfl 0.4 ")) << fine;
  EXPECT_NE(fine.find(" 1280 "), std::string::npos) << fine << ": 40 x 8 cells of 4 particles";
  EXPECT_NE(o.output.find("without damping"), std::string::npos);
}

/// The results of one study stay when another is run into their folder, or the same one while it runs.
TEST_F(StudyRuns, LeaveTheResultsOfAnotherStudy) {
  const fs::path first = write(), other = folder_ / "other.toml";
  ASSERT_EQ(riven(call("--no-timing"), folder_).code, 0);
  const std::string found = sample::text_of(out_ + "/study.json");
  fs::copy_file(first, other);
  const std::string into = " --quiet --no-timing -o '" + out_ + "'";
  const Outcome refused = riven("study '" + other.string() + "'" + into, folder_);
  EXPECT_EQ(refused.code, 4);
  EXPECT_NE(refused.errors.find("the results of another study\n  value:   cells, of scene bar.toml"), std::string::npos)
      << refused.errors;
  fs::copy_file(folder_ / "bar.toml", folder_ / "rod.toml");
  std::string of_rod = sample::text_of(first);
  of_rod.replace(of_rod.find("bar.toml"), 8, "rod.toml");
  std::ofstream(first) << of_rod;
  EXPECT_EQ(riven(call("--no-timing"), folder_).code, 4);
  EXPECT_EQ(sample::text_of(out_ + "/study.json"), found);
  write("", R"("4 mm", "2 mm", "1 mm", "0.8 mm")");
  {
    const FolderLock held(out_);
    const Outcome waits = riven(call("--no-timing"), folder_);
    EXPECT_EQ(waits.code, 4);
    EXPECT_NE(waits.errors.find("another run writes into this folder"), std::string::npos) << waits.errors;
  }
  EXPECT_EQ(riven(call("--no-timing"), folder_).code, 0) << "the same one, extended";
}

/// A run that dies is a point that failed, and is tried again the next time.
TEST_F(StudyRuns, OutliveRunsThatCrash) {
  write("", R"("4 mm", "2 mm", "0.05 mm")");
  const Outcome o = riven(call("--no-timing"), folder_, "ulimit -v 100000;");
  ASSERT_EQ(o.code, 0) << o.errors;
  long crashed = 0;
  const Json s = study();
  for (const Json& m : s["members"])
    if (m["status"] == "crashed") {
      ++crashed;
      EXPECT_FALSE(m["message"].get<std::string>().empty());
      EXPECT_NE(m["label"].get<std::string>().find("0.05 mm"), std::string::npos);
    }
  EXPECT_EQ(crashed, 2);
}

/// Files may not grow beyond some blocks: the study stops, says where, and keeps what it has.
TEST_F(StudyRuns, StopWhereADiskIsFull) {
  write();
  ASSERT_EQ(riven(call("--no-timing"), folder_).code, 0);
  const auto before = records();
  write("", R"("4 mm", "2 mm", "1 mm", "0.5 mm")");
  const Outcome full = riven(call("--no-timing"), folder_, "trap '' XFSZ; ulimit -f 300;");
  EXPECT_EQ(full.code, 4) << full.errors;
  EXPECT_NE(full.errors.find("could not write its results"), std::string::npos) << full.errors;
  EXPECT_NE(full.errors.find("what is done is kept"), std::string::npos) << full.errors;
  auto after = records();
  for (const auto& [run, time] : before)
    EXPECT_EQ(after[run], time);
  EXPECT_EQ(riven(call("--no-timing"), folder_).code, 0);
}

TEST_F(StudyRuns, RefuseWhatIsWrong) {
  EXPECT_EQ(riven("study", folder_).code, 2);
  const Outcome near = riven("study sent_i", folder_);
  EXPECT_EQ(near.code, 2);
  EXPECT_NE(near.errors.find("sent_j"), std::string::npos) << near.errors;
  const std::string path = write("scen = 1\n");
  EXPECT_EQ(riven(call(), folder_).code, 2);
  write();
  EXPECT_EQ(riven(call("--within 0"), folder_).code, 2);
  EXPECT_EQ(riven(call("--result play --within 2%"), folder_).code, 2);
  EXPECT_FALSE(fs::exists(out_ + "/runs"));
  write("", R"("4 mm", "2 mm", "1 mm"]\nchoices = [)");
  EXPECT_EQ(riven(call(), folder_).code, 2);
  std::string typo = sample::text_of(write());
  typo.replace(typo.find("external_work"), 13, "extrenal_work");
  std::ofstream(folder_ / "cells.toml") << typo;
  const Outcome column = riven(call(), folder_);
  EXPECT_EQ(column.code, 2);
  EXPECT_NE(column.errors.find("'external_work'"), std::string::npos) << column.errors;
  EXPECT_LE(records().size(), 2u) << "said after the first run that is done";
  const fs::path taken = folder_ / "taken";
  std::ofstream(taken.string()) << "a file";
  EXPECT_EQ(riven("study '" + path + "' --quiet -o '" + taken.string() + "'", folder_).code, 4);
}

}  // namespace
}  // namespace riven
