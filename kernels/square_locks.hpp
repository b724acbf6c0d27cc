// Locks for squares of nodes that several tiles add to: one atomic operation for a square, where atomic additions would
// take five for each of its nodes.
#pragma once
#include <atomic>
#include <thread>
#include <vector>

#include "core/state/grid.hpp"
#include "kernels/tile_reads.hpp"

namespace riven {

class SquareLocks {
 public:
  static constexpr int edge = 4;  ///< nodes; squares begin where tiles' reaches do

  explicit SquareLocks(const Lattice& lattice)
      : across_(number(lattice.nx) + 1),
        flags_(static_cast<size_t>(across_) * static_cast<size_t>(number(lattice.ny) + 1)) {}

  /// Holds the lock of the square whose lower left node is (x, y) for as long as it lives.
  class Hold {
   public:
    Hold(SquareLocks& locks, int x, int y)
        : flag_(locks.flags_[static_cast<size_t>(long{number(y)} * locks.across_ + number(x))]) {
      while (flag_.test_and_set(std::memory_order_acquire))
        std::this_thread::yield();
    }
    ~Hold() { flag_.clear(std::memory_order_release); }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    std::atomic_flag& flag_;
  };

 private:
  static int number(int node) { return (node + tile_margin) / edge; }

  int across_;
  std::vector<std::atomic_flag> flags_;
};

}  // namespace riven
