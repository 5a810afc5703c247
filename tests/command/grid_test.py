#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""grid_test.py CARREAU DATA: structured grids by `carreau mesh`, `info` and `fields`. DATA: tests/data/grid."""
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import mesh_files

PROGRAM, DATA = sys.argv[1:3]


def wing(chord_nodes=33, span_nodes=17):
    """A wing of one block around NACA 0012 from a sharp trailing edge, in PLOT3D text: spacing is abrupt in both ways."""
    nodes = []
    for j in range(span_nodes):
        y = 3 * (j / (span_nodes - 1)) ** 2
        c = 1 - 0.2 * y
        for i in range(chord_nodes):
            t = 2 * math.pi * i / (chord_nodes - 1)
            x = (1 + math.cos(t)) / 2
            thick = 0.6 * (0.2969 * math.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
            thick = 0 if i in (0, chord_nodes - 1) else thick
            nodes.append((c * x + 0.5 * y, y, math.copysign(c * thick, math.sin(t)) if thick else 0.0))
    numbers = [f"{p[axis]:.15g}" for axis in range(3) for p in nodes]
    return f"1\n{chord_nodes} {span_nodes} 1\n" + "\n".join(numbers) + "\n"


class Grids(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau grid ")

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

    def mesh(self, *arguments):
        return json.loads(self.run_command("mesh", *arguments, "-o", "x.mesh", "--json").stdout)

    def test_heights_have_the_given_step(self):
        self.mesh(os.path.join(DATA, "volcano.txt"), "--step", "10", "--size", "15")
        vertices = mesh_files.read_mesh(os.path.join(self.folder, "x.mesh")).vertices
        self.assertAlmostEqual(max(v[0] for v in vertices), 860, delta=1e-6)
        self.assertAlmostEqual(max(v[1] for v in vertices), 600, delta=1e-6)

    def test_a_wing_needs_fewer_triangles_by_direction(self):
        path = self.write("wing.fmt", wing())
        isotropic = self.mesh(path, "--angle", "8", "--lengths")["mesh"]["triangles"]
        anisotropic = self.mesh(path, "--angle", "8", "--lengths", "--anisotropic")["mesh"]["triangles"]
        self.assertGreater(isotropic, 2 * anisotropic)

    def test_info_knows_grids(self):
        figures = json.loads(self.run_command("info", self.write("wing.fmt", wing()), "--json").stdout)
        self.assertEqual(figures["faces"], 1)

    def test_files_xyz_are_grids_or_molecules(self):
        nodes = "0 1 2 0 1 2 0 1 2\n0 0 0 1 1 1 2 2 2\n0 0 0 0 0 0 0 0 0\n"
        binary = os.path.join(self.folder, "binary.xyz")
        with open(binary, "wb") as file:
            file.write(struct.pack("=3i", 3, 3, 1) + struct.pack("=27d", *map(float, nodes.split())))
        for name, text, faces in (("one", "3 3 1\n" + nodes, 1), ("block", "1\n3 3 1\n" + nodes, 1),
                                  ("atoms", "2\n3 3 1\nC 0 0 0\nO 1 0 0\n", 2), ("numbers", "2\ntitle\n6 0 0 0\n8 1 0 0\n", None),
                                  ("binary", None, 1)):
            path = binary if text is None else self.write(name + ".xyz", text)
            if faces is not None:
                self.assertEqual(json.loads(self.run_command("info", path, "--json").stdout)["faces"], faces, name)
            else:
                self.assertIn("van der Waals", self.run_command("info", path, code=2).stderr)

    def test_another_suffix_needs_the_format(self):
        path = self.write("heights.dat", "1 2 1\n2 3 2\n1 2 1\n")
        self.mesh(path, "--grid", "heights", "--size", "0.5")
        done = self.run_command("mesh", path, "--grid", "radii", "-o", "x.mesh", code=2)
        self.assertIn("--grid", done.stderr)

    def test_ridges_become_edges(self):
        """Half an elliptic cylinder (2 cos t, y, sin t) has the radius .5 along x = 2, z = 0."""
        at = [-1.25 + 2.5 * i / 31 for i in range(32)]
        nodes = [(2 * math.cos(t), j / 5, math.sin(t)) for j in range(11) for t in at]
        path = self.write("ellipse.fmt", "1\n32 11 1\n" + "\n".join(f"{p[axis]:.15g}" for axis in range(3) for p in nodes) + "\n")
        for radius, expected in (("0.6", 2), ("0.4", 0)):
            self.mesh(path, "--size", "0.25", "--ridges", radius, "--continuity", "2")
            mesh = mesh_files.read_mesh(os.path.join(self.folder, "x.mesh"))
            length = 0
            for edge in mesh.edges:
                p, q = (mesh.vertices[v] for v in edge[:2])
                if all(math.hypot(v[0] - 2, v[2]) < 1e-3 for v in (p, q)):
                    length += abs(q[1] - p[1])
            self.assertAlmostEqual(length, expected, delta=1e-6)

    def test_mistakes_name_file_and_line(self):
        path = self.write("bad.fmt", "1\n2 2 1\n0 1 0 1\n0 0 x 1\n")
        done = self.run_command("mesh", path, "-o", "x.mesh", code=2)
        self.assertIn("bad.fmt, line 4: y of block 1 should be a number, not 'x'", done.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "x.mesh")))
        done = self.run_command("mesh", path, "--smooth", "10,2", "-o", "x.mesh", code=2)
        self.assertIn("'10,2'", done.stderr)
        self.run_command("mesh", self.write("plain.txt", "1 2 1\n2 3 2\n1 2 1\n"), "--smooth", "10,distance", "-o", "x.mesh")

    def test_a_hole_that_cuts_a_block_is_reported_and_both_parts_are_meshed(self):
        rows = [["nan" if i == 4 else "0" for i in range(9)] for _ in range(6)]
        path = self.write("cut.txt", "\n".join(" ".join(row) for row in rows))
        done = self.run_command("mesh", path, "--size", "0.5", "-o", "x.mesh")
        self.assertIn("holes cut block 1 into 2 parts", done.stderr)
        xs = [v[0] for v in mesh_files.read_mesh(os.path.join(self.folder, "x.mesh")).vertices]
        self.assertTrue(min(xs) == 0 and max(xs) == 8)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
