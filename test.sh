#!/usr/bin/env bash
# Builds riven and runs every test: ./test.sh [options of ctest], for example  -R crack  or  -L kernels
# Installs missing Debian packages first, and VTK from PyPI into build/venv for reading results back.
# RIVEN_PRESET=sanitize tests another build; RIVEN_WERROR=ON makes warnings errors; RIVEN_TIDY=ON adds clang-tidy;
# RIVEN_GATE=ON adds the performance gate, which counts instructions of a build that valgrind can run, hence without
# AVX-512: a second one of some minutes, or on a machine that has no AVX-512 the one that is tested.
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

# Python with the VTK that ParaView is built on; made anew when what it shall hold changes.
make_venv() {
  local list=tests/requirements.txt venv=build/venv
  cmp -s "$list" "$venv/installed.txt" && return
  say "Installing $(grep -v '^#' "$list" | xargs) into $venv"
  rm -rf "$venv"
  "$python" -m venv "$venv" && "$venv/bin/pip" install --quiet -r "$list" && cp "$list" "$venv/installed.txt"
}

install_packages
make_venv || echo "Without VTK the tests that read results back will fail" >&2
counted=""
if [ "${RIVEN_GATE:-OFF}" = ON ]; then
  if grep -qw avx512f /proc/cpuinfo; then counted=apart; else export RIVEN_ARCH=x86-64-v3; fi
fi
say "Building"
build_targets
if [ "$counted" = apart ]; then
  say "Building what the performance gate counts"
  preset=v3 build=build/v3 build_targets riven-perf
fi
say "Testing"
export OMP_WAIT_POLICY=passive  # tests share the cores: threads that spin at a barrier keep each other from it
log=$build/test.log
code=0
ctest --test-dir "$build" --output-on-failure --no-tests=error -j "$jobs" "$@" | tee "$log" || code=$?

# ctest closes with "97% tests passed, 2 tests failed out of 60"
read -r failed total < <(sed -nE 's/.* ([0-9]+) tests? failed out of ([0-9]+)$/\1 \2/p' "$log" | tail -1) || true
echo "$((${total:-0} - ${failed:-0})) passed, ${failed:-0} failed"
exit "$code"
