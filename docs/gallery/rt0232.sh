#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# rt0232.sh: builds and runs the examples of RT-0232 sec. 6 in the folder runs.
set -e
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
F=$(pkg-config --variable=fortrandir carreau)
example() {  # FOLDER SOURCE...: the program blsurf of an example, in a separate folder
  mkdir -p runs/$1 && cp "$root"/fortran_examples/$1/*.env "$root"/fortran_examples/$1/*.pardom "$root"/fortran_examples/teapot/teapot.bpt runs/$1
  gfortran -J runs/$1 $2 "$root"/fortran_examples/$1/cad_m.f90 $F/carreau_c.f90 $F/carreau.f90 $F/blsurf_m.f90 $F/blsurf.f90 $(pkg-config --libs carreau) -o runs/$1/blsurf
}
example paraboloid
example teapot "$root"/fortran_examples/teapot/bezier_m.f90
example teapot_front "$root/fortran_examples/teapot/bezier_m.f90 $root/fortran_examples/teapot_front/spout_m.f90"
(cd runs/paraboloid && ./blsurf blsurf.env && ./blsurf coarse.env && ./blsurf curves.env)
(cd runs/teapot && ./blsurf blsurf.env)
cd runs/teapot_front
for env in blsurf geometric8 geometric16; do ./blsurf $env.env; done
for env in patch patch_minimum patch_geometric patch_and_geometry; do TEAPOT_SIZES=patch ./blsurf $env.env; done
for env in point_linear point_geometric; do TEAPOT_SIZES=point ./blsurf $env.env; done
