#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""command_mirror_test.py CARREAU MAKE_CELLS: symmetric meshes of `carreau mesh --mirror`."""
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from periodic_files import Mesh, euler

PROGRAM, MAKE_CELLS = sys.argv[1:3]
CELLS = tempfile.mkdtemp(prefix="carreau cells ")


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=600)


def reflected(point, axis, at):
    return tuple((2 * at - x if at else -x) + 0. if k == axis else x for k, x in enumerate(point))


class Mirror(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau mirror ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def mesh(self, body, *options, size="0.15", status=0):
        path = os.path.join(self.folder, "body.msh2")
        done = run("mesh", os.path.join(CELLS, body), "-o", path, "--size", size, *options)
        self.assertEqual(done.returncode, status, done.stderr)
        self.said = done.stderr
        return path

    def check(self, path, axis, at=0., within=0.):
        """Returns the mesh. Each vertex and each element has its image: to the last bit, or within a distance."""
        made = Mesh(path)
        rounded = (lambda p: tuple(x + 0. for x in p)) if within == 0 else (lambda p: tuple(round(x / within / 10) for x in p))
        number = {rounded(p): n for n, p in made.points.items()}
        image = {n: number.get(rounded(reflected(p, axis, at))) for n, p in made.points.items()}
        self.assertEqual([made.points[n] for n, m in image.items() if m is None], [])
        cells = sorted(tuple(sorted(cell)) for face in made.cells.values() for cell in face)
        self.assertEqual(sorted(tuple(sorted(image[n] for n in cell)) for cell in cells), cells)
        for _, slave, master, _, nodes in made.faces():
            self.assertTrue(made.same_cells(slave, master, nodes), (slave, master))
        self.assertEqual(run("check", path).returncode, 0)
        return made

    def test_a_block_with_bores_is_symmetric_to_the_last_bit(self):
        whole = 1.6 - math.pi * (0.8 * 0.2 ** 2 + 2 * 0.15 ** 2)
        for axis, name in enumerate("xyz"):
            with self.subTest(name):
                made = self.check(self.mesh("block.step", "--mirror", name, size="0.1"), axis)
                self.assertEqual(euler([c for f in made.cells.values() for c in f]), -4)  # three bores
                self.assertLess(abs(made.volume() - whole), 0.02 * whole)
                self.assertTrue(any(p[axis] == 0 for p in made.points.values()))  # the plane is an edge of the mesh

    def test_several_planes(self):
        made = self.check(self.mesh("block.step", "--mirror", "x", "--mirror", "y", "--mirror", "z"), 0)
        for axis in (1, 2):
            self.check(os.path.join(self.folder, "body.msh2"), axis)
        self.assertEqual(sum(len(f) for f in made.cells.values()) % 8, 0)

    def test_halves_become_whole(self):
        """A half with a face on the plane, and without it, a quarter about two planes: all make the block."""
        whole = self.check(self.mesh("block.step", "--mirror", "x"), 0)
        for body, planes in (("half.step", ("x",)), ("open.step", ("x",)), ("quarter.step", ("x", "y"))):
            with self.subTest(body):
                made = self.check(self.mesh(body, *(word for plane in planes for word in ("--mirror", plane))), 0)
                self.assertEqual(euler([c for f in made.cells.values() for c in f]), -4)
                self.assertLess(abs(made.volume() - whole.volume()), 0.01 * whole.volume())
                # No triangle lies in the plane.
                for cells in made.cells.values():
                    for cell in cells:
                        self.assertFalse(all(abs(made.points[n][0]) < 1e-9 for n in cell))

    def test_free_edges_are_mirrored(self):
        """Edges of no face: a segment and an arc across the plane are cut by it, or completed, and an edge in the plane stays one."""
        for body in ("wired.step", "half_wired.step"):
            with self.subTest(body):
                made = self.check(self.mesh(body, "--mirror", "x", "--loose-edges"), 0)
                on_faces = {n for face in made.cells.values() for cell in face for n in cell}
                free = {n: p for n, p in made.points.items() if n not in on_faces}
                self.assertEqual(max(p[0] for p in free.values()), 1.5)
                self.assertEqual(min(p[0] for p in free.values()), -1.5)
                # The segment, the arc and the edge in the plane have vertices there.
                self.assertEqual(sum(p[0] == 0 and abs(p[2] - .9) < 1e-12 for p in free.values()), 1)
                self.assertEqual(sum(abs(p[0]) < 1e-12 and abs(p[2] - 1.8) < 1e-12 for p in free.values()), 1)
                self.assertGreater(sum(abs(p[0]) < 1e-12 and 1 - 1e-9 < p[2] < 1.2 + 1e-9 for p in free.values()), 2)
                # One segment of length 3: as many edges on both sides.
                segment = sorted(p[0] for p in free.values() if abs(p[2] - .9) < 1e-12)
                self.assertEqual(segment, [-x + 0. for x in reversed(segment)])

    def test_images_follow_the_faces(self):
        made = Mesh(self.mesh("half.step", "--mirror", "x"))
        n = len(made.cells) // 2
        self.assertEqual(sorted(tuple(sorted(pair[1:3])) for pair in made.faces()), [(f, f + n) for f in range(1, n + 1)])

    def test_a_ball_and_a_rod(self):
        for body, volume in (("ball.step", 4 / 3 * math.pi), ("rod.step", 2 * math.pi * 0.4 ** 2)):
            for plane, axis, at in ((".3,0,0:1,0,0", 0, 0.3), ("0,.1,0:0,2,0", 1, 0.1), ("z", 2, 0.)):
                with self.subTest(body, plane=plane):
                    made = self.check(self.mesh(body, "--mirror", plane), axis, at, within=0. if at == 0 else 1e-12)
                    self.assertEqual(euler([c for f in made.cells.values() for c in f]), 2)
                    self.assertLess(abs(made.volume() - volume), 0.05 * volume)
        for element in ("p2", "q1.0", "q1.1", "q2.1"):  # the poles are in the halves
            with self.subTest(element):
                self.check(self.mesh("ball.step", "--mirror", "z", "--element", element, size="0.4"), 2)

    def test_elements_of_all_kinds(self):
        for element in ("p2", "q1.0", "q1.1", "q2.0", "q2.1"):
            with self.subTest(element):
                self.check(self.mesh("block.step", "--mirror", "x", "--element", element), 0)

    def test_a_real_part(self):
        """The bracket of the pages is symmetric about y = 20, a quarter of a plate becomes the plate."""
        data = os.path.join(os.path.dirname(sys.argv[3]), "docs", "data")
        made = self.check(self.mesh(os.path.join(data, "bracket.step"), "--mirror", "0,20,0:0,1,0", size="4"), 1, 20.)
        self.assertTrue(any(p[1] == 20 for p in made.points.values()))
        plate = os.path.join(data, "quarter_plate.step")
        for axis in (0, 1):
            self.check(self.mesh(plate, "--mirror", "x", "--mirror", "y", size="5%"), axis)

    def test_bodies_that_are_not_symmetric_are_reported(self):
        path = os.path.join(self.folder, "none.msh")
        for body, plane, words in (("uneven.step", "x", "the image of face"), ("rod.step", "y", "is on no face"), ("block.step", "1,1,0", "is not symmetric")):
            done = run("mesh", os.path.join(CELLS, body), "-o", path, "--mirror", plane)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)
            self.assertFalse(os.path.exists(path))
        for word in ("w", "1,2", "0,0,0", "1,2,3:0,0,0", "1:2"):
            done = run("mesh", os.path.join(CELLS, "cube.step"), "-o", path, "--mirror", word)
            self.assertEqual(done.returncode, 2, word)
            self.assertIn("--mirror '" + word + "'", done.stderr)

    def test_other_geometries_must_give_halves(self):
        path = os.path.join(self.folder, "none.msh")
        for formula, domain, words in (("z = x*x + y", "box:-1,-1,1,1", "face 1 lies across the plane, from -1 to 1"), ("z = x*x", "box:.5,-1,1,1", "lies on one side")):
            done = run("mesh", formula, "--domain", domain, "-o", path, "--mirror", "x")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    subprocess.run([MAKE_CELLS, CELLS], check=True, stdout=subprocess.DEVNULL)
    try:
        program = unittest.main(argv=sys.argv[:1] + sys.argv[4:], exit=False)
    finally:
        shutil.rmtree(CELLS)
    sys.exit(not program.result.wasSuccessful())
