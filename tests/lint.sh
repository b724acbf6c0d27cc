#!/usr/bin/env bash
# What every tracked file must keep: the format of .clang-format, no path of one particular machine, no left-over
# marks, scripts that parse. Prints what breaks a rule and fails if anything does.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bad=0
complain() {
  echo "lint: $*" >&2
  bad=1
}

mapfile -t tracked < <(git ls-files --cached --others --exclude-standard | while read -r f; do [ -f "$f" ] && echo "$f"; done)
[ ${#tracked[@]} -gt 0 ] || complain "no files to look at; is this a git checkout?"
files_like() { printf '%s\n' "${tracked[@]}" | grep -E "$1" || true; }

mapfile -t sources < <(files_like '\.(cpp|hpp|cu)$')
clang-format --dry-run -Werror "${sources[@]}" || complain "run clang-format -i on the files above"

# the brackets keep these patterns from matching this file
if grep -InE '(^|[^[:alnum:]._-])/(home|root|work|mnt|media|Users)[/]' "${tracked[@]}"; then
  complain "a path that exists on one machine only"
fi
if grep -InwE 'TO[D]O|FIX[M]E|X[X]X|HAC[K]' "${tracked[@]}"; then
  complain "a left-over mark; do it or drop it"
fi
for header in $(files_like '\.hpp$'); do
  grep -q '^#pragma once$' "$header" || complain "$header: no #pragma once"
done
for script in $(files_like '(\.sh|^\.ci/run)$'); do
  bash -n "$script" || complain "$script: does not parse"
done
[ "$bad" -eq 0 ] && echo "lint: ${#tracked[@]} files, ${#sources[@]} of them C++: clean"
exit "$bad"
