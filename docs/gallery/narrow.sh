#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# narrow.sh: the narrow zones of HDR fig. 3.2 to 3.4, as narrow_*.png and crescent.png.
set -eu
awk 'BEGIN {
  n = 24; pi = atan2(0, -1); print n + 4, 4, 1; print "A 0 0\nB 6 0\nC 6 3\nD 0 3"
  for (i = 0; i < n; ++i) { t = 2 * pi * i / n; printf "P%d %.9f %.9f\n", i, 3 + 1.2 * cos(t), .86 + .8 * sin(t) }
  print ";\n;\nAB NULL A B NULL ;\nBC NULL B C NULL ;\nCD NULL C D NULL ;\nDA NULL D A NULL ;"
  printf "HOLE NULL"; for (i = 0; i <= n; ++i) printf " P%d", i % n
  print " NULL ;\n;\n;\nAB 1 HOLE 2 ;\nAB +1 1 ;\nisotrope\nA .9 B .9 C .9 D .9"
  for (i = 0; i < n; ++i) printf "P%d .25\n", i
  print ";" }' > narrow.data
for passes in '0 0' '10 0' '10 20'; do
  set -- $passes
  carreau plane narrow.data -o narrow.mesh --set CheckCloseEdges=$1 --set CheckAdjacentEdges=$2 \
    --set CoefRectangle=0.25 --set edge_gradation=0 --set shape_trials=0 -q
  carreau picture narrow.mesh -o narrow_$1_$2.png --size 500x270 --color quality
done
printf '8 4 1\nA 1 0\nB 0 1\nC -1 0\nD 0 -1\nE .96 0\nF .25 .71\nG -.46 0\nH .25 -.71\n;\n;\nOUT ARC A B C D A ;\nIN ARC E F G H E ;\n;\n;\n;\nOUT +1 1 ;\nisotrope\n;\n' > crescent.data
carreau plane crescent.data -o crescent.mesh --size 0.6 -q
carreau picture crescent.mesh -o crescent.png --size 270x270
