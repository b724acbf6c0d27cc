#include "io/checkpoint_store.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/error.hpp"
#include "core/exec/timers.hpp"
#include "io/atomic_file.hpp"

namespace riven {
namespace fs = std::filesystem;

namespace {

constexpr const char* newest = "checkpoint.h5";
constexpr const char* previous = "checkpoint.previous.h5";

void clear_away(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error)
    fail_file(path, "remove the file", error.value());
}

/// Empty where there is none: a killed run has left none.
nlohmann::json summary_of(const fs::path& folder) {
  std::ifstream in(folder / "summary.json");
  nlohmann::json summary = nlohmann::json::parse(in, nullptr, false);
  return summary.is_object() ? std::move(summary) : nlohmann::json::object();
}

/// Is it a table of a run, whose first line begins so, or one that a killed run has left empty?
bool is_table(const fs::path& path, std::string_view begin) {
  std::ifstream in(path);
  std::string line;
  return !std::getline(in, line) || line.starts_with(begin);
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::equivalent(a, b, error);
}

}  // namespace

void refuse_to_remove_results(const fs::path& folder, const std::string& scene) {
  const nlohmann::json summary = summary_of(folder);
  for (const auto& [name, begin] :
       {std::pair{"history.csv", "time [s],"}, {"events.csv", "time [s],"}, {"crack_paths.csv", "crack,point,"}})
    if (!is_table(folder / name, begin))
      fail({Exit::file, "this folder holds a file of this name that no run has written", (folder / name).string(), "",
            "a folder that is new, or holds results", "-o names another folder; --overwrite removes what is there"});
  const std::string status = summary.value("status", "interrupted"), there = summary.value("scene", scene);
  std::error_code error;
  if (status == "interrupted" && fs::exists(folder / newest, error))
    fail({Exit::file, "this folder holds a run that was interrupted and can go on", folder.string(), newest,
          "a folder without an unfinished run",
          fmt::format("riven run --restart {} goes on with it; -o names another folder; --overwrite begins anew",
                      folder.string())});
  if (there != scene)
    fail({Exit::file, "this folder holds the results of another scene", folder.string(), there,
          fmt::format("a folder that is new, or holds results of {}", scene),
          "-o names another folder; --overwrite removes what is there"});
}

CheckpointFile find_checkpoint(const fs::path& at) {
  std::error_code error;
  if (!fs::exists(at, error))
    fail({Exit::file, "there is no such folder or file to restart from", at.string(), "", newest,
          "the folder of results of a run that was interrupted"});
  if (!fs::is_directory(at, error))
    return CheckpointFile(at);
  const fs::path file = at / newest, before = at / previous;
  if (!fs::exists(before, error)) {
    if (!fs::exists(file, error))
      fail({Exit::file, "there is no checkpoint in this folder", at.string(), "", newest,
            "the folder of results of a run that was interrupted"});
    return CheckpointFile(file);
  }
  if (!fs::exists(file, error))
    return CheckpointFile(before);
  try {
    return CheckpointFile(file);
  } catch (const Error& e) {
    try {
      CheckpointFile older(before);
      fmt::print(stderr, "riven: warning: {}\n  instead: {}\n", e.what(), before.string());
      return older;
    } catch (const Error&) {
    }
    throw;
  }
}

CheckpointStore::CheckpointStore(fs::path folder, const Output& when, const CheckpointFile* from)
    : folder_(std::move(folder)),
      every_(when.checkpoint_every),
      steps_(when.checkpoint_steps),
      newest_is_good_(from && same_file(from->path(), folder_ / newest)),
      last_(exec::Stopwatch::now()) {
  for (const char* name : {newest, previous}) {
    clear_away(AtomicFile::temporary_name(folder_ / name));
    if (!from || !same_file(from->path().parent_path(), folder_))
      clear_away(folder_ / name);
  }
}

bool CheckpointStore::due(long step) const {
  return (steps_ > 0 && step % steps_ == 0) || (every_ > 0 && exec::Stopwatch::now() - last_ >= every_);
}

/// There is a newest one at any time, by a second name for the present one where the file system has such.
void CheckpointStore::keep_newest() const {
  const fs::path file = folder_ / newest, before = folder_ / previous, other = AtomicFile::temporary_name(before);
  if (!newest_is_good_)
    return;
  ::unlink(other.c_str());
  const bool linked = ::link(file.c_str(), other.c_str()) == 0;
  if (::rename((linked ? other : file).c_str(), before.c_str()) != 0 && errno != ENOENT)
    fail_file(before, "put the file in place", errno);
  ::unlink(other.c_str());  // which is left when a kill came here before, and both are one file already
}

template <class Real>
void CheckpointStore::write(const SimulationOf<Real>& m, const RunSoFar& so_far) {
  write_checkpoint(folder_ / newest, m, so_far, [this] { keep_newest(); });
  newest_is_good_ = true;
  last_ = exec::Stopwatch::now();
}

#define RIVEN_CHECKPOINT_STORE(Real) template void CheckpointStore::write(const SimulationOf<Real>&, const RunSoFar&);
RIVEN_EACH_REAL(RIVEN_CHECKPOINT_STORE)
#undef RIVEN_CHECKPOINT_STORE

}  // namespace riven
