// The program in its folder of results: one run at a time, and runs that are asked to stop.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "io/atomic_file.hpp"
#include "io/folder_lock.hpp"
#include "io/frames.hpp"
#include "io/hdf_file.hpp"
#include "io/stop_request.hpp"
#include "io/vtkhdf.hpp"
#include "tests/io/faults.hpp"
#include "tests/io/results_sample.hpp"
#include "tests/io/small_run.hpp"
#include "tests/program.hpp"

namespace riven {
namespace {

/// riven with these arguments, what it prints in a file.
class Program {
 public:
  Program(std::vector<std::string> arguments, const std::filesystem::path& printed) {
    arguments.insert(arguments.begin(), RIVEN_PROGRAM);
    std::vector<char*> list;
    list.reserve(arguments.size() + 1);
    for (std::string& a : arguments)
      list.push_back(a.data());
    list.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      std::signal(SIGINT, SIG_DFL);
      const int out = ::open(printed.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      dup2(out, 1);
      dup2(out, 2);
      execv(list[0], list.data());
      _exit(127);
    }
  }
  void signal(int number) const { kill(pid_, number); }
  pid_t pid() const { return pid_; }
  /// Exit code, or less the signal that ended it.
  int end() const {
    int status = 0;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t pid_;
};

/// The small scene in files, run for so long that only a signal ends it.
struct LongRun {
  LongRun() {
    write_file(folder / "small.toml", test::small_scene);
    write_file(folder / "cracks.csv", test::small_cracks);
  }
  std::vector<std::string> arguments(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> list{"run", (folder / "small.toml").string(), "-o", results().string(), "--quiet",
                                  // a rigid body in a grid that it leaves after seconds of computing
                                  "--set", "solver.time=1 ms", "--set", "body.0.velocity=[\"0 m/s\", \"0 m/s\"]",
                                  "--set", "solver.dt_max=1 ns"};
    list.insert(list.end(), more.begin(), more.end());
    return list;
  }
  void wait_until_it_runs() const {
    const auto runs = [&] { return std::filesystem::exists(results() / "frames/particles_000000.vtkhdf"); };
    for (int tries = 0; !runs() && tries < 10000; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    ASSERT_TRUE(runs()) << sample::text_of(printed());
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  std::filesystem::path results() const { return folder / "results"; }
  std::filesystem::path printed() const { return folder / "printed"; }
  nlohmann::json summary() const { return nlohmann::json::parse(sample::text_of(results() / "summary.json")); }
  /// An exit code and what must be in the message.
  void expect(int code, int wanted, const std::vector<std::string>& parts) const {
    const std::string text = sample::text_of(printed());
    EXPECT_EQ(code, wanted) << text;
    for (const std::string& part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }

  const sample::Folder folder;
};

TEST(RunInFolder, SignalsInterruptItWithACheckpoint) {
  for (const auto& [number, name] : {std::pair{SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}, {SIGUSR1, "SIGUSR1"}}) {
    const LongRun run;
    const Program program(run.arguments(), run.printed());
    run.wait_until_it_runs();
    program.signal(number);
    run.expect(program.end(), 5, {name, "riven run --restart " + run.results().string()});
    EXPECT_EQ(run.summary()["status"], "interrupted");
    const long steps = run.summary()["steps"];
    EXPECT_GT(steps, 0);
    EXPECT_TRUE(std::filesystem::exists(run.results() / "checkpoint.h5"));
    EXPECT_TRUE(std::filesystem::exists(run.results() / "particles.vtkhdf"));
    EXPECT_EQ(sample::leftovers(run.results()), 0);

    const Program again({"run", "--restart", run.results().string(), "--wall-limit", "100 ms", "--quiet"},
                        run.printed());
    run.expect(again.end(), 5, {"the wall limit"});
    EXPECT_GT(run.summary()["steps"], steps);
  }
}

/// One that follows at once is taken for the first, sent to the program and to its group.
TEST(RunInFolder, ASecondSignalEndsItHalfASecondLater) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU}) {
    const pid_t child = fork();
    if (child == 0) {
      std::signal(number, SIG_DFL);
      const StopRequest stop(1e9);
      if (stop.asked())
        _exit(1);
      raise(number);
      if (!stop.asked())
        _exit(2);
      raise(number);
      if (stop.by() != (std::string("SIG") + sigabbrev_np(number)))
        _exit(3);
      std::this_thread::sleep_for(std::chrono::milliseconds(600));
      raise(number);
      _exit(4);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == number) << WEXITSTATUS(status);
  }
}

TEST(RunInFolder, ASecondRunIsRefusedAndNamesTheFirst) {
  const LongRun run;
  const Program first(run.arguments(), run.folder / "first");
  run.wait_until_it_runs();
  const Program second(run.arguments(), run.printed());
  run.expect(second.end(), 4, {run.results().string(), "process " + std::to_string(first.pid()), "one run at a time"});
  first.signal(SIGKILL);
  EXPECT_EQ(first.end(), -SIGKILL);
  EXPECT_TRUE(std::filesystem::exists(run.results() / ".lock"));
  const Program third(run.arguments({"--wall-limit", "50 ms"}), run.printed());
  run.expect(third.end(), 5, {"the wall limit"});
  EXPECT_EQ(sample::leftovers(run.results()), 0);
}

TEST(RunInFolder, ARunWhoseFolderIsMovedLeavesTheOneThatIsThereNowAlone) {
  const LongRun run;
  const Program first(run.arguments(), run.folder / "first");
  run.wait_until_it_runs();
  const std::filesystem::path moved = run.folder / "moved";
  std::filesystem::rename(run.results(), moved);
  const Program second(run.arguments(), run.printed());
  run.wait_until_it_runs();
  first.signal(SIGTERM);
  EXPECT_EQ(first.end(), 4);
  const std::string said = sample::text_of(run.folder / "first");
  EXPECT_NE(said.find("moved or removed while the run wrote into it"), std::string::npos) << said;
  EXPECT_FALSE(std::filesystem::exists(run.results() / "summary.json"));
  EXPECT_FALSE(std::filesystem::exists(moved / "summary.json"));
  second.signal(SIGTERM);
  run.expect(second.end(), 5, {"SIGTERM"});
  EXPECT_EQ(run.summary()["status"], "interrupted");
}

TEST(RunInFolder, ARestartThatIsKilledLeavesNoEndOfTheRunBefore) {
  const LongRun run;
  const Program first(run.arguments({"--wall-limit", "50 ms"}), run.printed());
  run.expect(first.end(), 5, {});
  EXPECT_TRUE(std::filesystem::exists(run.results() / "summary.json"));
  const Program again({"run", "--restart", run.results().string(), "--quiet"}, run.printed());
  for (int tries = 0; std::filesystem::exists(run.results() / "summary.json") && tries < 10000; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  again.signal(SIGKILL);
  EXPECT_EQ(again.end(), -SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(run.results() / "summary.json"));
  EXPECT_FALSE(std::filesystem::exists(run.results() / "crack_paths.csv"));
}

TEST(RunInFolder, AFrameThatCannotBeReadIsLeftOut) {
  const LongRun run;
  const std::vector<std::string> more{"--set", "output.frames=1000", "--set", "solver.time=20 ns"};
  const Program first(run.arguments(more), run.printed());
  run.expect(first.end(), 0, {});
  const std::filesystem::path frames = run.results() / "frames";
  const std::size_t all = list_frames(frames, "particles").size();
  ASSERT_GT(all, 3u);
  std::filesystem::resize_file(frames / "particles_000001.vtkhdf", 1000);
  std::filesystem::remove(frames / "particles_000002.vtkhdf");
  EXPECT_EQ(assemble_frames(run.results()), static_cast<int>(all) - 2);
  EXPECT_NO_THROW(HdfFile::open(run.results() / "particles.vtkhdf"));
}

TEST(RunInFolder, AnInterruptedRunIsNotBegunAnewUnlessToldTo) {
  const LongRun run;
  const Program first(run.arguments({"--wall-limit", "300 ms"}), run.printed());
  run.expect(first.end(), 5, {});
  const std::string history = sample::text_of(run.results() / "history.csv");
  const long steps = run.summary()["steps"];
  const Program second(run.arguments({"--wall-limit", "50 ms"}), run.printed());
  run.expect(second.end(), 4, {"--restart " + run.results().string(), "--overwrite"});
  EXPECT_EQ(sample::text_of(run.results() / "history.csv"), history);
  const Program third(run.arguments({"--wall-limit", "50 ms", "--overwrite"}), run.printed());
  run.expect(third.end(), 5, {"the wall limit"});
  EXPECT_LT(run.summary()["steps"], steps);
}

TEST(RunInFolder, ResultsOfAnotherSceneAreNotRemovedUnlessToldTo) {
  const LongRun run;
  const std::string there = R"({"scene": "strip", "status": "done"})";
  std::filesystem::create_directories(run.results());
  write_file(run.results() / "summary.json", there);
  const Program refused(run.arguments({"--wall-limit", "50 ms"}), run.printed());
  run.expect(refused.end(), 4, {run.results().string(), "strip", "results of small", "--overwrite"});
  EXPECT_EQ(sample::text_of(run.results() / "summary.json"), there);
  const Program told(run.arguments({"--wall-limit", "50 ms", "--overwrite"}), run.printed());
  run.expect(told.end(), 5, {"the wall limit"});
  EXPECT_EQ(run.summary()["scene"], "small");
}

TEST(RunInFolder, ATableThatIsNoneOfRivensIsNotRemovedUnlessToldTo) {
  const LongRun run;
  const std::string there = "year,event\n1215,charter\n";
  std::filesystem::create_directories(run.results());
  for (const char* name : {"history.csv", "events.csv", "crack_paths.csv"}) {
    const std::filesystem::path table = run.results() / name;
    write_file(table, there);
    const Program refused(run.arguments({"--wall-limit", "50 ms"}), run.printed());
    run.expect(refused.end(), 4, {table.string(), "no run has written", "--overwrite"});
    EXPECT_EQ(sample::text_of(table), there);
    std::filesystem::remove(table);
  }
  write_file(run.results() / "history.csv", there);
  const Program told(run.arguments({"--wall-limit", "50 ms", "--overwrite"}), run.printed());
  run.expect(told.end(), 5, {"the wall limit"});
}

TEST(RunInFolder, TwoColumnsOfOneNameAreRefusedBeforeAnythingIsWritten) {
  const LongRun run;
  const std::string there = R"({"scene": "small", "status": "done"})";
  std::filesystem::create_directories(run.results());
  write_file(run.results() / "summary.json", there);
  write_file(run.folder / "small.toml", std::string(test::small_scene) +
                                            "[[probe]]\nname = \"kinetic\"\nkind = \"crack_opening\"\n"
                                            "target = \"crack_1\"\n");
  const Program refused(run.arguments(), run.printed());
  run.expect(refused.end(), 2, {"small.toml:25", "probe", "kinetic", "kinetic_1"});
  EXPECT_EQ(sample::text_of(run.results() / "summary.json"), there);
}

TEST(RunInFolder, ARestartIntoAnotherFolderTakesAlongWhatThereIs) {
  const LongRun run;
  const Program first(run.arguments({"--wall-limit", "300 ms", "--set", "output.frames=1000000"}), run.printed());
  run.expect(first.end(), 5, {});
  const auto frames = [](const std::filesystem::path& folder) { return list_frames(folder / "frames", "particles"); };
  const std::vector<std::filesystem::path> before = frames(run.results());
  ASSERT_GT(before.size(), 3u);
  const auto other = run.folder / "other";
  std::filesystem::create_directories(other / "frames");
  write_file(other / "frames/particles_000001.vtkhdf", "of a run that was here before");
  const std::string history = sample::text_of(run.results() / "history.csv");
  const Program second({"run", "--restart", run.results().string(), "-o", other.string(), "--quiet", "--wall-limit",
                        "50 ms", "--set", "solver.time=2 ms"},
                       run.printed());
  run.expect(second.end(), 5, {"of 2.00 ms", "riven run --restart " + other.string()});
  EXPECT_EQ(frames(run.results()), before) << "nothing happens to the folder that it came from";
  EXPECT_TRUE(sample::text_of(other / "history.csv").starts_with(history));
  EXPECT_EQ(sample::text_of(other / "frames/particles_000001.vtkhdf"), sample::text_of(before[1]));
  EXPECT_GE(frames(other).size(), before.size());
}

TEST(RunInFolder, AChangedSceneIsRefused) {
  const LongRun run;
  const Program first(run.arguments({"--wall-limit", "50 ms"}), run.printed());
  run.expect(first.end(), 5, {});
  const std::string before = sample::text_of(run.results() / "history.csv");
  const Program other(run.arguments({"--restart", run.results().string(), "--set", "material.0.nu=0.2"}),
                      run.printed());
  run.expect(other.end(), 2, {"material.0.nu"});
  write_file(run.folder / "cracks.csv", "x0_mm,y0_mm,x1_mm,y1_mm\n1.3,4.2,6.1,4.7\n");
  const Program moved(run.arguments({"--restart", run.results().string()}), run.printed());
  run.expect(moved.end(), 2, {"cracks.csv"});
  EXPECT_EQ(sample::text_of(run.results() / "history.csv"), before);
}

TEST(RunInFolder, AFullDiskAtARestartHarmsNothing) {
  const LongRun run;
  const Program first(run.arguments({"--wall-limit", "50 ms"}), run.printed());
  run.expect(first.end(), 5, {});
  const auto text = [&](const char* name) { return sample::text_of(run.results() / name); };
  const std::string history = text("history.csv"), checkpoint = text("checkpoint.h5");
  const std::string go_on = "run --restart " + run.results().string() + " --wall-limit '50 ms' --quiet";
  for (const char* room : {"1", "16", "64"}) {  // blocks
    const Outcome full = riven(go_on, run.folder, std::string("ulimit -f ") + room + ";");
    EXPECT_EQ(full.code, 4) << room;
    EXPECT_EQ(text("history.csv").substr(0, history.size()), history) << room;
    EXPECT_EQ(text("checkpoint.h5"), checkpoint) << room;
  }
  EXPECT_EQ(riven(go_on, run.folder).code, 5);
}

TEST(RunInFolder, AFolderThatCannotBeWrittenToIsNamed) {
  const sample::Folder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0555));
  const pid_t child = fork();
  if (child == 0) {
    if (geteuid() == 0 && setuid(65534) != 0)  // permissions do not stop root
      _exit(2);
    const std::string message = file_error([&] { const FolderLock lock(folder.path()); });
    const bool good = message.find(folder.path().string()) != std::string::npos &&
                      message.find("Permission denied") != std::string::npos;
    if (!good)
      std::fprintf(stderr, "%s\n", message.c_str());
    _exit(good ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST(RunInFolder, ALockIsHeldUntilItsHolderDies) {
  const sample::Folder folder;
  {
    const FolderLock held(folder.path());
    const std::string message = file_error([&] { const FolderLock second(folder.path()); });
    EXPECT_NE(message.find("process " + std::to_string(getpid())), std::string::npos) << message;
  }
  EXPECT_EQ(sample::leftovers(folder.path()), 0);
  write_file(folder / ".lock", "12345\n");
  const FolderLock stale_is_no_obstacle(folder.path());
}

}  // namespace
}  // namespace riven
