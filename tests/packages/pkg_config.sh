#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# pkg_config.sh TREE WORK PKG_CONFIG CC [CAD]: a C program by pkg-config and the compiler alone.
set -eu
tree=$1 work=$2 pkg_config=$3 cc=$4 cad=${5:-0}
source=$(CDPATH='' cd -- "$(dirname -- "$0")/c" && pwd)/main.c
rm -rf -- "$work"
mkdir -p -- "$work"
cd -- "$work"
pc=$(find "$tree" -name carreau.pc)
PKG_CONFIG_PATH=$(dirname -- "$pc")
export PKG_CONFIG_PATH
if [ -e "$(dirname -- "$pc")/carreau-fortran.pc" ]; then
  test "$("$pkg_config" --modversion carreau)" = "$("$pkg_config" --modversion carreau-fortran)"
fi
# Blanks in paths come out with a backslash: eval.
flags=$("$pkg_config" --cflags --libs carreau)
eval "set -- $flags"
"$cc" -std=c99 "$source" -o customer "$@" -lm
LD_LIBRARY_PATH=$("$pkg_config" --variable=libdir carreau | sed 's/\\//g') ./customer
if [ "$cad" = 1 ]; then
  test "$("$pkg_config" --modversion carreau)" = "$("$pkg_config" --modversion carreau-cad)"
  flags=$("$pkg_config" --cflags --libs carreau-cad)
  eval "set -- $flags"
  cad_source=$(dirname -- "$(dirname -- "$source")")/cad
  "$cc" -std=c99 "$cad_source/main.c" -o cad_customer "$@" -lm
  LD_LIBRARY_PATH=$("$pkg_config" --variable=libdir carreau-cad | sed 's/\\//g') ./cad_customer "$cad_source/sphere.brep"
fi
