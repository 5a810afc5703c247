#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""adapt_inputs_test.py CARREAU TEAPOT HOST [MAKE_SHAPES]: `carreau adapt` takes every kind of geometry and every kind of background mesh:
triangles, tetrahedra, edges of curves. MAKE_SHAPES makes STEP files."""
import itertools
import math
import os
import subprocess
import sys
import unittest

from mesh_files import Mesh, read_mesh, read_sol, write_sol
from work_folder import WorkFolder

PROGRAM, TEAPOT, HOST, *SHAPES = map(os.path.abspath, sys.argv[1:])

PARDOM = "1\n1 1 4  1 0 0 0  1 0 0 0  1 0 0 0  1 0 0 0  0\n"  # as in fields_test.py
OCTAHEDRON = "OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n" + "".join(
    "3 %d %d %d\n" % t for t in ((0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)))


def poly(*corners):
    n = len(corners)
    return (f"{n} 2 0 0\n" + "".join(f"{i} {x} {y}\n" for i, (x, y) in enumerate(corners, 1)) +
            f"{n} 1\n" + "".join(f"{i} {i} {i % n + 1} {i}\n" for i in range(1, n + 1)) + "0\n")


def cube_patches():
    """[0, 1]^3 as six bilinear patches of a .bpt, turned outward."""
    patches = []
    for axis, end in itertools.product(range(3), (0, 1)):
        rows = []
        for v, u in itertools.product((0, 1), (0, 1)):
            point = [0, 0, 0]
            point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = end, *((u, v) if end else (v, u))
            rows.append("%d %d %d" % tuple(point))
        patches.append("1 1\n" + "\n".join(rows))
    return "6\n" + "\n".join(patches) + "\n"


def kuhn(low, high, n):
    """A box in n^3 boxes of six tetrahedra each: vertices and tetrahedra from 0."""
    place = lambda k: tuple(a + (b - a) * i / n for a, b, i in zip(low, high, k))  # noqa: E731
    vertices = [place((i, j, k)) for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)]
    tetrahedra = []
    for corner in itertools.product(range(n), repeat=3):
        for axes in itertools.permutations(range(3)):
            at, t = list(corner), []
            for axis in (*axes, None):
                t.append((at[2] * (n + 1) + at[1]) * (n + 1) + at[0])
                if axis is not None:
                    at[axis] += 1
            tetrahedra.append(tuple(t))
    return vertices, tetrahedra


def write_cells(path, dimension, vertices, name, cells):
    """A mesh of one kind of elements: "Tetrahedra" or "Edges"."""
    with open(path, "w") as file:
        file.write(f"MeshVersionFormatted 2\nDimension {dimension}\nVertices\n{len(vertices)}\n")
        file.writelines(" ".join(map(repr, map(float, p))) + " 0\n" for p in vertices)
        file.write(f"{name}\n{len(cells)}\n")
        file.writelines(" ".join(str(v + 1) for v in cell) + " 0\n" for cell in cells)
        file.write("End\n")
    mesh = Mesh(vertices, [])
    mesh.dimension = dimension
    return mesh


class Inputs(WorkFolder):
    program = PROGRAM

    def geometries(self):
        """Name, words that name the input, command of the first mesh."""
        yield "plane", [self.write("square.poly", poly((-1, -1), (1, -1), (1, 1), (-1, 1)))], "plane"
        yield "plane mesh", ["first.mesh"], None
        yield "patches", [TEAPOT], "mesh"
        yield "pardom", [self.write("x.pardom", PARDOM), "--host", HOST], "mesh"
        yield "triangles", [self.write("octahedron.off", OCTAHEDRON)], "mesh"
        for program in SHAPES:
            subprocess.run([program, self.folder], check=True, capture_output=True)
            yield "STEP", ["cylinder.step"], "mesh"

    def mean_ratio(self, mesh, wanted):
        """Mean of the lengths of edges over the sizes in their middles."""
        sides = {tuple(sorted((t[k], t[k - 1]))) for t in mesh.triangles for k in range(3)}
        ratios = []
        for i, j in sides:
            p, q = mesh.vertices[i], mesh.vertices[j]
            ratios.append(math.dist(p, q) / wanted(*[(a + b) / 2 for a, b in zip(p, q)]))
        return sum(ratios) / len(ratios)

    def test_every_geometry_is_adapted_by_sizes_metrics_and_vectors(self):
        for name, words, first in self.geometries():
            with self.subTest(geometry=name):
                if first:
                    self.done(first, *words, "-o", "first.mesh", "--size", "4%")
                mesh = read_mesh(self.path("first.mesh"))
                low, high = min(p[0] for p in mesh.vertices), max(p[0] for p in mesh.vertices)

                def size(*p):
                    return (high - low) * (0.02 + 0.03 * (p[0] - low) / (high - low))
                # A vector that is linear in space arrives exactly where the mesh is flat, else within its chords.
                write_sol(self.path("u.sol"), mesh, [2], lambda *p: p)
                write_sol(self.path("h.sol"), mesh, [1], lambda *p: [size(*p)])
                lower = [[0, 0], [1, 0], [1, 1]] if mesh.dimension == 2 else [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2]]
                write_sol(self.path("m.sol"), mesh, [3], lambda *p: [size(*p) ** -2 if i == j else 0 for i, j in lower])
                counts = {}
                for use in ("sizes", "metrics"):
                    self.done("adapt", *words, "--mesh", "first.mesh", "--sol", use[0].replace("s", "h") + ".sol", "--use", use, "--transfer", "u.sol",
                              "-o", "next.mesh", "--min", "0.01%", "--max", "100%")
                    after = read_mesh(self.path("next.mesh"))
                    counts[use] = len(after.triangles)
                    self.assertAlmostEqual(self.mean_ratio(after, size), 1, delta=0.08)
                    dimension, types, rows = read_sol(self.path("next.sol"))
                    self.assertEqual((dimension, types, len(rows)), (mesh.dimension, [2], len(after.vertices)))
                    away = [math.dist(p, row) for p, row in zip(after.vertices, rows)]
                    self.assertLess(sum(away) / len(away), 0.02 * (high - low))
                self.assertAlmostEqual(counts["metrics"] / counts["sizes"], 1, delta=0.05)
                # Values: a vector whose first component bends along x.
                write_sol(self.path("u.sol"), mesh, [2], lambda *p: [math.tanh(4 * (p[0] - low) / (high - low) - 2), *[0 for _ in p[1:]]])
                self.done("adapt", *words, "--mesh", "first.mesh", "--sol", "u.sol", "-o", "next.mesh", "--tolerance", "0.003", "--relative")
                _, types, rows = read_sol(self.path("next.sol"))
                self.assertEqual((types, len(rows)), ([2], len(read_mesh(self.path("next.mesh")).vertices)))

    def test_sizes_at_the_vertices_of_tetrahedra_hold_at_the_surface(self):
        vertices, tetrahedra = kuhn((-3, -3, -0.5), (3, 3, 6.5), 5)
        box = write_cells(self.path("box.mesh"), 3, vertices, "Tetrahedra", tetrahedra)

        def size(x, y, z):
            return 0.12 + 0.05 * z
        write_sol(self.path("box.sol"), box, [1], lambda *p: [size(*p)])
        write_sol(self.path("u.sol"), box, [1, 2], lambda x, y, z: [x - 2 * z, x, y, z])
        self.write("x.pardom", PARDOM)
        told = self.done("adapt", "x.pardom", "--host", HOST, "--mesh", "box.mesh", "--sol", "box.sol", "--use", "sizes", "-o", "next.mesh", "--min",
                         "0.01", "--max", "5")
        self.assertNotIn("outside", told)
        after = read_mesh(self.path("next.mesh"))
        self.assertAlmostEqual(self.mean_ratio(after, size), 1, delta=0.03)
        # Unit triangles of z = (x^2 + y^2) / 2 over [-2.5, 2.5]^2.
        n, wanted = 200, 0
        for i, j in itertools.product(range(n), range(n)):
            x, y = (5 * (k + 0.5) / n - 2.5 for k in (i, j))
            wanted += 4 / math.sqrt(3) * math.sqrt(1 + x * x + y * y) / size(x, y, (x * x + y * y) / 2) ** 2 * (5 / n) ** 2
        self.assertAlmostEqual(len(after.triangles) / wanted, 1, delta=0.05)
        # The same by --size-map, and a box that is too small is reported.
        os.rename(self.path("next.mesh"), self.path("by_adapt.mesh"))
        self.done("mesh", "x.pardom", "--host", HOST, "--size-map", "box.mesh", "-o", "next.mesh", "--min", "0.01", "--max", "5")
        self.assertEqual(read_mesh(self.path("next.mesh")).triangles, read_mesh(self.path("by_adapt.mesh")).triangles)
        vertices, tetrahedra = kuhn((-1, -1, -0.5), (1, 1, 1), 2)
        small = write_cells(self.path("small.mesh"), 3, vertices, "Tetrahedra", tetrahedra)
        write_sol(self.path("small.sol"), small, [1], lambda *p: [0.3])
        told = self.done("adapt", "x.pardom", "--host", HOST, "--mesh", "small.mesh", "--sol", "small.sol", "--use", "sizes", "-o", "next.mesh")
        self.assertIn("points lie outside of the background mesh", told)

    def test_values_of_a_volume_are_estimated_and_carried_over_on_its_surface(self):
        self.write("cube.bpt", cube_patches())
        vertices, tetrahedra = kuhn((0, 0, 0), (1, 1, 1), 8)
        box = write_cells(self.path("box.mesh"), 3, vertices, "Tetrahedra", tetrahedra)
        write_sol(self.path("u.sol"), box, [1, 2], lambda x, y, z: [10 * x * x, x, y, z])
        self.done("adapt", "cube.bpt", "--mesh", "box.mesh", "--sol", "u.sol", "-o", "next.mesh", "--tolerance", "0.02", "--max", "0.2")
        after = read_mesh(self.path("next.mesh"))
        # HDR eq. 3.3: 2/9 of 20 h^2 is the tolerance on four faces; vertices of the two others that bend along them have it, too.
        size = math.sqrt(4.5 * 0.02 / 20)
        inside = [t for t in after.triangles if all(0.3 < after.vertices[v][0] < 0.7 for v in t)]
        lengths = [math.dist(after.vertices[t[k]], after.vertices[t[k - 1]]) for t in inside for k in range(3)]
        self.assertAlmostEqual(sum(lengths) / len(lengths) / size, 1, delta=0.1)
        _, types, rows = read_sol(self.path("next.sol"))
        self.assertEqual(types, [1, 2])
        for p, row in zip(after.vertices, rows):
            self.assertLess(math.dist(p, row[1:]), 1e-12)
            self.assertAlmostEqual(row[0], 10 * p[0] ** 2, delta=10 / 4 / 64 + 1e-12)

    def test_sizes_at_the_vertices_of_edges_give_the_counts_of_the_report(self):
        """RR-2818 sec. 6.1, fig. 20 to 23: five sizes on a segment of length 10; 17, 26 and 21 edges by the three laws."""
        self.write("strip.poly", poly((0, 0), (10, 0), (10, 4), (0, 4)))
        line = write_cells(self.path("line.mesh"), 2, [(0, 0), (3, 0), (4, 0), (8, 0), (10, 0)], "Edges", [(k, k + 1) for k in range(4)])
        wanted = dict(zip(line.vertices, (1.5, 0.5, 2, 0.1, 0.7)))
        write_sol(self.path("line.sol"), line, [1], lambda *p: [wanted[p]])
        for law, count in ((0, 17), (1, 26), (2, 21)):
            self.done("adapt", "strip.poly", "--mesh", "line.mesh", "--sol", "line.sol", "--use", "sizes", "-o", "next.mesh", "--min", "0.001", "--max",
                      "10", "--set", f"hinterpol_flag={law}")
            after = read_mesh(self.path("next.mesh"))
            self.assertEqual(sum(p[1] == 0 for p in after.vertices) - 1, count)

    def test_faces_between_curves_with_sizes_are_interpolated(self):
        """A size that is linear on the border of a convex domain is linear inside (mean values)."""
        self.write("square.poly", poly((-1, -1), (1, -1), (1, 1), (-1, 1)))
        border = [(-1 + 0.25 * k, -1) for k in range(8)]
        border += [(-y, x) for x, y in border] + [(-x, -y) for x, y in border] + [(y, -x) for x, y in border]
        loop = write_cells(self.path("loop.mesh"), 2, border, "Edges", [(k, (k + 1) % 32) for k in range(32)])

        def size(x, y):
            return 0.06 + 0.02 * (x + y)
        write_sol(self.path("loop.sol"), loop, [1], lambda *p: [size(*p)])
        self.done("adapt", "square.poly", "--mesh", "loop.mesh", "--sol", "loop.sol", "--use", "sizes", "-o", "next.mesh", "--min", "0.001", "--max", "10")
        after = read_mesh(self.path("next.mesh"))
        self.assertAlmostEqual(self.mean_ratio(after, size), 1, delta=0.03)
        n = 200
        places = [2 * (k + 0.5) / n - 1 for k in range(n)]
        wanted = sum(4 / math.sqrt(3) / size(x, y) ** 2 * (2 / n) ** 2 for x, y in itertools.product(places, places))
        self.assertAlmostEqual(len(after.triangles) / wanted, 1, delta=0.05)
        # Fields need triangles or tetrahedra.
        result = self.run_program("adapt", "square.poly", "--mesh", "loop.mesh", "--sol", "loop.sol", "-o", "none.mesh")
        self.assertEqual(result.returncode, 2)
        self.assertIn("a mesh with a field needs triangles or tetrahedra; it has none", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
