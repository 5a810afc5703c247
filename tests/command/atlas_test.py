#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""atlas_test.py CARREAU: `carreau mesh --surface atlas` on a torus of triangles, and on files that are none."""
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]


def torus(n, m, large, small):
    """OFF text of n x m vertices, rows shifted by half a step by turns."""
    lines = [f"OFF {n * m} {2 * n * m} 0"]
    for i in range(n):
        for j in range(m):
            a, b = 2 * math.pi * i / n, 2 * math.pi * (j + .5 * (i % 2)) / m
            r = large + small * math.cos(b)
            lines.append(f"{r * math.cos(a):.17g} {r * math.sin(a):.17g} {small * math.sin(b):.17g}")
    for i in range(n):
        for j in range(m):
            def at(row, column):
                return row % n * m + column % m
            shift = i % 2
            lines.append(f"3 {at(i, j)} {at(i + 1, j + shift)} {at(i, j + 1)}")
            lines.append(f"3 {at(i, j)} {at(i + 1, j + shift - 1)} {at(i + 1, j + shift)}")
    return lines


class Atlas(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau atlas ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def mesh(self, name, lines, code, *options):
        with open(os.path.join(self.folder, name), "w") as file:
            file.write("\n".join(lines) + "\n")
        done = subprocess.run([PROGRAM, "mesh", name, "--surface", "atlas", "-o", "out.mesh",
                               *(options or ("--size", "0.2"))],
                              capture_output=True, text=True, timeout=120, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_a_torus_becomes_a_closed_mesh_on_it(self):
        text = self.mesh("torus.off", torus(36, 18, 2, .8), 0)
        self.assertIn("atlas over 1296 triangles", text)
        self.check_torus(text)

    def test_uneven_triangles_are_meshed_evenly_first(self):
        text = self.mesh("uneven.off", torus(100, 12, 2, .8), 0)
        self.assertIn("triangles made evenly of 2400, ", text)
        self.check_torus(text)

    def test_curvature_sizes_see_the_torus_and_no_waves(self):
        text = self.mesh("torus.off", torus(36, 18, 2, .8), 0, "--angle", "12")
        self.check_torus(text)
        with open(os.path.join(self.folder, "out.mesh")) as file:
            words = file.read().split()
        # Equilateral triangles whose edges differ by 12 degrees from the tangents of the smallest circles.
        edge = 2 * math.sin(math.radians(12)) * .8
        self.assertLess(int(words[words.index("Triangles") + 1]), 1.4 * 4 * math.pi ** 2 * 2 * .8 / (math.sqrt(3) / 4 * edge ** 2))
        done = subprocess.run([PROGRAM, "check", "out.mesh"], capture_output=True, text=True, timeout=120, cwd=self.folder)
        self.assertRegex(done.stdout, r"folds +0 edges")

    def test_large_clusters_make_a_surface_without_folds_or_a_message(self):
        self.assertIn("turned over near", self.mesh("torus.off", torus(30, 15, 2, .8), 2, "--reach", "3", "--size", ".2"))
        # At .18 and .2 one face of 82 needs a repair.
        self.check_torus(self.mesh("torus.off", torus(36, 18, 2, .8), 0, "--border", "cubic", "--size", ".19"))
        done = subprocess.run([PROGRAM, "mesh", "x.bpt", "--reach", "2", "-o", "y.mesh"], capture_output=True, text=True)
        self.assertIn("--reach goes with --surface atlas, not with 'x.bpt'", done.stderr)

    def test_borders_from_the_outer_one_cover_a_torus(self):
        self.check_torus(self.mesh("coarse.off", torus(20, 10, 2, .8), 0, "--border", "outer-spline", "--size", ".3"))

    def check_torus(self, text):
        self.assertIn(" 0 repaired, 0 failed", text)
        self.assertNotIn("turned over", text)
        with open(os.path.join(self.folder, "out.mesh")) as file:
            words = file.read().split()
        count = int(words[words.index("Vertices") + 1])
        start = words.index("Vertices") + 2
        triangles = int(words[words.index("Triangles") + 1])
        self.assertEqual(2 * count, triangles)  # closed, of Euler number 0
        for v in range(count):
            x, y, z = map(float, words[start + 4 * v:start + 4 * v + 3])
            self.assertAlmostEqual(math.hypot(math.hypot(x, y) - 2, z), .8, delta=.04)

    def test_open_surfaces_are_reported_with_the_vertex(self):
        lines = torus(12, 8, 2, .8)
        self.assertIn("border at the edge of vertices", self.mesh("open.off", [lines[0].replace("192", "191")] + lines[1:-1], 2))
        self.assertIn("goes with a mesh of triangles", self.mesh("file.bpt", ["1"], 2))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
