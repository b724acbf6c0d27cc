# Shared set-up of ./run.sh and ./test.sh; sourced, not run. Leaves the shell in the repository's root with
# `build` and `jobs` set. RIVEN_PRESET names another preset of CMakePresets.json than release.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
preset=${RIVEN_PRESET:-release}
build=build/$preset
jobs=${RIVEN_JOBS:-$(nproc)}
python=/usr/bin/python3  # Debian's: it sees python3-h5py, python3-numpy and python3-matplotlib

say() { printf '\n== %s\n' "$*"; }

# Installs the packages of packages.txt that are missing. Asks apt for nothing when all are there.
install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    say "This is no Debian: the tools and libraries of packages.txt must be there already"
    return
  fi
  local package present missing=""
  present=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n')
  for package in $(sed 's/#.*//' packages.txt); do
    grep -qx "installed $package" <<<"$present" || missing+=" $package"
  done
  [ -z "$missing" ] && return
  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "These Debian packages are missing, and neither root nor sudo is at hand to install them:" >&2
      echo "  apt-get install --no-install-recommends$missing" >&2
      exit 4
    fi
    root=(sudo)
  fi
  say "Installing$missing"
  "${root[@]}" apt-get update -qq
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing
}

# build_targets [TARGET...]: configures the preset and builds the targets (everything without one).
build_targets() {
  local log
  log=$(mktemp)
  if ! cmake --preset "$preset" -DRIVEN_WERROR="${RIVEN_WERROR:-OFF}" -DRIVEN_TIDY="${RIVEN_TIDY:-OFF}" \
    -DRIVEN_GATE="${RIVEN_GATE:-OFF}" ${RIVEN_ARCH:+-DRIVEN_ARCH="$RIVEN_ARCH"} >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    exit 1
  fi
  rm -f "$log"
  cmake --build "$build" -j "$jobs" ${1:+--target "$@"}
}
