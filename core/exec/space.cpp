#include "core/exec/space.hpp"

#include <omp.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <execution>
#include <vector>

#include "core/error.hpp"
#include "core/exec/counting.hpp"
#include "core/exec/device.hpp"

namespace riven::exec {

namespace {

/// A range of tasks that begins with one thread, and that others help with when they are done with their own.
struct alignas(64) Share {
  std::atomic<long> next;
  long end;
};

/// Thread t begins with the t-th part of [0, n): in all launches of a step with the same part of the grid and of the
/// particles, whose lines stay in its cache.
void run_by_openmp(int threads, long n, void (*task)(const void*, long), const void* of) {
  std::vector<Share> shares(static_cast<size_t>(threads));
  for (int t = 0; t < threads; ++t) {
    shares[static_cast<size_t>(t)].next = n * t / threads;
    shares[static_cast<size_t>(t)].end = n * (t + 1) / threads;
  }
#pragma omp parallel num_threads(threads)
  for (int k = 0, own = omp_get_thread_num(); k < threads; ++k) {
    Share& share = shares[static_cast<size_t>((own + k) % threads)];
    for (long i; (i = share.next.fetch_add(1, std::memory_order_relaxed)) < share.end;)
      task(of, i);
  }
}

}  // namespace

struct Space::Arena : tbb::task_arena {
  using tbb::task_arena::task_arena;
};

Space::Space(Kind kind, int threads)
    : kind_(kind), threads_(kind == Kind::serial ? 1 : std::max(1, threads)), timers_(kind == Kind::cuda) {
  if (kind_ == Kind::stdpar)
    arena_ = std::make_unique<Arena>(threads_);
  if (std::string why_not; !available(kind, &why_not))
    fail({Exit::bad_input, why_not, "--exec or solver.exec", name(kind), "a space that is there", "openmp"});
}

Space::~Space() = default;

void Space::run(long n, void (*task)(const void* of, long i), const void* of) const {
  // waking threads for a single task costs more than the task
  switch (n <= 1 ? Kind::serial : kind_) {
    case Kind::serial:
      for (long i = 0; i < n; ++i)
        task(of, i);
      break;
    case Kind::openmp:
    case Kind::cuda: run_by_openmp(threads_, n, task, of); break;
    case Kind::stdpar:
      // par, not par_unseq: kernels may use atomics
      arena_->execute(
          [&] { std::for_each(std::execution::par, Counting{0}, Counting{n}, [=](long i) { task(of, i); }); });
      break;
  }
}

bool available(Kind kind, std::string* why_not) {
  if (kind != Kind::cuda)
    return true;
#if defined(RIVEN_DEVICE)
  const device::Found found = device::find();
#else
  const device::Found found{false, "this build has no CUDA space (RIVEN_CUDA)"};
#endif
  if (!found.any && why_not)
    *why_not = found.name;
  return found.any;
}

const char* name(Kind kind) {
  switch (kind) {
    case Kind::serial: return "serial";
    case Kind::openmp: return "openmp";
    case Kind::stdpar: return "stdpar";
    case Kind::cuda: return "cuda";
  }
  return "?";
}

bool parse(const std::string& text, Kind& kind) {
  for (Kind k : {Kind::serial, Kind::openmp, Kind::stdpar, Kind::cuda})
    if (text == name(k))
      return kind = k, true;
  return false;
}

int available_threads() {
  return omp_get_num_procs();
}

}  // namespace riven::exec
