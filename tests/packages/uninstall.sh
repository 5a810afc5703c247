#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# uninstall.sh CMAKE BUILD WORK: what `cmake --install` puts into a tree, the target uninstall takes away; files of others stay.
set -eu
cmake=$1 build=$2 work=$3
rm -rf -- "$work"
mkdir -p -- "$work/usr/local/lib"
echo mine >"$work/usr/local/lib/mine"
# The list of what a person has installed is his.
manifest=$build/install_manifest.txt
[ ! -e "$manifest" ] || mv -- "$manifest" "$manifest.kept"
trap 'rm -f -- "$manifest"; [ ! -e "$manifest.kept" ] || mv -- "$manifest.kept" "$manifest"' EXIT
DESTDIR=$work "$cmake" -DCMAKE_INSTALL_PREFIX=/usr/local -P "$build/cmake_install.cmake" >/dev/null
test -e "$work/usr/local/include/carreau.h"
DESTDIR=$work "$cmake" -P "$build/uninstall.cmake" >/dev/null
left=$(cd -- "$work" && find . ! -type d | sort)
[ "$left" = "./usr/local/lib/mine" ] || { echo "left behind: $left"; exit 1; }
left=$(cd -- "$work" && find . -type d -name 'carreau*')
[ -z "$left" ] || { echo "folders left behind: $left"; exit 1; }
