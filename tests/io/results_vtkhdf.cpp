// Frames and joined files read back through plain HDF5: counts, offsets, values.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "io/frames.hpp"
#include "io/history.hpp"
#include "io/summary.hpp"
#include "io/vtkhdf.hpp"
#include "tests/io/results_sample.hpp"

namespace riven {
namespace {

using Integers = std::vector<std::int64_t>;

PolyData points(int n, double value) {
  PolyData d;
  std::vector<double> s;
  std::vector<std::int64_t> id;
  for (int i = 0; i < n; ++i) {
    d.points.insert(d.points.end(), {value + i, -value, 0.0});
    d.connectivity.push_back(i);
    d.offsets.push_back(i + 1);
    s.insert(s.end(), {value * i, value});
    id.push_back(100 * n + i);
  }
  d.point_arrays = {{"pair", 2, "Pa", s}, {"id", 1, "", id}};
  d.cell_arrays = {{"mark", 1, "", id}};
  return d;
}

TEST(ResultsVtkhdf, AFrameHoldsTheFormatsGroupsAndAttributes) {
  const sample::Folder folder;
  write_vtkhdf(folder / "a.vtkhdf", points(3, 2.5), 0.125);
  const HdfFile f = HdfFile::open(folder / "a.vtkhdf");
  EXPECT_EQ(f.text_attribute("/VTKHDF", "Type"), "PolyData");
  EXPECT_EQ(f.integer_attribute("/VTKHDF", "Version"), (Integers{2, 0}));
  EXPECT_EQ(f.integer_attribute("/VTKHDF/Steps", "NSteps"), Integers{1});
  EXPECT_EQ(f.read<double>("/VTKHDF/Steps/Values"), std::vector<double>{0.125});
  EXPECT_EQ(f.read<std::int64_t>("/VTKHDF/NumberOfPoints"), Integers{3});
  EXPECT_EQ(f.extent("/VTKHDF/Points"), (std::vector<std::size_t>{3, 3}));
  EXPECT_EQ(f.read<std::int64_t>("/VTKHDF/Vertices/Offsets"), (Integers{0, 1, 2, 3}));
  for (const std::string group : {"Lines", "Polygons", "Strips"}) {
    EXPECT_EQ(f.read<std::int64_t>("/VTKHDF/" + group + "/NumberOfCells"), Integers{0});
    EXPECT_EQ(f.read<std::int64_t>("/VTKHDF/" + group + "/Offsets"), Integers{0});
    EXPECT_TRUE(f.read<std::int64_t>("/VTKHDF/" + group + "/Connectivity").empty());
  }
  EXPECT_EQ(f.text_attribute("/VTKHDF/PointData/pair", "unit"), "Pa");
  EXPECT_EQ(f.extent("/VTKHDF/PointData/pair"), (std::vector<std::size_t>{3, 2}));
}

TEST(ResultsVtkhdf, AFrameComesBackAsItWasWritten) {
  const sample::Folder folder;
  const PolyData d = crack_poly(sample::cracks(0.3));
  write_vtkhdf(folder / "a.vtkhdf", d, 0.3);
  const TimedPolyData back = read_vtkhdf(folder / "a.vtkhdf");
  EXPECT_EQ(back.time, 0.3);
  EXPECT_EQ(back.data.kind, d.kind);
  EXPECT_EQ(back.data.points, d.points);
  EXPECT_EQ(back.data.connectivity, d.connectivity);
  EXPECT_EQ(back.data.offsets, d.offsets);
  ASSERT_EQ(back.data.point_arrays.size(), d.point_arrays.size());
  for (const PolyArray& a : d.point_arrays)
    for (const PolyArray& b : back.data.point_arrays)
      if (a.name == b.name) {
        EXPECT_EQ(a.data, b.data) << a.name;
        EXPECT_EQ(a.unit, b.unit) << a.name;
        EXPECT_EQ(a.components, b.components) << a.name;
      }
}

// Five steps of 3, 3, 2, 0 and 4 points: the second one uses the cells of the first again.
TEST(ResultsVtkhdf, StepsOfChangingSizeHaveTheirOffsets) {
  const sample::Folder folder;
  const int counts[] = {3, 3, 2, 0, 4};
  VtkHdfWriter writer(folder / "a.vtkhdf");
  for (int k = 0; k < 5; ++k)
    writer.append(points(counts[k], k), 10.0 * k);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.vtkhdf")) << "has its name only when it is complete";
  writer.commit();
  const HdfFile f = HdfFile::open(folder / "a.vtkhdf");
  const std::string steps = "/VTKHDF/Steps/";
  EXPECT_EQ(f.integer_attribute("/VTKHDF/Steps", "NSteps"), Integers{5});
  EXPECT_EQ(f.read<double>(steps + "Values"), (std::vector<double>{0, 10, 20, 30, 40}));
  EXPECT_EQ(f.read<std::int64_t>("/VTKHDF/NumberOfPoints"), (Integers{3, 2, 0, 4}));
  EXPECT_EQ(f.read<std::int64_t>(steps + "PartOffsets"), (Integers{0, 0, 1, 2, 3}));
  EXPECT_EQ(f.read<std::int64_t>(steps + "NumberOfParts"), (Integers{1, 1, 1, 1, 1}));
  EXPECT_EQ(f.read<std::int64_t>(steps + "PointOffsets"), (Integers{0, 3, 6, 8, 8}));
  EXPECT_EQ(f.extent(steps + "CellOffsets"), (std::vector<std::size_t>{5, 4}));
  const Integers cells = f.read<std::int64_t>(steps + "CellOffsets");
  const Integers ids = f.read<std::int64_t>(steps + "ConnectivityIdOffsets");
  const std::int64_t expected[] = {0, 0, 3, 5, 5};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(cells[4 * k], expected[k]);
    EXPECT_EQ(ids[4 * k], expected[k]);
    for (std::size_t other = 1; other < 4; ++other)
      EXPECT_EQ(cells[4 * k + other], 0);
  }
  EXPECT_EQ(f.read<std::int64_t>(steps + "PointDataOffsets/id"), (Integers{0, 3, 6, 8, 8}));
  EXPECT_EQ(f.read<std::int64_t>(steps + "CellDataOffsets/mark"), (Integers{0, 3, 6, 8, 8}));
  EXPECT_EQ(f.read<std::int64_t>("/VTKHDF/PointData/id"),
            (Integers{300, 301, 302, 300, 301, 302, 200, 201, 400, 401, 402, 403}));
  EXPECT_EQ(f.read<double>("/VTKHDF/Points").at(3 * 9), 5.0) << "step 4, point 1";
}

TEST(ResultsVtkhdf, LargeFramesCrossChunksUnharmed) {
  const sample::Folder folder;
  const int n = 150001;  // more than two chunks of every kind
  const PolyData d = points(n, 0.5);
  write_vtkhdf(folder / "x_000000.vtkhdf", d, 0);
  write_vtkhdf(folder / "x_000001.vtkhdf", points(n - 1, 0.25), 1);
  ASSERT_EQ(assemble_vtkhdf(folder.path(), "x", folder / "x.vtkhdf"), 2);
  EXPECT_EQ(read_vtkhdf(folder / "x_000000.vtkhdf").data.points, d.points);
  const HdfFile f = HdfFile::open(folder / "x.vtkhdf");
  const auto pair = f.read<double>("/VTKHDF/PointData/pair");
  ASSERT_EQ(pair.size(), 2u * (2 * n - 1));
  EXPECT_EQ(pair[2 * (n - 1)], 0.5 * (n - 1));
  EXPECT_EQ(pair[2 * n + 2], 0.25) << "second step, point 1";
  EXPECT_LT(std::filesystem::file_size(folder / "x_000000.vtkhdf"), 1.1 * n * 8 * 5 + 1e5)
      << "cells and ids cost next to nothing beside 5 numbers per point";
}

TEST(ResultsVtkhdf, FramesOfDifferentArraysAreNotJoined) {
  const sample::Folder folder;
  VtkHdfWriter writer(folder / "a.vtkhdf");
  writer.append(points(2, 1), 0);
  PolyData other = points(2, 1);
  other.point_arrays[0].name = "other";
  EXPECT_THROW(writer.append(other, 1), Error);
}

TEST(ResultsVtkhdf, JoinedFramesEqualTheFrames) {
  const sample::Folder folder;
  const Scene scene = sample::scene();
  FrameWriter writer(folder.path(), scene);
  for (int k = 0; k < 4; ++k)
    writer.write(0.25 * k, sample::particles(0.25 * k, k), sample::cracks(0.25 * k, k));
  writer.finish();
  const HdfFile joined = HdfFile::open(folder / "particles.vtkhdf");
  std::size_t at = 0;
  for (const auto& path : list_frames(folder / "frames", "particles")) {
    const TimedPolyData frame = read_vtkhdf(path);
    for (const PolyArray& a : frame.data.point_arrays)
      if (a.name == "stress") {
        const auto& own = std::get<std::vector<double>>(a.data);
        const auto all = joined.read<double>("/VTKHDF/PointData/stress");
        ASSERT_LE(at + own.size(), all.size());
        EXPECT_TRUE(std::equal(own.begin(), own.end(), all.begin() + static_cast<std::ptrdiff_t>(at)));
        at += own.size();
      }
  }
  EXPECT_EQ(at, 6u * (4 * sample::nx * sample::ny - 6));
  EXPECT_EQ(HdfFile::open(folder / "cracks.vtkhdf").read<std::int64_t>("/VTKHDF/NumberOfPoints"),
            (Integers{9, 10, 11, 12}));
}

TEST(ResultsVtkhdf, JoinedFramesHaveWhatAllFramesHaveInTheirBestPrecision) {
  const sample::Folder folder;
  Scene scene = sample::scene();
  scene.output.precision = Precision::as_float;
  scene.output.fields.clear();
  std::vector<double> times;
  for (const bool later : {false, true}) {  // a run that goes on with other output
    if (later) {
      scene.output.precision = Precision::as_double;
      scene.output.fields = {"fringe"};
      scene.output.fringe_constant = 1e-7;
    }
    FrameWriter writer(folder.path(), scene, times);
    writer.write(0.5 * static_cast<double>(times.size()), sample::particles(0.25), sample::cracks(0.25));
    times = writer.times();
    writer.finish();
  }
  const auto frames = list_frames(folder / "frames", "particles");
  ASSERT_EQ(frames.size(), 2u);
  const auto reals = [](const HdfFile& f, const char* name) {
    return f.read<double>(std::string("/VTKHDF/PointData/") + name);
  };
  std::vector<double> expected;
  for (const auto& path : frames) {
    const HdfFile frame = HdfFile::open(path);
    const std::vector<double> stress = reals(frame, "stress");
    expected.insert(expected.end(), stress.begin(), stress.end());
  }
  const HdfFile joined = HdfFile::open(folder / "particles.vtkhdf");
  EXPECT_FALSE(joined.has("/VTKHDF/PointData/fringe"));
  EXPECT_FALSE(joined.is_float("/VTKHDF/PointData/stress"));
  EXPECT_EQ(reals(joined, "stress"), expected);
}

TEST(ResultsVtkhdf, ARunThatBeginsAnewRemovesOldFramesAndAResumedOneKeepsThem) {
  const sample::Folder folder;
  const Scene scene = sample::scene();
  const auto frames = [&] { return list_frames(folder / "frames", "particles").size(); };
  const auto write = [&](FrameWriter& w, int n) {
    for (int k = 0; k < n; ++k)
      w.write(0.1 * static_cast<double>(w.times().size()), sample::particles(0), sample::cracks(0));
  };
  {
    FrameWriter first(folder.path(), scene);
    write(first, 5);
    first.finish();
  }
  {
    FrameWriter resumed(folder.path(), scene, {0, 0.1, 0.2});
    EXPECT_EQ(frames(), 3u);
    EXPECT_FALSE(std::filesystem::exists(folder / "particles.vtkhdf")) << "would show what is no longer there";
    write(resumed, 1);
    EXPECT_EQ(frames(), 4u);
    const std::string index = sample::text_of(folder / "particles.pvd");
    EXPECT_NE(index.find("frames/particles_000003.vtp"), std::string::npos);
    EXPECT_EQ(index.find("frames/particles_000004.vtp"), std::string::npos);
  }
  FrameWriter anew(folder.path(), scene);
  EXPECT_EQ(frames(), 0u);
}

// Written where RIVEN_SAMPLE_RESULTS says, so that check_vtk.py and check_pictures.py can open it.
TEST(ResultsSample, WritesAFolderForOtherReaders) {
  const sample::Folder own;
  const char* asked = std::getenv("RIVEN_SAMPLE_RESULTS");
  const std::filesystem::path folder = asked ? std::filesystem::path(asked) : own.path();
  const Scene scene = sample::scene();
  FrameWriter writer(folder, scene);
  History history(folder / "history.csv", {{"time", "s"}, {"strain", "1"}, {"stress", "Pa"}, {"kinetic", "J"}});
  for (int k = 0; k < 6; ++k) {
    const double t = 0.2 * k;
    const int removed = k < 2 ? 0 : 10 * k, grown = k < 3 ? 0 : k;
    writer.write(t, sample::particles(t, removed), sample::cracks(t, grown));
    history.row(std::vector{t, 0.01 * t, 2.5e7 * t, 0.5 * t * t});
  }
  writer.finish();
  Summary summary;
  summary.scene = scene.name;
  summary.title = scene.title;
  summary.status = "done";
  summary.time = 1;
  summary.cracks = summarize_cracks(sample::cracks(1, 5), {});
  write_summary(folder / "summary.json", summary);
  EXPECT_TRUE(std::filesystem::exists(folder / "particles.vtkhdf"));
  EXPECT_TRUE(std::filesystem::exists(folder / "cracks.pvd"));
  EXPECT_EQ(sample::leftovers(folder), 0);
}

}  // namespace
}  // namespace riven
