#include "io/vtkhdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>

#include "core/error.hpp"
#include "io/common_arrays.hpp"

namespace riven {
namespace fs = std::filesystem;

namespace {

const std::string root = "/VTKHDF";
const std::string steps = root + "/Steps";
const std::array<std::string, 4> topologies = {"Vertices", "Lines", "Polygons", "Strips"};

std::size_t index_of(PolyData::Cells kind) {
  return kind == PolyData::Cells::vertices ? 0 : 1;
}

/// The path of an object in a group.
std::string in(const std::string& group, const std::string& name) {
  return fmt::format("{}/{}", group, name);
}

template <class T>
void append_one(HdfFile& file, const std::string& dataset, T value) {
  file.append(dataset, &value, 1);
}

std::string signature(const std::string& group, const PolyArray& a) {
  return fmt::format("{}/{} [{}] {}", group, a.name, a.components,
                     a.holds<double>()  ? "double"
                     : a.holds<float>() ? "float"
                                        : "integer");
}

}  // namespace

VtkHdfWriter::VtkHdfWriter(const fs::path& path) : file_(HdfFile::create(path)) {
  file_.make_group(root);
  file_.put_attribute(root, "Version", std::vector<std::int64_t>{2, 0});
  file_.put_attribute(root, "Type", "PolyData");
  for (const std::string& group : topologies)
    file_.make_group(in(root, group));
  for (const std::string group : {"PointData", "CellData"})
    file_.make_group(in(root, group));
  file_.make_group(steps);
  for (const std::string group : {"PointDataOffsets", "CellDataOffsets"})
    file_.make_group(in(steps, group));
}

void VtkHdfWriter::check_same_arrays(const PolyData& data) {
  std::vector<std::string> found;
  for (const PolyArray& a : data.point_arrays)
    found.push_back(signature("PointData", a));
  for (const PolyArray& a : data.cell_arrays)
    found.push_back(signature("CellData", a));
  if (steps_ == 0)
    signature_ = found;
  if (found == signature_)
    return;
  const auto differs = std::mismatch(found.begin(), found.end(), signature_.begin(), signature_.end());
  const std::string name = differs.first != found.end() ? *differs.first : *differs.second;
  fail({Exit::internal, "the arrays of a frame differ from those of the first frame", file_.path().string(), name, "",
        "assemble the frames of one run only"});
}

// The reader finds the offsets of a step at (cells before it) + (parts before it), because each part has one more
// offset than cells. Repeating a part therefore repeats all four kinds of cells.
void VtkHdfWriter::append_topology(PolyData& data) {
  const bool same = steps_ > 0 && data.kind == kind_ && data.point_count() == point_count_ &&
                    data.offsets == offsets_ && data.connectivity == connectivity_;
  if (same)
    return;
  part_ = parts_++;
  cells_at_ = cells_;
  ids_at_ = ids_;
  append_one(file_, root + "/NumberOfPoints", data.point_count());
  static const std::vector<std::int64_t> no_cells{0}, no_ids;
  for (std::size_t k = 0; k < topologies.size(); ++k) {
    const bool here = k == index_of(data.kind);
    const auto& offsets = here ? data.offsets : no_cells;
    const auto& ids = here ? data.connectivity : no_ids;
    const auto cells = static_cast<std::int64_t>(offsets.size()) - 1;
    const std::string group = in(root, topologies[k]);
    append_one(file_, in(group, "NumberOfCells"), cells);
    append_one(file_, in(group, "NumberOfConnectivityIds"), static_cast<std::int64_t>(ids.size()));
    file_.append(in(group, "Offsets"), offsets.data(), offsets.size());
    file_.append(in(group, "Connectivity"), ids.data(), ids.size());
    cells_[k] += cells;
    ids_[k] += static_cast<std::int64_t>(ids.size());
  }
  kind_ = data.kind;
  connectivity_ = std::move(data.connectivity);
  offsets_ = std::move(data.offsets);
  point_count_ = data.point_count();
}

void VtkHdfWriter::append_arrays(const std::string& group, const std::vector<PolyArray>& arrays, std::int64_t rows,
                                 std::int64_t& done) {
  for (const PolyArray& a : arrays) {
    const std::string dataset = in(in(root, group), a.name);
    const std::size_t width = a.components == 1 ? 0 : static_cast<std::size_t>(a.components);
    a.visit([&](const auto& v) {
      if (a.name.find_first_of("/.") != std::string::npos || v.size() != static_cast<std::size_t>(rows * a.components))
        fail({Exit::internal, "an array has no proper name, or not one row per item", file_.path().string(), a.name, "",
              ""});
      file_.append(dataset, v.data(), static_cast<std::size_t>(rows), width);
    });
    if (steps_ == 0 && !a.unit.empty())
      file_.put_attribute(dataset, "unit", a.unit);
    append_one(file_, in(in(steps, group + "Offsets"), a.name), done);
  }
  done += rows;
}

void VtkHdfWriter::append(PolyData data, double time) {
  check_same_arrays(data);
  const std::int64_t points = data.point_count(), cells = data.cell_count();
  append_topology(data);
  data.connectivity = std::vector<std::int64_t>{};  // not {}, which keeps the memory
  data.offsets = std::vector<std::int64_t>{};
  file_.append(root + "/Points", data.points.data(), static_cast<std::size_t>(points), 3);
  data.points = std::vector<double>{};
  append_one(file_, steps + "/Values", time);
  append_one(file_, steps + "/PartOffsets", part_);
  append_one(file_, steps + "/NumberOfParts", std::int64_t{1});
  append_one(file_, steps + "/PointOffsets", points_);
  file_.append(steps + "/CellOffsets", cells_at_.data(), 1, cells_at_.size());
  file_.append(steps + "/ConnectivityIdOffsets", ids_at_.data(), 1, ids_at_.size());
  points_ += points;
  append_arrays("PointData", data.point_arrays, points, point_rows_);
  append_arrays("CellData", data.cell_arrays, cells, cell_rows_);
  ++steps_;
}

void VtkHdfWriter::commit() {
  file_.put_attribute(steps, "NSteps", std::vector<std::int64_t>{steps_});
  file_.commit();
}

void write_vtkhdf(const fs::path& path, PolyData data, double time) {
  VtkHdfWriter writer(path);
  writer.append(std::move(data), time);
  writer.commit();
}

namespace {

template <class T>
void read_when_wanted(const std::shared_ptr<const HdfFile>& file, const std::string& dataset, PolyArray& a) {
  a.data = std::vector<T>{};
  a.make = [=]() -> PolyValues { return file->read<T>(dataset); };
}

/// Arrays that are read when they are wanted.
std::vector<PolyArray> list_arrays(const std::shared_ptr<const HdfFile>& file, const std::string& group) {
  std::vector<PolyArray> arrays;
  for (const std::string& name : file->children(group)) {
    const std::string dataset = in(group, name);
    PolyArray a{name, 1, file->has_attribute(dataset, "unit") ? file->text_attribute(dataset, "unit") : "", {}};
    if (const auto extent = file->extent(dataset); extent.size() == 2)
      a.components = static_cast<int>(extent[1]);
    if (file->is_integer(dataset))
      read_when_wanted<std::int64_t>(file, dataset, a);
    else if (file->is_float(dataset))
      read_when_wanted<float>(file, dataset, a);
    else
      read_when_wanted<double>(file, dataset, a);
    arrays.push_back(std::move(a));
  }
  return arrays;
}

/// Opens a file of one frame.
HdfFile open_frame(const fs::path& path) {
  HdfFile file = HdfFile::open(path);
  if (!file.has(steps) || file.integer_attribute(steps, "NSteps") != std::vector<std::int64_t>{1})
    fail({Exit::file, "cannot read the file: it is no frame of a run", path.string(), "", "", ""});
  return file;
}

/// A frame whose arrays are read when they are wanted.
TimedPolyData look_into_frame(const fs::path& path) {
  const auto file = std::make_shared<const HdfFile>(open_frame(path));
  TimedPolyData frame;
  frame.time = file->read<double>(steps + "/Values").at(0);
  PolyData& d = frame.data;
  d.points = file->read<double>(root + "/Points");
  const bool lines = file->read<std::int64_t>(root + "/Lines/NumberOfCells").at(0) > 0;
  d.kind = lines ? PolyData::Cells::lines : PolyData::Cells::vertices;
  const std::string group = in(root, topologies[index_of(d.kind)]);
  d.connectivity = file->read<std::int64_t>(in(group, "Connectivity"));
  d.offsets = file->read<std::int64_t>(in(group, "Offsets"));
  d.point_arrays = list_arrays(file, root + "/PointData");
  d.cell_arrays = list_arrays(file, root + "/CellData");
  return frame;
}

}  // namespace

TimedPolyData read_vtkhdf(const fs::path& path) {
  TimedPolyData frame = look_into_frame(path);
  for (auto* arrays : {&frame.data.point_arrays, &frame.data.cell_arrays})
    for (PolyArray& a : *arrays)
      a.settle();
  return frame;
}

double read_vtkhdf_time(const fs::path& path) {
  return open_frame(path).read<double>(steps + "/Values").at(0);
}

std::vector<fs::path> list_frames(const fs::path& folder, const std::string& prefix) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".vtkhdf" || !name.starts_with(prefix + "_"))
      continue;
    const std::string digits = name.substr(prefix.size() + 1);
    if (!digits.empty() && std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }))
      found.push_back(entry.path());
  }
  if (error)
    fail_file(folder, "read the folder", error.value());
  // Numbers have leading zeros up to six digits; longer ones come later.
  std::sort(found.begin(), found.end(), [](const fs::path& a, const fs::path& b) {
    const std::string x = a.filename().string(), y = b.filename().string();
    return x.size() != y.size() ? x.size() < y.size() : x < y;
  });
  return found;
}

int assemble_vtkhdf(const fs::path& folder, const std::string& prefix, const fs::path& out) {
  const std::vector<fs::path> frames = list_frames(folder, prefix);
  if (frames.empty())
    return 0;
  CommonArrays of_points, of_cells;
  std::vector<fs::path> sound;
  for (const fs::path& path : frames) {
    try {
      const auto file = std::make_shared<const HdfFile>(open_frame(path));
      of_points.meet(list_arrays(file, root + "/PointData"));
      of_cells.meet(list_arrays(file, root + "/CellData"));
      sound.push_back(path);
    } catch (const Error& e) {
      if (e.code() != Exit::file)
        throw;
      fmt::print(stderr, "riven: warning: {}\n  instead: {} without this frame\n", e.what(), out.string());
    }
  }
  if (sound.empty())
    return 0;
  VtkHdfWriter writer(out);
  for (const fs::path& path : sound) {
    TimedPolyData frame = look_into_frame(path);
    of_points.keep(frame.data.point_arrays);
    of_cells.keep(frame.data.cell_arrays);
    writer.append(std::move(frame.data), frame.time);
  }
  writer.commit();
  return static_cast<int>(sound.size());
}

}  // namespace riven
