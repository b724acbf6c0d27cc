#!/usr/bin/env bash
# Builds riven and runs one scene: ./run.sh [SCENE] [options of `riven run`]
#   SCENE    a file, or the name of a shipped scene (`build/release/riven cases` lists them); ten_cracks by default
#   options  for example  -o DIR  --set solver.cfl=0.3  --threads 4  --exec stdpar
# Results go to results/NAME unless -o says otherwise. Installs missing Debian packages first.
# Pictures are drawn as the scene says in lines such as  `# draw: --field sigma_yy --magnify 20`  (the options of
# `riven picture`), or else of the von Mises stress.
start=$PWD
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

case "${1:-}" in
  -h | --help)
    sed -n '2,/^[^#]/s/^# \{0,1\}//p' run.sh
    exit 0
    ;;
  "" | -*) scene=ten_cracks ;;
  *)
    scene=$1
    shift
    ;;
esac
[ -f "$start/$scene" ] && scene=$start/$scene
out=$PWD/results/$(basename "$scene" .toml)
options=()
while [ $# -gt 0 ]; do
  case "$1" in
    -o | --output)
      out=${2:?"$1 needs a folder"}
      shift
      ;;
    --output=*) out=${1#*=} ;;
    *) options+=("$1") ;;
  esac
  shift
done
[[ $out == /* ]] || out=$start/$out

install_packages
say "Building"
build_targets riven
say "Running $scene"
"$build/riven" run "$scene" -o "$out" "${options[@]}"

say "Drawing"
file=$scene
[ -f "$file" ] || file=cases/scenes/$scene.toml
pictures=$(sed -n 's/^# draw: *//p' "$file")
riven=$PWD/$build/riven
while read -r picture; do
  (cd "$out" && xargs "$riven" picture . <<<"$picture")  # which takes quotes as a shell does
done <<<"$pictures"
say "Results are in $out"
