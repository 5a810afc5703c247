#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# naca0012.sh FOLDER: the loop of RR-2818 sec. 6.4 around the profile NACA 0012, by files, as a solver runs it: three adaptations to values at the
# vertices of the mesh before. The field stands in for the flow at Mach 0.8 and 1.25 degrees: a strong shock above, a weak one below, stagnation at
# the nose. FOLDER gets naca0.mesh to naca3.mesh with their .sol, and a picture. The program carreau is in PATH.
set -eu
mkdir -p "$1"
cd "$1"

# The profile by 121 points, dense at its nose, and a circle of radius 5; splines but for the trailing edge.
awk 'BEGIN {
  n = 60; m = 32; pi = atan2(0, -1); count = 2 * n + m; print count, 2, 0, 0
  for (i = 0; i < 2 * n; ++i) {
    t = 1 - i / n; s = t < 0 ? -t : t; p = s * s
    y = .6 * (.2969 * s + p * (-.126 + p * (-.3516 + p * (.2843 - .1036 * p))))
    printf "%d %.12f %.12f\n", i + 1, p, t < 0 ? -y : y }
  for (i = 0; i < m; ++i) printf "%d %.12f %.12f\n", 2 * n + i + 1, .5 + 5 * cos(2 * pi * i / m), 5 * sin(2 * pi * i / m)
  print count, 1
  for (i = 0; i < 2 * n; ++i) print i + 1, i + 1, (i + 1) % (2 * n) + 1, 1
  for (i = 0; i < m; ++i) print 2 * n + i + 1, 2 * n + i + 1, 2 * n + (i + 1) % m + 1, 2
  print "1\n1 .5 0" }' > naca.poly

solve() { # values at the vertices of $1.mesh, in the place of a solver
  awk 'function step(x) { return x > 300 ? 1 : x < -300 ? 0 : 1 / (1 + exp(-2 * x)) }
    function shock(x, y, at, height) { return step((at + .15 * y - x) / .02) * step((x - .05) / .15) * step((height - y) / .15) }
    function flow(x, y,  above) { above = step(y / .04)
      return .8 + .5 * above * shock(x, y, .62, .6) + .25 * (1 - above) * shock(x, -y, .35, .3) - .6 * exp(-(x * x + y * y) / .01) }
    $1 == "Vertices" { getline; n = $1; print "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n" n "\n1 1"
      for (i = 0; i < n; ++i) { getline; printf "%.15g\n", flow($1, $2) }
      print "End" }' "$1.mesh" > "$1.sol"
}

carreau plane naca.poly --smooth=60 -o naca0.mesh --size 0.8 --angle 4 --min 0.004 --gradation 1.25 -q
solve naca0
i=0
for stretch in 3.4 6.8 8.5; do # the largest of the maps of the report
  i=$((i + 1))
  carreau adapt naca.poly --smooth=60 --mesh naca$((i - 1)).mesh --sol naca$((i - 1)).sol -o naca$i.mesh \
    --shape anisotropic --tolerance 0.0015 --ratio $stretch --min 0.004 --max 0.8 --gradation 1.4 -q
  solve naca$i
done
carreau picture naca3.mesh -o naca0012.png --size 900x600 --around 0.5,0,0,0.75
