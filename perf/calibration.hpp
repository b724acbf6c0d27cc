// What the machine gives a computation like riven's at this moment: frequency, caches and memory are shared with others
// and change by the minute, so that a time means something only beside another one taken with it.
#pragma once
#include <vector>

namespace riven::perf {

/// Processor time of this thread, s: what others do on the same core does not count.
double cpu_seconds();

/// Work of a fixed size that must never change, since baselines are ratios to its time. A round holds, all of them for
/// about as long on a quiet machine: independent multiply-adds in registers; sums of arrays in the first and in the
/// second cache; additions to an array in the third and to the next part of one beyond all caches; a plain transfer of
/// particles to nine nodes and back, with gathers, floors and divisions; and unforeseeable branches on integers.
class Calibration {
 public:
  Calibration();
  /// Mean processor time of a round, s, over as many rounds as take about `seconds`: a scene and the rounds after it
  /// are disturbed alike only if they last alike.
  double round_over(double seconds);

 private:
  void round();
  void sum_in_cache();
  void stream();
  void transfer();
  void branch();

  std::vector<double> near_, middle_, cached_, distant_, x_, y_, v_, nodes_;
  long next_ = 0;
  double sum_ = 0;
  unsigned integer_ = 1;
};

}  // namespace riven::perf
