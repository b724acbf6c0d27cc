#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "core/error.hpp"
#include "io/checkpoint.hpp"
#include "io/checkpoint_header.hpp"
#include "io/checkpoint_members.hpp"
#include "io/read_scene.hpp"
#include "kernels/make_derived.hpp"

namespace riven {

namespace {

using namespace checkpoint;

[[noreturn]] void misfit(const HdfFile& file, const std::string& dataset, std::string value = {},
                         std::string limit = {}) {
  fail({Exit::file, "the checkpoint does not fit its scene: " + dataset, file.path().string(), std::move(value),
        std::move(limit), "the version of riven that wrote it"});
}

void require_count(const HdfFile& file, const std::string& dataset, std::size_t count, std::size_t wanted) {
  if (count != wanted)
    misfit(file, dataset, fmt::format("{} items", count), fmt::format("{} items", wanted));
}

class MemberReader {
 public:
  explicit MemberReader(const HdfFile& file) : file_(file) {}

  template <class Array>
  void fixed(const std::string& name, Array& array) {
    take(name, array, [&](std::size_t count) {
      require_count(file_, state_path(name), count, static_cast<std::size_t>(array.size()));
    });
  }
  template <class Array>
  void growing(const std::string& name, Array& array) {
    take(name, array, [&](std::size_t count) { array.resize(static_cast<decltype(array.size())>(count)); });
  }
  template <class Struct>
  void record(const std::string& name, Struct& one) {
    const std::vector<double> numbers = read_rows(name, one);
    require_count(file_, state_path(name), numbers.size(), width_of(one));
    put_rows(name, &one, 1, numbers);
  }
  template <class Struct>
  void records(const std::string& name, std::vector<Struct>& list) {
    Struct any{};
    const std::vector<double> numbers = read_rows(name, any);
    require_count(file_, state_path(name), numbers.size(), list.size() * width_of(any));
    put_rows(name, list.data(), list.size(), numbers);
  }
  template <class Struct>
  void grown_records(const std::string& name, std::vector<Struct>& list) {
    Struct any{};
    const std::vector<double> numbers = read_rows(name, any);
    const std::size_t width = width_of(any);
    list.assign(numbers.size() / width, any);
    require_count(file_, state_path(name), numbers.size(), list.size() * width);
    put_rows(name, list.data(), list.size(), numbers);
  }

 private:
  template <class Array, class Size>
  void take(const std::string& name, Array& array, const Size& size) {
    using Stored = ValuesOf<Array>;
    const auto values = file_.read<typename Stored::Type>(state_path(name));
    const std::size_t count = values.size() / Stored::count;
    size(count);
    if (count > 0)
      std::memcpy(static_cast<void*>(array.data()), values.data(), count * Stored::count * sizeof(values[0]));
  }

  template <class Struct>
  static std::size_t width_of(Struct& s) {
    std::size_t n = 0;
    each_number_of(s, [&](const std::string&, auto&) { ++n; });
    return n;
  }

  template <class Struct>
  std::vector<double> read_rows(const std::string& name, Struct& any) const {
    const std::string columns = file_.text_attribute(state_path(name), "columns"), known = columns_of(any);
    if (columns != known)
      misfit(file_, state_path(name), columns, known);
    return file_.read<double>(state_path(name));
  }

  template <class Struct>
  void put_rows(const std::string& name, Struct* first, std::size_t count, const std::vector<double>& numbers) const {
    auto from = numbers.begin();
    for (std::size_t i = 0; i < count; ++i)
      each_number_of(first[i], [&](const std::string& column, auto& to) { put(name, column, *from++, to); });
  }

  template <class Number>
  void put(const std::string& name, const std::string& column, double stored, Number& to) const {
    constexpr double most = 9007199254740992;  // whole numbers are exact up to here
    if constexpr (std::is_floating_point_v<Number>) {
      to = stored;
    } else if (std::abs(stored) <= most) {
      to = static_cast<Number>(static_cast<long>(stored));
    } else {
      misfit(file_, state_path(name) + " " + column, fmt::format("{}", stored), "a whole number");
    }
  }

  const HdfFile& file_;
};

/// Arrays of crack points all hold as many, or none.
void check_points(const HdfFile& file, const Cracks& c) {
  if (!std::is_sorted(c.start.begin(), c.start.end()) || c.start[0] != 0)
    misfit(file, state_path("cracks/start"));
  for (const long size : {c.crack.size(), c.serial.size(), c.plane.size(), c.upper.size(), c.lower.size()})
    require_count(file, state_path("cracks"), static_cast<std::size_t>(size), static_cast<std::size_t>(c.points()));
  c.each_point_array([&](const auto& a) {
    require_count(file, state_path("cracks"), static_cast<std::size_t>(a.size()), static_cast<std::size_t>(c.points()));
  });
}

}  // namespace

CheckpointFile::CheckpointFile(const std::filesystem::path& path)
    : file_((verify_checkpoint(path), HdfFile::open(path))) {}

std::string CheckpointFile::text(const std::string& dataset) const {
  const auto bytes = file_.read<std::uint8_t>(dataset);
  return {bytes.begin(), bytes.end()};
}

Scene CheckpointFile::scene(const std::vector<std::string>& overrides) const {
  std::map<std::string, std::string> files;
  if (file_.has("/scene/files"))
    for (const std::string& number : file_.children("/scene/files"))
      files[text("/scene/files/" + number + "/name")] = text("/scene/files/" + number + "/content");
  return parse_scene(text("/scene/text"), text("/scene/path"), overrides, std::move(files));
}

template <class Real>
RunSoFar CheckpointFile::restore(SimulationOf<Real>& m) const {
  each_member(m, MemberReader(file_));
  check_points(file_, m.state.cracks);
  make_derived(m);
  RunSoFar run;
  const auto numbers = file_.read<double>("/run/numbers");
  require_count(file_, "/run/numbers", numbers.size(), 3);
  run.wall_seconds = numbers[0];
  run.frame_interval = numbers[1];
  run.frames_due = std::lround(numbers[2]);
  run.frames = file_.read<double>("/run/frames");
  run.history = text("/run/history");
  for (std::size_t k = 0; file_.has(retry_path(k)); ++k) {
    const auto all = file_.read<double>(retry_path(k) + "/numbers");
    require_count(file_, retry_path(k), all.size(), 4);
    run.retries.push_back({std::lround(all[0]), all[1], std::lround(all[2]), all[3], text(retry_path(k) + "/message")});
  }
  return run;
}

#define RIVEN_RESTORE(Real) template RunSoFar CheckpointFile::restore(SimulationOf<Real>&) const;
RIVEN_EACH_REAL(RIVEN_RESTORE)
#undef RIVEN_RESTORE

}  // namespace riven
