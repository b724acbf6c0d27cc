// VTKHDF 2.0 PolyData files with time steps, as ParaView 5.12 and VTK 9.3 or newer read them
// (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html, section VTKHDF).
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "io/hdf_file.hpp"
#include "io/poly_data.hpp"

namespace riven {

struct TimedPolyData {
  PolyData data;
  double time = 0;  ///< s
};

/// Writes steps one after another; the file has its name only after commit(). The number of points and cells may
/// change from step to step, the arrays (names, components, types) may not.
class VtkHdfWriter {
 public:
  explicit VtkHdfWriter(const std::filesystem::path& path);
  /// Throws Error (file) on a failed write, or (internal) when the arrays differ from those of the first step. Takes
  /// the data, to give back each part as soon as it is written.
  void append(PolyData data, double time);
  void commit();

 private:
  void append_topology(PolyData& data);
  void append_arrays(const std::string& group, const std::vector<PolyArray>& arrays, std::int64_t rows,
                     std::int64_t& done);
  void check_same_arrays(const PolyData& data);

  HdfFile file_;
  std::int64_t steps_ = 0;
  std::vector<std::string> signature_;  ///< of each array
  // of the topology written last, which a step with the same one uses again
  PolyData::Cells kind_ = PolyData::Cells::vertices;
  std::vector<std::int64_t> connectivity_, offsets_;
  std::int64_t point_count_ = -1;
  // where the present step begins in the datasets, and how much they hold
  std::int64_t part_ = 0, parts_ = 0, points_ = 0, point_rows_ = 0, cell_rows_ = 0;
  std::array<std::int64_t, 4> cells_at_{}, cells_{}, ids_at_{}, ids_{};
};

/// One frame in a file of its own.
void write_vtkhdf(const std::filesystem::path& path, PolyData data, double time);

/// A file of one frame. Throws Error (file) when it cannot be read or is no such file.
TimedPolyData read_vtkhdf(const std::filesystem::path& path);

/// The time of a file of one frame, s.
double read_vtkhdf_time(const std::filesystem::path& path);

/// The finished frames of a folder in the order of their numbers: files "<prefix>_<digits>.vtkhdf".
std::vector<std::filesystem::path> list_frames(const std::filesystem::path& folder, const std::string& prefix);

/// Joins the finished frames of a folder into one file with time steps, one array of a frame in memory at a time.
/// Returns how many there were; without any, no file is written.
int assemble_vtkhdf(const std::filesystem::path& folder, const std::string& prefix, const std::filesystem::path& out);

}  // namespace riven
