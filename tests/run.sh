#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds, and runs all tests. Works from any folder; the build is in build/release of the clone.
set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
. "$root/tests/setup.sh"
# clang and libclang-rt-dev: fuzzing. openexr, python3-vtk9, python3-gmsh, python3-meshio: they read our files.
# chromium, chromium-driver, python3-selenium: a browser that shows reports. calculix-ccx: a solver that reads our .inp.
# tetgen, gmsh: they fill our surfaces. patchelf: wheels and archives that hold all libraries.
# libcgal-dev: its predicates find the same triangles that cross. python3-sphinx and what follows: the pages.
# libopenmpi-dev, openmpi-bin: many processes. dpkg-dev, file: cpack asks them what a package depends on.
need_packages g++ gcc gfortran cmake ninja-build pkg-config python3 binutils locales \
  libocct-data-exchange-dev libocct-ocaf-dev libocct-visualization-dev libocct-modeling-algorithms-dev \
  libocct-modeling-data-dev libocct-foundation-dev \
  libgtest-dev libmuparser-dev libmedc-dev libpng-dev zlib1g-dev libcli11-dev libeigen3-dev libopenexr-dev libtbb-dev nlohmann-json3-dev openexr gmsh zsh fish groff-base clang libclang-rt-dev \
  python3-vtk9 python3-gmsh python3-meshio libcgal-dev python3-numpy python3-pytest python3-pip python3-setuptools python3-wheel python3-venv mypy \
  chromium chromium-driver python3-selenium calculix-ccx tetgen patchelf \
  python3-sphinx python3-myst-parser furo doxygen python3-breathe \
  libopenmpi-dev openmpi-bin dpkg-dev file
build=$root/build/release
configure "$root" "$build" -DCMAKE_BUILD_TYPE=Release -DCARREAU_TESTS=ON -DCARREAU_FORTRAN=ON -DCARREAU_BENCH=ON -DCARREAU_TEST_VARIANTS=ON
cmake --build "$build" -j "$(processors)"
cd "$build"
# Unit tests take two minutes on two processors; the others follow if they pass.
ctest -j "$(processors)" --output-on-failure -L unit
exec ctest -j "$(processors)" --output-on-failure -LE unit
