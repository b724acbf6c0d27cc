// Arithmetic and traffic of tasks, counted and not estimated: callgrind says how often each instruction ran, how often
// it read and wrote, and which of that missed a simulated last-level cache; objdump says what each instruction is.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace riven::perf {

/// Per particle and step.
struct Operations {
  double instructions = 0;
  /// Additions, subtractions, multiplications, divisions and square roots, one for each lane of a vector, and two for a
  /// fused multiply-add; minima, comparisons, roundings and conversions are none.
  double flops = 0;
  /// Bytes that loads and stores move between registers and the first cache.
  double moved = 0;
  /// Bytes between the last-level cache and memory: lines that reads fetch and lines written back. As in the triad that
  /// it is held against, lines fetched only to be written over do not count. A line that one task leaves changed in the
  /// cache counts for the task that drives it out.
  double traffic = 0;

  Operations& operator+=(const Operations& o);
};

struct TaskOperations {
  std::string label;
  Operations operations;
};

/// What an instruction does each time that it runs.
struct Instruction {
  int flops = 0;
  int access = 8;  ///< bytes of each of its reads and writes, where it has any
};
/// Reads a line of `objdump -M intel` from behind its address, such as "vmulsd xmm0,xmm1,QWORD PTR [rax]".
Instruction classify(std::string_view text);

/// Bytes of the last-level cache of this machine.
long last_level_cache();

/// Runs `command` under callgrind with a last-level cache of so many bytes, and adds up what its dumps hold, task by
/// task. Throws Error (file) where valgrind or the program is missing, (internal) if callgrind and objdump disagree.
std::vector<TaskOperations> count_operations(const std::vector<std::string>& command, long cache);

}  // namespace riven::perf
