#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# cpack.sh CPACK BUILD WORK COMMAND CAD: the archive and the package that cpack makes hold what is installed; the archive's command runs where
# it was unpacked, with libraries of the archive and of glibc only, and the package names the libraries that it needs.
set -eu
cpack=$1 build=$2 work=$3 command=$4 cad=$5 data=$(cd -- "$(dirname -- "$0")/../../docs/data" && pwd)
rm -rf -- "$work"
mkdir -p -- "$work/unpacked"
cd -- "$work"
"$cpack" --config "$build/CPackConfig.cmake" -B "$work/made" >cpack.log 2>&1 || { cat cpack.log; exit 1; }
archive=$(find made -maxdepth 1 -name '*.tar.gz')
tar xzf "$archive" -C unpacked
root=$(find unpacked -mindepth 1 -maxdepth 1 -type d)
test -e "$root/include/carreau.h" && test -e "$root/lib/libcarreau.so"
if [ "$command" = 1 ]; then
  "$root/bin/carreau" mesh 'z = x * y' --domain disc:0,0,1 --size 0.2 -q -o saddle.mesh
  test -s saddle.mesh
  if [ "$cad" = 1 ]; then
    "$root/bin/carreau" mesh "$data/bracket.step" -q -o bracket.mesh
    test -s bracket.mesh
  fi
fi
if grep -q CPACK_PRE_BUILD_SCRIPTS "$build/CPackConfig.cmake"; then
  licences=$root/share/doc/carreau/licenses
  test -s "$licences/LICENSE"
  inside=$(cd -- "$root/lib" && pwd)
  for file in "$root"/bin/* "$root"/lib/*.so*; do
    case $file in *libcarreau_mpi*) continue ;; esac # it uses the MPI of its machine
    case $file in */libcarreau*.so* | */bin/*) ;; *) grep -q "^$(basename "$file")  " "$licences/LIBRARIES.txt" ;; esac
    ldd "$file" | sed -n 's/^[[:space:]]*\([^ ]*\) => \(.*\)/\1|\2/p' | while IFS='|' read -r name path; do
      case $name in libc.so.* | libm.so.* | libdl.so.* | librt.so.* | libpthread.so.*) continue ;; esac
      case $(readlink -f "${path% (*}") in "$inside"/*) ;; *) echo "$file finds $name outside: $path"; exit 1 ;; esac
    done
  done
fi
if command -v dpkg-deb >/dev/null 2>&1; then
  deb=$(find made -maxdepth 1 -name '*.deb')
  dpkg-deb --field "$deb" Depends | grep -q 'libc6'
  dpkg-deb --contents "$deb" | grep -q 'usr/include/carreau.h'
  dpkg-deb --ctrl-tarfile "$deb" | tar t | grep -q triggers
fi
