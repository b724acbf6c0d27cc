#include "io/frames.hpp"

#include <fmt/format.h>

#include "io/atomic_file.hpp"
#include "io/vtkhdf.hpp"
#include "io/vtp.hpp"

namespace riven {
namespace fs = std::filesystem;

namespace {

const std::string prefixes[] = {"particles", "cracks"};

std::string frame_name(const std::string& prefix, int number) {
  return fmt::format("{}_{:06d}", prefix, number);
}

/// Removes what an older run, or the one that is resumed, has left from this frame on.
void remove_from(const fs::path& folder, int first_frame) {
  const auto remove = [](const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error)
      fail_file(path, "remove the file", error.value());
  };
  for (const std::string& prefix : prefixes) {
    const std::string first = frame_name(prefix, first_frame);
    std::vector<fs::path> old;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "frames")) {
      const std::string name = entry.path().filename().string(), stem = entry.path().stem().string();
      const bool ours = entry.path().extension() == ".vtkhdf" || entry.path().extension() == ".vtp";
      if ((ours && stem.starts_with(prefix + "_") && (stem.size() > first.size() || stem >= first)) ||
          (name.starts_with("." + prefix + "_") && name.ends_with(".part")))
        old.push_back(entry.path());
    }
    for (const fs::path& path : old)
      remove(path);
    for (const char* ending : {".vtkhdf", ".pvd"}) {
      const fs::path whole = folder / (prefix + ending);
      remove(whole);
      remove(AtomicFile::temporary_name(whole));
    }
  }
}

}  // namespace

FrameWriter::FrameWriter(fs::path folder, const Scene& scene, std::vector<double> times)
    : folder_(std::move(folder)), scene_(scene), times_(std::move(times)) {
  make_folder(folder_ / "frames");
  remove_from(folder_, static_cast<int>(times_.size()));
}

void FrameWriter::write_one(const std::string& prefix, PolyData data, double time) const {
  const fs::path path = folder_ / "frames" / frame_name(prefix, static_cast<int>(times_.size()));
  if (scene_.output.sidecar == Sidecar::vtp)
    write_vtp(path.string() + ".vtp", data, time);
  write_vtkhdf(path.string() + ".vtkhdf", std::move(data), time);
}

template <class Real>
void FrameWriter::write(double time, const Particles<Real, 2>& particles, const Cracks& cracks) {
  write_one(prefixes[0], particle_poly(particles, scene_), time);
  if (!scene_.cracks.empty())
    write_one(prefixes[1], crack_poly(cracks), time);
  times_.push_back(time);
  if (scene_.output.sidecar == Sidecar::vtp)
    write_indices();
}

void FrameWriter::write_indices() const {
  for (const std::string& prefix : prefixes) {
    if (prefix == prefixes[1] && scene_.cracks.empty())
      continue;
    std::vector<std::pair<double, std::string>> entries;
    for (std::size_t n = 0; n < times_.size(); ++n)
      entries.emplace_back(times_[n], "frames/" + frame_name(prefix, static_cast<int>(n)) + ".vtp");
    write_pvd(folder_ / (prefix + ".pvd"), entries);
  }
}

void FrameWriter::finish() const {
  const auto found = static_cast<std::size_t>(assemble_frames(folder_));
  if (found < times_.size())
    fmt::print(stderr, "riven: warning: {} of {} frames are missing, or cannot be read: {}\n", times_.size() - found,
               times_.size(), (folder_ / "frames").string());
}

void bring_frames(const fs::path& from, const fs::path& to, int count) {
  make_folder(to / "frames");
  std::error_code error;
  if (fs::equivalent(from.empty() ? "." : from, to, error))
    return;
  remove_from(to, 0);
  for (const std::string& prefix : prefixes)
    for (int n = 0; n < count; ++n)
      for (const char* ending : {".vtkhdf", ".vtp"}) {
        const fs::path name = fs::path("frames") / (frame_name(prefix, n) + ending);
        fs::copy_file(from / name, to / name, error);
        if (error && error != std::errc::no_such_file_or_directory)
          fail_file(to / name, "copy the file", error.value());
      }
}

int assemble_frames(const fs::path& folder) {
  const int particles = assemble_vtkhdf(folder / "frames", prefixes[0], folder / (prefixes[0] + ".vtkhdf"));
  assemble_vtkhdf(folder / "frames", prefixes[1], folder / (prefixes[1] + ".vtkhdf"));
  return particles;
}

#define RIVEN_FRAMES(Real) template void FrameWriter::write(double, const Particles<Real, 2>&, const Cracks&);
RIVEN_EACH_REAL(RIVEN_FRAMES)
#undef RIVEN_FRAMES

}  // namespace riven
