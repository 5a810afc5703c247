#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# plane_figures.sh FOLDER: draws figures of plane domains there, each like the figure of HDR or RR-2818 named above its commands. The
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

# RR-2818 fig. 20 to 27: a segment of length 10 by five sizes, and one of length 7.5 by five metrics (angle, h1, h2), as the sides of strips:
# background meshes of edges alone. The report has 17, 26 and 21 edges by sizes; its three laws are hinterpol_flag 0, 1 and 2.
strip() { # length height
  printf '4 2 0 0\n1 0 0\n2 %s 0\n3 %s %s\n4 0 %s\n4 1\n1 1 2 1\n2 2 3 2\n3 3 4 2\n4 4 1 2\n0\n' "$1" "$1" "$2" "$2"
}
line() { # abscissae: a .mesh of edges between them
  echo "MeshVersionFormatted 2 Dimension 2 Vertices $#"
  printf '%s 0 0\n' "$@"
  echo "Edges $(($# - 1))"
  i=1
  while [ $i -lt $# ]; do echo "$i $((i + 1)) 1"; i=$((i + 1)); done
  echo End
}
strip 10 2.5 > sizes.poly
line 0 3 4 8 10 > sizes.mesh
printf 'MeshVersionFormatted 2 Dimension 2 SolAtVertices 5 1 1\n1.5\n.5\n2\n.1\n.7\nEnd\n' > sizes.sol
strip 7.5 2.5 > metrics.poly
line 0 2 3 6 7.5 > metrics.mesh
echo '30 .70 .25  90 1.10 .15  0 .30 .30  -60 1.50 .40  -45 1.00 .35' | awk '{
  print "MeshVersionFormatted 2 Dimension 2 SolAtVertices 5 1 3"
  for (i = 1; i < NF; i += 3) { a = $i * atan2(0, -1) / 180; c = cos(a); s = sin(a); p = $(i + 1) ^ -2; q = $(i + 2) ^ -2
    print p * c * c + q * s * s, (p - q) * c * s, p * s * s + q * c * c }
  print "End" }' > metrics.sol
for what in sizes metrics; do
  middle=5; [ $what = sizes ] || middle=3.75
  carreau picture $what.mesh --metric $what.sol --ellipses 1 -o "$out/plane_line_$what.png" --size 900x330 --around ${middle},0,0,2.2
  for law in 0 1 2; do
    carreau adapt $what.poly --mesh $what.mesh --sol $what.sol --use $what --set hinterpol_flag=$law --min 0.001 --max 10 -o $what$law.mesh -q
    echo "$what, law $law: $(awk '$1 == "Edges" { getline; n = $1; for (i = 0; i < n; ++i) { getline; m += $3 == 1 } } END { print m }' $what$law.mesh) edges"
  done
  carreau picture ${what}1.mesh -o "$out/plane_strip_$what.png" --size 900x260
done

# HDR fig. 4.9: the parameter plane of the paraboloid z = (x^2 + y^2)/2, meshed so that the surface has edges of .5, with the ellipses of the induced
# metric (1 + x^2, x y, 1 + y^2) / .5^2. Without formulas (muParser) this figure is left out.
if carreau mesh 'z = (x^2 + y^2) / 2' --domain box:-2.5,-2.5,2.5,2.5 --size 0.5 -o sheet.mesh -q 2> sheet.log; then
  awk '$1 == "Dimension" { print; getline; print 2; next }
    $1 == "Vertices" { print; getline; print; n = $1; for (i = 0; i < n; ++i) { getline; print $1, $2, $4 } next }
    { print }' sheet.mesh > flat.mesh
  awk '$1 == "Vertices" { getline; n = $1; print "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n" n "\n1 3"
      for (i = 0; i < n; ++i) { getline; print (1 + $1 * $1) / .25, $1 * $2 / .25, (1 + $2 * $2) / .25 }
      print "End" }' flat.mesh > flat.sol
  carreau picture flat.mesh --metric flat.sol -o "$out/paraboloid_induced.png" --size 480x480
fi
