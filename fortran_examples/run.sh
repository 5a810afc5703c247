#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs missing packages, builds, and meshes the Utah teapot through its Fortran host. Then out/teapot of the clone holds
# the mesh for Medit and Gmsh (.mesh), for ParaView (.vtu), and a picture (.png).
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
. "$root/tests/setup.sh"
need_packages g++ gcc gfortran cmake ninja-build libpng-dev zlib1g-dev libcli11-dev libeigen3-dev libopenexr-dev libtbb-dev nlohmann-json3-dev
out=$root/out/teapot
# A build that exists serves; a new one leaves out CAD files, .med files and Python, which the teapot does not need.
build=$root/build/release
if [ -e "$build/CMakeCache.txt" ]; then
  set --
else
  build=$root/build/teapot
  set -- -DCARREAU_OPENCASCADE=OFF -DCARREAU_MED=OFF -DCARREAU_PYTHON=OFF
fi
echo "Step 1 of 3: configure $build"
configure "$root" "$build" -DCMAKE_BUILD_TYPE=Release -DCARREAU_FORTRAN=ON "$@"
echo "Step 2 of 3: compile the library, the host and the command; the first time this takes about $((9 / $(processors) + 1)) minutes on $(processors) processors"
cmake --build "$build" -j "$(processors)" --target blsurf_teapot carreau_command

mkdir -p "$out"
cd "$root/fortran_examples/teapot"
cp x.pardom blsurf.env teapot.bpt "$out"
cd "$out"
rm -f teapot.mesh teapot.vtu teapot.png
echo
echo "Step 3 of 3: mesh the teapot"
echo "Teapot of 32 Bezier patches, edges of length 0.1:"
start=$(date +%s%N)
"$build/fortran_examples/blsurf_teapot"
end=$(date +%s%N)
"$build/cad_adapters/command/carreau" check teapot.mesh --allow-crossings  # its spout and handle run into its body
echo "time        $(((end - start) / 1000000)) ms, reading and writing files included"
"$build/cad_adapters/command/carreau" picture teapot.mesh -o teapot.png --size 1600x1100
echo
echo "Written in $out:"
ls -l teapot.mesh teapot.vtu teapot.png
