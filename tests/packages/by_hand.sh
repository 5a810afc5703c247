#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# by_hand.sh TREE WORK FORTRAN: the program of the manual by the command line of README, with sources of the installed tree;
# then the same with its modules and libraries.
set -eu
tree=$1 work=$2 fortran=$3
case=$(CDPATH='' cd -- "$(dirname -- "$0")/../cabi/paraboloid" && pwd)
rm -rf -- "$work"
mkdir -p -- "$work"
cp "$case/cad_m.f90" "$case/x.pardom" "$(dirname -- "$0")/blsurf/blsurf.env" "$work"
cd -- "$work"
F=$tree/share/carreau/fortran
"$fortran" cad_m.f90 "$F/carreau_c.f90" "$F/carreau.f90" "$F/blsurf_m.f90" "$F/blsurf.f90" \
  "-L$tree/lib" -lcarreau "-Wl,-rpath,$tree/lib" -o blsurf
./blsurf
# 216 boundary edges: RT-0232 sec. 6.1.
awk '$1 == "Edges" { getline n; found = (n + 0 ? n : $2) } END { exit found + 0 != 216 }' x.mesh
mv x.mesh first.mesh

mkdir modules
cd modules
modules=$(find "$tree/lib/fortran/modules/carreau" -name carreau.mod -exec dirname {} \;)
"$fortran" "-I$modules" ../cad_m.f90 "$F/blsurf_m.f90" "$F/blsurf.f90" "-L$tree/lib" -lcarreau_fortran -lcarreau \
  "-Wl,-rpath,$tree/lib" -o blsurf
cp ../x.pardom ../blsurf.env .
./blsurf
cmp x.mesh ../first.mesh
