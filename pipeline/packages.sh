#!/bin/sh
# SPDX-License-Identifier: AGPL-3.0-or-later
# Installs what is missing from Debian: packages.sh build|solve|check|check-long. `build` is what the programs need,
# `solve` also the flow solver, `check` also what the tests hold them against: programs of others, `check-long` another
# MPI and a browser too.
set -eu

build="gcc g++ cmake make python3 pkg-config libfyaml-dev libjansson-dev libcmocka-dev libcairo2-dev
  libopenmpi-dev openmpi-bin libhdf5-dev libcgns-dev libcgal-dev libtet1.5-dev
  libocct-foundation-dev libocct-modeling-data-dev libocct-modeling-algorithms-dev libocct-ocaf-dev
  libocct-data-exchange-dev"
other_mpi="libmpich-dev mpich iproute2"
browser="chromium"
judges="cgns-convert code-saturne gmsh python3-gmsh python3-vtk9 openfoam tetgen valgrind"

case "${1:-}" in
build) wanted=$build ;;
solve) wanted="$build openfoam" ;;
check) wanted="$build $judges" ;;
check-long) wanted="$build $judges $other_mpi $browser" ;;
*) echo "packages: usage: packages.sh build|solve|check|check-long" >&2; exit 2 ;;
esac

if ! command -v dpkg-query > /dev/null; then
  echo "packages: this is no Debian system; going on without a look at its packages" >&2
  exit 0
fi
missing=
for package in $wanted; do
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || :)" = installed ] ||
    missing="$missing $package"
done
[ -n "$missing" ] || exit 0

root=
if [ "$(id -u)" -ne 0 ]; then
  if command -v sudo > /dev/null && { sudo -n true 2> /dev/null || [ -t 0 ]; }; then
    root=sudo
  else
    echo "packages: error: neither root nor sudo; let somebody run: apt-get install --no-install-recommends$missing" >&2
    exit 1
  fi
fi

# $1: what failed. Its last lines tell why.
fail() {
  tail -n 15 "$log" >&2
  echo "packages: error: $1 failed; missing:$missing" >&2
  exit 1
}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "packages: installing$missing" >&2
# One source that does not answer does not matter where the others have the packages: the install tells.
$root apt-get update -q > "$log" 2>&1 || echo "packages: apt-get update had errors; going on" >&2
$root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing >> "$log" 2>&1 ||
  fail "apt-get install"
