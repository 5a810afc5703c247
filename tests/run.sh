#!/bin/sh
# Installs what is missing, builds, and runs all tests. Works from any folder; the build is in build/test of the clone.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
. "$root/tests/setup.sh"
# clang and libclang-rt-dev: fuzzing. openexr: its tools read our files.
need_packages g++ gcc gfortran cmake ninja-build pkg-config python3 binutils locales \
  libocct-data-exchange-dev libocct-ocaf-dev libocct-visualization-dev libocct-modeling-algorithms-dev \
  libocct-modeling-data-dev libocct-foundation-dev \
  libgtest-dev libmuparser-dev libpng-dev zlib1g-dev libcli11-dev libeigen3-dev libopenexr-dev libtbb-dev nlohmann-json3-dev openexr zsh fish groff-base clang libclang-rt-dev
build=$root/build/test
configure "$root" "$build" -DCMAKE_BUILD_TYPE=Release -DCARREAU_BENCH=ON
cmake --build "$build" -j "$(processors)"
cd "$build"
exec ctest -j "$(processors)" --output-on-failure
