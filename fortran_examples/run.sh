#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs missing packages, builds, and meshes the Utah teapot through its Fortran host. Then out/teapot of the clone holds
# the mesh for Medit and Gmsh (.mesh), for ParaView (.vtu), and a picture (.png).
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
. "$root/tests/setup.sh"
need_packages g++ gcc gfortran cmake ninja-build libpng-dev zlib1g-dev libcli11-dev libeigen3-dev libopenexr-dev libtbb-dev nlohmann-json3-dev
build=$root/build/release
out=$root/out/teapot
configure "$root" "$build" -DCMAKE_BUILD_TYPE=Release -DCARREAU_FORTRAN=ON
cmake --build "$build" -j "$(processors)" --target blsurf_teapot carreau_command

mkdir -p "$out"
cd "$root/fortran_examples/teapot"
cp x.pardom blsurf.env teapot.bpt "$out"
cd "$out"
rm -f teapot.mesh teapot.vtu teapot.png
echo
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
