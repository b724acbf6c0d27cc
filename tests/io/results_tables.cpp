// The history, the summary and the progress line.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/history.hpp"
#include "io/peak_memory.hpp"
#include "io/progress.hpp"
#include "io/summary.hpp"
#include "tests/io/results_sample.hpp"

namespace riven {
namespace {

const std::vector<HistoryColumn> columns = {{"time", "s"}, {"opening, left", "m"}, {"steps", ""}};

TEST(ResultsHistory, NumbersComeBackBitForBit) {
  const sample::Folder folder;
  const std::vector<double> row = {1.0 / 3, -2.2250738585072014e-308, 1e22};
  History(folder / "history.csv", columns).row(row);
  const std::string text = sample::text_of(folder / "history.csv");
  const std::size_t end = text.find('\n');
  EXPECT_EQ(text.substr(0, end), "time [s],\"opening, left [m]\",steps [1]");
  const char* at = text.c_str() + end + 1;
  for (const double value : row) {
    char* stop = nullptr;
    EXPECT_EQ(std::strtod(at, &stop), value);
    at = stop + 1;
  }
}

TEST(ResultsHistory, RowsAreInTheFileAsSoonAsTheyAreWritten) {
  const sample::Folder folder;
  History history(folder / "history.csv", columns);
  history.row(std::vector{0.0, 1.0, 2.0});
  EXPECT_TRUE(sample::text_of(folder / "history.csv").ends_with("\n0,1,2\n"));
  EXPECT_THROW(history.row(std::vector{1.0}), Error) << "a value per column";
}

TEST(ResultsHistory, AResumedRunGoesOnAtItsCheckpoint) {
  const sample::Folder folder;
  const auto path = folder / "history.csv";
  std::string rows;
  {
    History first(path, columns);
    for (int k = 0; k < 3; ++k)
      first.row(std::vector{0.25 * k, 1.0, 2.0});
    rows = first.rows();
    first.row(std::vector{0.75, 5.0, 6.0});
  }
  write_file(path, sample::text_of(path) + "1.25,1");  // a row cut short by a kill
  History resumed(path, columns, rows);
  resumed.row(std::vector{0.75, 7.0, 8.0});
  EXPECT_EQ(sample::text_of(path), "time [s],\"opening, left [m]\",steps [1]\n0,1,2\n0.25,1,2\n0.5,1,2\n0.75,7,8\n");
  EXPECT_EQ(resumed.rows(), "0,1,2\n0.25,1,2\n0.5,1,2\n0.75,7,8\n");
}

TEST(ResultsSummary, HasWhatProgramsReadFromIt) {
  const sample::Folder folder;
  Summary s;
  s.scene = "sample";
  s.status = "unstable";
  s.message = "particle 7 left the grid";
  s.steps = 1234567;
  s.time = 1e-3;
  s.peak_memory_bytes = 3'000'000'000;
  s.effects = {"cracks", "contact"};
  s.tasks = {{"particle to grid", "", 12, 0.5}};
  s.energy.kinetic = 2;
  s.energy.relative_error = std::nan("");
  s.momentum_error = 1e-15;
  s.angular_momentum_error = INFINITY;
  s.warnings = {{"both sides", 3, {0.5, 0.25}, "smaller cells"}, {"third crack", 0, {}, ""}};
  s.probes = {{"opening", 1e-5, "m"}};
  Tip grown;
  grown.crack = 1;
  grown.length = 3e-4;
  s.cracks = summarize_cracks(sample::cracks(1), {grown, grown});
  s.fragments = {{2, 30, {0.1, 0.2}}, {1, 15, {}}};
  s.reactions = {{"upper", {1, -2}}};
  write_summary(folder / "summary.json", s);
  const auto j = nlohmann::json::parse(sample::text_of(folder / "summary.json"));
  for (const char* key : {"status", "steps", "time", "wall_seconds", "particles", "particle_steps_per_second",
                          "peak_memory_bytes", "threads", "exec", "scatter", "precision", "effects", "tasks",
                          "between_steps", "energy", "momentum_error", "warnings", "tips", "probes"})
    EXPECT_TRUE(j.contains(key)) << key;
  for (const char* key :
       {"kinetic", "strain", "external_work", "damping", "contact", "fracture", "numerical", "transfer"})
    EXPECT_TRUE(j["energy"][key].is_number()) << key;
  EXPECT_EQ(j["steps"], 1234567);
  EXPECT_EQ(j["peak_memory_bytes"], 3'000'000'000) << "more than 32 bits";
  EXPECT_EQ(j["message"], "particle 7 left the grid");
  EXPECT_TRUE(j["energy"]["relative_error"].is_null()) << "not a number";
  EXPECT_TRUE(j["angular_momentum_error"].is_null()) << "infinite";
  EXPECT_EQ(j["momentum_error"], 1e-15);
  EXPECT_EQ(j["tasks"][0]["label"], "particle to grid");
  EXPECT_EQ(j["warnings"]["both sides"]["count"], 3);
  EXPECT_EQ(j["warnings"]["both sides"]["try"], "smaller cells");
  EXPECT_EQ(j["warnings"]["both sides"]["first_place"][1], 0.25);
  EXPECT_TRUE(j["warnings"]["third crack"]["first_place"].is_null());
  EXPECT_EQ(j["probes"]["opening"]["value"], 1e-5);
  EXPECT_EQ(j["cracks"][1]["name"], "slanted");
  EXPECT_NEAR(j["cracks"][1]["max_opening"].get<double>(), 2e-5, 1e-17);
  EXPECT_NEAR(j["cracks"][0]["length"].get<double>(), 4 * 0.8e-3, 1e-15);
  EXPECT_EQ(j["cracks"][0]["grown"], 0);
  EXPECT_NEAR(j["cracks"][1]["grown"].get<double>(), 6e-4, 1e-18) << "at both tips";
  ASSERT_EQ(j["fragments"].size(), 2u);
  EXPECT_EQ(j["fragments"][0]["mass"], 2);
  EXPECT_EQ(j["fragments"][0]["particles"], 30);
  EXPECT_EQ(j["fragments"][0]["centre"][1], 0.2);
  EXPECT_EQ(j["reactions"]["upper"][1], -2);
}

TEST(ResultsSummary, PeakMemoryIsTheMostThatTheProcessHasHeld) {
  const auto hold = [](std::size_t bytes) {
    std::vector<char> block(bytes);
    for (std::size_t i = 0; i < bytes; i += 512)
      block[i] = 1;  // else the system may not give it
    return std::accumulate(block.begin(), block.end(), 0L);
  };
  const long first = peak_memory();
  EXPECT_LT(first, 16L << 30) << "in bytes, not in something smaller";
  const long block = first + (64L << 20);  // more than all that other tests of this process have held
  ASSERT_GT(hold(static_cast<std::size_t>(block)), 0);
  const long peak = peak_memory();
  EXPECT_GE(peak, block);
  EXPECT_LE(peak, block + first + (8L << 20));
  EXPECT_GE(peak_memory(), block) << "it does not fall when memory is given back";
}

TEST(ResultsProgress, TimesAreInUnitsForPeople) {
  EXPECT_EQ(format_time(0), "0 s");
  EXPECT_EQ(format_time(1.5), "1.50 s");
  EXPECT_EQ(format_time(1.2345e-3), "1.23 ms");
  EXPECT_EQ(format_time(9.996e-4), "1.00 ms");
  EXPECT_EQ(format_time(85.34e-9), "85.3 ns");
  EXPECT_EQ(format_time(851e-12), "851 ps");
  EXPECT_EQ(format_duration(59.6), "1 min 0 s");
  EXPECT_EQ(format_duration(3725), "1 h 2 min");
  EXPECT_EQ(format_duration(INFINITY), "unknown");
}

TEST(ResultsProgress, MemoryIsInUnitsForPeople) {
  EXPECT_EQ(format_bytes(0), "0 B");
  EXPECT_EQ(format_bytes(999), "999 B");
  EXPECT_EQ(format_bytes(1000), "1.00 kB");
  EXPECT_EQ(format_bytes(999'600), "1.00 MB");
  EXPECT_EQ(format_bytes(85'340'000), "85.3 MB");
  EXPECT_EQ(format_bytes(2'166'880'000), "2.17 GB");
}

TEST(ResultsProgress, TheLineSaysHowFarHowFastAndHowLong) {
  EXPECT_EQ(progress_line({12345, 0.5e-3, 2e-3, 85e-9, "wave speed", 24.06e6, 75}),
            " 25 %  step 12,345  500 us of 2.00 ms  dt 85.0 ns (wave speed)  24.1 M particle-steps/s  1 min 15 s left");
}

/// What a run of three steps writes to a descriptor.
void run(int descriptor, bool quiet, double between = 60) {
  Progress progress(0, 3, 1000, quiet, descriptor, between);
  for (int step = 1; step <= 3; ++step)
    progress.update(step, step, 1, "wave speed");
}

/// All that arrives until a tenth of a second passes without more: a terminal hands on in pieces what it was written.
std::string read_all(int descriptor) {
  std::string all;
  char text[4096];
  for (pollfd arrives{descriptor, POLLIN, 0}; poll(&arrives, 1, 100) > 0;) {
    const ssize_t n = ::read(descriptor, text, sizeof text);
    if (n <= 0)
      break;
    all.append(text, static_cast<std::size_t>(n));
  }
  return all;
}

TEST(ResultsProgress, ATerminalSeesTheEndAndANewLine) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0)
    GTEST_SKIP() << "no terminal can be opened here";
  ASSERT_EQ(grantpt(terminal) | unlockpt(terminal), 0);
  const int screen = open(ptsname(terminal), O_RDWR | O_NOCTTY);
  ASSERT_GE(screen, 0);
  run(screen, true);
  EXPECT_EQ(read_all(terminal), "");
  run(screen, false);
  const std::string seen = read_all(terminal);
  EXPECT_NE(seen.find("\r100 %  step 3"), std::string::npos) << seen;
  EXPECT_EQ(seen.find("step 2"), std::string::npos) << "at most one line a second, and the last";
  EXPECT_TRUE(seen.ends_with("\n"));
  EXPECT_LE(seen.size(), 80 + 8u) << "cut to the terminal's width";
  close(screen);
  close(terminal);
}

TEST(ResultsProgress, AFileSeesALineNowAndThen) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  run(ends[1], false);
  EXPECT_EQ(read_all(ends[0]), "");
  run(ends[1], true, 0);
  EXPECT_EQ(read_all(ends[0]), "");
  run(ends[1], false, 0);
  const std::string seen = read_all(ends[0]);
  EXPECT_TRUE(seen.starts_with(" 33 %  step 1")) << seen;
  EXPECT_NE(seen.find("\n 66 %  step 2"), std::string::npos) << seen;
  EXPECT_TRUE(seen.ends_with("left\n")) << seen;
  close(ends[0]);
  close(ends[1]);
}

}  // namespace
}  // namespace riven
