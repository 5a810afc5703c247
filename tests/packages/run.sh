#!/bin/sh
# Installs the build tree and uses it as customers do. Usage: run.sh BUILD SOURCE C_COMPILER FORTRAN_COMPILER LIBDIR
set -eu
build=$1 source=$2 cc=$3 fc=$4 libdir=$5
work=$build/packages
prefix="$work/a prefix"
rm -rf "$work"
mkdir -p "$work"
cmake --install "$build" --prefix "$prefix" >"$work/install.log"
python3 "$source/tests/packages/extract.py" "$source/README.md" c "$work/sample.c"
python3 "$source/tests/packages/extract.py" "$source/README.md" fortran "$work/sample.f90"
paraboloid=$source/fortran_examples/paraboloid
export LD_LIBRARY_PATH="$prefix/$libdir${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"

echo "-- C project by find_package"
cmake -S "$source/tests/packages/c" -B "$work/c" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$cc" -DSAMPLE="$work/sample.c" >"$work/c.log"
cmake --build "$work/c" >>"$work/c.log"
"$work/c/customer" | grep triangles

echo "-- C by pkg-config"
PKG_CONFIG_PATH="$prefix/$libdir/pkgconfig" pkg-config --exists --print-errors carreau
eval "set -- $(PKG_CONFIG_PATH="$prefix/$libdir/pkgconfig" pkg-config --cflags --libs carreau)"
"$cc" "$work/sample.c" "$@" -o "$work/customer_pc"
"$work/customer_pc" | grep triangles

[ -n "$fc" ] || exit 0
echo "-- Fortran project by find_package, with carreau_add_blsurf"
cmake -S "$source/tests/packages/fortran" -B "$work/fortran" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_Fortran_COMPILER="$fc" \
  -DSAMPLE="$work/sample.f90" -DCAD_M="$paraboloid/cad_m.f90" >"$work/fortran.log"
cmake --build "$work/fortran" >>"$work/fortran.log"
"$work/fortran/customer"
cp "$paraboloid/x.pardom" "$paraboloid/blsurf.env" "$work/fortran/"
(cd "$work/fortran" && ./blsurf && test -s x.mesh)

echo "-- cad_m by one command line"
mkdir "$work/hand"
cp "$paraboloid/cad_m.f90" "$paraboloid/x.pardom" "$paraboloid/blsurf.env" "$work/hand/"
f="$prefix/share/carreau/fortran"
(cd "$work/hand" && "$fc" cad_m.f90 "$f/carreau_c.f90" "$f/carreau.f90" "$f/blsurf_m.f90" "$f/blsurf.f90" -L"$prefix/$libdir" -lcarreau -o blsurf && ./blsurf && cmp x.mesh "$work/fortran/x.mesh")
