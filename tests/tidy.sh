#!/usr/bin/env bash
# clang-tidy with the checks of .clang-tidy:  tests/tidy.sh BUILD_DIR [--changed | FILE...]
# --changed looks only at sources that differ from the commit before the last one; without files, at all of them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:?"usage: tests/tidy.sh BUILD_DIR [--changed | FILE...]"}
shift
case "${1:-}" in
  "") mapfile -t files < <(git ls-files '*.cpp') ;;
  --changed) mapfile -t files < <(git diff --name-only --diff-filter=d HEAD~1 -- '*.cpp' 2>/dev/null || git ls-files '*.cpp') ;;
  *) files=("$@") ;;
esac
# fuzz targets are compiled on demand and have no entry among the compile commands
mapfile -t files < <(printf '%s\n' "${files[@]}" | grep -vE '^(tests/fuzz/.*)?$' || true)
[ ${#files[@]} -gt 0 ] || exit 0
# clang cannot read GCC's precompiled headers: every source includes what it uses
commands=$(mktemp -d)
trap 'rm -rf "$commands"' EXIT
sed -E 's/ -Winvalid-pch//; s/ -include [^ ]*cmake_pch\.hxx//' "$build/compile_commands.json" \
  >"$commands/compile_commands.json"
# GCC's omp.h, after all of clang's own headers
printf '%s\0' "${files[@]}" | xargs -0 -n1 -P "$(nproc)" clang-tidy -p "$commands" --quiet \
  --extra-arg=-idirafter"$(g++ -print-file-name=include)" --extra-arg=-Wno-everything
echo "tidy: ${#files[@]} files clean"
