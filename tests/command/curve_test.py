#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""curve_test.py CARREAU: `carreau curve` by the figures and closed forms of INRIA RR-2818, and on the files of BL2D."""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

PROGRAM = os.path.abspath(sys.argv[1])
LAWS = ("linear", "geometric", "sinusoidal")


def inverse_mean(law, h, k):
    """The mean of 1 / h(s) between sizes h and k (RR-2818 sec. 5.4)."""
    return {"linear": math.log(k / h) / (k - h), "geometric": (k - h) / (h * k * math.log(k / h)), "sinusoidal": 1 / math.sqrt(h * k)}[law]


def fortran(x):
    """A number with three digits in its exponent: 1.5e+001."""
    mantissa, exponent = f"{x:.17e}".split("e")
    return f"{mantissa}e{exponent[0]}{int(exponent[1:]):03d}"


class Curve(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau curve ")
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w") as file:
            file.write(text)
        return name

    def run_curve(self, *arguments, code=0):
        done = subprocess.run([PROGRAM, "curve", *arguments], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def curves(self, *arguments):
        return json.loads(self.run_curve(*arguments, "--json").stdout)["curves"]

    def mesh(self, name):
        """Vertices and edges (a, b, reference), from 0."""
        with open(os.path.join(self.folder, name)) as file:
            words = file.read().split()
        width = int(words[words.index("Dimension") + 1]) + 1
        at = words.index("Vertices")
        vertices = [tuple(map(float, words[at + 2 + width * i:at + 1 + width * (i + 1)])) for i in range(int(words[at + 1]))]
        at = words.index("Edges")
        edges = [tuple(map(int, words[at + 2 + 3 * i:at + 5 + 3 * i])) for i in range(int(words[at + 1]))]
        return vertices, [(a - 1, b - 1, ref) for a, b, ref in edges]

    def test_the_sizes_of_figure_20(self):
        places, sizes = (0, 3, 4, 8, 10), (1.5, 0.5, 2, 0.1, 0.7)
        points = self.write("points.txt", "# figure 20\n" + "".join(f"{s} 0\n" for s in places))
        self.write("sizes.txt", "".join(f"{h}\n" for h in sizes))
        for law, printed in zip(LAWS, (17, 26, 21)):
            row, = self.curves(points, "--sizes", "sizes.txt", "--law", law, "-o", law + ".mesh", "-o", law + ".svg")
            exact = sum((t - s) * inverse_mean(law, h, k) for s, t, h, k in zip(places, places[1:], sizes, sizes[1:]))
            self.assertEqual(row["edges"], printed)
            self.assertAlmostEqual(row["length"], 10, delta=1e-12)
            self.assertAlmostEqual(row["metric_length"], exact, delta=1e-11)
            vertices, edges = self.mesh(law + ".mesh")
            self.assertEqual([(a, b) for a, b, _ in edges][-1][1], 1)  # both ends come first
            cuts = sorted(x for x, _ in vertices)
            # h(s) takes the length of each edge on it (the theorem of sec. 6.1), here of a common length near 1.
            for a, b in zip(cuts, cuts[1:]):
                between = [self.size(law, places, sizes, a + (b - a) * i / 200) for i in range(201)]
                self.assertLessEqual(min(between), (b - a) * printed / exact * 1.001)
                self.assertGreaterEqual(max(between), (b - a) * printed / exact * 0.999)
            drawing = xml.etree.ElementTree.parse(os.path.join(self.folder, law + ".svg")).getroot()
            self.assertEqual(sum(each.tag.endswith("circle") for each in drawing), printed + 1)
            self.assertEqual(sum(each.tag.endswith("polyline") for each in drawing), 5 + 1)

    @staticmethod
    def size(law, places, sizes, s):
        i = max(k for k in range(len(places) - 1) if places[k] <= s)
        t, h, k = (s - places[i]) / (places[i + 1] - places[i]), sizes[i], sizes[i + 1]
        return {"linear": h + t * (k - h), "geometric": h * (k / h) ** t, "sinusoidal": (h + k + (h - k) * math.cos(math.pi * t)) / 2}[law]

    def test_the_metrics_of_figure_24(self):
        triplets = ((0, 30, 0.70, 0.25), (2, 90, 1.10, 0.15), (3, 0, 0.30, 0.30), (6, -60, 1.50, 0.40), (7.5, -45, 1.00, 0.35))
        points = self.write("points.txt", "".join(f"{s} 0\n" for s, *_ in triplets))
        rows = ""
        for _, angle, h1, h2 in triplets:
            c, s, p, q = math.cos(math.radians(angle)), math.sin(math.radians(angle)), h1 ** -2, h2 ** -2
            rows += f"{p * c * c + q * s * s!r} {(p - q) * c * s!r} {p * s * s + q * c * c!r}\n"
        self.write("metrics.h", "5 3\n" + rows)
        for law, edges in zip(LAWS, (22, 23, 23)):  # as fortran_examples/c_metric_curves
            self.assertEqual(self.curves(points, "--sizes", "metrics.h", "--law", law)[0]["edges"], edges)

    def test_a_spline_through_points_of_a_parabola_is_the_parabola(self):
        # Half the vector between neighbours is the tangent of y = x^2 at equal steps, and free ends make parabolas (sec. 3.3).
        points = self.write("parabola.txt", "".join(f"{x} {x * x}\n" for x in (-2, -1, 0, 1, 2)))
        row, = self.curves(points, "--size", "0.05", "--deviation", "1e-5", "-o", "parabola.mesh")
        exact = 2 * (2 * math.sqrt(17) + math.asinh(4) / 2) / 2
        self.assertAlmostEqual(row["length"], exact, delta=1e-7 * exact)
        self.assertEqual(row["edges"], round(exact / 0.05))
        for x, y in self.mesh("parabola.mesh")[0]:
            self.assertAlmostEqual(y, x * x, delta=1e-6)
        straight, = self.curves(points, "--through", "straight")
        self.assertAlmostEqual(straight["length"], 2 * (math.sqrt(2) + math.sqrt(10)), delta=1e-12)

    def test_a_closed_spline_has_no_corner(self):
        n = 24
        at = lambda i: (math.cos(2 * math.pi * (i % n) / n), math.sin(2 * math.pi * (i % n) / n))
        points = self.write("circle.txt", "".join("{!r} {!r}\n".format(*at(i)) for i in range(n + 1)))
        row, = self.curves(points, "--size", str(2 * math.pi / 48), "-o", "circle.mesh", "--deviation", "1e-4")
        self.assertAlmostEqual(row["length"], 2 * math.pi, delta=1e-3)
        self.assertEqual(row["edges"], 48)
        vertices, edges = self.mesh("circle.mesh")
        self.assertEqual((len(vertices), len(edges)), (48, 48))
        for x, y in vertices:
            self.assertAlmostEqual(math.hypot(x, y), 1, delta=1e-3)

    def test_curves_of_space_and_several_of_them(self):
        helix = "".join(f"{math.cos(t / 10)!r} {math.sin(t / 10)!r} {t / 20}\n" for t in range(101))
        points = self.write("helix.txt", helix + "\n! a second one\n0 0 0\n0 0 2\n")
        first, second = self.curves(points, "--size", "0.1", "-o", "helix.mesh")
        self.assertAlmostEqual(first["length"], 10 * math.sqrt(1.25), delta=1e-3)
        self.assertEqual((second["reference"], second["edges"]), (2, 20))
        vertices, edges = self.mesh("helix.mesh")
        self.assertEqual({len(v) for v in vertices}, {3})
        self.assertEqual(len(edges), first["edges"] + 20)

    def test_a_loop_of_a_piece_is_reported(self):
        points = self.write("loop.txt", "-20 -20\n0 0\n1 0\n20 -20\n")
        self.assertIn("a piece of its spline crosses itself", self.run_curve(points).stderr)
        self.assertEqual(self.run_curve(points, "--through", "straight").stderr, "")

    def test_files_of_bl2d(self):
        # A beam: SMOOTH of eight straight curves with a middle each, in the layout of its files.
        corners = [(-90, -15), (-60, -15), (60, -15), (90, -15), (90, 15), (30, 15), (-30, 15), (-90, 15)]
        pairs = list(zip(corners, corners[1:] + corners[:1]))
        middles = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in pairs]
        text = "      p1\n16 16 1\n" + "".join(f"{fortran(x)} {fortran(y)}\n" for x, y in [(-90, -15), (90, 15), *corners, *middles])
        text += "".join(f"1 {i + 1} {i + 9}\n1 {i + 9} {(i + 1) % 8 + 1}\n" for i in range(8)) + "\n 1 9\n\nsupplement\n16 0 8 8 8\n"
        for i, (a, b) in enumerate(pairs):
            length = math.dist(a, b)
            text += f"3\n{i + 1} {fortran(0)}\n{i + 9} {fortran(length / 2)}\n{(i + 1) % 8 + 1} {fortran(length)}\n"
        self.write("piece.0.0.smo", text + "\n8 tgvectors\n" + "1.0e+000 0.0e+000 1.0e+000 0.0e+000\n" * 8)
        rows = self.curves("piece.0.0.smo", "--size", "15", "-o", "piece.0.0.mc", "-o", "edges.mesh")
        self.assertEqual([row["edges"] for row in rows], [2, 8, 2, 2, 4, 4, 4, 2])  # lengths over 15: 28
        again = self.curves("piece.0.0.mc", "--sizes", self.write("piece.0.0.hc", "28 1\n" + "15\n" * 28))
        self.assertEqual([(row["reference"], row["edges"]) for row in again], [(i + 1, row["edges"]) for i, row in enumerate(rows)])
        # MS: two subdomains in a frame whose corners come last.
        self.write("two.ms", "p1\n10 9 2\n0 0\n1 0\n2 0\n0 1\n1 1\n2 1\n-9 -9\n9 -9\n9 9\n-9 9\n1 2 5 1\n1 5 4 1\n2 3 6 2\n2 6 5 2\n"
                   "7 8 1 0\n8 3 2 0\n8 2 1 0\n9 10 4 0\n9 6 3 0\n")
        rows = self.curves("two.ms", "--sizes", self.write("two.h", "6 1\n" + "0.25\n" * 6), "-o", "two.mesh")
        self.assertEqual(sorted(row["edges"] for row in rows), [4, 12, 12])
        done = subprocess.run([PROGRAM, "check", "two.ms", "--json"], cwd=self.folder, capture_output=True, text=True)
        checked = json.loads(done.stdout)  # two squares of side 1 in two triangles each
        self.assertEqual((done.returncode, checked["triangles"], checked["faces"], checked["quality"]["area"]), (0, 4, 2, 2))

    def test_mistakes_have_sentences(self):
        def refused(sentence, *arguments):
            self.assertIn(sentence, self.run_curve(*arguments, code=2).stderr)
        self.write("good.txt", "0 0\n1 0\n2 1\n")
        refused("bad.txt, line 2: a word is not a number", self.write("bad.txt", "0 0\n1 x\n"))
        refused("bad.txt, line 2: a point has two or three coordinates", self.write("bad.txt", "0 0\n1 0 0\n"))
        refused("has one point only", self.write("bad.txt", "0 0\n"))
        refused("has no curve", self.write("bad.txt", "# nothing\n"))
        refused("has values at 2 points; there are 3", "good.txt", "--sizes", self.write("sizes.txt", "1\n1\n"))
        refused("a size must be above 0", "good.txt", "--sizes", self.write("sizes.txt", "1\n0\n1\n"))
        refused("not positive definite", "good.txt", "--sizes", self.write("sizes.h", "3 3\n1 0 1\n1 0 1\n1 2 1\n"))
        refused("the first line is a number of points", "good.txt", "--sizes", self.write("sizes.h", "1\n1\n1\n"))
        refused("coincide", self.write("bad.txt", "0 0\n0 0\n1 0\n"))
        refused("bad.mc, line 7: the vertex 9 does not exist; there are 2",
                self.write("bad.mc", "p1\n2 1 1\n0 0\n1 0\n0 0\n1 0\n1 1 9\n"))
        refused(".mc", "good.txt", "-o", "x.vtu")
        refused("dimension 2", self.write("space.txt", "0 0 0\n1 0 0\n"), "-o", "x.mc")
        self.assertFalse(os.path.exists(os.path.join(self.folder, "x.mc")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
