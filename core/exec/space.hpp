// Execution spaces: where a kernel runs. Chosen at run time, one program holds them all.
#pragma once
#include <memory>
#include <string>

#include "core/exec/timers.hpp"

namespace riven::exec {

enum class Kind { serial, openmp, stdpar, cuda };

/// A place to run kernels, with its thread count and the timers that every launch reports to. With a device the threads
/// are those of what runs beside it on the host.
class Space {
 public:
  /// Throws Error (bad input) for a device that is not there.
  explicit Space(Kind kind = Kind::serial, int threads = 1);
  Space(const Space&) = delete;
  Space& operator=(const Space&) = delete;
  ~Space();

  Kind kind() const { return kind_; }
  int threads() const { return threads_; }
  bool on_device() const { return kind_ == Kind::cuda; }
  Timers& timers() const { return timers_; }
  /// task(of, i) for i in [0, n) on the threads of this space. By a pointer: how threads share a range out is compiled
  /// once, not for every kernel.
  void run(long n, void (*task)(const void* of, long i), const void* of) const;

 private:
  struct Arena;

  Kind kind_;
  int threads_;
  std::unique_ptr<Arena> arena_;  ///< TBB's threads; only with StdPar
  mutable Timers timers_;
};

/// Whether such a space can be made here; else `why_not` says what is missing.
bool available(Kind kind, std::string* why_not = nullptr);
/// "serial", "openmp", "stdpar", "cuda".
const char* name(Kind kind);
/// Inverse of name(); false when the name is unknown.
bool parse(const std::string& text, Kind& kind);
/// Cores that this process may use.
int available_threads();

}  // namespace riven::exec
