// Full disks, folders that cannot be written, kills: what was finished stays, and the message says what happened.
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/frames.hpp"
#include "io/history.hpp"
#include "io/peak_memory.hpp"
#include "io/summary.hpp"
#include "io/vtkhdf.hpp"
#include "tests/io/faults.hpp"
#include "tests/io/results_sample.hpp"

namespace riven {
namespace {

PolyData block(int n) {
  PolyData d;
  d.points.resize(3 * static_cast<std::size_t>(n), 0.1);
  for (int a = 0; a < 8; ++a)
    d.point_arrays.push_back({"a" + std::to_string(a), 1, "", std::vector<double>(static_cast<std::size_t>(n), a)});
  return d;
}

/// By how much the most memory that a process of its own holds grows while it writes and joins two frames, bytes.
long memory_of_frames(const std::filesystem::path& folder, int count) {
  int ends[2];
  if (pipe(ends) != 0)
    return -1;
  const pid_t child = fork();
  if (child == 0) {
    mallopt(M_MMAP_THRESHOLD, 1 << 20);  // arrays go back to the system when they are freed, as large ones always do
    auto p = sample::particles(1);
    p.each_array([&](auto& a) { a.resize(count); });
    for (int k = 0; k < count; ++k)
      p.id[k] = k;
    Scene scene = sample::scene();
    scene.output.sidecar = Sidecar::none;
    const long before = peak_memory();
    FrameWriter frames(folder, scene);
    for (const double time : {0., 1.})
      frames.write(time, p, sample::cracks(time));
    frames.finish();
    const long taken = peak_memory() - before;
    const bool told = write_all(ends[1], &taken, sizeof taken);
    std::exit(told ? 0 : 1);
  }
  close(ends[1]);
  long taken = -1;
  if (read(ends[0], &taken, sizeof taken) != sizeof taken)
    taken = -1;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return taken;
}

// A frame holds 232 bytes of each particle.
TEST(ResultsFailures, FramesOfManyParticlesTakeLittleMemory) {
  const sample::Folder folder;
  constexpr int count = 600'000;
  const long taken = memory_of_frames(folder.path(), count);
  EXPECT_GT(taken, 10L * count) << "something must have been measured";
  EXPECT_LT(taken, 90L * count) << "points, cells and the largest array, not all arrays";
  EXPECT_EQ(read_vtkhdf_time(folder.path() / "frames/particles_000001.vtkhdf"), 1);
}

// From a file that cannot take its first byte to one that lacks only its last ones.
TEST(ResultsFailures, AFullDiskLosesOnlyTheFrameThatDidNotFit) {
  const sample::Folder folder;
  const auto path = folder / "frame.vtkhdf";
  write_vtkhdf(path, block(30000), 1.0);
  const auto whole = std::filesystem::file_size(path);
  const std::string before = sample::text_of(path);
  for (const rlim_t room :
       {rlim_t{0}, rlim_t{100}, rlim_t{5000}, rlim_t{whole / 3}, rlim_t{whole - 5000}, rlim_t{whole - 1}}) {
    EXPECT_TRUE(with_small_disk(room, [&] {
      const std::string message = file_error([&] { write_vtkhdf(path, block(30000), 2.0); });
      const bool names = message.find(path.string()) != std::string::npos;
      const bool reason = message.find("File too large") != std::string::npos;
      if (!names || !reason)
        std::fprintf(stderr, "%s\n", message.c_str());
      return names && reason;
    })) << room;
    EXPECT_EQ(sample::text_of(path), before) << "the older file stays as it was";
    EXPECT_EQ(sample::leftovers(folder.path()), 0);
  }
}

TEST(ResultsFailures, JoiningOnAFullDiskKeepsTheFrames) {
  const sample::Folder folder;
  for (int k = 0; k < 5; ++k)
    write_vtkhdf(folder / ("p_00000" + std::to_string(k) + ".vtkhdf"), block(20000), k);
  for (const rlim_t room : {rlim_t{2'000'000}, rlim_t{5'000'000}})
    EXPECT_TRUE(with_small_disk(room, [&] {
      return file_error([&] { assemble_vtkhdf(folder.path(), "p", folder / "p.vtkhdf"); }).find("File too large") !=
             std::string::npos;
    }));
  EXPECT_FALSE(std::filesystem::exists(folder / "p.vtkhdf"));
  EXPECT_EQ(sample::leftovers(folder.path()), 0);
  EXPECT_EQ(assemble_vtkhdf(folder.path(), "p", folder / "p.vtkhdf"), 5);
}

TEST(ResultsFailures, AFullDiskLeavesTheHistoryWithWholeRows) {
  const sample::Folder folder;
  EXPECT_TRUE(with_small_disk(1000, [&] {
    History history(folder / "history.csv", {{"time", "s"}, {"kinetic", "J"}});
    const std::string message = file_error([&] {
      for (int k = 0; k < 1000; ++k)
        history.row(std::vector{0.1 * k, 1.0 / 3});
    });
    return message.find("File too large") != std::string::npos;
  }));
  const std::string text = sample::text_of(folder / "history.csv");
  EXPECT_GT(text.size(), 900u);
  EXPECT_EQ(text.back(), '\n');
}

/// Of a run that is taken up again, too: its first row may be the one that finds no room.
TEST(ResultsFailures, AFullDiskLeavesTheRowsFromBeforeARestart) {
  const sample::Folder folder;
  const std::vector<HistoryColumn> columns{{"time", "s"}, {"kinetic", "J"}};
  EXPECT_TRUE(with_small_disk(60, [&] {
    History history(folder / "history.csv", columns, "0,1\n1,2\n2,3\n");
    return file_error([&] {
             for (int k = 0; k < 100; ++k)
               history.row(std::vector{1.0 / 3, 2.0 / 3});
           }) != "no error";
  }));
  const std::string text = sample::text_of(folder / "history.csv");
  EXPECT_EQ(text, "time [s],kinetic [J]\n0,1\n1,2\n2,3\n") << text;
}

TEST(ResultsFailures, ADeviceWithoutSpaceIsNamedAsSuch) {
  const sample::Folder folder;
  std::filesystem::create_symlink("/dev/full", folder / "history.csv");
  const std::string message = file_error([&] { History history(folder / "history.csv", {{"time", "s"}}); });
  EXPECT_NE(message.find("No space left on device"), std::string::npos) << message;
  EXPECT_NE(message.find("free some space"), std::string::npos) << message;
}

TEST(ResultsFailures, AFolderThatCannotBeMadeIsNamed) {
  const sample::Folder folder;
  write_file(folder / "file", "not a folder");
  const Scene scene = sample::scene();
  for (const auto& bad : {folder / "file", folder / "file/below", std::filesystem::path("/proc/riven")}) {
    const std::string message = file_error([&] { FrameWriter writer(bad, scene); });
    EXPECT_NE(message.find(bad.string()), std::string::npos) << message;
  }
  if (geteuid() == 0)
    return;  // whom permissions do not stop
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const std::string message = file_error([&] { FrameWriter writer(folder / "out", scene); });
  EXPECT_NE(message.find("Permission denied"), std::string::npos) << message;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(ResultsFailures, AFolderThatVanishedIsNamed) {
  const sample::Folder folder;
  for (const auto& write : std::vector<std::function<void()>>{
           [&] { write_vtkhdf(folder / "gone/a.vtkhdf", block(2), 0); },
           [&] { write_summary(folder / "gone/summary.json", {}); },
           [&] {
             History history(folder / "gone/history.csv", {{"time", "s"}});
           },
       })
    EXPECT_NE(file_error(write).find("No such file or directory"), std::string::npos);
}

TEST(ResultsFailures, ADamagedFrameIsNamedAndLeftOut) {
  const sample::Folder folder;
  write_file(folder / "p_000000.vtkhdf", "no HDF5 at all");
  testing::internal::CaptureStderr();
  EXPECT_EQ(assemble_vtkhdf(folder.path(), "p", folder / "p.vtkhdf"), 0);
  const std::string message = testing::internal::GetCapturedStderr();
  EXPECT_NE(message.find("p_000000.vtkhdf: cannot read the file"), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(folder / "p.vtkhdf"));
  EXPECT_EQ(sample::leftovers(folder.path()), 0);
}

TEST(ResultsFailures, ANewRunClearsAwayWhatAKillMayLeave) {
  const sample::Folder folder;
  std::filesystem::create_directories(folder / "frames");
  for (const std::string prefix : {"particles", "cracks"})
    for (const std::string& name :
         {"." + prefix + ".pvd.part", "." + prefix + ".vtkhdf.part", "frames/." + prefix + "_000004.vtkhdf.part",
          "frames/." + prefix + "_000004.vtp.part"})
      std::ofstream(folder / name) << "half";
  ASSERT_EQ(sample::leftovers(folder.path()), 8);
  const Scene scene = sample::scene();
  FrameWriter anew(folder.path(), scene);
  EXPECT_EQ(sample::leftovers(folder.path()), 0);
}

// A process that writes frames and history as fast as it can is killed at some moment, several times.
TEST(ResultsFailures, AKilledRunLeavesEveryFinishedFrameReadable) {
  const Scene scene = sample::scene();
  for (int attempt = 0; attempt < 6; ++attempt) {
    const sample::Folder folder;
    const pid_t child = fork();
    if (child == 0) {
      FrameWriter writer(folder.path(), scene);
      History history(folder / "history.csv", {{"time", "s"}, {"kinetic", "J"}});
      for (int k = 0; k < 100000; ++k) {
        writer.write(k, sample::particles(k, k % 7), sample::cracks(k, k % 3));
        history.row(std::vector{1.0 * k, 0.1 * k});
      }
      _exit(0);
    }
    while (!std::filesystem::exists(folder / "frames/particles_000003.vtkhdf")) {
      ASSERT_EQ(waitpid(child, nullptr, WNOHANG), 0) << "the writer must not end by itself";
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::microseconds(700 * attempt));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);

    const auto frames = list_frames(folder / "frames", "particles");
    ASSERT_GE(frames.size(), 4u);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const TimedPolyData frame = read_vtkhdf(frames[k]);
      EXPECT_EQ(frame.time, static_cast<double>(k));
      EXPECT_EQ(frame.data.point_count(), sample::nx * sample::ny - static_cast<std::int64_t>(k % 7));
    }
    EXPECT_EQ(assemble_frames(folder.path()), static_cast<int>(frames.size()));
    EXPECT_EQ(sample::text_of(folder / "history.csv").back(), '\n');
    FrameWriter anew(folder.path(), scene);
    EXPECT_EQ(sample::leftovers(folder.path()), 0) << "the next run clears away what the kill has left";
  }
}

}  // namespace
}  // namespace riven
