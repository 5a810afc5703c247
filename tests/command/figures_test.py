#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""figures_test.py CARREAU DATA: figures of the HDR on inputs of our own, with counts beside the paper's. DATA: tests/data/grid.
docs/reference/papers.md prints ours."""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import mesh_files

PROGRAM, DATA = sys.argv[1:3]
PAGE = os.path.join(DATA, "..", "..", "..", "docs", "reference", "papers.md")


WAVE = 0.345  # its area and length give the numbers of edges and triangles of fig. 1.4


def radius(t):
    """The contour r(t) = 1 + WAVE cos 5 t stands for the analytic one of HDR fig. 1.3, which the paper does not print."""
    return 1 + WAVE * math.cos(5 * t)


def tangent(t):
    r, s = radius(t), -5 * WAVE * math.sin(5 * t)
    return (s * math.cos(t) - r * math.sin(t), s * math.sin(t) + r * math.cos(t))


def angle_between(p, q):
    return abs(math.degrees(math.atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1])))


def printed(figure):
    """The numbers that the page prints as ours for a figure."""
    with open(PAGE) as file:
        ours = next(line for line in file if line.startswith(f"| {figure} |")).split("|")[4]
    return [float(number.replace(" ", "")) for number in re.findall(r"\d+(?: \d{3})*(?:\.\d+)?|\.\d+", ours)]


def signed_volume(mesh):
    """Inside triangles that are counterclockwise from outside."""
    sum6 = 0
    for corners in mesh.triangles:
        (a, b, c), (d, e, f), (g, h, i) = (mesh.vertices[v] for v in corners)
        sum6 += a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return sum6 / 6


class Figures(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau figures ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def mesh(self, *arguments):
        """The mesh, and figures of it."""
        done = subprocess.run([PROGRAM, *arguments, "-o", self.path("x.mesh"), "--json", "-q"], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return mesh_files.read_mesh(self.path("x.mesh")), json.loads(done.stdout)["mesh"]

    def is_printed(self, figure, *values):
        """The page prints these values, to half a percent."""
        numbers = printed(figure)
        for value in values:
            self.assertLess(min(abs(value / number - 1) for number in numbers), 0.005, (value, numbers))

    def contour(self, *options):
        """A mesh inside the contour by options, and its border from vertex to vertex."""
        mesh, _ = self.mesh("plane", self.path("contour.poly"), "--smooth", *options)
        after = {a: b for a, b, _ in mesh.edges}
        border = [min(after)]
        while after[border[-1]] != border[0]:
            border.append(after[border[-1]])
        self.assertEqual(len(border), len(mesh.edges))
        return mesh, [mesh.vertices[v] for v in border]

    def test_contours_of_figures_1_3_to_1_8(self):
        n = 720
        points = [(radius(t) * math.cos(t), radius(t) * math.sin(t)) for t in (2 * math.pi * k / n for k in range(n))]
        with open(self.path("contour.poly"), "w") as file:
            file.write(f"{n} 2 0 0\n" + "".join(f"{k + 1} {x:.16g} {y:.16g}\n" for k, (x, y) in enumerate(points)))
            file.write(f"{n} 0\n" + "".join(f"{k + 1} {k + 1} {(k + 1) % n + 1}\n" for k in range(n)) + "0\n")
        length = sum(math.dist(p, q) for p, q in zip(points, points[1:] + points[:1]))
        # Fig. 1.4 and 1.5: 108 vertices and 168 triangles, with half the size 403 and 711. So 46 and 93 edges bound them (2 V - 2 - T).
        for size, vertices, triangles in ((length / 46.4, 108, 168), (length / 92.8, 403, 711)):
            mesh, border = self.contour("--size", repr(size))
            self.assertEqual(len(border), 2 * vertices - 2 - triangles)
            self.assertAlmostEqual(len(mesh.vertices) / vertices, 1, delta=0.05)
            self.assertAlmostEqual(len(mesh.triangles) / triangles, 1, delta=0.05)
        # Fig. 1.6 to 1.8: 8 degrees between edges and tangents, then ratios of 1.1 and 1.3 between consecutive edges.
        shapes, ratios, largest = [], [], []
        for gradation in (0, 1.1, 1.3):
            mesh, border = self.contour("--angle", "8", "--max", "0.3", "--gradation", str(gradation), "--set", "geo_guarantee=1")
            edges = [(q[0] - p[0], q[1] - p[1]) for p, q in zip(border, border[1:] + border[:1])]
            angles = [angle_between(edge, tangent(math.atan2(p[1], p[0])))
                      for edge, p, q in zip(edges, border, border[1:] + border[:1]) for p in (p, q)]
            lengths = [math.hypot(*edge) for edge in edges]
            ratio = max(max(a / b, b / a) for a, b in zip(lengths, lengths[1:] + lengths[:1]))
            self.assertLess(max(angles), 8)
            ratios.append(ratio)
            largest.append(max(angles))
            if gradation > 0:
                self.assertLess(ratio, gradation * 1.005)
            else:
                self.assertGreater(ratio, 1.3)
            worst = min(2 * math.sqrt(3) * area / sum(d * d for d in sides) for area, sides in map(self.triangle(mesh), mesh.triangles))
            shapes.append(worst)
        self.assertTrue(shapes[0] < shapes[1] and shapes[0] < shapes[2], shapes)
        self.is_printed("1.6 to 1.8", max(largest), *ratios[1:])

    @staticmethod
    def triangle(mesh):
        def sides(corners):
            p, q, r = (mesh.vertices[v] for v in corners)
            area = abs((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))
            return area, (math.dist(p, q), math.dist(q, r), math.dist(r, p))
        return sides

    def test_a_head_that_is_uniform_in_its_parameters_as_figure_4_12(self):
        """9372 triangles; ours are as many in the plane of angles and heights, and distorted in space."""
        columns, rows, step, low = 90, 72, 4.22535, -150
        size = math.sqrt(columns * (rows - 1) / (9372 * math.sqrt(3) / 4))
        mesh, figures = self.mesh("mesh", os.path.join(DATA, "head.cyl"), "--smooth", "2000", "--set", f"parameter_size={size}", "--min", "0.1")
        self.assertAlmostEqual(len(mesh.triangles) / 9372, 1, delta=0.03)
        self.is_printed("4.12", len(mesh.triangles))
        shapes = []
        for corners in mesh.triangles:
            at = [(math.atan2(y, x) * columns / (2 * math.pi), (z - low) / step) for x, y, z in (mesh.vertices[v] for v in corners)]
            at = [((u - at[0][0] + columns / 2) % columns - columns / 2, v) for u, v in at]  # across the seam
            (a, b), (c, d), (e, f) = at
            area = abs((c - a) * (f - b) - (d - b) * (e - a))
            shapes.append(2 * math.sqrt(3) * area / sum(math.dist(p, q) ** 2 for p, q in zip(at, at[1:] + at[:1])))
        self.assertGreater(sum(shapes) / len(shapes), 0.98)
        self.assertLess(figures["q2_mean"], 0.96)

    def test_a_bust_adapted_as_figure_25_of_the_manual(self):
        """A head of our own in place of the bust: by curvature and by direction, which needs fewer triangles."""
        head = os.path.join(DATA, "head.cyl")
        counts = []
        for shape in ([], ["--anisotropic"]):
            _, figures = self.mesh("mesh", head, "--smooth", "2000", "--continuity", "2", "--angle", "8", "--max", "5%", "--gradation", "1.3", *shape)
            counts.append(figures["triangles"])
        self.assertLess(counts[1], counts[0])
        self.is_printed("RT-0232 25", *counts)

    def test_an_aircraft_uniform_and_geometric_as_figure_4_26(self):
        """The Falcon has 26 899 triangles of mean quality .995 and, by 8 degrees with gradation 1.3, 147 500 of .975."""
        sys.path.insert(0, os.path.join(DATA, "..", "..", "bench"))
        import aircraft
        aircraft.write_plot3d(self.path("aircraft.fmt"), aircraft.aircraft())
        for options, quality in ((["--size", "0.6"], 0.98), (["--angle", "16", "--gradation", "1.3", "--max", "5%"], 0.96)):
            _, figures = self.mesh("mesh", self.path("aircraft.fmt"), "--lengths", "--join", "30", *options)
            self.assertEqual(figures["open_edges"], 0)
            self.assertGreater(figures["q2_mean"], quality)
            self.is_printed("4.26", figures["triangles"], figures["q2_mean"])

    @unittest.skipUnless(shutil.which("tetgen"), "without tetgen")
    def test_tetrahedra_around_an_aircraft_as_figure_4_34(self):
        """The uniform mesh of a box around the Boeing has about 485 000 tetrahedra of mean quality .5; ours lie around our aircraft."""
        sys.path.insert(0, os.path.join(DATA, "..", "..", "bench"))
        import aircraft
        aircraft.write_plot3d(self.path("aircraft.fmt"), aircraft.aircraft())
        mesh, _ = self.mesh("mesh", self.path("aircraft.fmt"), "--size", "0.6", "--lengths", "--join", "30")
        with open(self.path("hole.off"), "w") as file:  # turned around: a cavity of the box
            file.write(f"OFF {len(mesh.vertices)} {len(mesh.triangles)} 0\n")
            file.writelines(f"{x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in mesh.vertices)
            file.writelines(f"3 {a} {c} {b}\n" for a, b, c in mesh.triangles)
        corners = [(x, y, z) for x in (-4, 74) for y in (-34, 34) for z in (-9, 15)]
        with open(self.path("box.off"), "w") as file:
            file.write("OFF 8 6 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in corners))
            file.write("4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n")
        done = subprocess.run([PROGRAM, "volume", self.path("box.off"), self.path("hole.off"), "--size", "1.29", "--engine", "tetgen",
                               "-o", self.path("volume.mesh"), "--json"], capture_output=True, text=True, timeout=280)
        self.assertEqual(done.returncode, 0, done.stderr)
        volume = json.loads(done.stdout)["volume"]
        self.assertAlmostEqual(volume["tetrahedra"] / 485000, 1, delta=0.1)
        self.is_printed("4.34", volume["tetrahedra"])
        inside = signed_volume(mesh)
        self.assertAlmostEqual(volume["solids"][0]["volume"] / (78 * 68 * 24 - inside), 1, delta=1e-3)

    def test_a_fragment_of_dna_as_figure_4_30(self):
        """637 atoms have 154 220 vertices and 309 004 triangles, 485 an atom; here 120 atoms of 1BNA."""
        with open(os.path.join(DATA, "..", "molecule", "1bna.xyzr")) as file:
            atoms = file.readlines()[:120]
        with open(self.path("fragment.xyzr"), "w") as file:
            file.writelines(atoms)
        mesh, figures = self.mesh("mesh", self.path("fragment.xyzr"), "--surface", "vws", "--size", "0.245")
        self.assertEqual(figures["open_edges"], 0)
        self.assertAlmostEqual(len(mesh.triangles) / len(atoms) / (309004 / 637), 1, delta=0.1)
        self.assertEqual(2 * len(mesh.vertices) - len(mesh.triangles), 0)  # one handle
        self.is_printed("4.30", len(mesh.triangles) / len(atoms))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
