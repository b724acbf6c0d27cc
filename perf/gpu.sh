#!/usr/bin/env bash
# Tests and measures the CUDA space on the GPU of this machine: ./perf/gpu.sh [tests|sanitizer|throughput]...
# All three without arguments. Needs nvcc, compute-sanitizer and the packages of packages.txt.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=build/cuda
cmake --preset cuda >/dev/null
cmake --build "$build" -j "$(nproc)" --target riven riven-perf test_core test_kernels test_physics

for part in ${*:-tests sanitizer throughput}; do
  case $part in
    tests)  # every space, the device's among them; over long runs, too
      "$build/tests/test_core"
      "$build/tests/test_kernels"
      "$build/tests/test_physics" --gtest_filter='Spaces.*' --gtest_also_run_disabled_tests
      ;;
    sanitizer)  # accesses out of bounds, and threads of a team that do not wait for each other
      for tool in memcheck racecheck; do
        compute-sanitizer --tool "$tool" --error-exitcode 1 "$build/tests/test_kernels" --gtest_filter='Device.*'
        compute-sanitizer --tool "$tool" --error-exitcode 1 "$build/tests/test_physics" \
          --gtest_filter='Spaces.AgreeOnAPlateWithGrowingCracks'
      done
      ;;
    throughput)  # million particle-steps per second beside the processor's
      nvidia-smi --query-gpu=name,memory.total --format=csv,noheader
      "$build/riven-perf" throughput --only device,block
      ;;
    *)
      echo "unknown part '$part': tests, sanitizer or throughput" >&2
      exit 2
      ;;
  esac
done
