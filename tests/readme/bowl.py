#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bowl.py MESH: the mesh of README's samples is the paraboloid over a disc of radius 2, with edges of 0.1."""
import math
import sys


def section(words, name, width):
    at = words.index(name)
    count = int(words[at + 1])
    rows = words[at + 2:at + 2 + width * count]
    return [rows[width * i:width * (i + 1)] for i in range(count)]


with open(sys.argv[1]) as file:
    words = file.read().split()
points = [tuple(map(float, row[:3])) for row in section(words, "Vertices", 4)]
triangles = [tuple(int(v) - 1 for v in row[:3]) for row in section(words, "Triangles", 4)]
for x, y, z in points:
    assert abs(z - (x * x + y * y) / 2) < 1e-12 and math.hypot(x, y) < 2 + 1e-12, (x, y, z)

area = 0
sides = {}
for a, b, c in triangles:
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = points[a], points[b], points[c]
    ux, uy, uz, vx, vy, vz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
    area += math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2
    assert ux * vy - uy * vx > 0, "a triangle is turned over"
    for side in ((a, b), (b, c), (c, a)):
        key = tuple(sorted(side))
        sides[key] = sides.get(key, 0) + 1
# Exact area 2 pi / 3 (5^(3/2) - 1); chords of length h lose a part of the order of h^2 (curvature at most 1).
exact = 2 * math.pi / 3 * (5 ** 1.5 - 1)
assert exact * (1 - 0.1 ** 2) < area < exact, (area, exact)
# A disc: Euler's number 1, one border, of the length of the circle.
assert len(points) - len(sides) + len(triangles) == 1
border = [side for side, count in sides.items() if count == 1]
assert all(count <= 2 for count in sides.values())
assert abs(len(border) - 4 * math.pi / 0.1) <= 2, len(border)
