#!/usr/bin/env bash
# Installs what is missing (Debian packages), builds, and does one of:
#   run       the main job: Taylor impact of annealed copper; prints computed against measured, shows the figure
#   point     the point driver's job: 6061-T6 through 95 measured curves; prints the table, shows the figure
#   test      unit and verification tests
#   validate  figures of the laws, Taylor impacts and rate sticks against experiment, the gas against exact solutions
#             (validate NAME: one; --full: all; --list)
#   bench     nanoseconds per update and per particle-step, with the environment beside them
# Environment: BRISANCE_PRESET (default release; ci makes warnings errors), BRISANCE_JOBS (default: all cores).
set -euo pipefail
cd "$(dirname "$0")"

packages=(build-essential cmake ninja-build pkg-config libeigen3-dev librandom123-dev libboost-dev libhdf5-dev zlib1g-dev
          libtomlplusplus-dev libudunits2-dev libcli11-dev libfmt-dev libceres-dev libmuparser-dev libgtest-dev
          libgnuplot-iostream-dev gnuplot-nox libboost-iostreams-dev libboost-filesystem-dev libboost-system-dev)

usage() {
  sed -n '2,9s/^# \{0,1\}//p' "$0"
  exit 2
}

install_packages() {
  local missing=()
  for package in "${packages[@]}"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  echo "bootstrap: installing ${missing[*]}"
  local as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  "${as_root[@]}" apt-get update -qq
  DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

preset=${BRISANCE_PRESET:-release}
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive}  # waiting threads leave the cores to others
jobs=${BRISANCE_JOBS:-$(nproc)}
build=build/$preset

# build CMAKE_OPTION [TARGET]...: without targets everything
build() {
  cmake --preset "$preset" "$1" -Wno-dev >"build-$preset.log" 2>&1 || { cat "build-$preset.log"; exit 1; }
  rm -f "build-$preset.log"
  shift
  cmake --build "$build" -j "$jobs" ${1:+--target "$@"}
}

show() {  # on a desktop
  if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && command -v xdg-open >/dev/null; then xdg-open "$1" >/dev/null 2>&1 || true; fi
}

[ $# -ge 1 ] || usage
action=$1
shift
case $action in
  run)
    install_packages
    build -DBRISANCE_BUILD_TESTS=OFF brisance
    "$build/simulator/brisance" run data/cases/taylor_copper_190_mts.toml -o out/taylor_copper_190_mts --overwrite "$@"
    echo "figure: out/taylor_copper_190_mts/profile_bar.png"
    show out/taylor_copper_190_mts/profile_bar.png
    ;;
  point)
    install_packages
    build -DBRISANCE_BUILD_TESTS=OFF pointdriver
    mkdir -p out
    "$build/driver/pointdriver" compare data/cases/point_6061_t6.toml -o out/6061_t6.csv --plot out/6061_t6.png --plot out/6061_t6.svg "$@"
    show out/6061_t6.png
    ;;
  test)
    install_packages
    build -DBRISANCE_BUILD_TESTS=ON
    ctest --preset "$preset" -j "$jobs" "$@"
    ;;
  validate)
    install_packages
    build -DBRISANCE_BUILD_TESTS=OFF gallery ice_comparison taylor gas detonation
    case ${1:-} in
      "" | --full)
        missed=0  # one that misses a limit does not keep the others from being made
        for program in gallery ice_comparison detonation gas; do "$build/plots/$program" || missed=1; done
        "$build/plots/taylor" "$@" || missed=1
        exit $missed
        ;;
      --list)
        for program in gallery taylor gas; do "$build/plots/$program" --list; done
        echo "ice_comparison         the two schemes of the gas at a strong shock"
        echo "rate_sticks            sticks of ANFO against experiment"
        ;;
      ice_comparison) "$build/plots/ice_comparison" ;;
      rate_sticks) shift && "$build/plots/detonation" "$@" ;;
      taylor_*) "$build/plots/taylor" "$@" ;;
      gas_*) "$build/plots/gas" "$@" ;;
      *) "$build/plots/gallery" "$@" ;;
    esac
    ;;
  bench)
    install_packages
    build -DBRISANCE_BUILD_TESTS=ON bench bench_simulator bench_gas
    "$build/tests/bench"
    "$build/tests/bench_simulator" "$@"
    "$build/tests/bench_gas"
    ;;
  *) usage ;;
esac
