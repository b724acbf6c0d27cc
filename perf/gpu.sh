#!/usr/bin/env bash
# Tests and measures the CUDA space on the GPU of this machine: ./perf/gpu.sh [PART]...
# All parts without arguments. Needs nvcc, compute-sanitizer and the packages of packages.txt; `large` 64 GiB of memory.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=build/cuda
all="tests physics stability sanitizer throughput large cracks"
parts=${*:-$all}
for part in $parts; do
  [[ " $all " == *" $part "* ]] || { echo "unknown part '$part'; there are: $all" >&2; exit 2; }
done
cmake --preset cuda >/dev/null
cmake --build "$build" -j "$(nproc)" --target riven riven-perf \
  test_core test_kernels test_physics test_io test_stability

# million particle-steps per second, what share of a copy's bandwidth that is, and the share of each kernel by events
measure() {
  nvidia-smi --query-gpu=name,memory.total --format=csv,noheader
  "$build/riven-perf" throughput --threads "$(nproc)" --only "$1"
}

for part in $parts; do
  case $part in
    tests)  # what compares spaces, the device's among them, over long runs, too; and what else is quick, there
      "$build/tests/test_core"
      "$build/tests/test_kernels"
      "$build/tests/test_physics" --gtest_filter='Spaces.*' --gtest_also_run_disabled_tests
      RIVEN_TEST_EXEC=cuda "$build/tests/test_kernels"
      RIVEN_TEST_EXEC=cuda "$build/tests/test_io"
      ;;
    physics) RIVEN_TEST_EXEC=cuda "$build/tests/test_physics" ;;
    stability) RIVEN_TEST_EXEC=cuda "$build/tests/test_stability" ;;
    sanitizer)  # accesses out of bounds, and threads of a team that do not wait for each other
      for tool in memcheck racecheck; do
        RIVEN_TEST_EXEC=cuda compute-sanitizer --tool "$tool" --error-exitcode 1 "$build/tests/test_kernels"
        compute-sanitizer --tool "$tool" --error-exitcode 1 "$build/tests/test_physics" \
          --gtest_filter='Spaces.AgreeOnAPlateWithGrowingCracks'
      done
      ;;
    throughput) measure device,block ;;  # 1, 4 and 16 million particles, and the processor's rate
    large) measure device-large ;;       # 64 million
    cracks) measure device-cracks ;;     # 200 cracks among 16 million
  esac
done
