// Sums over all items before each item: where lists begin that are laid one behind the other.
#pragma once
#include "core/exec/parallel.hpp"

namespace riven::exec {

inline namespace RIVEN_SIDE {

namespace detail {

/// Pieces of a chunk that the threads of a team sum by themselves.
#if defined(RIVEN_ON_DEVICE)
inline constexpr int scan_pieces = 64;
#else
inline constexpr int scan_pieces = 1;
#endif
inline constexpr long scan_piece = chunk / scan_pieces;

template <class T>
struct ScanPieces {
  T sum[scan_pieces];
};

/// f(i) for the items of piece t of chunk c.
template <class F>
RIVEN_INLINE void each_of_piece(long n, long c, long t, const F& f) {
  const long first = c * chunk + t * scan_piece, last = first + scan_piece, end = n < last ? n : last;
  for (long i = first; i < end; ++i)
    f(i);
}

}  // namespace detail

/// What a scan knows once all items have been summed. T: a plain struct, or a number, with +=.
template <class T, class Of>
struct Scan {
  const Space& space;
  long n;
  Of of;
  Array<T> before{};  ///< [chunks] of each
  T total{};
};

/// Sums of(i) over i in [0, n). Every sum is made in an order that depends on n alone.
template <class T, class Of>
Scan<T, Of> begin_scan(const Space& space, long n, const Of& of) {
  Scan<T, Of> scan{space, n, of};
  const long chunks = (n + chunk - 1) / chunk;
  scan.before.renew(chunks);
  parallel_teams<detail::ScanPieces<T>>(
      space, "sums before", chunks,
      [=, sum = data_to_fill(scan.before)] RIVEN_KERNEL(const Team& team, detail::ScanPieces<T>& own, long c) {
        team.each(detail::scan_pieces, [&](long t) {
          T piece{};
          detail::each_of_piece(n, c, t, [&](long i) { piece += of(i); });
          own.sum[t] = piece;
        });
        team.each(1, [&](long) {
          T all{};
          for (const T& piece : own.sum)
            all += piece;
          sum[c] = all;
        });
      });
  for (T& sum : scan.before) {
    const T own = sum;
    sum = scan.total;
    scan.total += own;
  }
  return scan;
}

/// put(i, sum of those before i) for all i, which returns of(i) once more. What it writes may be what of(i), but of no
/// other item, reads.
template <class T, class Of, class Put>
void end_scan(const Scan<T, Of>& scan, const Put& put) {
  const long n = scan.n;
  const Of of = scan.of;
  parallel_teams<detail::ScanPieces<T>>(
      scan.space, "sums before", scan.before.size(),
      [=, before = data(scan.before)] RIVEN_KERNEL(const Team& team, detail::ScanPieces<T>& own, long c) {
        if (detail::scan_pieces > 1)
          team.each(detail::scan_pieces, [&](long t) {
            T piece{};
            detail::each_of_piece(n, c, t, [&](long i) { piece += of(i); });
            own.sum[t] = piece;
          });
        team.each(detail::scan_pieces, [&](long t) {
          T sum = before[c];
          for (long k = 0; k < t; ++k)
            sum += own.sum[k];
          detail::each_of_piece(n, c, t, [&](long i) { sum += put(i, sum); });
        });
      });
}

}  // namespace RIVEN_SIDE

}  // namespace riven::exec
