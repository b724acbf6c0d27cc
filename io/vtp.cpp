#include "io/vtp.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>

#include "io/atomic_file.hpp"

namespace riven {
namespace {

constexpr const char* byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

const char* type_name(double) {
  return "Float64";
}
const char* type_name(float) {
  return "Float32";
}
const char* type_name(std::int64_t) {
  return "Int64";
}

/// The XML part names each array and where it begins in the block of raw bytes behind it.
struct Appended {
  std::string xml;
  std::string bytes;

  template <class T>
  void array(const std::string& name, int components, const std::vector<T>& values) {
    xml += fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)",
                       type_name(T{}), name, components, bytes.size());
    xml += '\n';
    const std::uint64_t size = values.size() * sizeof(T);
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes.append(reinterpret_cast<const char*>(values.data()), size);
  }

  void arrays(const char* group, const std::vector<PolyArray>& all) {
    xml += fmt::format("<{}>\n", group);
    for (const PolyArray& a : all)
      a.visit([&](const auto& values) { array(a.name, a.components, values); });
    xml += fmt::format("</{}>\n", group);
  }
};

}  // namespace

void write_vtp(const std::filesystem::path& path, const PolyData& data, double time) {
  const bool lines = data.kind == PolyData::Cells::lines;
  Appended out;
  out.xml = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{:.17g}</DataArray>\n"
      "</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n<Points>\n",
      byte_order, time, data.point_count(), lines ? 0 : data.cell_count(), lines ? data.cell_count() : 0);
  out.array("Points", 3, data.points);
  out.xml += fmt::format("</Points>\n<{}>\n", lines ? "Lines" : "Verts");
  out.array("connectivity", 1, data.connectivity);
  // This format leaves out the leading zero of the offsets.
  out.array("offsets", 1, std::vector<std::int64_t>(data.offsets.begin() + 1, data.offsets.end()));
  out.xml += fmt::format("</{}>\n", lines ? "Lines" : "Verts");
  out.arrays("PointData", data.point_arrays);
  out.arrays("CellData", data.cell_arrays);
  out.xml += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";

  AtomicFile file(path);
  file.write(out.xml);
  file.write(out.bytes);
  file.write("\n</AppendedData>\n</VTKFile>\n");
  file.commit();
}

void write_pvd(const std::filesystem::path& path, const std::vector<std::pair<double, std::string>>& frames) {
  std::string xml = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"{}\">\n<Collection>\n",
      byte_order);
  for (const auto& [time, file] : frames)
    xml += fmt::format("<DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", time, file);
  write_file(path, xml + "</Collection>\n</VTKFile>\n");
}

}  // namespace riven
