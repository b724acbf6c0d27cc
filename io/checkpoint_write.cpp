#include "io/checkpoint.hpp"
#include "io/checkpoint_header.hpp"
#include "io/checkpoint_members.hpp"

namespace riven {

namespace {

using namespace checkpoint;

class MemberWriter {
 public:
  explicit MemberWriter(HdfFile& file) : file_(file) {}

  template <class Array>
  void fixed(const std::string& name, Array& array) {
    using Stored = ValuesOf<Array>;
    file_.put(state_path(name), reinterpret_cast<const typename Stored::Type*>(array.data()),
              static_cast<std::size_t>(array.size()) * Stored::count);
  }
  template <class Array>
  void growing(const std::string& name, Array& array) {
    fixed(name, array);
  }
  template <class Struct>
  void record(const std::string& name, Struct& one) {
    rows(name, &one, 1, columns_of(one));
  }
  template <class Struct>
  void records(const std::string& name, std::vector<Struct>& list) {
    Struct any{};
    rows(name, list.data(), list.size(), columns_of(any));
  }
  template <class Struct>
  void grown_records(const std::string& name, std::vector<Struct>& list) {
    records(name, list);
  }

 private:
  template <class Struct>
  void rows(const std::string& name, Struct* first, std::size_t count, const std::string& columns) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i)
      each_number_of(first[i], [&](const std::string&, auto& n) { numbers.push_back(static_cast<double>(n)); });
    file_.put(state_path(name), numbers.data(), numbers.size());
    file_.put_attribute(state_path(name), "columns", columns);
  }

  HdfFile& file_;
};

void put_text(HdfFile& file, const std::string& dataset, std::string_view text) {
  file.put(dataset, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

void put_scene(HdfFile& file, const Scene& scene) {
  put_text(file, "/scene/path", scene.source_path);
  put_text(file, "/scene/text", scene.source_text);
  int n = 0;
  for (const auto& [name, content] : scene.files) {
    const std::string group = "/scene/files/" + std::to_string(n++);
    put_text(file, group + "/name", name);
    put_text(file, group + "/content", content);
  }
}

void put_run(HdfFile& file, const RunSoFar& run) {
  put_text(file, "/run/history", run.history);
  file.put("/run/frames", run.frames.data(), run.frames.size());
  const double numbers[] = {run.wall_seconds, run.frame_interval, static_cast<double>(run.frames_due)};
  file.put("/run/numbers", numbers, std::size(numbers));
  for (std::size_t k = 0; k < run.retries.size(); ++k) {
    const Retry& r = run.retries[k];
    const double all[] = {static_cast<double>(r.step), r.time, static_cast<double>(r.back_to), r.cfl};
    file.put(retry_path(k) + "/numbers", all, std::size(all));
    put_text(file, retry_path(k) + "/message", r.message);
  }
}

}  // namespace

template <class Real>
void write_checkpoint(const std::filesystem::path& path, const SimulationOf<Real>& m, const RunSoFar& so_far,
                      const std::function<void()>& before) {
  HdfFile file = HdfFile::create(path, checkpoint_header_bytes);
  put_scene(file, m.scene);
  put_run(file, so_far);
  // the visitor takes members as they are, to serve readers, too; this one changes none
  each_member(const_cast<SimulationOf<Real>&>(m), MemberWriter(file));
  file.commit([&](int descriptor) {
    seal_checkpoint(descriptor, path);
    if (before)
      before();
  });
}

#define RIVEN_WRITE_CHECKPOINT(Real)                                                                       \
  template void write_checkpoint(const std::filesystem::path&, const SimulationOf<Real>&, const RunSoFar&, \
                                 const std::function<void()>&);
RIVEN_EACH_REAL(RIVEN_WRITE_CHECKPOINT)
#undef RIVEN_WRITE_CHECKPOINT

}  // namespace riven
