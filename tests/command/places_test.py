#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""places_test.py CARREAU: `carreau project`, and the options --embed-point, --embed-curve of `carreau mesh`."""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]


def patch(x0, z_of):
    """Control points of degrees 1 x 1 over x0 <= x <= x0 + 1, 0 <= y <= 1."""
    return "1 1\n" + "".join(f"{x} {y} {z_of(x)}\n" for x in (x0, x0 + 1) for y in (0, 1))


# A roof: z = x for x < 1, and z = 2 - x.
ROOF = "2\n" + patch(0, lambda x: x) + patch(1, lambda x: 2 - x)


def read_mesh(path):
    """Vertices with references, and edges with references, of a .mesh file."""
    with open(path) as file:
        words = file.read().split()

    def rows(key, width):
        if key not in words:
            return []
        at = words.index(key) + 1
        n = int(words[at])
        values = words[at + 1:at + 1 + width * n]
        return [tuple(map(float, values[width * i:width * i + width])) for i in range(n)]
    return rows("Vertices", 4), rows("Edges", 3)


class Places(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau places ")
        self.roof = self.write("roof.bpt", ROOF)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def run_command(self, *arguments, code=0):
        done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_points_of_a_file_are_projected(self):
        points = self.write("points.txt", "# above the first and second patch\n0.5 0.5 1.5\n\n1.5, 0.25, 1.5\n")
        text = self.run_command("project", self.roof, "--points", points).stdout.splitlines()
        self.assertEqual(text[0], "# face u v distance x y z")
        rows = [list(map(float, line.split())) for line in text[1:]]
        for row, expected in zip(rows, ((1, 1, 0.5, math.sqrt(0.5), 1, 0.5, 1), (2, 0, 0.25, math.sqrt(0.5), 1, 0.25, 1))):
            for value, wanted in zip(row[3:], expected[3:]):
                self.assertAlmostEqual(value, wanted, 12)
        rows = json.loads(self.run_command("project", self.roof, "--points", points, "--json", "--only", "2").stdout)["points"]
        self.assertEqual([row["face"] for row in rows], [2, 2])
        self.assertAlmostEqual(rows[1]["distance"], math.sqrt(0.5), 12)
        self.assertAlmostEqual(rows[1]["uv"][1], 0.25, 12)

    def test_mistakes_of_points_are_named(self):
        bad = self.write("bad.txt", "0 0 0\n0 zero 0\n")
        self.assertIn("line 2", self.run_command("project", self.roof, "--points", bad, code=2).stderr)
        self.assertIn("no point", self.run_command("project", self.roof, "--points", self.write("none.txt", "# none\n"), code=2).stderr)
        one = self.write("one.txt", "0 0 0\n")
        self.assertIn("reference 7", self.run_command("project", self.roof, "--points", one, "--only", "7", code=2).stderr)
        self.assertIn("X,Y,Z", self.run_command("mesh", self.roof, "--embed-point", "1,2", "-o", "a.mesh", code=2).stderr)
        self.assertIn("embed_tolerance", self.run_command("mesh", self.roof, "--embed-point", "0,0,3", "-o", "a.mesh", code=2).stderr)
        self.assertIn("--embed-wires", self.run_command("mesh", self.roof, "--embed-wires", "-o", "a.mesh", code=2).stderr)

    def test_points_and_curves_are_embedded(self):
        line = self.write("ridge line.txt", "0.2 0.3 0.2\n1 0.5 1\n1.6 0.4 0.4\n")
        self.run_command("mesh", self.roof, "--size", "0.2", "--embed-curve", line, "--embed-point", "0.7,0.8,0.7", "-o", "a.mesh", "-o", "a.msh")
        vertices, edges = read_mesh(os.path.join(self.folder, "a.mesh"))
        self.assertEqual(sum(math.dist(v[:3], (0.7, 0.8, 0.7)) < 1e-12 for v in vertices), 1)
        lengths = {}
        for a, b, ref in edges:
            lengths[ref] = lengths.get(ref, 0) + math.dist(vertices[int(a) - 1][:3], vertices[int(b) - 1][:3])
        expected = math.dist((0.2, 0.3, 0.2), (1, 0.5, 1)) + math.dist((1, 0.5, 1), (1.6, 0.4, 0.4))
        self.assertTrue(any(abs(length - expected) < 1e-9 for length in lengths.values()), lengths)
        with open(os.path.join(self.folder, "a.msh")) as file:
            self.assertIn('"ridge line"', file.read())
        self.run_command("check", "a.mesh")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
