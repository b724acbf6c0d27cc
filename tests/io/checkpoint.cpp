// Checkpoints that cannot be trusted are refused with a reason, whatever happened to them, and what was good stays.
#include "io/checkpoint.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "io/checkpoint_header.hpp"
#include "io/checkpoint_store.hpp"
#include "tests/io/faults.hpp"
#include "tests/io/results_sample.hpp"
#include "tests/io/small_run.hpp"
#include "tests/spaces.hpp"

namespace riven {
namespace {

using test::SmallRun;

constexpr const char *newest = "checkpoint.h5", *previous = "checkpoint.previous.h5";

void put(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string refusal(const std::filesystem::path& path) {
  return file_error([&] { CheckpointFile file(path); });
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Step that the checkpoint is of.
long step_of(const CheckpointFile& file) {
  SmallRun run;
  file.restore(run.m);
  return run.m.state.clock.step;
}

/// A store in the folder that has written at steps 2 and 4.
void write_two(const std::filesystem::path& folder) {
  SmallRun run;
  CheckpointStore store(folder, run.scene.output, nullptr);
  for (int k = 0; k < 2; ++k) {
    run.steps(2);
    store.write(run.m, {});
  }
}

TEST(Checkpoint, StandsAlone) {
  const sample::Folder folder;
  RunSoFar so_far{1.5, {0, 1e-6}, 1e-6, 2, "0,1\n1e-6,2\n", {{5, 2e-6, 3, 0.2, "it grew"}}};
  {
    SmallRun run({"solver.cfl=0.3"});
    run.steps(3);
    write_checkpoint(folder / "a.h5", run.m, so_far);
  }
  const CheckpointFile file(folder / "a.h5");
  const Scene scene = file.scene();
  EXPECT_EQ(scene.cfl, 0.3) << "overrides are in the text";
  EXPECT_EQ(scene.name, "small");
  ASSERT_EQ(scene.cracks.size(), 1u) << "there is no cracks.csv to read it from";
  EXPECT_DOUBLE_EQ(scene.cracks[0].points[1].x, 6.1e-3);
  EXPECT_EQ(file.scene({"solver.time=1 s"}).end_time, 1);
  const test::ChosenSpace space;
  Simulation m(scene, space);
  const RunSoFar back = file.restore(m);
  EXPECT_EQ(m.state.clock.step, 3);
  EXPECT_EQ(back.wall_seconds, so_far.wall_seconds);
  EXPECT_EQ(back.frames, so_far.frames);
  EXPECT_EQ(back.frame_interval, so_far.frame_interval);
  EXPECT_EQ(back.frames_due, so_far.frames_due);
  EXPECT_EQ(back.history, so_far.history);
  ASSERT_EQ(back.retries.size(), 1u);
  EXPECT_EQ(back.retries[0].step, 5);
  EXPECT_EQ(back.retries[0].time, 2e-6);
  EXPECT_EQ(back.retries[0].back_to, 3);
  EXPECT_EQ(back.retries[0].cfl, 0.2);
  EXPECT_EQ(back.retries[0].message, "it grew");
}

TEST(Checkpoint, EveryFlippedBitIsSeen) {
  const sample::Folder folder;
  SmallRun run;
  run.steps(2);
  write_checkpoint(folder / "a.h5", run.m, {0, {0}, 1, 1, "0,1\n"});
  const std::string good = sample::text_of(folder / "a.h5");
  std::mt19937 random(5);
  const auto expect_refusal = [&](std::size_t at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ (1 << (random() % 8)));
    put(folder / "b.h5", bad);
    const std::string message = refusal(folder / "b.h5");
    EXPECT_TRUE(holds(message, "damaged") || holds(message, "not whole") || holds(message, "another format") ||
                holds(message, "no checkpoint"))
        << "byte " << at << ": " << message;
    EXPECT_TRUE(holds(message, (folder / "b.h5").string()));
  };
  for (std::size_t at = 0; at < checkpoint_header_bytes; ++at)
    expect_refusal(at);
  for (int k = 0; k < 400; ++k)
    expect_refusal(checkpoint_header_bytes + random() % (good.size() - checkpoint_header_bytes));
}

TEST(Checkpoint, OneThatIsCutShortIsRefused) {
  const sample::Folder folder;
  SmallRun run;
  run.steps(1);
  write_checkpoint(folder / "a.h5", run.m, {});
  const std::string good = sample::text_of(folder / "a.h5");
  const std::size_t size = good.size();
  for (const std::size_t length : {size - 1, size / 2, std::size_t{513}, std::size_t{512}})
    for (const bool zeros : {false, true}) {  // as a file system may leave it after a crash of the machine
      std::string bad = good.substr(0, length);
      bad.resize(zeros ? size : length, '\0');
      put(folder / "b.h5", bad);
      if (bad != good) {
        EXPECT_TRUE(holds(refusal(folder / "b.h5"), zeros ? "damaged" : "not whole")) << length;
      }
    }
  put(folder / "b.h5", good + "more");
  EXPECT_TRUE(holds(refusal(folder / "b.h5"), "not whole"));
  for (const std::size_t length : {std::size_t{511}, std::size_t{40}, std::size_t{0}}) {
    put(folder / "b.h5", good.substr(0, length));
    EXPECT_TRUE(holds(refusal(folder / "b.h5"), length < 20 ? "no checkpoint" : "not whole")) << length;
  }
}

TEST(Checkpoint, WhatIsNoneIsRefused) {
  const sample::Folder folder;
  put(folder / "text", "a text");
  EXPECT_TRUE(holds(refusal(folder / "text"), "no checkpoint of riven"));
  HdfFile other = HdfFile::create(folder / "other.h5");
  other.make_group("/state");
  other.commit();
  EXPECT_TRUE(holds(refusal(folder / "other.h5"), "no checkpoint of riven"));
  EXPECT_TRUE(holds(refusal(folder / "none.h5"), "No such file"));
  EXPECT_TRUE(holds(refusal(folder.path()), "not a file"));
  EXPECT_TRUE(holds(refusal("/dev/null"), "not a file"));
}

TEST(Checkpoint, AnotherFormatIsNamed) {
  const sample::Folder folder;
  SmallRun run;
  run.steps(1);
  write_checkpoint(folder / "a.h5", run.m, {});
  std::string bytes = sample::text_of(folder / "a.h5");
  const std::string ours = fmt::format("format {}", checkpoint_format);
  bytes.replace(bytes.find(ours), ours.size(), "format 0");
  put(folder / "b.h5", bytes);
  const std::string message = refusal(folder / "b.h5");
  EXPECT_TRUE(holds(message, "format 0") && holds(message, ours)) << message;
}

TEST(Checkpoint, OneOfAnotherSceneIsNotTaken) {
  const sample::Folder folder;
  SmallRun run;
  run.steps(2);
  write_checkpoint(folder / "a.h5", run.m, {});
  const CheckpointFile file(folder / "a.h5");
  for (const char* setting :
       {"body.0.particles_per_cell=3", "grid.upper=[\"30 mm\", \"10 mm\"]", "fracture.contour=4"}) {
    SmallRun other({setting});
    const std::string message = file_error([&] { file.restore(other.m); });
    EXPECT_TRUE(holds(message, "does not fit its scene")) << setting << ": " << message;
  }
}

TEST(Checkpoint, TheOneBeforeIsKept) {
  const sample::Folder folder;
  write_two(folder.path());
  EXPECT_EQ(step_of(CheckpointFile(folder / newest)), 4);
  EXPECT_EQ(step_of(CheckpointFile(folder / previous)), 2);
  EXPECT_EQ(step_of(find_checkpoint(folder.path())), 4);
  EXPECT_EQ(sample::leftovers(folder.path()), 0);
  std::filesystem::remove(folder / newest);
  EXPECT_EQ(step_of(find_checkpoint(folder.path())), 2);
  SmallRun anew;
  const CheckpointStore store(folder.path(), anew.scene.output, nullptr);
  EXPECT_TRUE(holds(file_error([&] { find_checkpoint(folder.path()); }), "no checkpoint in this folder"));
}

TEST(Checkpoint, ADamagedOneGivesWayToTheOneBefore) {
  const sample::Folder folder;
  write_two(folder.path());
  std::string bytes = sample::text_of(folder / newest);
  bytes[bytes.size() / 2] ^= 1;
  put(folder / newest, bytes);
  testing::internal::CaptureStderr();
  const CheckpointFile found = find_checkpoint(folder.path());
  const std::string warning = testing::internal::GetCapturedStderr();
  EXPECT_EQ(step_of(found), 2);
  EXPECT_TRUE(holds(warning, "damaged") && holds(warning, previous)) << warning;

  SmallRun run;
  found.restore(run.m);
  CheckpointStore store(folder.path(), run.scene.output, &found);
  run.steps(1);
  store.write(run.m, {});
  EXPECT_EQ(step_of(CheckpointFile(folder / newest)), 3);
  EXPECT_EQ(step_of(CheckpointFile(folder / previous)), 2) << "the damaged one takes no good one's place";

  put(folder / previous, "nothing");
  put(folder / newest, bytes);
  EXPECT_TRUE(holds(file_error([&] { find_checkpoint(folder.path()); }), "damaged"));
}

TEST(Checkpoint, AKillBetweenTheTwoNamesLeavesNoMess) {
  const sample::Folder folder;
  write_two(folder.path());
  std::filesystem::remove(folder / previous);
  std::filesystem::create_hard_link(folder / newest, folder / previous);
  const CheckpointFile found = find_checkpoint(folder.path());
  SmallRun run;
  found.restore(run.m);
  CheckpointStore store(folder.path(), run.scene.output, &found);
  run.steps(1);
  store.write(run.m, {});
  EXPECT_EQ(step_of(CheckpointFile(folder / newest)), 5);
  EXPECT_EQ(step_of(CheckpointFile(folder / previous)), 4);
  EXPECT_EQ(sample::leftovers(folder.path()), 0);
}

TEST(Checkpoint, AFullDiskKeepsThoseThatThereAre) {
  const sample::Folder folder;
  write_two(folder.path());
  const CheckpointFile found = find_checkpoint(folder.path());
  SmallRun run;
  found.restore(run.m);
  const auto size = std::filesystem::file_size(folder / newest);
  CheckpointStore store(folder.path(), run.scene.output, &found);
  for (const rlim_t room : {rlim_t{0}, rlim_t{600}, rlim_t{size / 2}, rlim_t{size - 1}})
    EXPECT_TRUE(with_small_disk(room, [&] {
      const std::string message = file_error([&] { store.write(run.m, {}); });
      std::fprintf(stderr, "%s\n", message.c_str());
      return holds(message, "File too large") && holds(message, newest);
    })) << room;
  EXPECT_EQ(step_of(CheckpointFile(folder / newest)), 4);
  EXPECT_EQ(step_of(CheckpointFile(folder / previous)), 2);
  EXPECT_EQ(sample::leftovers(folder.path()), 0);
}

TEST(Checkpoint, IsDueByStepsAndByTime) {
  const sample::Folder folder;
  const auto due = [&](std::vector<std::string> settings, long step) {
    const Scene s = test::small(settings);
    return CheckpointStore(folder.path(), s.output, nullptr).due(step);
  };
  EXPECT_FALSE(due({}, 100)) << "10 minutes are not over";
  EXPECT_TRUE(due({"output.checkpoint=1 ns"}, 1));
  EXPECT_FALSE(due({"output.checkpoint=0 s"}, 1)) << "never";
  EXPECT_TRUE(due({"output.checkpoint_steps=50"}, 100));
  EXPECT_FALSE(due({"output.checkpoint_steps=50"}, 99));
}

}  // namespace
}  // namespace riven
