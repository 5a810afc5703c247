#!/bin/sh
# Installs what is missing, builds, and meshes the Utah teapot through its Fortran host: mesh, VTU and picture in out/teapot.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
. "$root/tests/setup.sh"
need_packages g++ gcc gfortran cmake ninja-build libpng-dev libcli11-dev
build=$root/build/examples
out=$root/out/teapot
mkdir -p "$build" "$out"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCARREAU_TESTS=OFF >"$build/configure.log" 2>&1 || {
  cat "$build/configure.log" >&2
  exit 1
}
cmake --build "$build" -j "$(jobs)"
cd "$root/fortran_examples/teapot"
cp x.pardom blsurf.env teapot.bpt "$out/"
cd "$out"
"$build/fortran_examples/blsurf_teapot"
command=$build/cad_adapters/command/carreau
"$command" check teapot.mesh
"$command" picture teapot.mesh -o teapot.png
echo
echo "The mesh and its picture are in $out:"
ls -l teapot.mesh teapot.vtu teapot.png
