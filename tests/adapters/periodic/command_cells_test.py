#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""command_cells_test.py CARREAU MAKE_CELLS: periodic cells in closed form, and solvers that read matching pairs."""
import ctypes
import glob
import importlib
import itertools
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

from periodic_files import Mesh, euler

PROGRAM, MAKE_CELLS = sys.argv[1:3]
CELLS = tempfile.mkdtemp(prefix="carreau cells ")
AXES = ("--periodic", "x", "--periodic", "y", "--periodic", "z")


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=600)


def masters_of(path, count):
    """The field periodic_master of a legacy .vtk: the first node of each node's class, from 0."""
    with open(path, "rb") as file:
        values = file.read().partition(b"periodic_master")[2].partition(b"\n")[2]
    return [int(x) for x in struct.unpack_from(f">{count}d", values)]


def six_tubes(inner=0.5, opening=0.35):
    """A cell of bicubic Bezier patches like the surface of a gyroid: six tubes of square section from a cube to the sides of the cell [-1, 1]^3."""
    patches = []
    for axis in range(3):
        for side in (-1, 1):
            corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
            for k in range(4):
                (p, q), (r, s) = corners[k], corners[(k + 1) % 4]
                rows = []
                for i in range(4):  # from the cube to the side
                    w = i / 3
                    height, half = inner + w * (1 - inner), inner + w * (opening - inner) - 0.1 * w * (1 - w)
                    for j in range(4):
                        t = j / 3
                        point = [0., 0., 0.]
                        point[axis] = side * height
                        point[(axis + 1) % 3] = half * (p + t * (r - p))
                        point[(axis + 2) % 3] = half * (q + t * (s - q))
                        rows.append(point)
                if side > 0:
                    rows = [rows[4 * i + 3 - j] for i in range(4) for j in range(4)]
                patches.append(rows)
    lines = [str(len(patches))]
    for rows in patches:
        lines += ["3 3", *(" ".join(repr(x) for x in point) for point in rows)]
    return "\n".join(lines) + "\n"


