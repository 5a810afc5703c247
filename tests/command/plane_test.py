#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""plane_test.py CARREAU BL2D: plane domains by files: areas and references, the loop of bl2d.env, a sentence for each mistake."""
import math
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, BL2D = (os.path.abspath(path) for path in sys.argv[1:3])

# A square plate with a square hole and two triangles of other materials.
SQUARES = """12 2 0 1
1 0 0 1
2 8 0 1
3 8 8 1
4 0 8 1
5 1 1 2
6 3 1 2
7 3 3 2
8 1 3 2
9 5 5 3
10 7 5 3
11 7 7 3
12 4 6.5 4
13 1
1 1 2 1
2 2 3 1
3 3 4 1
4 4 1 1
5 5 6 2
6 6 7 2
7 7 8 2
8 8 5 2
9 9 10 3
10 10 11 3
11 11 9 3
12 12 9 5
13 12 11 0
1
1 2 2
1
1 6.5 5.5 9
"""

PIECE = """100 -- points
50  -- segments
10  -- subdomains
A -90 -15  B 0 -15  C 10.6 -10.6  D 15 0  E 10.6 10.6  F 0 15  G -90 15
S -60 0  T -50 -8  U -40 0  V -50 8
;
A ;
AB NULL A B NULL ;
BF NULL B C D E F NULL ;
FG NULL F G NULL ;
GA NULL G A NULL ;
H V S T U V S T ;
;
A 20 ;
AB 1 BF 2 FG 1 GA 3 H 4 ;
AB +1 200 ;
isotrope
A 6 G 6 B 2 F 2 D 1 S 1
;
"""
# A beam; its next sizes grow along side 1, and fall along side 3, as exponentials.
BEAM = """9 -- points
9 -- segments
1 -- subdomains
A 0 0  B 120 0  C 120 20  D 0 20
;
;
AB NULL A B NULL ; BC NULL B C NULL ; CD NULL C D NULL ; DA NULL D A NULL ;
;
A 20 ;
AB 1  BC 2  CD 3  DA 4 ;
AB +1 200 ;
isotrope A 15 B 10 C 15 D 10 ;
"""

ENV = "base piece\ngeom 0\nadapt {}\nelement p1\nfile_h {}\n"


class Mesh:
    """A .bl2d or plane .mesh: vertices (x, y, ref), edges (a, b, ref), triangles (a, b, c, ref), from 0."""

    def __init__(self, path):
        with open(path) as file:
            words = file.read().split()
        if path.endswith(".bl2d"):
            assert words[0] == "p1"
            n, k, m = map(int, words[1:4])
            at = 4
            self.vertices = [(float(words[at + 3 * i]), float(words[at + 3 * i + 1]), int(words[at + 3 * i + 2])) for i in range(n)]
            self.edges = self.rows(words, at + 3 * n, k, 3)
            self.triangles = self.rows(words, at + 3 * n + 3 * k, m, 4)
        else:
            assert words[words.index("Dimension") + 1] == "2", path
            at = words.index("Vertices") + 2
            n = int(words[at - 1])
            self.vertices = [(float(words[at + 3 * i]), float(words[at + 3 * i + 1]), int(words[at + 3 * i + 2])) for i in range(n)]
            self.edges = self.section(words, "Edges", 3)
            self.triangles = self.section(words, "Triangles", 4)

    @staticmethod
    def rows(words, at, count, width):
        table = [[int(w) for w in words[at + width * i:at + width * (i + 1)]] for i in range(count)]
        return [[v - 1 for v in row[:-1]] + [row[-1]] for row in table]

    def section(self, words, name, width):
        if name not in words:
            return []
        at = words.index(name) + 2
        return self.rows(words, at, int(words[at - 1]), width)

    def areas(self):
        """Area by reference."""
        sums = {}
        for a, b, c, ref in self.triangles:
            (x, y, _), (u, v, _), (r, s, _) = (self.vertices[i] for i in (a, b, c))
            twice = (u - x) * (s - y) - (v - y) * (r - x)
            assert twice > 0
            sums[ref] = sums.get(ref, 0) + twice / 2
        return sums

    def length(self, ref):
        return sum(math.dist(self.vertices[a][:2], self.vertices[b][:2]) for a, b, r in self.edges if r == ref)


