#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""command_periodic_test.py CARREAU MAKE_CELLS: periodic meshes of `carreau mesh`, glued to themselves and read back by Gmsh."""
import importlib
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from periodic_files import Mesh

PROGRAM, MAKE_CELLS = sys.argv[1:3]
CELLS = tempfile.mkdtemp(prefix="carreau cells ")
AXES = ("--periodic", "x", "--periodic", "y", "--periodic", "z")
SECTOR = ("--periodic", "rotate:0,0,0:0,0,1:60")


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=600)


class Periodic(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau periodic ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def mesh(self, cell, *options, size="0.2", name="cell.msh2", status=0):
        path = os.path.join(self.folder, name)
        done = run("mesh", os.path.join(CELLS, cell), "-o", path, "--size", size, *options)
        self.assertEqual(done.returncode, status, done.stderr)
        self.said = done.stderr
        return path

    def check(self, path, faces, within=2e-12):
        """Pairs of faces, exact images, equal elements, a sound mesh."""
        made = Mesh(path)
        self.assertEqual(len(made.faces()), faces)
        self.assertLessEqual(made.mismatch(), within)
        for _, slave, master, _, nodes in made.faces():
            self.assertTrue(made.same_cells(slave, master, nodes), (slave, master))
        self.assertEqual(run("check", path, "--allow-crossings").returncode, 0)
        return made

    def test_a_cube_has_three_pairs_of_faces_and_classes_of_edges_and_corners(self):
        made = self.check(self.mesh("cube.step", *AXES), 3)
        self.assertEqual(sum(pair[0] == 1 for pair in made.pairs), 9)  # twelve edges in three classes
        self.assertEqual(sum(pair[0] == 0 for pair in made.pairs), 7)  # eight corners in one
        self.assertEqual(len({made.classes()[n] for n, p in made.points.items() if set(p) <= {0., 1.}}), 1)
        self.assertIn("periodic: 3 pairs of faces", self.said)

    def test_a_translation_by_its_length_is_the_same(self):
        path = self.mesh("cube.step", "--periodic", "1,0,0")
        self.check(path, 1)
        with open(path, "rb") as file:
            first = file.read()
        with open(self.mesh("cube.step", "--periodic", "x"), "rb") as file:
            self.assertEqual(file.read(), first)

    def test_sectors_of_cylinders(self):
        for cell in ("sector.step", "annulus.step"):
            with self.subTest(cell):
                self.check(self.mesh(cell, *SECTOR), 1)
        self.check(self.mesh("sector24.step", "--periodic", "rotate:0,0,0:0,0,1:15", size="0.05"), 1)

    def test_sizes_of_one_side_hold_on_the_other_side(self):
        made = self.check(self.mesh("cube.step", *AXES, "--face-size", "1=.05"), 3)
        slave = next(pair for pair in made.faces() if 1 in pair[1:3])
        self.assertGreater(len(made.cells[slave[1]]), 600)

    def test_gradation_crosses_the_border(self):
        for options in (("--gradation", "1.3"), ("--gradation", "1.3", "--size-map", ".03 + .2*abs(x - .9)")):
            with self.subTest(options):
                self.check(self.mesh("cube.step", *AXES, *options), 3)

    def test_elements_of_all_kinds(self):
        for element in ("p2", "p3", "p4", "q1.0", "q1.1", "q2.0", "q2.1", "q3", "q3.1", "q4.1"):
            for cell, options, pairs in (("fcc.step", AXES, None), ("annulus.step", SECTOR, 1)):
                with self.subTest(element=element, cell=cell):
                    path = self.mesh(cell, *options, "--element", element)
                    made = Mesh(path)
                    self.check(path, pairs or len(made.faces()))

    def test_spheres_in_the_corners_and_faces_of_a_cube(self):
        """Glued, the surface in the cell is four whole spheres."""
        made = self.check(self.mesh("fcc.step", *AXES, size="0.1"), 3)
        self.assertEqual(made.euler_of_skin(), 8)

    def test_circles_that_begin_at_different_places(self):
        for element in ("p1", "p2", "p3"):  # tables of lengths place nodes on curves differently
            with self.subTest(element):
                made = self.check(self.mesh("shifted.step", *AXES, "--element", element, size="0.1"), 3)
                self.assertEqual(made.euler_of_skin(), 2)

    def test_forty_inclusions(self):
        made = self.check(self.mesh("inclusions.step", *AXES, size="0.05"), 3)
        self.assertEqual(made.euler_of_skin(), 80)

    def test_anisotropic_sizes(self):
        made = Mesh(self.mesh("fcc.step", *AXES, "--anisotropic", "--angle", "10"))
        self.assertEqual(len(made.faces()), 3)
        self.assertLessEqual(made.mismatch(), 2e-12)

    def test_faces_that_do_not_match_are_reported(self):
        path = os.path.join(self.folder, "none.msh")
        done = run("mesh", os.path.join(CELLS, "mismatch.step"), "-o", path, "--periodic", "x")
        self.assertEqual(done.returncode, 2)
        self.assertIn("do not match", done.stderr)
        self.assertIn("apart at (", done.stderr)
        for word in ("w", "1,2", "0,0,0", "rotate:0,0,0:0,0,0:60", "1=", "rotate:1"):
            done = run("mesh", os.path.join(CELLS, "cube.step"), "-o", path, "--periodic", word)
            self.assertEqual(done.returncode, 2, word)
            self.assertIn("--periodic", done.stderr)
        done = run("mesh", os.path.join(CELLS, "cube.step"), "-o", path, "--periodic", "1=1")
        self.assertIn("periodic with itself", done.stderr)
        # Curves of a sheet and of a plane domain, with the distance and the place; faces of one boundary.
        done = run("mesh", "z = x*x", "--domain", "box:0,0,1,1", "-o", path, "--periodic", "x")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"nearest is curve \d: the image of curve \d is 1 away from it at \(1, ")
        patches = os.path.join(self.folder, "two.bpt")
        with open(patches, "w", encoding="utf-8") as file:
            print(2, *("3 3\n" + "\n".join(f"{i / 3} {j / 3} {z + z * .3 * (i in (1, 2) and j in (1, 2))}" for i in range(4) for j in range(4)) for z in (0, 1)), sep="\n", file=file)
        done = run("mesh", patches, "-o", path, "--size", ".1", "--periodic", "2=1")
        self.assertEqual(done.returncode, 2)
        self.assertNotIn("again without", done.stderr)
        self.assertRegex(done.stderr, r"face 2: .* the image of face 1 and face 2 do not match: .* beside it is 0\.0\d+ away from the face")

    def test_the_partner_of_a_face_that_fails_is_reported(self):
        """A bump that the border does not show."""
        patches, path = os.path.join(self.folder, "two.bpt"), os.path.join(self.folder, "none.msh")
        with open(patches, "w", encoding="utf-8") as file:
            print(2, *("3 3\n" + "\n".join(f"{i / 3} {j / 3} {z + z * .003 * (i in (1, 2) and j in (1, 2))}" for i in range(4) for j in range(4)) for z in (0, 1)), sep="\n", file=file)
        done = run("mesh", patches, "-o", path, "--size", ".1", "--periodic", "2=1")
        self.assertEqual(done.returncode, 2)
        self.assertIn("face 1: its periodic partner, face 2, failed: face 2: the image of the mesh of face 1 is 0.001", done.stderr)
        self.assertIn("away from the surface at (", done.stderr)

    def test_prescribed_edges_of_both_sides(self):
        """Edges of one side are the edges of the other side; two that differ are an error."""
        made = self.check(self.mesh("cube.step", *AXES, "--curve-edges", "1=7"), 3)
        counts = {len(pair[4]) for pair in made.pairs if pair[0] == 1}
        self.assertIn(8, counts)

    def test_pairs_as_text(self):
        path = os.path.join(self.folder, "pairs.txt")
        self.mesh("cube.step", *AXES, "-o", path)
        with open(path, encoding="utf-8") as file:
            blocks = [line.split() for line in file if line.startswith("# ") and line[2].isdigit()]
        self.assertEqual([int(block[1]) for block in blocks], 7 * [0] + 9 * [1] + 3 * [2])

    def test_gmsh_reads_the_pairs(self):
        try:
            gmsh = importlib.import_module("gmsh")
        except ImportError:
            raise unittest.SkipTest("Python has no gmsh") from None
        for element in ("p1", "p2", "p3", "q3.1"):  # of version 2.2 Gmsh reads no pairs, not even its own
            with self.subTest(element=element):
                path = self.mesh("fcc.step", *AXES, "--element", element, name="cell.msh")
                gmsh.initialize()
                try:
                    gmsh.option.setNumber("General.Terminal", 0)
                    gmsh.open(path)
                    found = 0
                    for dimension, tag in gmsh.model.getEntities(2):
                        master, nodes, masters, affine = gmsh.model.mesh.getPeriodicNodes(dimension, tag, True)
                        if master == tag:
                            continue
                        found += 1
                        self.assertGreater(len(nodes), 3)
                        for node, partner in zip(nodes, masters):
                            y, x = gmsh.model.mesh.getNode(node)[0], gmsh.model.mesh.getNode(partner)[0]
                            image = [sum(affine[4 * i + k] * x[k] for k in range(3)) + affine[4 * i + 3] for i in range(3)]
                            self.assertLess(math.dist(image, y), 2e-12)
                    self.assertEqual(found, 3)
                finally:
                    gmsh.finalize()


if __name__ == "__main__":
    subprocess.run([MAKE_CELLS, CELLS], check=True, stdout=subprocess.DEVNULL)
    try:
        program = unittest.main(argv=sys.argv[:1] + sys.argv[4:], exit=False)
    finally:
        shutil.rmtree(CELLS)
    sys.exit(not program.result.wasSuccessful())
