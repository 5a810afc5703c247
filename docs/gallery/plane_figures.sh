#!/bin/sh
# plane_figures.sh FOLDER: draws figures of plane domains there, each like the one of HDR or RR-2818 that stands above its commands. The
# program carreau is in PATH.
set -eu
mkdir -p "$1"
cd "$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
out=$(pwd)
cd "$work"

# HDR fig. 1.1: a domain whose triangles can all be equilateral.
cat > equilateral.poly <<'END'
3 2 0 0
1 0 0
2 1 0
3 .5 .86602540378443865
3 0
1 1 2
2 2 3
3 3 1
0
END
carreau plane equilateral.poly -o equilateral.mesh --size 0.1 -q
carreau picture equilateral.mesh -o "$out/plane_equilateral.png" --size 400x360

# HDR fig. 3.5: a circle of radius 50 and size 5, a closed curve of size .25 (a clover in the place of the @), gradation 1.25.
awk 'BEGIN {
  n = 64; pi = atan2(0, -1)
  print n + 2, n + 2, 2; print "E 50 0 W -50 0"
  for (i = 0; i < n; ++i) { t = 2 * pi * i / n; r = 16 + 6 * cos(3 * t); printf "P%d %.9f %.9f\n", i, r * cos(t), r * sin(t) }
  print ";\n;\nRIM ARC E W E ;"; printf "CLOVER NULL"
  for (i = 0; i <= n; ++i) printf " P%d", i % n
  print " NULL ;\n;\n;\nRIM 1 CLOVER 2 ;\nRIM +1 1 CLOVER +1 2 ;\nisotrope\nE 5"
  for (i = 0; i < n; ++i) printf "P%d .25\n", i
  print ";" }' > clover.data
for frontal in 0 1; do
  carreau plane clover.data -o clover.mesh --gradation 1.25 --set frontal=$frontal -q
  carreau picture clover.mesh -o "$out/plane_clover_$frontal.png" --size 420x420
done

# RR-2818 fig. 28 to 32: a domain in metrics that turn and stretch, with the unit ellipses at half their size.
awk 'BEGIN {
  n = 32; pi = atan2(0, -1); print n, n, 2
  for (i = 0; i < n; ++i) { t = 2 * pi * i / n; r = 2 + .6 * cos(3 * t); printf "P%d %.9f %.9f\n", i, 1.5 * r * cos(t), r * sin(t) }
  printf ";\n;\nC NULL"; for (i = 0; i <= n; ++i) printf " P%d", i % n
  print " NULL ;\n;\n;\nC 1 ;\nC +1 1 ;\n" }' > turning.data
carreau plane turning.data -o turning0.mesh --size 0.15 -q
for i in 1 2; do
  # Size .3 along a direction that turns with x, and .3 to .07 across.
  awk '$1 == "Vertices" { getline; n = $1; print "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n" n "\n1 3"
    for (i = 0; i < n; ++i) { getline; a = .6 * $1; p = 1 / .3 ^ 2; h = .07 + .23 * ($2 / 2.6) ^ 2; q = 1 / h ^ 2; c = cos(a); s = sin(a)
      print p * c * c + q * s * s, (p - q) * c * s, p * s * s + q * c * c }
    print "End" }' turning$((i - 1)).mesh > turning.sol
  carreau adapt turning.data --mesh turning$((i - 1)).mesh --sol turning.sol --use metrics --transfer turning.sol -o turning$i.mesh -q
done
carreau picture turning2.mesh --metric turning2.sol -o "$out/plane_ellipses.png" --size 640x480

# HDR fig. 1.9 to 1.11: a loop towards a curve of Lissajous, by metrics at the vertices of the mesh before.
cat > square.poly <<'END'
4 2 0 0
1 -1.2 -1.2
2  1.2 -1.2
3  1.2  1.2
4 -1.2  1.2
4 0
1 1 2
2 2 3
3 3 4
4 4 1
0
END
carreau plane square.poly -o liss0.mesh --size 0.12 -q
for i in 1 2 3; do
  awk 'BEGIN { pi = atan2(0, -1); m = 3000
      for (k = 0; k < m; ++k) { t = 2 * pi * k / m; X[k] = sin(3 * t + pi / 2); Y[k] = sin(2 * t) } }
    $1 == "Vertices" { getline; n = $1; print "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n" n "\n1 1"
    for (i = 0; i < n; ++i) { getline; d = 1e9
      for (k = 0; k < m; ++k) { e = ($1 - X[k]) ^ 2 + ($2 - Y[k]) ^ 2; if (e < d) d = e }
      print .012 + .15 * sqrt(d) }
    print "End" }' liss$((i - 1)).mesh > liss.sol
  carreau adapt square.poly --mesh liss$((i - 1)).mesh --sol liss.sol --use sizes -o liss$i.mesh -q
done
carreau picture liss3.mesh -o "$out/plane_lissajous.png" --size 480x480
