// VTK's older XML PolyData files and the index that gives them times, for ParaView before 5.12 and for VisIt.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/poly_data.hpp"

namespace riven {

/// One frame, binary data appended. Throws Error (file) on a failed write.
void write_vtp(const std::filesystem::path& path, const PolyData& data, double time);

/// The index of a series: (time in s, path relative to the index) of each frame.
void write_pvd(const std::filesystem::path& path, const std::vector<std::pair<double, std::string>>& frames);

}  // namespace riven
