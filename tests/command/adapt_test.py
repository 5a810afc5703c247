#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""adapt_test.py CARREAU FORMULAS PAGE TEAPOT: `carreau adapt`: the loop of the page docs/how-to/adapt.md as it stands there, sizes and metrics by
files, several fields at once, surfaces in space, a sentence for each mistake. FORMULAS is 1 when the program has muParser."""
import json
import math
import os
import re
import subprocess
import sys
import unittest

from mesh_files import read_mesh, read_png, read_sol, write_sol
from work_folder import WorkFolder

PROGRAM, PAGE, TEAPOT = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[3]), os.path.abspath(sys.argv[4])
FORMULAS = sys.argv[2] in ("1", "ON", "TRUE")

SQUARE = "4 2 0 0\n1 -1 -1\n2 1 -1\n3 1 1\n4 -1 1\n4 1\n1 1 2 1\n2 2 3 2\n3 3 4 3\n4 4 1 4\n0\n"


class Adapt(WorkFolder):
    program = PROGRAM

    def setUp(self):
        super().setUp()
        self.write("square.poly", SQUARE)

    def fails(self, *words, sentence):
        before = sorted(os.listdir(self.folder))
        result = self.run_program("adapt", *words)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn(sentence, result.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before, "a mistake leaves no file")

    def start(self, size="0.1"):
        self.done("plane", "square.poly", "-o", "0.mesh", "--size", size)
        return read_mesh(self.path("0.mesh"))

    def solution(self, name, mesh, types, value):
        write_sol(self.path(name), mesh, types, value)

    def interpolation_error(self, mesh, f):
        """Largest distance at the middles of triangles."""
        worst = 0
        for t in mesh.triangles:
            p = [mesh.vertices[v] for v in t]
            middle = [sum(q[k] for q in p) / 3 for k in range(2)]
            worst = max(worst, abs(sum(f(*q) for q in p) / 3 - f(*middle)))
        return worst

    def test_the_loop_of_the_page_finds_the_front(self):
        with open(PAGE) as file:
            scripts = re.findall(r"^```sh\n(.*?)^```$", file.read(), re.M | re.S)
        scripts = [script for script in scripts if "carreau adapt" in script]
        self.assertEqual(len(scripts), 1)
        environment = dict(os.environ, PATH=os.path.dirname(PROGRAM) + os.pathsep + os.environ["PATH"])
        done = subprocess.run(["sh", "-eu"], input=scripts[0], cwd=self.folder, env=environment, capture_output=True, text=True,
                              timeout=300)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

        def front(x, y):
            return math.tanh(20 * (y - x * x / 2))
        first, last = (read_mesh(self.path(f"step{i}.mesh")) for i in (0, 4))
        self.assertLess(len(last.vertices), 1.5 * len(first.vertices))
        self.assertLess(self.interpolation_error(last, front), self.interpolation_error(first, front) / 5)
        dimension, types, rows = read_sol(self.path("step4.sol"))
        self.assertEqual((dimension, types, len(rows)), (2, [1, 2], len(last.vertices)))
        with open(self.path("step4.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")

    def test_the_loop_around_the_profile_of_the_report(self):
        """RR-2818 sec. 6.4 by docs/gallery/naca0012.sh: 1344, 2099, 2117, 2223 points; docs/reference/papers.md prints ours."""
        environment = dict(os.environ, PATH=os.path.dirname(PROGRAM) + os.pathsep + os.environ["PATH"])
        script = os.path.join(os.path.dirname(PAGE), "..", "gallery", "naca0012.sh")
        done = subprocess.run(["sh", script, self.folder], env=environment, capture_output=True, text=True, timeout=300)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

        def step(x):
            return (1 + math.tanh(x)) / 2

        def shock(x, y, at, height):
            return step((at + 0.15 * y - x) / 0.02) * step((x - 0.05) / 0.15) * step((height - y) / 0.15)

        def flow(x, y):
            above = step(y / 0.04)
            return 0.8 + 0.5 * above * shock(x, y, 0.62, 0.6) + 0.25 * (1 - above) * shock(x, -y, 0.35, 0.3) - 0.6 * math.exp(-100 * (x * x + y * y))

        def mean_error(mesh):
            """Root of the mean square at the middles of triangles, by area."""
            squares = area = 0
            for t in mesh.triangles:
                (ax, ay), (bx, by), (cx, cy) = p = [mesh.vertices[v] for v in t]
                here = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
                away = sum(flow(*q) for q in p) / 3 - flow((ax + bx + cx) / 3, (ay + by + cy) / 3)
                squares, area = squares + here * away ** 2, area + here
            return math.sqrt(squares / area)
        meshes = [read_mesh(self.path(f"naca{i}.mesh")) for i in range(4)]
        for mesh, points in zip(meshes, (1344, 2099, 2117, 2223)):
            self.assertAlmostEqual(len(mesh.vertices) / points, 1, delta=0.17)
            sides = {tuple(sorted((t[k], t[k - 1]))) for t in mesh.triangles for k in range(3)}
            self.assertEqual(len(mesh.vertices) - len(sides) + len(mesh.triangles), 0, "a disc with a hole")
        self.assertAlmostEqual(len(meshes[3].vertices) / 2223, 1, delta=0.05)
        with open(os.path.join(os.path.dirname(PAGE), "..", "reference", "papers.md")) as file:
            text = file.read()
        for row, counts in (("points", [len(m.vertices) for m in meshes]), ("on the boundary", [len(m.edges) for m in meshes])):
            printed = re.findall(r"(\d+) \(\d+\)", re.search(rf"\| {row} \|.*", text).group())
            self.assertEqual(len(printed), len(counts))
            for count, number in zip(counts, map(int, printed)):
                self.assertAlmostEqual(count / number, 1, delta=0.005, msg=f"{row}: {counts}")
        self.assertLess(mean_error(meshes[3]), mean_error(meshes[0]) / 5)
        _, types, rows = read_sol(self.path("naca3.sol"))
        self.assertEqual((types, len(rows)), ([1], len(meshes[3].vertices)))
        self.assertTrue(os.path.exists(self.path("naca0012.png")))

    def test_sizes_and_metrics_are_taken_and_fields_carried_over(self):
        mesh = self.start()
        self.solution("h.sol", mesh, [1], lambda x, y: [0.05])
        self.solution("m.sol", mesh, [3], lambda x, y: [2500, 0, 100])
        # Linear functions of x and y arrive exactly, whatever their type.
        self.solution("all.sol", mesh, [1, 2, 3, 4], lambda x, y: [x + 2 * y, x, -y, 1 + x, y, 3, 1, 2 * x, y, 4])
        for sizes, use, wanted in (("h.sol", "sizes", 4 / math.sqrt(3) / 0.05 ** 2 * 4), ("m.sol", "metrics", 4 / math.sqrt(3) * 500 * 4)):
            self.done("adapt", "square.poly", "--mesh", "0.mesh", "--sol", sizes, "--use", use, "--transfer", "all.sol", "-o", "next.mesh")
            after = read_mesh(self.path("next.mesh"))
            self.assertAlmostEqual(len(after.triangles) / wanted, 1, delta=0.08)
            dimension, types, rows = read_sol(self.path("next.sol"))
            self.assertEqual((dimension, types), (2, [1, 2, 3, 4]))
            for (x, y), row in zip(after.vertices, rows):
                for found, exact in zip(row, [x + 2 * y, x, -y, 1 + x, y, 3, 1, 2 * x, y, 4]):
                    self.assertAlmostEqual(found, exact, delta=1e-12)
        # A metric among values is a metric; without fields there is no .sol.
        self.done("adapt", "square.poly", "--mesh", "0.mesh", "--sol", "m.sol", "-o", "values.mesh", "-o", "values.solb")
        self.assertEqual(read_mesh(self.path("values.mesh")).triangles, after.triangles)
        self.done("adapt", "square.poly", "--mesh", "0.mesh", "--sol", "h.sol", "--use", "sizes", "-o", "bare.mesh")
        self.assertFalse(os.path.exists(self.path("bare.sol")))

    def test_several_fields_and_the_components_of_a_vector_count_together(self):
        """Fields that bend along x and along y (HDR eq. 3.3): the count of triangles follows from both sizes."""
        mesh = self.start()
        tolerance, bends = 0.01, (20, 4)
        sizes = [math.sqrt(4.5 * tolerance / k) for k in bends]
        self.solution("two.sol", mesh, [1, 1], lambda x, y: [bends[0] / 2 * x * x, bends[1] / 2 * y * y])
        self.solution("vector.sol", mesh, [2], lambda x, y: [bends[0] / 2 * x * x, bends[1] / 2 * y * y])
        counts = []
        for name in ("two.sol", "vector.sol"):
            self.done("adapt", "square.poly", "--mesh", "0.mesh", "--sol", name, "-o", "next.mesh", "--shape", "anisotropic", "--tolerance",
                      str(tolerance))
            counts.append(len(read_mesh(self.path("next.mesh")).triangles))
        self.assertEqual(counts[0], counts[1])
        self.assertAlmostEqual(counts[0] / (16 / math.sqrt(3) / (sizes[0] * sizes[1])), 1, delta=0.1)

    def test_each_parameter_of_the_estimator_is_an_option(self):
        mesh = self.start()
        self.solution("u.sol", mesh, [1], lambda x, y: [10 * x * x])

        def count(*options, tolerance="0.02"):
            self.done("adapt", "square.poly", "--mesh", "0.mesh", "--sol", "u.sol", "-o", "next.mesh", "--tolerance", tolerance, *options)
            return len(read_mesh(self.path("next.mesh")).triangles)
        size = math.sqrt(4.5 * 0.02 / 20)
        self.assertAlmostEqual(count() / (16 / math.sqrt(3) / size ** 2), 1, delta=0.1)
        # In the other direction the size is hmax, or a third of it by the ratio.
        self.assertAlmostEqual(count("--shape", "anisotropic", "--max", "0.3") / (16 / math.sqrt(3) / (size * 0.3)), 1, delta=0.1)
        self.assertAlmostEqual(count("--shape", "anisotropic", "--ratio", "3") / (16 / math.sqrt(3) / (size * 3 * size)), 1, delta=0.1)
        # Relative errors with a floor of 1: the tolerance is .02 of the largest value, 10.
        self.assertAlmostEqual(count("--relative", "--floor", "1") / (16 / math.sqrt(3) / (10 * size ** 2)), 1, delta=0.1)
        self.assertGreater(count("--recovery", "projection", "--min", "0.05"), 1000)
        # The graph of x^2 by an angle a: 2 sin(a) / curvature in its tangent planes, less in the plane on its slopes (HDR sec. 3.4.3 a.2).
        wanted, steps = 0, 10000
        for i in range(steps):
            slope = 2 * (2 * (i + 0.5) / steps - 1)
            h = min(math.sin(math.radians(8)) * (1 + slope ** 2) ** 1.5, math.sqrt(8) / 5)
            wanted += 4 / math.sqrt(3) * math.sqrt(1 + slope ** 2) / h ** 2 * 4 / steps
        self.solution("u.sol", mesh, [1], lambda x, y: [x * x])
        found = count("--source", "curvature", "--shape", "graph", "--min", "0.02", tolerance="8")
        self.assertAlmostEqual(found / wanted, 1, delta=0.15)

    def summary(self, *words):
        result = self.run_program("adapt", *words, "-o", "next.mesh", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)["adaptation"]

    def widths(self, name):
        mesh = read_mesh(self.path(name))
        return [abs(mesh.vertices[t[k]][0] - mesh.vertices[t[k - 1]][0]) for t in mesh.triangles for k in range(3)]

    def test_the_error_of_the_last_mesh_is_estimated(self):
        """The field 10 x^2 bends by 20: 2/9 20 dx^2 on each edge (HDR eq. 3.3)."""
        self.solution("u.sol", self.start(), [1], lambda x, y: [10 * x * x])
        wanted = 2 / 9 * 20 * max(self.widths("0.mesh")) ** 2
        for tolerance in (wanted / 2, wanted * 1.01):
            loop = self.summary("square.poly", "--mesh", "0.mesh", "--sol", "u.sol", "--tolerance", repr(tolerance))
            self.assertAlmostEqual(loop["estimated_error_of_last_mesh"], wanted, delta=1e-6 * wanted)
            self.assertEqual((loop["tolerance"], loop["reached_by_last_mesh"]), (tolerance, tolerance > wanted))

    def test_surfaces_in_space_are_adapted(self):
        self.done("mesh", TEAPOT, "-o", "0.mesh", "--size", "2%")
        mesh = read_mesh(self.path("0.mesh"))
        self.assertEqual(mesh.dimension, 3)
        self.solution("u.sol", mesh, [1, 2], lambda x, y, z: [math.tanh(8 * (z - 1.2)), x, y, z])
        self.done("adapt", TEAPOT, "--mesh", "0.mesh", "--sol", "u.sol", "-o", "1.mesh", "--tolerance", "0.01", "--min", "0.03", "--gradation", "1.5")
        after = read_mesh(self.path("1.mesh"))
        dimension, types, rows = read_sol(self.path("1.sol"))
        self.assertEqual((dimension, types, len(rows)), (3, [1, 2], len(after.vertices)))
        # Edges are short where the field bends, 1.2 +- .08, and long far from it.

        def mean_edge(low, high):
            lengths = [math.dist(after.vertices[t[k]], after.vertices[t[k - 1]]) for t in after.triangles for k in range(3)
                       if low < after.vertices[t[k]][2] < high]
            return sum(lengths) / len(lengths)
        self.assertLess(2 * mean_edge(1.1, 1.3), mean_edge(0, 0.6))
        away = [math.dist(p, row[1:]) for p, row in zip(after.vertices, rows)]
        self.assertLess(sum(away) / len(away), 0.01)  # the chords of the last mesh

    def test_a_formula_makes_the_whole_loop(self):
        if not FORMULAS:
            self.skipTest("no muParser")
        told = self.done("adapt", "square.poly", "--formula", "10 * x^2", "--tolerance", "0.02", "--iterations", "2", "--size", "0.2", "-o",
                         "next.mesh")
        self.assertEqual(told.count("\nadaptation "), 2)
        self.assertIn("tolerance  0.02 not reached: estimated error ", told)
        size = math.sqrt(4.5 * 0.02 / 20)
        self.assertAlmostEqual(len(read_mesh(self.path("next.mesh")).triangles) / (16 / math.sqrt(3) / size ** 2), 1, delta=0.1)
        # The first mesh within the tolerance ends the loop: its error is at most 20 h^2 / 8 on edges h.
        loop = self.summary("square.poly", "--formula", "10 * x^2", "--tolerance", "0.02", "--min", "0.03", "--max", "0.03")
        self.assertEqual((loop["meshes"], loop["mesh"], loop["reached"]), (1, 1, True))
        self.assertLess(loop["estimated_error"], 0.02)
        self.assertAlmostEqual(loop["estimated_error"], 20 / 8 * max(self.widths("next.mesh")) ** 2, delta=1e-6)
        self.fails("square.poly", "--formula", "1 / (x - x)", "-o", "next.vtu", sentence="has no finite value at x =")
        self.fails("square.poly", "--mesh", "0.mesh", "--sol", "u.sol", "--convergence", "0.1", "-o", "next.vtu", sentence="it does not go with --mesh")
        # From the formula itself; the loop ends when the mesh no longer changes.
        told = self.done("adapt", "square.poly", "--formula", "10 * x^2", "--differences", "--tolerance", "0.02", "--iterations", "9", "--convergence",
                         "0.1", "--size", "0.2", "-o", "next.mesh")
        self.assertLess(told.count("\nadaptation "), 9)
        self.assertAlmostEqual(len(read_mesh(self.path("next.mesh")).triangles) / (16 / math.sqrt(3) / size ** 2), 1, delta=0.1)
        self.fails("square.poly", "--formula", "x +", "-o", "next.vtu", sentence="The formula 'x +' is wrong at position")

    def test_pictures_show_the_ellipses_of_metrics(self):
        """Four vertices of a square 2 x 2: rings with half axes .4 along y and .2 along x, at half of sizes .8 and .4."""
        self.write("two.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices 4\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\nTriangles 2\n1 2 3 1\n1 3 4 1\nEnd\n")
        self.solution("m.sol", read_mesh(self.path("two.mesh")), [3], lambda x, y: [1 / 0.4 ** 2, 0, 1 / 0.8 ** 2])
        self.done("picture", "two.mesh", "-o", "bare.png", "--size", "500x500", "--no-edges", "--color", "none")
        self.done("picture", "two.mesh", "--metric", "m.sol", "-o", "rings.png", "--size", "500x500", "--no-edges", "--color", "none")
        bare, rings = read_png(self.path("bare.png")), read_png(self.path("rings.png"))
        square = [(x, y) for y in range(500) for x in range(500) if sum(bare[y][x]) < 630]
        left, top = min(x for x, _ in square), min(y for _, y in square)
        width = max(x for x, _ in square) - left
        red = [(x, y) for y in range(500) for x in range(500) if rings[y][x][0] > 1.5 * rings[y][x][1] + 20]
        self.assertGreater(len(red), 200)
        scale = width / 2
        for x, y in red:
            # In units of the half axes, from the nearest vertex: on the ring, but for the width of the line.
            dx = min(abs(x + 0.5 - left), abs(x + 0.5 - left - width)) / scale
            dy = min(abs(y + 0.5 - top), abs(y + 0.5 - top - width)) / scale
            self.assertAlmostEqual(math.hypot(dx / 0.2, dy / 0.4), 1, delta=0.12)
        self.fails_picture("two.mesh", "--metric", "short.sol", sentence="it has values at 1 vertices, but the mesh has 4")

    def test_pictures_show_the_ellipses_of_the_mesh_itself(self):
        """Six equilateral triangles of side 1 around a vertex, twice as wide: half axes 1 and .5, at half the scale."""
        corners = [(2 * math.cos(k * math.pi / 3), math.sin(k * math.pi / 3)) for k in range(6)]
        self.write("six.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices 7\n0 0 0\n" + "".join(f"{x!r} {y!r} 0\n" for x, y in corners)
                   + "Triangles 6\n" + "".join(f"1 {k + 2} {(k + 1) % 6 + 2} 1\n" for k in range(6)) + "End\n")
        common = ("--size", "400x400", "--no-edges", "--color", "none", "--around", "0,0,0,1.5")
        self.done("picture", "six.mesh", "--metric", "mesh", "-o", "rings.png", *common)
        self.check_ring("rings.png", 0.92 * 200 / 1.5, (1, 0.5))
        self.fails_picture("six.mesh", "--view", "top", "--view", "iso", "--around", "0,0,0,1", sentence="--around shows one view")
        self.fails_picture("six.mesh", "--around", "0,0,0,0", sentence="--around requires a radius above 0")

    def test_ellipses_of_surfaces_lie_in_their_tangent_planes(self):
        """The plane z = x, by metrics of space with the sizes .8, .8 along it and another size across: from above the ring is narrower by
        sqrt(2)."""
        corners = [(-1, -1, -1), (1, -1, 1), (1, 1, 1), (-1, 1, -1)]
        self.write("tilted.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 5\n0 0 0 0\n" + "".join("%d %d %d 0\n" % p for p in corners)
                   + "Triangles 4\n" + "".join(f"1 {k + 2} {(k + 1) % 4 + 2} 1\n" for k in range(4)) + "End\n")
        a, b = 1 / 0.8 ** 2, 1 / 0.05 ** 2  # along, across
        write_sol(self.path("m.sol"), read_mesh(self.path("tilted.mesh")), [3],
                  lambda *p: [(a + b) / 2, 0, a, (a - b) / 2, 0, (a + b) / 2] if p == (0, 0, 0) else [1e4, 0, 1e4, 0, 0, 1e4])
        self.done("picture", "tilted.mesh", "--metric", "m.sol", "-o", "rings.png", "--size", "400x400", "--no-edges", "--color", "none", "--view", "top",
                  "--around", "0,0,0,0.8")
        self.check_ring("rings.png", 0.92 * 200 / 0.8, (0.4 / math.sqrt(2), 0.4), 0.05)

    def check_ring(self, name, scale, axes, delta=0.02):
        """Around the middle of a picture of 400 x 400, of `scale` pixels a unit; rings of other vertices lie outside."""
        reached, directions = [0, 0], set()
        for y, row in enumerate(read_png(self.path(name))):
            for x, (r, g, b) in enumerate(row):
                p = ((x + 0.5 - 200) / scale, (y + 0.5 - 200) / scale)
                away = math.hypot(p[0] / axes[0], p[1] / axes[1])
                if r > 1.5 * g + 20 and away < 1.01 + delta:
                    self.assertGreater(away, 0.97 - delta)
                    directions.add(int(16 * math.atan2(p[1], p[0]) / math.pi))
                    reached = [max(reached[0], abs(p[0])), max(reached[1], abs(p[1]))]
        self.assertGreaterEqual(len(directions), 31)
        for k in range(2):
            self.assertAlmostEqual(reached[k] / axes[k], 1, delta=2 * delta)

    def fails_picture(self, *words, sentence):
        self.write("short.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n1\n1 1\n1\nEnd\n")
        result = self.run_program("picture", *words, "-o", "none.png")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn(sentence, result.stderr)
        self.assertFalse(os.path.exists(self.path("none.png")))

    def test_mistakes_have_a_sentence_and_leave_no_file(self):
        mesh = self.start()
        self.solution("u.sol", mesh, [1], lambda x, y: [x])
        self.solution("h.sol", mesh, [1], lambda x, y: [0.1 if x < 0.5 else 0])
        self.write("short.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n1\n1 1\n1\nEnd\n")
        self.solution("full.sol", mesh, [4], lambda x, y: [1, 2, 3, 4])
        self.solution("minus.sol", mesh, [3], lambda x, y: [1, 0, -1])
        lost = ("square.poly", "-o", "next.mesh")
        self.fails(*lost, sentence="An adaptation requires --mesh and --sol")
        self.fails(*lost, "--mesh", "0.mesh", sentence="--mesh requires --sol")
        self.fails(*lost, "--sol", "u.sol", sentence="--sol requires --mesh")
        self.fails(*lost, "--mesh", "none.mesh", "--sol", "u.sol", sentence="--mesh 'none.mesh': there is no such file")
        self.fails(*lost, "--mesh", "0.mesh", "--sol", "u.sol", "--formula", "x", sentence="--formula stands in the place")
        self.fails(*lost, "--mesh", "0.mesh", "--sol", "short.sol", sentence="short.sol: it has values at 1 vertices, but 0.mesh has")
        self.fails(*lost, "--mesh", "0.mesh", "--sol", "full.sol", sentence="full.sol: it has tensors among other fields")
        self.fails(*lost, "--mesh", "0.mesh", "--sol", "minus.sol", sentence="vertex 1 has a metric that is not positive definite")
        self.fails(*lost, "--mesh", "0.mesh", "--sol", "h.sol", "--use", "sizes", sentence="has the size 0, which is not positive")
        self.fails(*lost, "--mesh", "0.mesh", "--sol", "u.sol", "--use", "colours", sentence="--use 'colours' is not one of: values, sizes, metrics")
        self.fails(*lost, "--mesh", "0.mesh", "--sol", "u.sol", "--tolerance", "0", sentence="--tolerance")
        self.fails(*lost, "--mesh", "0.mesh", "--sol", "u.sol", "--transfer", "short.sol", sentence="short.sol: it has values at 1 vertices")
        self.fails("square.poly", "--mesh", "0.mesh", "--sol", "u.sol", "--use", "sizes", "-o", "a.mesh", "-o", "a.sol",
                   sentence="There are no fields for 'a.sol'")
        self.fails("square.poly", "--mesh", "0.mesh", "--sol", "u.sol", "-o", "0.mesh", sentence="it is an input")
        self.fails("square.poly", "--mesh", "0.mesh", "--sol", "u.sol", "-o", "u.mesh", sentence="it is an input")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
