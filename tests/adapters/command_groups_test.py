#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""command_groups_test.py CARREAU MAKE_SHAPES: groups and imprints of `carreau mesh`, as the readers of other programs find them.

The shape is a plate of 4 x 4 x 1 (solid 1) and a cube of side 2 on it (solid 2)."""
import importlib
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, MAKE_SHAPES = sys.argv[1:3]
SHAPES = tempfile.mkdtemp(prefix="carreau shapes ")
RULES = ("--group", "base=face:1-2", "--group", "rim=edge:1-3", "--group", "foot=vertex:1", "--group", "steel=solid:1")


def reader(name):
    """A program that reads our files, where Python has it (python3-gmsh, python3-meshio, python3-vtk9)."""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise unittest.SkipTest(f"Python has no {name}") from None


def six_volumes(p, q, r, s):
    a, b, c = ([x - y for x, y in zip(other, p)] for other in (q, r, s))
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]))


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120)


def content(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class Groups(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau groups ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def mesh(self, name, *options, shape="touching.brep", status=0):
        path = os.path.join(self.folder, name)
        done = run("mesh", os.path.join(SHAPES, shape), "-o", path, "--size", "0.5", *options)
        self.assertEqual(done.returncode, status, done.stderr)
        self.said = done.stderr
        return path

    def test_an_imprint_leaves_no_crossing(self):
        self.mesh("apart.mesh")
        self.assertIn("crossing:", self.said)
        path = self.mesh("joined.mesh", "--imprint")
        self.assertNotIn("crossing:", self.said)
        self.assertIn("1 face between two solids", self.said)
        self.assertEqual(run("check", path).returncode, 0)

    def test_gmsh_fills_the_solids(self):
        """Volumes are 16 and 8; each physical group has the entities that the rules name, and each entity one group."""
        gmsh = reader("gmsh")
        path = self.mesh("joined.msh", "--imprint", *RULES)
        gmsh.initialize()
        try:
            gmsh.option.setNumber("General.Terminal", 0)
            gmsh.open(path)
            for dimension in range(4):
                for entity in gmsh.model.getEntities(dimension):
                    self.assertEqual(len(gmsh.model.getPhysicalGroupsForEntity(*entity)), 1, entity)
            names = {gmsh.model.getPhysicalName(*group): group for group in gmsh.model.getPhysicalGroups()}
            self.assertEqual(sorted(gmsh.model.getEntitiesForPhysicalGroup(*names["base"])), [1, 2])
            self.assertEqual(names["base"][0], 2)
            self.assertEqual(sorted(gmsh.model.getEntitiesForPhysicalGroup(*names["rim"])), [1, 2, 3])
            self.assertEqual(names["foot"][0], 0)
            gmsh.model.mesh.createGeometry([(3, 1), (3, 2)])
            gmsh.model.mesh.generate(3)
            tags, coordinates, _ = gmsh.model.mesh.getNodes()
            points = {tag: coordinates[3 * i:3 * i + 3] for i, tag in enumerate(tags)}
            for solid, expected in ((1, 16), (2, 8)):
                kinds, _, nodes = gmsh.model.mesh.getElements(3, solid)
                self.assertEqual(list(kinds), [4])
                corners = [points[node] for node in nodes[0]]
                volumes = [six_volumes(*corners[i:i + 4]) / 6 for i in range(0, len(corners), 4)]
                self.assertGreater(min(volumes), 0)
                self.assertAlmostEqual(sum(volumes), expected, places=9)
            self.assertEqual([dimension for dimension, tag in gmsh.model.getPhysicalGroups()
                              if gmsh.model.getPhysicalName(dimension, tag) == "steel"], [2, 3])
        finally:
            gmsh.finalize()

    def test_version_2_of_msh_has_one_group_for_each_element(self):
        meshio = reader("meshio")
        read = meshio.read(self.mesh("joined.msh2", "--imprint", *RULES, "--set", "flag=1"), "gmsh")
        self.assertLessEqual({"base", "rim", "foot", "steel"}, set(read.field_data))
        for block, physical in zip(read.cells, read.cell_data["gmsh:physical"]):
            self.assertTrue((physical > 0).all(), block.type)

    def test_solvers_find_the_groups(self):
        inp = content(self.mesh("joined.inp", "--imprint", *RULES))
        self.assertRegex(inp, r"\*ELSET, ELSET=base\nface_1, face_2\n")
        nodes = {name: re.findall(r"\d+", numbers) for name, numbers in re.findall(r"\*NSET, NSET=(\w+)\n([\d, \n]*)", inp)}
        self.assertEqual(set(nodes["rim"]), set(nodes["curve_1"]) | set(nodes["curve_2"]) | set(nodes["curve_3"]))
        for name in ("rim", "curve_1", "foot"):
            self.assertEqual(len(nodes[name]), len(set(nodes[name])), name)  # CalculiX counts a node as often as a set has it
        su2 = content(self.mesh("joined.su2", "--imprint", *RULES))
        markers = re.findall(r"MARKER_TAG= (\w+)", su2)
        self.assertEqual(len(markers), len(set(markers)))
        self.assertLessEqual({"base", "steel"}, set(markers))
        unv = content(self.mesh("joined.unv", "--imprint", *RULES))
        for name in ("base", "rim", "steel"):
            self.assertRegex(unv, rf"(?m)^{name}$")

    def test_vtk_finds_names_and_sides(self):
        vtu = reader("vtk").vtkXMLUnstructuredGridReader()
        vtu.SetFileName(self.mesh("joined.vtu", "--imprint", *RULES))
        vtu.Update()
        grid = vtu.GetOutput()
        solids = grid.GetCellData().GetArray("solids")
        sides = {tuple(int(x) for x in solids.GetTuple(i)) for i in range(solids.GetNumberOfTuples())}
        self.assertEqual(sides, {(0, 0), (1, 0), (2, 0), (1, 2)})  # edges have none
        text = grid.GetFieldData().GetArray("curve_name")
        self.assertEqual(bytes(int(text.GetValue(i)) for i in range(text.GetNumberOfTuples())), b"rim\0rim\0rim\0")

    def test_groups_by_part_and_by_color(self):
        parts = content(self.mesh("parts.inp", "--group-by", "part", shape="assembly.step"))
        self.assertRegex(parts, r"ELSET=ball\n")
        self.assertRegex(parts, r"ELSET=block_2\n")  # of two blocks
        self.assertRegex(content(self.mesh("names.su2", shape="assembly.step")), r"MARKER_TAG= block\n")
        faces = re.findall(r"MARKER_TAG= (\w+)", content(self.mesh("faces.su2", "--group-by", "face", shape="assembly.step")))
        self.assertEqual(len(faces), 13)  # a ball and two blocks
        colours = content(self.mesh("coloured.inp", "--group-by", "color", shape="named_faces.step"))
        self.assertIn("ELSET=color_40a030", colours)
        self.assertRegex(content(self.mesh("red.inp", "--group", "green=color:#40A030", shape="named_faces.step")), r"ELSET=green\n")

    def test_groups_of_nothing_are_rejected(self):
        for rule, said in (("a=face:99", "there is no face 99"), ("a=bolt", "no face, solid, edge or vertex has this name"),
                           ("a=edge:rim", "there is no such edge"), ("a=color:red", "a colour is written #rrggbb"),
                           ("a=color:#123456", "no face has this colour"), ("a=edge:999", "no curve of reference 999"), ("a", "--group")):
            path = os.path.join(self.folder, "none.mesh")
            done = run("mesh", os.path.join(SHAPES, "touching.brep"), "-o", path, "--group", rule)
            self.assertEqual(done.returncode, 2, rule)
            self.assertIn(said, done.stderr)
            self.assertFalse(os.path.exists(path))
        done = run("mesh", os.path.join(SHAPES, "named_faces.step"), "-o", os.path.join(self.folder, "none.mesh"), "--group", "a=topp")
        self.assertIn("did you mean 'top'", done.stderr)

    def test_an_entity_has_one_group(self):
        self.mesh("twice.inp", "--group", "a=face:1-3", "--group", "b=face:3")
        self.assertIn("1 entity was in another group", self.said)

    def edges(self, path, ref):
        """The number and the longest length of the edges on a curve of a .mesh file."""
        words = content(path).split()
        at = words.index("Vertices")
        points = [[float(x) for x in words[at + 2 + 4 * i:at + 5 + 4 * i]] for i in range(int(words[at + 1]))]
        at = words.index("Edges")
        rows = [[int(x) for x in words[at + 2 + 3 * i:at + 5 + 3 * i]] for i in range(int(words[at + 1]))]
        lengths = [math.dist(points[a - 1], points[b - 1]) for a, b, curve in rows if curve == ref]
        return len(lengths), max(lengths)

    def test_sizes_on_edges_and_vertices(self):
        path = self.mesh("fine.mesh", "--size-on", "edge:1=0.1")
        count, longest = self.edges(path, 1)
        self.assertLessEqual(longest, 0.1 * math.sqrt(2))
        self.assertGreaterEqual(count * longest, 1 - 1e-12)  # its length is 1 or 4
        for rule, said in (("edge:99=1", "number 99 does not exist"), ("edge:1=0", "--size-on"), ("bolt=1", "no face, solid, edge or vertex")):
            done = run("mesh", os.path.join(SHAPES, "touching.brep"), "-o", os.path.join(self.folder, "none.mesh"), "--size-on", rule)
            self.assertEqual(done.returncode, 2)
            self.assertIn(said, done.stderr)

    def test_segments_of_a_circle(self):
        """The hole of the plate is a circle."""
        for n in (12, 24, 48):
            by_count = content(self.mesh("n.mesh", "--segments-per-circle", str(n), "--max", "10", shape="plate.step"))
            by_angle = content(self.mesh("a.mesh", "--angle", str(180 / n), "--max", "10", shape="plate.step"))
            self.assertEqual(by_count, by_angle)

    def test_units_that_contradict_are_rejected(self):
        done = run("mesh", os.path.join(SHAPES, "touching.brep"), "-o", os.path.join(self.folder, "none.mesh"), "--unit", "m")
        self.assertEqual(done.returncode, 2)
        self.assertIn("the file has no unit", done.stderr)
        self.assertIn("unit        m (the file has in)", run("info", os.path.join(SHAPES, "inch.step"), "--unit", "m").stdout)


if __name__ == "__main__":
    subprocess.run([MAKE_SHAPES, SHAPES], check=True, stdout=subprocess.DEVNULL)
    try:
        unittest.main(argv=sys.argv[:1], verbosity=2)
    finally:
        shutil.rmtree(SHAPES)
