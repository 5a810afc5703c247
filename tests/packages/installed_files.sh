#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# installed_files.sh TREE WORK FORTRAN COMMAND CAD PYTHON: what an installed tree must hold, and must not.
set -eu
tree=$1 fortran=$3 command=$4 cad=$5 python=$6
cd -- "$tree"
fail=0
need() {
  for path in "$@"; do
    [ -e "$path" ] || { echo "missing: $path"; fail=1; }
  done
}
need lib/libcarreau_f77.a include/carreau.h include/carreau_geometry.h include/carreau_atlas.h include/carreau_remesh.h lib/libcarreau.so lib/cmake/carreau/carreau-config.cmake lib/pkgconfig/carreau.pc \
  share/doc/carreau/LICENSE share/doc/carreau/README.md share/doc/carreau/CHANGELOG.md share/doc/carreau/docs/limits.md share/doc/carreau/docs/third_party.md share/doc/carreau/docs/third_party_notices.txt
if [ "$fortran" = 1 ]; then
  need share/carreau/fortran/carreau.f90 share/carreau/fortran/blsurf_m.f90 lib/libcarreau_fortran.a \
    lib/fortran/modules/carreau/*/carreau.mod lib/pkgconfig/carreau-fortran.pc share/man/man1/blsurf.1
fi
# Where MPI was found.
mpi_header=
if [ -e include/carreau_mpi.h ]; then
  mpi_header="include/carreau_mpi.h "
  need lib/libcarreau_mpi.so lib/pkgconfig/carreau-mpi.pc
fi
cad_header=
if [ "$cad" = 1 ]; then
  cad_header="include/carreau_cad.h include/carreau_cad.hpp "
  need lib/libcarreau_cad.so lib/libcarreau_cad_step-*.so lib/libcarreau_cad_iges-*.so lib/libcarreau_cad_changes-*.so lib/pkgconfig/carreau-cad.pc lib/cmake/carreau/carreau-cad-targets.cmake
  if [ "$fortran" = 1 ]; then
    need share/carreau/fortran/carreau_cad.f90 lib/libcarreau_cad_fortran.a lib/fortran/modules/carreau/*/carreau_cad.mod \
      lib/pkgconfig/carreau-cad-fortran.pc
  fi
fi
if [ "$python" = 1 ]; then
  need lib/python3*/dist-packages/carreau/__init__.py lib/python3*/dist-packages/carreau/py.typed lib/python3*/dist-packages/carreau-*.dist-info/METADATA
  [ ! -e carreau ] || { echo "what a wheel has inside is installed, too"; fail=1; }
fi
if [ "$command" = 1 ]; then
  need bin/carreau share/bash-completion/completions/carreau share/zsh/site-functions/_carreau \
    share/fish/vendor_completions.d/carreau.fish
  for command in mesh info areas check picture fields params completion; do need share/man/man1/carreau-$command.1; done
  ./bin/carreau --version # finds its library in the tree
fi
# A manual page for each program.
for program in bin/*; do
  [ -e "$program" ] || continue
  need "share/man/man1/${program##*/}.1"
done
# The headers, and no file that knows where it was built.
headers=$(find include -type f | LC_ALL=C sort | tr '\n' ' ')
wrapper=$(for part in adaptation atlas callbacks delivered error geometry mesh metric remesh session; do printf 'include/carreau/%s.hpp ' $part; done)
wanted="include/carreau.h include/carreau.hpp ${wrapper}include/carreau_atlas.h ${cad_header}include/carreau_geometry.h ${mpi_header}include/carreau_remesh.h "
[ "$headers" = "$wanted" ] || { echo "headers: $headers"; fail=1; }
if grep -rlI -e "$tree.first" .; then
  echo "these files hold the path of the first installation"
  fail=1
fi
exit $fail