class Plane(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau plane ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
        return self.path(name)

    def run_program(self, *arguments):
        return subprocess.run(arguments, capture_output=True, text=True, timeout=60, cwd=self.folder)

    def plane(self, domain, *options, output="out.mesh"):
        done = self.run_program(PROGRAM, "plane", domain, "-q", "-o", self.path(output), *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return Mesh(self.path(output))

    def test_areas_are_exact_and_references_are_kept(self):
        domain = self.write("squares.poly", SQUARES)
        mesh = self.plane(domain, "--size", "0.5")
        areas = mesh.areas()
        triangle = abs((5 - 4) * (7 - 6.5) - (7 - 4) * (5 - 6.5)) / 2 - 0  # of points 9, 11, 12
        inner = 2.0  # of points 9, 10, 11
        self.assertAlmostEqual(areas[9], inner, delta=1e-12)
        self.assertAlmostEqual(sum(areas.values()), 64 - 4, delta=1e-11)
        self.assertEqual(len(areas), 3)
        self.assertTrue(any(abs(area - triangle) < 1e-12 for area in areas.values()))
        self.assertAlmostEqual(mesh.length(1), 32, delta=1e-12)
        self.assertAlmostEqual(mesh.length(2), 8, delta=1e-12)
        self.assertAlmostEqual(mesh.length(5), math.dist((4, 6.5), (5, 5)), delta=1e-12)
        for x, y, ref in ((0, 0, 1), (1, 1, 2), (7, 7, 3), (4, 6.5, 4)):
            self.assertIn((x, y, ref), mesh.vertices)
        self.assertEqual({ref for _, _, ref in mesh.vertices}, {0, 1, 2, 3, 4})

    def test_every_format_holds_the_same_mesh(self):
        domain = self.write("squares.poly", SQUARES)
        outputs = [self.path("out" + suffix) for suffix in (".mesh", ".bl2d", ".meshb", ".vtu", ".msh", ".stl")]
        done = self.run_program(PROGRAM, "plane", domain, "-q", "--size", "1", *[word for path in outputs for word in ("-o", path)])
        self.assertEqual(done.returncode, 0, done.stderr)
        mesh, again = Mesh(outputs[0]), Mesh(outputs[1])
        self.assertEqual(mesh.vertices, again.vertices)
        self.assertEqual(mesh.triangles, again.triangles)
        self.assertEqual(sorted(mesh.edges), sorted(again.edges))
        counts = {re.search(r"triangles +(\d+)", self.run_program(PROGRAM, "check", path).stdout)[1] for path in outputs}
        self.assertEqual(counts, {str(len(mesh.triangles))})

    def test_a_mesh_is_a_domain_for_the_next_one(self):
        mesh = self.plane(self.write("squares.poly", SQUARES), "--size", "1")
        again = self.plane(self.path("out.mesh"), "--size", "0.5", output="finer.bl2d")
        self.assertGreater(len(again.triangles), len(mesh.triangles))
        for ref, area in mesh.areas().items():
            self.assertAlmostEqual(again.areas()[ref], area, delta=1e-11)

    @staticmethod
    def area_of_spline(n):
        """Area of the closed spline of Catmull and Rom through n points of the unit circle: n equal pieces, by Green."""
        a = 2 * math.pi / n
        b, c = (1.0, 0.0), (math.cos(a), math.sin(a))
        tangents = (0.0, math.sin(a)), (-math.sin(a) * math.sin(a), math.sin(a) * math.cos(a))
        twice, steps = 0.0, 2000

        def at(t):
            h = 2 * t ** 3 - 3 * t * t + 1, t ** 3 - 2 * t * t + t, 3 * t * t - 2 * t ** 3, t ** 3 - t * t
            return [h[0] * b[k] + h[1] * tangents[0][k] + h[2] * c[k] + h[3] * tangents[1][k] for k in (0, 1)]
        for i in range(steps):
            (x, y), (u, v) = at(i / steps), at((i + 1) / steps)
            twice += x * v - y * u
        return n * twice / 2

    def test_smooth_polygons_are_splines(self):
        n = 16
        points = "".join(f"{i + 1} {math.cos(2 * math.pi * i / n)!r} {math.sin(2 * math.pi * i / n)!r}\n" for i in range(n))
        edges = "".join(f"{i + 1} {i + 1} {(i + 1) % n + 1}\n" for i in range(n))
        domain = self.write("disc.poly", f"{n} 2 0 0\n{points}{n} 0\n{edges}0\n")
        polygon = sum(self.plane(domain, "--size", "0.02").areas().values())
        self.assertAlmostEqual(polygon, n / 2 * math.sin(2 * math.pi / n), delta=1e-12)
        mesh = self.plane(domain, "--smooth", "--size", "0.02")
        # Chords of .02 of curves of radius 1 leave a share .02^2 / 6 out.
        self.assertAlmostEqual(sum(mesh.areas().values()), self.area_of_spline(n), delta=1.5 * math.pi * 0.02 ** 2 / 6)
        sides = {side for a, b, c, _ in mesh.triangles for side in ((a, b), (b, c), (c, a))}
        radii = [math.hypot(*mesh.vertices[a][:2]) for a, b in sides if (b, a) not in sides]
        middle = math.cos(math.pi / n) + math.sin(2 * math.pi / n) * math.sin(math.pi / n) / 4
        self.assertGreaterEqual(min(radii), middle - 1e-9)  # the polygon's own is cos(pi / n)
        self.assertLessEqual(max(radii), 1 + 1e-9)

    def test_sizes_at_the_vertices_of_a_mesh_govern_the_next_one(self):
        mesh = self.plane(self.write("unit.poly", "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n"),
                          "--size", "0.1", output="one.mesh")
        n = len(mesh.vertices)
        self.write("round.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n%d\n1 1\n%sEnd\n" % (n, "0.05\n" * n))
        self.write("thin.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n%d\n1 3\n%sEnd\n" % (n, "2500 0 100\n" * n))
        self.write("coarse.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n%d\n1 1\n%sEnd\n" % (n, "0.25\n" * n))
        coarse = self.plane(self.path("one.mesh"), "--sol", self.path("coarse.sol"))
        self.assertEqual(len(coarse.edges), 16)  # four a side: vertices of the finer mesh do not stay
        for name, wanted in (("round.sol", 4 / math.sqrt(3) / 0.05 ** 2), ("thin.sol", 4 / math.sqrt(3) * math.sqrt(2500 * 100))):
            count = len(self.plane(self.path("one.mesh"), "--sol", self.path(name)).triangles)
            self.assertAlmostEqual(count / wanted, 1, delta=0.15, msg=name)
        self.write("short.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n1\n1 1\n1\nEnd\n")
        self.fails("one.mesh", "--sol", "short.sol", sentence="it has values at 1 vertices, but one.mesh has")

    def test_segments_that_cross_are_arranged(self):
        # Two segments cross the side 3 at (3, 8) and (2.6, 8); a point is given twice.
        for name, text, note in (("cross.poly", SQUARES.replace("7 3 3 2", "7 3 9 2"), "2 crossings of segments became points"),
                                 ("twice.poly", SQUARES.replace("12 4 6.5 4", "12 8 8 4"),
                                  "1 repeated points were merged")):
            self.write(name, text)
            done = self.run_program(PROGRAM, "plane", name, "-o", "arranged.mesh", "--size", "1")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr.count(note), 1, done.stderr)
            self.assertEqual(self.run_program(PROGRAM, "check", "arranged.mesh").returncode, 0)

    def area(self, mesh):
        done = self.run_program(PROGRAM, "check", mesh, "--json")
        return json.loads(done.stdout)["quality"]["area"]

    def test_nodes_are_meshed_in_their_convex_hull(self):
        self.write("five.node", "5 2 0 1\n1 0 0 1\n2 2 0 1\n3 2 1 1\n4 0 1 1\n5 1 0 0\n6 .5 .5 0\n".replace("5 2 0 1", "6 2 0 1"))
        self.assertEqual(self.run_program(PROGRAM, "plane", "five.node", "-o", "five.mesh", "--size", "0.4").returncode, 0)
        self.assertAlmostEqual(self.area("five.mesh"), 2, delta=1e-12)
        # A .poly without points takes the points of the .node beside it.
        self.write("five.poly", "0 2 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n")
        self.assertEqual(self.run_program(PROGRAM, "plane", "five.poly", "-o", "five.mesh", "--size", "0.4").returncode, 0)
        self.assertAlmostEqual(self.area("five.mesh"), 1, delta=1e-12)

    def test_airfoils_of_both_layouts(self):
        # A kite as an airfoil: area .06; with a blunt trailing edge of .02, .065.
        for half, area in ((0, 0.06), (0.01, 0.065)):
            upper, lower = [(0, 0), (0.5, 0.06), (1, half)], [(0, 0), (0.5, -0.06), (1, -half)]
            rows = lambda points: "".join(f"  {x:.6f}  {y:.6f}\n" for x, y in points)
            selig = rows(upper[::-1] + lower[1:])
            for text in ("KITE 12\n" + selig, selig, "KITE\n 3.  3.\n\n" + rows(upper) + "\n" + rows(lower)):
                self.write("kite.dat", text)
                done = self.run_program(PROGRAM, "plane", "kite.dat", "-o", "kite.mesh", "--size", "0.05")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertAlmostEqual(self.area("kite.mesh"), area, delta=1e-9)
        self.write("short.dat", "KITE\n 3.  4.\n\n" + rows(upper) + "\n" + rows(lower))
        self.fails("short.dat", sentence="short.dat, line 2: 3 and 4 points are announced, and there are 6")
        self.write("word.dat", "KITE\n0 0\n1 x\n")
        self.fails("word.dat", sentence="word.dat, line 3: two coordinates were expected, not '1 x'")

    def fails(self, *arguments, sentence):
        done = self.run_program(PROGRAM, "plane", *arguments, "-o", "no.mesh")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn(sentence, done.stderr)
        self.assertFalse(os.path.exists(self.path("no.mesh")))

    def test_mistakes_are_reported_with_the_line(self):
        self.write("open.poly", SQUARES.replace("13 1\n", "12 1\n").replace("4 4 1 1\n", "").split("5 5 6 2")[0].replace("12 1\n", "3 1\n") + "0\n")
        self.fails("open.poly", sentence="its boundary is open, since only one curve ends at point '1'")
        self.write("wrong.data", PIECE.replace("AB +1 200", "AB -1 200"))
        self.fails("wrong.data", sentence="wrong.data, line 16: the domain lies on the right of curve 'AB', which is its outer side")
        self.write("name.data", PIECE.replace("NULL F G NULL", "NULL F Z NULL"))
        self.fails("name.data", sentence="name.data, line 10: there is no point 'Z'")
        self.write("size.data", PIECE.replace("D 1 ", "D 0 "))
        self.fails("size.data", sentence="a size is not positive")
        self.write("loop.data", "9\n9\n9\nA -11 -8 B 0 0 C 1 0 D 12 -8 Z .5 -5\n;\n;\n"
                   "L A B C D ;\nR NULL C Z B NULL ;\n;\n;\n;\nL -1 1 ;\nisotrope\n;\n")
        self.fails("loop.data", sentence="line 7: curve 'L' makes a loop between point 'B' and point 'C': it passes (0.5, 0.")
        self.fails("none.poly", sentence="none.poly")
        self.fails("x.step", sentence="does not have a suffix of plane domains")

    # ---- bl2d ----

    def bl2d(self, code=0):
        done = self.run_program(BL2D)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stderr if code else done.stdout

    def test_bl2d_runs_the_loop_by_files(self):
        self.write("piece.0.data", PIECE)
        self.write("bl2d.env", "-- a comment\n" + ENV.format(0, 1))
        self.bl2d()
        counts = []
        for step in range(4):
            mesh = Mesh(self.path(f"piece.0.{step}.bl2d"))
            self.assertEqual(set(mesh.areas()), {200})
            self.assertEqual({ref for _, _, ref in mesh.edges}, {1, 2, 3, 4})
            self.assertIn((-90, -15, 20), mesh.vertices)
            counts.append(len(mesh.triangles))
            sizes = "".join(f"{max(0.5, min(6, 0.5 + 0.15 * abs(x + 20 - y)))}\n" for x, y, _ in mesh.vertices)
            self.write(f"piece.0.{step}.h", f"{len(mesh.vertices)} 1\n{sizes}")
            self.write("bl2d.env", ENV.format(step + 1, 0))
            if step < 3:
                self.bl2d()
        self.assertAlmostEqual(counts[3] / counts[2], 1, delta=0.03)
        self.assertGreater(counts[1], counts[0] / 10)

    def test_bl2d_stretches_triangles_by_metrics(self):
        self.write("piece.0.data", PIECE)
        self.write("bl2d.env", ENV.format(0, 0))
        self.bl2d()
        for step in range(2):
            n = len(Mesh(self.path(f"piece.0.{step}.bl2d")).vertices)
            self.write(f"piece.0.{step}.h", f"{n} 3\n" + "0.04 0 1\n" * n)
            self.write("bl2d.env", ENV.format(step + 1, 0))
            self.bl2d()
        mesh = Mesh(self.path("piece.0.2.bl2d"))
        area = sum(mesh.areas().values())
        self.assertAlmostEqual(len(mesh.triangles) / (area * 4 / math.sqrt(3) * math.sqrt(0.04)), 1, delta=0.15)

    def test_bl2d_cuts_the_boundary_by_the_sizes_of_the_mesh_before(self):
        self.write("piece.0.0.data", BEAM)
        self.write("bl2d.env", ENV.format(0, 0))
        self.bl2d()
        before = Mesh(self.path("piece.0.0.bl2d"))
        below, above = math.log(1.25) / 15, math.log(1.15) / 30
        sizes = "".join(f"{2 * math.exp(below * x) if y < 1 else 3 * math.exp(above * (120 - x))!r}\n" for x, y, _ in before.vertices)
        self.write("piece.0.0.h", f"{len(before.vertices)} 1\n{sizes}")
        self.write("bl2d.env", ENV.format(1, 0))
        self.bl2d()
        after = Mesh(self.path("piece.0.1.bl2d"))
        for side, corner, first, growth in ((1, (0, 0), 2, below), (3, (120, 20), 3, above)):
            length = (1 - math.exp(-growth * 120)) / (first * growth)  # of the side, in sizes
            n = round(length)
            ends = {v for a, b, ref in after.edges if ref == side for v in (a, b)}
            found = sorted(math.dist(after.vertices[v][:2], corner) for v in ends)
            self.assertEqual(len(found), n + 1)
            for k, s in enumerate(found[1:-1], 1):
                self.assertAlmostEqual(s, -math.log(1 - k * length / n * growth * first) / growth, delta=5e-4 * 120)

    def test_bl2d_reports_mistakes(self):
        self.write("bl2d.env", ENV.format(0, 0))
        self.assertIn("there is no domain: none of piece.0.0.data, piece.0.data", self.bl2d(2))
        self.write("piece.0.data", PIECE)
        self.write("bl2d.env", ENV.format(3, 0))
        self.assertIn("there is no mesh of step 2", self.bl2d(2))
        self.write("bl2d.env", ENV.format(0, 0).replace("p1", "p3"))
        self.assertIn("bl2d.env, line 4: parameter element must be", self.bl2d(2))
        self.write("bl2d.env", ENV.format(0, 0) + "gradatoin 1.2\n")
        self.assertIn("bl2d.env, line 6: ", self.bl2d(2))
        self.write("bl2d.env", ENV.format(0, 0))
        self.bl2d()
        self.write("piece.0.0.h", "3 1\n1\n1\n1\n")
        self.write("bl2d.env", ENV.format(1, 0))
        self.assertIn("piece.0.0.h: it has values at 3 vertices", self.bl2d(2))
        self.assertFalse(os.path.exists(self.path("piece.0.1.bl2d")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