def gyroid(n):
    """Triangles of the gyroid in [0, 2 pi]^3 by tetrahedra of n^3 cubes, as a file .off: opposite sides have equal vertices."""
    step = 2 * math.pi / n
    waves = [math.sin(step * i) for i in range(n)], [math.cos(step * i) for i in range(n)]

    def level(p):
        (s, c), (x, y, z) = waves, (i % n for i in p)
        return s[x] * c[y] + s[y] * c[z] + s[z] * c[x] + 0.05

    paths = [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]
    number, points, triangles = {}, [], []

    def crossing(p, q):
        if (key := (min(p, q), max(p, q))) not in number:
            (a, b), number[key] = key, len(points)
            share = level(a) / (level(a) - level(b))
            points.append([step * (x + share * (y - x)) for x, y in zip(a, b)])
        return number[key]

    for cube in itertools.product(range(n), repeat=3):
        for path in paths:
            corners = [cube]
            for axis in path:
                corners.append(tuple(x + (k == axis) for k, x in enumerate(corners[-1])))
            above = [p for p in corners if level(p) > 0]
            below = [p for p in corners if level(p) <= 0]
            if len(above) == 2:
                (a, b), (c, d) = above, below
                ring = [crossing(a, c), crossing(a, d), crossing(b, d), crossing(b, c)]
            elif len(above) in (1, 3):
                ring = [crossing(p, q) for p in above for q in below]
            else:
                continue
            for k in range(1, len(ring) - 1):
                triangle = [ring[0], ring[k], ring[k + 1]]
                (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (points[v] for v in triangle)
                u, v = (bx - ax, by - ay, bz - az), (cx - ax, cy - ay, cz - az)
                normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
                up = sum(m * (sum(p[i] for p in above) / len(above) - sum(p[i] for p in below) / len(below)) for i, m in enumerate(normal))
                triangles.append(triangle if up > 0 else triangle[::-1])
    lines = ["OFF", f"{len(points)} {len(triangles)} 0", *(" ".join(map(repr, p)) for p in points), *(f"3 {a} {b} {c}" for a, b, c in triangles)]
    return "\n".join(lines) + "\n"


class Cells(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau cells ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name, text=None):
        path = os.path.join(self.folder, name)
        if text is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        return path

    def mesh(self, source, *options, size="0.1", name="cell.msh2", command="mesh"):
        path = self.path(name)
        sizes = ("--size", size) if size else ()
        done = run(command, source, "-o", path, *sizes, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return path

    def euler_of(self, made):
        glued = made.classes()
        return euler([tuple(glued[n] for n in cell) for cells in made.cells.values() for cell in cells])

    def test_six_tubes_have_genus_three(self):
        """Three pairs of openings: V - E + F = 2 - 2 * 3."""
        made = Mesh(self.mesh(self.path("tubes.bpt", six_tubes()), *AXES))
        self.assertEqual(made.mismatch(), 0)
        self.assertEqual(sum(pair[0] == 1 for pair in made.pairs), 12)  # four curves at each opening
        self.assertEqual(self.euler_of(made), -4)

    def test_a_wavy_square_is_a_torus(self):
        """V - F / 2 = 0 of triangles, V - E + F = 0."""
        made = Mesh(self.mesh("z = .1*sin(6.283185307179586*x)*cos(6.283185307179586*y)", "--domain", "box:0,0,1,1", *AXES[:4]))
        self.assertLess(made.mismatch(), 2e-12)
        self.assertEqual(self.euler_of(made), 0)
        glued = made.classes()
        self.assertEqual(2 * len(set(glued.values())), sum(len(cells) for cells in made.cells.values()))

    def test_a_sixth_of_a_torus(self):
        """Glued, its two closed borders make a torus: V - F / 2 = 0, V - E + F = 0."""
        torus = "x = (2 + .7*cos(v))*cos(u); y = (2 + .7*cos(v))*sin(u); z = .7*sin(v)"
        made = Mesh(self.mesh(torus, "--domain", f"box:0,0,{math.pi / 3!r},{2 * math.pi!r}", "--periodic", "rotate:0,0,0:0,0,1:60", size="0.15"))
        self.assertLess(made.mismatch(), 2e-12)
        self.assertEqual(self.euler_of(made), 0)
        self.assertEqual(2 * len({made.classes()[n] for cells in made.cells.values() for cell in cells for n in cell}),
                         sum(len(cells) for cells in made.cells.values()))

    def test_other_elements_cross_patches(self):
        """Slaves get the images of their masters' elements, with their nodes; the rest crosses borders of patches. Six tubes, glued, have
        genus 3, and the sector of a pipe has one pair. An eighth of a sphere may have one triangle, whose normal is as near to its neighbours' normals."""
        tubes = self.path("tubes.bpt", six_tubes())
        cases = ((os.path.join(CELLS, "annulus.step"), ("--periodic", "rotate:0,0,0:0,0,1:60"), "0.2", 1), (os.path.join(CELLS, "sector24.step"), ("--periodic", "rotate:0,0,0:0,0,1:15"), ".05", 1),
                 (tubes, AXES, "0.2", 0), (os.path.join(CELLS, "fcc.step"), AXES, ".2", 3))
        for element in ("p1", "p2", "q1.0", "q1.1", "q2.0", "q2.1"):
            for source, options, size, faces in cases:
                with self.subTest(element, source=source):
                    path = self.path("cell.msh2")
                    done = run("mesh", source, "-o", path, "--size", size, "--cross-patch", "--element", element, *options)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertNotIn("no cross-patch remeshing", done.stderr)
                    made = Mesh(path)
                    self.assertEqual(len(made.faces()), faces)
                    self.assertLess(made.mismatch(), 4e-12)
                    for _, slave, master, _, nodes in made.faces():
                        self.assertTrue(made.same_cells(slave, master, nodes))
                        on_face = {n for cell in made.nodes[master] for n in cell}
                        self.assertEqual(on_face, {m for _, m in nodes})
                    if source == tubes:
                        self.assertEqual(self.euler_of(made), -4)
                    if source.endswith("fcc.step"):
                        self.assertEqual(made.euler_of_skin(), 8)
                    self.require_sound(path, element)

    def test_closed_curves_that_maps_carry_onto_themselves(self):
        """A pipe under turns by 60 degrees: its circles repeat. A ball of two halves under half a turn: its circle is reversed, and one half is the
        image of the other one."""
        for turn, options in ((60, ()), (60, ("--face-size", "1=.07")), (72, ("--size-map", ".05 + .1*abs(x)")), (90, ("--element", "p2")), (90, ("--element", "q3")),
                              (60, ("--cross-patch",)), (60, ("--cross-patch", "--element", "p2")), (60, ("--cross-patch", "--element", "q1.1"))):
            with self.subTest(turn=turn, options=options):
                made = Mesh(self.mesh(os.path.join(CELLS, "pipe.step"), "--periodic", f"rotate:0,0,0:0,0,1:{turn}", *options, size="0.2"))
                rim = {n: p for n, p in made.points.items() if min(abs(p[2]), abs(p[2] - 1)) < 1e-9 and min(abs(math.hypot(*p[:2]) - r) for r in (.5, 1)) < 1e-9}
                angle = math.radians(turn)
                for x, y, z in rim.values():
                    image = (x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle), z)
                    self.assertLess(min(math.dist(image, p) for p in rim.values()), 4e-12)
                # The pairs are of the circles with themselves: each node that is no master is the image of one master.
                self.assertEqual({pair[:2] + pair[2:3] for pair in made.pairs}, {(1, c, c) for pair in made.pairs for c in pair[1:2]})
                self.assertLess(made.mismatch(), 4e-12)
                slaves = [slave for pair in made.pairs for slave, _ in pair[4]]
                masters = {master for pair in made.pairs for _, master in pair[4]}
                self.assertEqual(len(slaves), len(set(slaves)))
                self.assertEqual(masters | set(slaves), set(rim))
                self.assertEqual(len(rim), len(masters) * 360 // turn)
                self.require_sound(self.path("cell.msh2"), "q" if "q1.1" in options else "p1")
        for options in ((), ("--size-map", ".1 + .1*abs(y)"), ("--element", "p2"), ("--element", "q1.1"), ("--cross-patch", "--element", "p2")):
            with self.subTest(options=options):
                made = Mesh(self.mesh(os.path.join(CELLS, "lens.step"), "--periodic", "rotate:0,0,0:1,0,0:180", *options, size="0.25"))
                self.assertEqual(len(made.faces()), 1)
                self.assertLess(made.mismatch(), 2e-12)
                rim = [p for p in made.points.values() if abs(p[2]) < 1e-9]
                for x, y, z in rim:
                    self.assertLess(min(math.dist((x, -y, -z), p) for p in rim), 4e-12)
                for _, slave, master, _, nodes in made.faces():
                    self.assertTrue(made.same_cells(slave, master, nodes))
                self.assertEqual(run("check", self.path("cell.msh2")).returncode, 0)

    def test_a_turn_that_never_returns_is_reported(self):
        done = run("mesh", os.path.join(CELLS, "pipe.step"), "-o", self.path("none.msh"), "--periodic", "rotate:0,0,0:0,0,1:57.29577951308232", "--size", ".2")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("no whole number of edges can be repeated so", done.stderr)

    def test_pairs_of_a_face_that_a_turn_carries_onto_itself(self):
        """An annulus and the sides of its pipe: the report lists the curves whose nodes have pairs, each with itself; seams have none."""
        path = self.path("pipe.msh2")
        done = run("mesh", os.path.join(CELLS, "pipe.step"), "-o", path, "--periodic", "rotate:0,0,0:0,0,1:60", "--size", ".2")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = re.findall(r"face (\d): the map of a periodicity carries the face onto itself: nodes on its curves (\d) and (\d) have pairs; nodes inside have none", done.stderr)
        self.assertEqual([int(face) for face, _, _ in found], [1, 2, 3, 4])
        made = Mesh(path)
        inside = {n for n, (x, y, z) in made.points.items() if min(abs(math.hypot(x, y) - r) for r in (.5, 1)) > 1e-9 or 1e-9 < z < 1 - 1e-9}
        self.assertFalse(inside & {n for pair in made.pairs for nodes in pair[4] for n in nodes})
        self.assertEqual(len({pair[1] for pair in made.pairs}), 4)

    def test_a_torus_that_is_cut_once(self):
        """Its two borders are one circle of space under the turn by 300 degrees; glued, it is a torus."""
        torus = "x = (2 + .7*cos(v))*cos(u); y = (2 + .7*cos(v))*sin(u); z = .7*sin(v)"
        for element in ("p1", "p2", "q1.1"):
            made = Mesh(self.mesh(torus, "--domain", f"box:0,0,{5 * math.pi / 3!r},{2 * math.pi!r}", "--periodic", "rotate:0,0,0:0,0,1:300", "--element", element, size="0.3"))
            self.assertLess(made.mismatch(), 2e-12)
            self.assertEqual(self.euler_of(made), 0)

    def test_refined_meshes_stay_periodic(self):
        """Each halving makes four elements of one; images stay images."""
        cases = ((os.path.join(CELLS, "fcc.step"), AXES, "0.15"), (os.path.join(CELLS, "sector24.step"), ("--periodic", "rotate:0,0,0:0,0,1:15"), ".06"),
                 (os.path.join(CELLS, "lens.step"), ("--periodic", "rotate:0,0,0:1,0,0:180"), ".4"))
        for element in ("p1", "p2", "q1.0", "q1.1", "q2.1"):
            for source, options, size in cases:
                counts = []
                for halvings in (0, 1, 2):
                    with self.subTest(element, source=source, halvings=halvings):
                        made = Mesh(self.mesh(source, *options, "--element", element, "--halvings", str(halvings), size=size))
                        counts.append(sum(map(len, made.cells.values())))
                        self.assertEqual(counts[-1], counts[0] * 4 ** halvings)
                        self.assertLess(made.mismatch(), 2e-12)
                        self.assertEqual(len(made.faces()), 3 if options == AXES else 1)
                        for _, slave, master, _, nodes in made.faces():
                            self.assertTrue(made.same_cells(slave, master, nodes))
                            self.assertEqual({n for cell in made.nodes[master] for n in cell}, {m for _, m in nodes})
                        if source.endswith("fcc.step"):
                            self.assertEqual(made.euler_of_skin(), 8)
                        self.require_sound(self.path("cell.msh2"), element)

    def test_refined_files_stay_periodic(self):
        """`carreau refine` reads pairs of both versions; images of cut edges are cut at the images of their middles."""
        for body, options, size, faces in (("fcc.step", AXES, ".2", 3), ("annulus.step", ("--periodic", "rotate:0,0,0:0,0,1:60"), ".25", 1),
                                           ("pipe.step", ("--periodic", "rotate:0,0,0:0,0,1:60"), ".3", 0)):
            first = Mesh(self.mesh(os.path.join(CELLS, body), "-o", self.path("first.msh"), *options, name="first.msh2", size=size))
            for name in ("first.msh", "first.msh2"):
                for depth in (0, 3):
                    with self.subTest(body, name=name, depth=depth):
                        path = self.path("finer.msh2")
                        done = run("refine", self.path(name), "-o", path, "-o", self.path("finer.vtk"), *(("--angle", "10", "--depth", str(depth)) if depth else ()))
                        self.assertEqual(done.returncode, 0, done.stderr)
                        made = Mesh(path)
                        self.assertEqual(len(made.faces()), faces)
                        self.assertLess(made.mismatch(), 2e-12)
                        self.assertTrue(made.pairs)
                        self.assertEqual(made.without_one_master(), [])
                        self.assertEqual(masters_of(self.path("finer.vtk"), len(made.points)), [root - 1 for _, root in sorted(made.classes().items())])
                        for _, slave, master, _, nodes in made.faces():
                            self.assertTrue(made.same_cells(slave, master, nodes))
                            self.assertEqual({n for cell in made.cells[master] for n in cell}, {m for _, m in nodes})
                        if body == "fcc.step":
                            self.assertEqual(made.euler_of_skin(), 8)
                        count = [sum(map(len, m.cells.values())) for m in (first, made)]
                        pairs = [sum(len(pair[4]) for pair in m.pairs) for m in (first, made)]
                        self.assertEqual((count[1] > 1.5 * count[0], pairs[1] > pairs[0]), (depth > 0, depth > 0))
                        if depth == 0:
                            self.assertEqual(made.classes(), first.classes())
                        self.assertEqual(run("check", path).returncode, 0)

    def test_estimates_of_one_side_count_for_both(self):
        """Values vary beside x = 0 alone; the next mesh is as fine at x = 1."""
        source, last = os.path.join(CELLS, "cube.step"), self.path("last.msh2")
        self.mesh(source, "-o", self.path("last.mesh"), name="last.msh2", size="0.15")
        places = Mesh(last).points
        values = [math.exp(-40 * (places[n][0] ** 2 + (places[n][1] - .5) ** 2 + (places[n][2] - .5) ** 2)) for n in sorted(places)]
        self.path("last.sol", f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n{len(values)}\n1 1\n" + "\n".join(map(repr, values)) + "\nEnd\n")
        done = run("adapt", source, "--mesh", self.path("last.mesh"), "--sol", self.path("last.sol"), "-o", self.path("next.msh2"), *AXES[:2], "--size", ".2", "--min", ".02")
        self.assertEqual(done.returncode, 0, done.stderr)
        made = Mesh(self.path("next.msh2"))
        self.assertEqual(made.mismatch(), 0)
        self.assertEqual(len(made.faces()), 1)
        low, high = ([n for n, p in made.points.items() if p[0] == at] for at in (0, 1))
        self.assertEqual(len(low), len(high))
        self.assertGreater(len(low), 2 * sum(p[0] == 0 for p in places.values()))

    def test_classes_of_spheres(self):
        """Pieces of spheres in the corners, on the edges and on the faces of a cube: glued, they are one sphere of eight pieces, three of four and
        three of two. A vertex on n sides of the cube has 2^n images."""
        for body, sphere in (("spheres.step", True), ("cube.step", False)):
            for element in ("p1", "p2", "q1.1"):
                with self.subTest(body, element=element):
                    made = Mesh(self.mesh(os.path.join(CELLS, body), *AXES, "--element", element))
                    self.assertLess(made.mismatch(), 2e-12)
                    members = {}
                    for n, root in made.classes().items():
                        members.setdefault(root, []).append(n)
                    on_sides = {n: sum(min(abs(x), abs(x - 1)) < 1e-9 for x in p) for n, p in made.points.items()}
                    for all in members.values():
                        self.assertEqual({len(all)}, {2 ** on_sides[n] for n in all})
                    self.assertEqual(max(on_sides.values()), 2 if sphere else 3)
                    if sphere:
                        self.assertEqual(made.skin_pieces(), [2, 2, 2, 4, 4, 4, 8])
                        self.assertEqual(made.euler_of_skin(), 14)  # seven spheres

    def test_an_edge_that_a_half_turn_reverses(self):
        """The half turn about the diagonal of a cube's side carries the edge on z onto itself, reversed, and x = 0 onto y = 0."""
        for options in ((), ("--face-size", "1=.07"), ("--size-map", ".05 + .2*z")):
            with self.subTest(options):
                made = Mesh(self.mesh(os.path.join(CELLS, "cube.step"), "--periodic", "rotate:0,0,.5:1,1,0:180", *options, size="0.2"))
                self.assertEqual(len(made.faces()), 3)
                self.assertLess(made.mismatch(), 2e-12)
                heights = sorted(p[2] for p in made.points.values() if abs(p[0]) < 1e-12 and abs(p[1]) < 1e-12)
                for low, high in zip(heights, reversed(heights)):
                    self.assertLess(abs(low + high - 1), 2e-12)
                itself = [nodes for dimension, slave, master, _, nodes in made.pairs if dimension == 1 and slave == master]
                self.assertEqual([len(nodes) for nodes in itself], [len(heights) // 2, len(itself[1])])
                # Two corners of an edge that is turned are one pair; no master is a slave.
                corners = [pair[1:3] for pair in made.pairs if pair[0] == 0]
                self.assertEqual(len(corners), 4)
                self.assertEqual({slave for slave, _ in corners} & {master for _, master in corners}, set())
                for _, slave, master, _, nodes in made.faces():
                    self.assertTrue(made.same_cells(slave, master, nodes))

    def test_cross_patch_meshes_stop_at_periodic_faces(self):
        for options in (("--size-map", ".05 + .1*abs(x - .5)"), ()):
            with self.subTest(options):
                path = self.mesh(os.path.join(CELLS, "fcc.step"), *AXES, "--cross-patch", *options)
                made = Mesh(path)
                self.assertEqual(len(made.faces()), 3)
                self.assertLess(made.mismatch(), 2e-12)
                for _, slave, master, _, nodes in made.faces():
                    self.assertTrue(made.same_cells(slave, master, nodes))
                self.assertEqual(made.euler_of_skin(), 8)

    def require_sound(self, path, elements):
        """No defects; quadrilaterals of the free mesh may be invalid, too."""
        done = run("check", path)
        if elements.startswith("q"):
            wrong = [line for line in (done.stdout + done.stderr).splitlines() if re.match(r"(element|triangle|edge|vertex) \d", line) and "Jacobian" not in line]
            self.assertEqual(wrong, [])
        else:
            self.assertEqual(done.returncode, 0, done.stdout)

    def check_triangles(self, path, pairs):
        """Faces of triangles: exact images, equal elements, a sound mesh."""
        made = Mesh(path)
        self.assertEqual(len(made.faces()), pairs)
        self.assertLess(made.mismatch(), 2e-12)
        for _, slave, master, _, nodes in made.faces():
            self.assertTrue(made.same_cells(slave, master, nodes), (slave, master))
        self.assertEqual(run("check", path).returncode, 0)
        return made

    def test_a_cube_of_triangles(self):
        """Both sides have different triangles: the cube is exported without pairs."""
        stl = self.mesh(os.path.join(CELLS, "cube.step"), "--face-size", "1=.11", name="cube.stl", size="0.3")
        for options in ((), ("--size-map", ".04 + .1*x"), ("--threads", "3")):
            with self.subTest(options):
                made = self.check_triangles(self.mesh(stl, *AXES, *options), 3)
                self.assertEqual(sum(pair[0] == 1 for pair in made.pairs), 9)  # twelve edges in three classes
                self.assertEqual(sum(pair[0] == 0 for pair in made.pairs), 7)  # eight corners in one
                self.assertEqual(euler([c for f in made.cells.values() for c in f]), 2)

    def test_spheres_of_triangles_in_the_corners_and_faces_of_a_cube(self):
        """Glued, the surface in the cell is four whole spheres; sizes are uniform or follow curvature."""
        stl = self.mesh(os.path.join(CELLS, "fcc.step"), *AXES, name="fcc.stl", size="0.04")
        for size, options in (("0.08", ()), (None, ("--max", ".15", "--angle", "12"))):
            with self.subTest(options):
                made = self.check_triangles(self.mesh(stl, *AXES, *options, size=size), 3)
                self.assertEqual(made.euler_of_skin(), 8)

    def test_other_elements_of_triangles(self):
        stl = self.mesh(os.path.join(CELLS, "fcc.step"), *AXES, name="fcc.stl", size="0.04")
        for element in ("p2", "q1.0", "q1.1", "q2.0", "q2.1"):
            with self.subTest(element):
                made = self.check_triangles(self.mesh(stl, *AXES, "--element", element, size="0.08"), 3)
                self.assertEqual(made.euler_of_skin(), 8)
                for _, _, master, _, nodes in made.faces():
                    self.assertEqual({n for cell in made.nodes[master] for n in cell}, {m for _, m in nodes})

    def test_a_sector_of_triangles(self):
        """Both sides of the sector meet in its axis, whose vertices are their own images."""
        stl = self.mesh(os.path.join(CELLS, "sector.step"), "--periodic", "rotate:0,0,0:0,0,1:60", name="sector.stl", size="0.05")
        self.check_triangles(self.mesh(stl, "--periodic", "rotate:0,0,0:0,0,1:60"), 1)

    def test_a_minimal_surface_of_triangles(self):
        """The gyroid sin x cos y + sin y cos z + sin z cos x = -.05 in its cell, an open sheet: glued, it has no border and genus 3 for each of two
        primitive cells, so V - E + F = -8."""
        made = Mesh(self.mesh(self.path("gyroid.off", gyroid(12)), *AXES, size="0.4"))
        self.assertEqual(made.faces(), [])
        self.assertLess(made.mismatch(), 2e-12)
        self.assertEqual(self.euler_of(made), -8)

    def test_triangles_that_do_not_match_are_reported(self):
        stl = self.mesh(os.path.join(CELLS, "mismatch.step"), name="mismatch.stl", size="0.1")
        done = run("mesh", stl, "-o", self.path("none.msh"), "--periodic", "x")
        self.assertEqual(done.returncode, 2)
        self.assertIn("do not match", done.stderr)
        self.assertIn("apart at (", done.stderr)
        cube = self.mesh(os.path.join(CELLS, "cube.step"), name="cube.stl", size="0.3")
        spheres = self.mesh(os.path.join(CELLS, "fcc.step"), *AXES, name="fcc.stl", size="0.08")
        for source, options, words in ((spheres, ("--anisotropic", "--angle", "10"), "sizes by direction are for patches alone"), (cube, ("--periodic", "7=1"), "no face of reference 7")):
            done = run("mesh", source, "-o", self.path("none.msh"), "--periodic", "x", *options)
            self.assertEqual(done.returncode, 2)
            self.assertIn(words, done.stderr)

    def test_med_has_an_equivalence_for_each_pair(self):
        libraries = sorted(glob.glob("/usr/lib/*/libmedC.so.*"))
        if not libraries:
            raise unittest.SkipTest("no libmedC")
        source = os.path.join(CELLS, "fcc.step")
        text = self.path("pairs.txt")
        path = self.mesh(source, *AXES, "-o", text, name="cell.med")
        with open(text, encoding="utf-8") as file:
            lines = [line.split() for line in file][1:]
        blocks = {}
        for line in lines:
            if line[0] == "#":
                key = f"periodic_{['points', 'curves', 'faces'][int(line[1])]}_{line[2]}_{line[3]}"
                blocks[key] = []
            else:
                blocks[key] += [int(line[0]), int(line[1])]
        med = ctypes.CDLL(libraries[0])
        med.MEDfileOpen.restype = ctypes.c_int64
        file = ctypes.c_int64(med.MEDfileOpen(path.encode(), 0))
        self.assertGreaterEqual(file.value, 0)
        count = med.MEDnEquivalence(file, b"carreau")
        self.assertEqual(count, len(blocks))
        for index in range(1, count + 1):
            name, about = ctypes.create_string_buffer(65), ctypes.create_string_buffer(201)
            steps, constant = ctypes.c_int(0), ctypes.c_int(0)
            self.assertGreaterEqual(med.MEDequivalenceInfo(file, b"carreau", index, name, about, ctypes.byref(steps), ctypes.byref(constant)), 0)
            size = ctypes.c_int(0)
            self.assertGreaterEqual(med.MEDequivalenceCorrespondenceSize(file, b"carreau", name, -1, -1, 3, 0, ctypes.byref(size)), 0)
            nodes = (ctypes.c_int * (2 * size.value))()
            self.assertGreaterEqual(med.MEDequivalenceCorrespondenceRd(file, b"carreau", name, -1, -1, 3, 0, nodes), 0)
            self.assertEqual(list(nodes), blocks[name.value.decode()])
            self.assertEqual(len(about.value.split()), 12)
        med.MEDfileClose(file)

    def test_calculix_homogenises_a_laminate(self):
        """Two layers across x: stress / strain is the harmonic mean of their moduli, without lateral contraction. The equations are of our sets of
        nodes."""
        if shutil.which("ccx") is None:
            raise unittest.SkipTest("no ccx")
        poly = self.path("cell.poly", "6 2 0 0\n1 0 0\n2 .4 0\n3 1 0\n4 1 1\n5 .4 1\n6 0 1\n7 0\n1 1 2\n2 2 3\n3 3 4\n4 4 5\n5 5 6\n6 6 1\n7 2 5\n0\n")
        path = self.mesh(poly, *AXES[:4], name="cell.inp", command="plane", size="0.15")
        with open(path, encoding="utf-8") as file:
            lines = file.read().splitlines()
        nodes, elements, sets, kind = {}, {}, {}, None
        for line in lines:
            if line.startswith("*"):
                words = line.upper().replace(" ", "").split(",")
                kind = words[0]
                name = next((word[5:] for word in words if word.startswith("NSET=")), "")
                continue
            row = [word.strip() for word in line.split(",") if word.strip()]
            if kind == "*NODE":
                nodes[int(row[0])] = [float(x) for x in row[1:4]]
            elif kind == "*ELEMENT":
                elements[int(row[0])] = [int(n) for n in row[1:]]
            elif kind == "*NSET":
                sets.setdefault(name, []).extend(int(n) for n in row)
        pairs = [(sets[n.replace("MASTER", "SLAVE")], sets[n]) for n in sorted(sets) if n.startswith("PERIODIC") and n.endswith("MASTER")]
        self.assertGreaterEqual(len(pairs), 2)
        reference, force = max(nodes) + 1, 2.
        text = ["*NODE", *(f"{n}, {x}, {y}, 0." for n, (x, y, *_) in nodes.items()), f"{reference}, 2., 0., 0."]
        triangles = {n: c for n, c in elements.items() if len(c) == 3}
        layer = {n: sum(nodes[v][0] for v in c) / 3 < 0.4 for n, c in triangles.items()}
        for soft in (True, False):
            text += [f"*ELEMENT, TYPE=CPS3, ELSET={'SOFT' if soft else 'HARD'}", *(f"{n}, {c[0]}, {c[1]}, {c[2]}" for n, c in triangles.items() if layer[n] == soft)]
        dependent = set()
        for slaves, masters in pairs:
            self.assertEqual(len(slaves), len(masters))
            for slave, master in zip(slaves, masters):
                dx, dy = nodes[slave][0] - nodes[master][0], nodes[slave][1] - nodes[master][1]
                self.assertEqual((round(dx, 9), round(dy, 9)) in ((1, 0), (0, 1), (-1, 0), (0, -1)), True)
                if slave in dependent:
                    continue
                dependent.add(slave)
                text += ["*EQUATION", "3", f"{slave}, 1, 1., {master}, 1, -1., {reference}, 1, {-dx:.1f}"] if dx else ["*EQUATION", "2", f"{slave}, 1, 1., {master}, 1, -1."]
                text += ["*EQUATION", "2", f"{slave}, 2, 1., {master}, 2, -1."]
        free = next(n for n in nodes if n not in dependent and n in {v for c in triangles.values() for v in c})
        text += ["*MATERIAL, NAME=A", "*ELASTIC", "100., 0.", "*MATERIAL, NAME=B", "*ELASTIC", "1000., 0.", "*SOLID SECTION, ELSET=SOFT, MATERIAL=A", "1.",
                 "*SOLID SECTION, ELSET=HARD, MATERIAL=B", "1.", "*BOUNDARY", f"{free}, 1, 2", f"{reference}, 2, 3",
                 "*NSET, NSET=REF", f"{reference}", "*STEP", "*STATIC", "*CLOAD", f"{reference}, 1, {force}", "*NODE PRINT, NSET=REF", "U", "*END STEP"]
        self.path("job.inp", "\n".join(text) + "\n")
        done = subprocess.run(["ccx", "job"], cwd=self.folder, capture_output=True, text=True, timeout=120)
        with open(self.path("job.dat"), encoding="utf-8") as file:
            rows = [line.split() for line in file]
        strain = next((float(row[1]) for row in rows if len(row) == 4 and row[0] == str(reference)), None)
        self.assertIsNotNone(strain, done.stdout[-2000:])
        self.assertAlmostEqual(strain / force, 0.4 / 100 + 0.6 / 1000, places=7)

    def test_dolfinx_reads_matching_pairs(self):
        """Vertices of the mesh that dolfinx makes are paired by the maps of the file."""
        for name in ("dolfinx", "gmsh"):
            try:
                importlib.import_module(name)
            except ImportError:
                raise unittest.SkipTest(f"Python has no {name}") from None
        script = """
import sys
import gmsh
import numpy as np
from mpi4py import MPI
from dolfinx.io import gmshio
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.open(sys.argv[1])
for dimension, tag in gmsh.model.getEntities(2):
    if not gmsh.model.getPhysicalGroupsForEntity(2, tag).size:
        gmsh.model.addPhysicalGroup(2, [tag])
mesh, _, _ = gmshio.model_to_mesh(gmsh.model, MPI.COMM_WORLD, 0, gdim=3)
places = mesh.geometry.x
count = worst = 0
for line in open(sys.argv[2]):
    words = line.split()
    if words[0] != "#" or words[1] != "2":
        continue
    map = np.array([float(x) for x in words[5:]]).reshape(3, 4)
    axis = int(np.argmax(np.abs(map[:, 3])))
    masters, slaves = (places[np.abs(places[:, axis] - at) < 1e-9] for at in (0., 1.))
    if map[axis, 3] < 0:
        masters, slaves = slaves, masters
    images = masters @ map[:, :3].T + map[:, 3]
    assert len(images) == len(slaves) == int(words[4]), (len(images), len(slaves), words[4])
    worst = max(worst, max(np.min(np.linalg.norm(slaves - image, axis=1)) for image in images))
    count += 1
print(count, worst)
"""
        text = self.path("pairs.txt")
        path = self.mesh(os.path.join(CELLS, "inclusions.step"), *AXES, "-o", text, size="0.06")
        done = subprocess.run([sys.executable, "-c", script, path, text], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr[-1500:])
        count, worst = done.stdout.split()[-2:]
        self.assertEqual(int(count), 3)
        self.assertLess(float(worst), 2e-12)


if __name__ == "__main__":
    subprocess.run([MAKE_CELLS, CELLS], check=True, stdout=subprocess.DEVNULL)
    try:
        program = unittest.main(argv=sys.argv[:1] + sys.argv[4:], exit=False)
    finally:
        shutil.rmtree(CELLS)
    sys.exit(not program.result.wasSuccessful())
