#!/bin/sh
# Installs what is missing, builds, and runs all tests. Works from any folder; the build is in build/test of the clone.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
. "$root/tests/setup.sh"
need_packages g++ gcc gfortran cmake ninja-build libgtest-dev libpng-dev libcli11-dev pkg-config python3 clang libclang-rt-14-dev binutils
mkdir -p "$root/build/test"
cmake -S "$root" -B "$root/build/test" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCARREAU_BENCH=ON >"$root/build/test/configure.log" 2>&1 || {
  cat "$root/build/test/configure.log" >&2
  exit 1
}
cmake --build "$root/build/test" -j "$(jobs)"
exec ctest --test-dir "$root/build/test" -j "$(jobs)" --output-on-failure
