#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""command_cad_test.py CARREAU MAKE_SHAPES: sizes near entities, files of sizes, names, layers and trees of CAD files; groups
in the files of other programs.

touching.brep is a plate of 4 x 4 x 1 and a cube of side 2 on it. press.step is a plate and two parts "stamp" of side 1, with
names, layers and automatic names (make_shapes.cpp)."""
import collections
import importlib
import json
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
RULES = ("--group", "base=face:1-2", "--group", "edges=edge:2-3", "--group", "foot=vertex:1", "--group", "steel=solid:2")
# Text, a drawn leader and a plane beside a part, as AP242 has them (ISO 10303-242, -46): none of it is geometry of the part.
PMI = """#9001=CARTESIAN_POINT('',(50.,0.,0.));
#9002=CARTESIAN_POINT('',(50.,50.,0.));
#9003=POLYLINE('leader',(#9001,#9002));
#9004=GEOMETRIC_CURVE_SET('leader',(#9003));
#9005=PRESENTATION_STYLE_ASSIGNMENT((NULL_STYLE(.NULL.)));
#9006=ANNOTATION_CURVE_OCCURRENCE('flatness 0.1',(#9005),#9004);
#9007=DIRECTION('',(0.,0.,1.));
#9008=DIRECTION('',(1.,0.,0.));
#9009=AXIS2_PLACEMENT_3D('',#9001,#9007,#9008);
#9010=PLANE('datum A',#9009);
#9011=ANNOTATION_PLANE('',(#9005),#9010,(#9006));
#9012=DRAUGHTING_MODEL('PMI',(#9006),#{context});
#9013=CONSTRUCTIVE_GEOMETRY_REPRESENTATION('supplemental geometry',(#9010,#9003),#{context});
#9014=CONSTRUCTIVE_GEOMETRY_REPRESENTATION_RELATIONSHIP('supplemental geometry','',#{shape},#9013);
"""


def reader(name):
    """A program that reads our files, where Python has it."""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise unittest.SkipTest(f"Python has no {name}") from None


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120)


def content(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def triangles(path):
    """Corners of the triangles of a .mesh file, and their references."""
    words = content(path).split()
    at = words.index("Vertices")
    points = [[float(x) for x in words[at + 2 + 4 * i:at + 5 + 4 * i]] for i in range(int(words[at + 1]))]
    at = words.index("Triangles")
    rows = [[int(x) for x in words[at + 2 + 4 * i:at + 6 + 4 * i]] for i in range(int(words[at + 1]))]
    return [[points[k - 1] for k in row[:3]] for row in rows], [row[3] for row in rows]


class CadFiles(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau cad ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name, text=None):
        path = os.path.join(self.folder, name)
        if text is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        return path

    def mesh(self, name, *options, shape="touching.brep", status=0):
        path = self.path(name)
        done = run("mesh", os.path.join(SHAPES, shape), "-o", path, *options)
        self.assertEqual(done.returncode, status, done.stderr)
        self.said = done.stderr
        return path

    def failure(self, *options, shape="touching.brep"):
        done = run("mesh", os.path.join(SHAPES, shape), "-o", self.path("none.mesh"), *options)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertFalse(os.path.exists(self.path("none.mesh")))
        return done.stderr

    def check_sizes(self, path, distance, size, reach, around):
        """Edges have the length that grows linearly with the distance of their middle from the entity."""
        ratios = []
        for corners in triangles(path)[0]:
            for a, b in zip(corners, corners[1:] + corners[:1]):
                middle = [(x + y) / 2 for x, y in zip(a, b)]
                share = min(1, distance(middle) / reach)
                ratios.append(math.dist(a, b) / (size + share * (around - size)))
        ratios.sort()
        self.assertGreater(len(ratios), 1000)
        self.assertAlmostEqual(ratios[len(ratios) // 2], 1, delta=0.15)
        self.assertLess(ratios[int(0.99 * len(ratios))], 1.7)

    def test_sizes_near_a_face(self):
        """The bottom of the plate; the side of the cube is 2 away from it."""
        bottom = next(face["face"] for face in json.loads(run("info", os.path.join(SHAPES, "touching.brep"), "--faces", "--json").stdout)["face_list"]
                      if face["box"][1][2] == 0)
        path = self.mesh("a.mesh", "--size", "0.5", "--near", f"face:{bottom}=0.05:2")

        def distance(p):
            return math.hypot(max(-p[0], p[0] - 4, 0), max(-p[1], p[1] - 4, 0), p[2])
        self.check_sizes(path, distance, 0.05, 2, 0.5)

    def test_sizes_near_edges_and_vertices(self):
        """Edge 1 of the plate is (0, 0, 0) - (0, 0, 1), vertex 1 an end of it."""
        path = self.mesh("e.mesh", "--size", "0.5", "--near", "edge:1=0.03:2")
        self.check_sizes(path, lambda p: math.hypot(p[0], p[1], max(0, p[2] - 1)), 0.03, 2, 0.5)
        one, two = (self.mesh(name, "--size", "0.5", "--near", rule) for name, rule in (("1.mesh", "vertex:1=0.02:1"), ("2.mesh", "vertex:2=0.02:1")))
        ends = [min((p for corners in triangles(path)[0] for p in corners), key=lambda p: min(math.dist(p, q) for q in [p])) for path in (one, two)]
        self.assertEqual(len(ends), 2)
        for path in (one, two):
            shortest = min(((math.dist(a, b), a) for corners in triangles(path)[0] for a, b in zip(corners, corners[1:] + corners[:1])))
            self.assertLess(shortest[0], 0.04)
            self.assertLess(math.hypot(*shortest[1][:2]), 0.2)  # at an end of edge 1

    def test_a_spot_inside_a_large_face(self):
        """The cube leaves no edge on the plate: the top of the plate is fine below it all the same."""
        path = self.mesh("s.mesh", "--size", "1", "--near", "solid:2=0.1:0.5")
        on_top = [corners for corners in triangles(path)[0] if all(abs(p[2] - 1) < 1e-9 for p in corners)]
        inside = [corners for corners in on_top if all(0.6 < p[0] < 2.4 and 1.1 < p[1] < 2.9 for p in corners)]
        longest = max(math.dist(a, b) for corners in inside for a, b in zip(corners, corners[1:] + corners[:1]))
        self.assertGreater(len(inside), 400)
        self.assertLess(longest, 0.2)

    def test_sizes_near_entities_go_beside_curvature(self):
        plain = triangles(self.mesh("p.mesh", shape="plate.step"))[0]
        near = triangles(self.mesh("n.mesh", "--near", "edge:1=1%:20%", shape="plate.step"))[0]
        self.assertGreater(len(near), len(plain))

    def test_wrong_rules_of_near(self):
        for rule, said in (("face:99=0.1:1", "there is no face 99"), ("face:1=0.1", "a size and a reach"), ("face:1=0:1", "--near 'face:1=0:1'"),
                           ("edge:99=.1:1", "there is no edge 99"), ("vertex:99=.1:1", "there is no vertex 99"), ("face:1=3:1", "is above the size"),
                           ("bolt=.1:1", "no face, solid, edge or vertex has this name")):
            self.assertIn(said, self.failure("--size", "1", "--near", rule))

    def test_layers_along_an_edge(self):
        done = run("mesh", os.path.join(SHAPES, "plate.step"), "-o", self.path("l.mesh"), "--size", "4%", "--json",
                   "--layers", "edge:1=first:0.01,ratio:1.3,count:6")
        self.assertEqual(done.returncode, 0, done.stderr)
        layers, = json.loads(done.stdout)["layers"]
        self.assertEqual(layers["rows"], 6)
        for height in layers["first_height"].values():
            self.assertAlmostEqual(height / 0.01, 1, delta=0.05)
        for growth in layers["growth"].values():
            self.assertAlmostEqual(growth / 1.3, 1, delta=0.05)

    def test_y_plus_of_the_first_row(self):
        done = run("mesh", os.path.join(SHAPES, "plate.step"), "-o", self.path("l.mesh"), "--size", "4%", "--json",
                   "--layers", "edge:1=yplus:2,u_tau/nu:200,ratio:1.3,count:6")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"layers +y\+ [12]\.?\d* \([\d.]+ to [\d.]+\) at the first height, edge:1=yplus:2")
        layers, = json.loads(done.stdout)["layers"]
        for name, expected in (("y_plus", 2), ("first_over_request", 1), ("first_height", 0.01)):
            for value in layers[name].values():
                self.assertAlmostEqual(value / expected, 1, delta=0.05)
        for wrong in ("yplus:1", "yplus:1,u_tau/nu:0", "first:.01,yplus:1,u_tau/nu:100", "first:.01,u_tau/nu:-1", "u_tau/nu:100"):
            self.assertIn("layers are written as in edge:1=first:", self.failure("--size", "1", "--layers", "edge:1=" + wrong))

    def test_layers_of_curved_elements(self):
        for element in ("p2", "q1.1", "q2.0", "q2.1"):
            with self.subTest(element):
                done = run("mesh", os.path.join(SHAPES, "plate.step"), "-o", self.path("l.msh"), "--size", "4%", "--json", "--element", element,
                           "--layers", "edge:1=first:0.01,ratio:1.3,count:6")
                self.assertEqual(done.returncode, 0, done.stderr)
                layers, = json.loads(done.stdout)["layers"]
                self.assertEqual((layers["rows"], layers["fewest_rows"]), (6, 6))
                for height in layers["first_height"].values():
                    self.assertAlmostEqual(height / 0.01, 1, delta=0.05)

    def test_missing_rows_are_reported(self):
        """The opposite edges of a strip as wide as a row is high have no room."""
        done = run("mesh", os.path.join(SHAPES, "plate.step"), "-o", self.path("l.msh"), "--size", "4%", "--json", "--layers", "edge:1-12=first:0.9,ratio:1.2,count:2")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("no row", done.stderr)
        layers, = json.loads(done.stdout)["layers"]
        self.assertEqual(layers["fewest_rows"], 0)

    def test_wrong_layers(self):
        for rule, said in (("edge:1", "--layers"), ("edge:1=0.1", "layers are written as"), ("edge:1=ratio:1.2", "layers are written as"),
                           ("edge:1=first:0.1,ratio:x", "layers are written as"), ("edge:1=first:-1", "--layers"),
                           ("edge:99=first:.1", "there is no edge 99"), ("face:1=first:.1", "layers grow from edges")):
            self.assertIn(said, self.failure("--size", "1", "--layers", rule))

    def test_a_file_of_sizes(self):
        sizes = self.path("sizes.json", '{"size": 0.5, "gradation": 1.4, "size-on": {"edge:1": 0.1, "solid:2": "3%"},\n'
                          ' "face-size": {"3": 0.3}, "near": {"vertex:1": {"size": 0.02, "reach": 1}}}')
        by_file = self.mesh("f.mesh", "--sizes", sizes)
        by_options = self.mesh("o.mesh", "--size", "0.5", "--gradation", "1.4", "--size-on", "edge:1=0.1", "--size-on", "solid:2=3%",
                               "--face-size", "3=0.3", "--near", "vertex:1=0.02:1")
        self.assertEqual(content(by_file), content(by_options))
        finer = self.mesh("finer.mesh", "--sizes", sizes, "--size", "0.3")  # the command line takes precedence
        self.assertGreater(len(triangles(finer)[0]), len(triangles(by_file)[0]))
        circle = self.path("circle.json", '{"segments-per-circle": 24, "max": 10}')
        self.assertEqual(content(self.mesh("c.mesh", "--sizes", circle, shape="plate.step")),
                         content(self.mesh("d.mesh", "--segments-per-circle", "24", "--max", "10", shape="plate.step")))

    def test_wrong_files_of_sizes(self):
        for text, said in (('{"size": 0.5,\n "near": }', "line 2"), ("[1]", "an object"), ('{"sise": 1}', "did you mean 'size'"),
                           ('{"size": -1}', "key 'size'"), ('{"size": true}', "key 'size': a length"), ('{"angle": 100}', "key 'angle': a number from 0.01 to 89"),
                           ('{"angle": 10, "segments-per-circle": 24}', "exclude each other"), ('{"size": 1, "size": 2}', "key 'size': the key occurs twice"),
                           ('{"near": {"face:1": 3}}', "key 'near' 'face:1'"), ('{"near": {"face:1": {"size": 1, "reach": 0}}}', "'reach'"),
                           ('{"size-on": {"edge:1": "x"}}', "key 'size-on' 'edge:1'"), ('{"size-on": {"face:99": 1}}', "sizes.json', key 'size-on'"),
                           ('{"near": {"face:99": {"size": 0.1, "reach": 1}}}', "sizes.json', key 'near'"), ('{"gradation": 0.5}', "key 'gradation'")):
            said_here = self.failure("--sizes", self.path("sizes.json", text))
            self.assertIn("sizes.json'", said_here)
            self.assertIn(said, said_here)
        self.assertIn("none.json", self.failure("--sizes", self.path("none.json")))

    def test_the_tree_of_a_file(self):
        tree = run("info", os.path.join(SHAPES, "press.step")).stdout.split("tree:\n")[1]
        self.assertRegex(tree, r"^  assembly  press  18 faces\n    part  plate, solid 1  6 faces  layer walls\n")
        self.assertRegex(tree, r"face \d+  contact\n")
        self.assertRegex(tree, r"edge \d+  rim\n")
        self.assertRegex(tree, r"vertex \d+  corner\n")
        self.assertRegex(tree, r"    part  stamp, solid 2  6 faces  layer tools\n    part  stamp, solid 3  stamp_2  6 faces  layer tools\n")
        self.assertNotIn("#197", tree)
        rows = json.loads(run("info", os.path.join(SHAPES, "press.step"), "--json").stdout)["tree"]
        self.assertEqual([row["name"] for row in rows if row["kind"] == "solid"], ["plate", "stamp", "stamp_2"])

    def test_layers_and_names_become_groups(self):
        inp = content(self.mesh("layers.inp", "--size", "0.5", "--group-by", "layer", shape="press.step"))
        self.assertRegex(inp, r"\*ELSET, ELSET=walls\nface_1, face_2, face_3, face_4, face_5, face_6\n")
        self.assertRegex(inp, r"\*ELSET, ELSET=tools\n")
        self.assertRegex(inp, r"\*NSET, NSET=rim\n\d+, \d+")  # names of edges and vertices of the file
        self.assertRegex(inp, r"\*NSET, NSET=corner\n\d+\n")
        inp = content(self.mesh("rules.inp", "--size", "0.5", "--group", "hard=layer:tools", "--group", "line=edge:ri*", "--group", "spot=corner", shape="press.step"))
        self.assertRegex(inp, r"\*ELSET, ELSET=hard\nface_7, face_8")
        self.assertRegex(inp, r"\*NSET, NSET=line\n")
        self.assertRegex(inp, r"\*NSET, NSET=spot\n")
        names = re.findall(r"ELSET=([a-z]\w*)\n", content(self.mesh("names.inp", "--size", "0.5", "--group-by", "name", shape="press.step")))
        self.assertLessEqual({"contact", "plate", "stamp"}, set(names))
        self.assertIn("did you mean 'walls'", self.failure("--group", "a=layer:wals", shape="press.step"))
        self.assertIn("the file has no layers", self.failure("--group", "a=layer:walls"))
        self.assertIn("did you mean 'rim'", self.failure("--group", "a=edge:rmi", shape="press.step"))
        joined = content(self.mesh("joined.inp", "--size", "0.5", "--imprint", "--group-by", "layer", shape="press.step"))
        self.assertRegex(joined, r"\*NSET, NSET=rim\n")  # names follow an imprint

    def test_touching_parts_and_their_area(self):
        self.mesh("t.mesh", "--size", "0.5", shape="press.step")
        self.assertRegex(self.said, r"touching   2 pairs of solids, common area 2, largest 1 \(plate and stamp(_2)?\); --imprint")
        self.mesh("t.mesh", "--size", "0.5", "--imprint", shape="press.step")
        self.assertNotIn("touching ", self.said)
        self.assertIn("touch at", run("info", os.path.join(SHAPES, "touching.brep")).stdout)
        self.assertIn(", common area 4", run("info", os.path.join(SHAPES, "touching.brep")).stdout)
        contacts = json.loads(run("info", os.path.join(SHAPES, "press.step"), "--json").stdout)["common_areas"]
        self.assertEqual([contact["solids"] for contact in contacts], [[1, 2], [1, 3]])

    def test_a_table_beside_medit_files(self):
        self.mesh("m.mesh", "--size", "0.5", *RULES)
        rows = {tuple(line.split(" ", 2)) for line in content(self.path("m.groups")).splitlines()[1:]}
        self.assertLessEqual({("2", "1", "base"), ("2", "2", "base"), ("1", "2", "edges"), ("1", "3", "edges"), ("0", "1", "foot"), ("3", "2", "steel")}, rows)
        refs = set(triangles(self.path("m.mesh"))[1])
        self.assertTrue(all(int(ref) in refs for dimension, ref, _ in rows if dimension == "2"))
        self.mesh("plain.mesh", "--size", "0.5")
        self.assertFalse(os.path.exists(self.path("plain.groups")))

    def test_sets_of_nastran(self):
        bdf = content(self.mesh("n.bdf", "--size", "0.5", *RULES))
        sets = dict(re.findall(r"\$ set \d+: ([^\n]*)\nSET \d+ = ([^$B]*)\n", bdf))
        self.assertLessEqual({"base", "steel", "edges", "foot (grids)"}, set(sets))

        def numbers(text):
            found = []
            for piece in text.replace("\n", " ").split(","):
                first, *last = (int(x) for x in piece.split("THRU"))
                found += range(first, (last or [first])[0] + 1)
            return found
        plotel = {int(line[8:16]): (int(line[16:24]), int(line[24:32])) for line in bdf.splitlines() if line.startswith("PLOTEL")}
        self.assertTrue(all(number in plotel for number in numbers(sets["edges"])))
        shells = {int(line[8:16]): int(line[16:24]) for line in bdf.splitlines() if line.startswith("CTRIA3")}
        self.assertEqual({shells[number] for number in numbers(sets["base"])}, {1, 2})
        self.assertEqual(len(numbers(sets["foot (grids)"])), 1)
        self.assertEqual(run("check", self.path("n.bdf"), "--allow-crossings").returncode, 0)

    def test_families_of_med(self):
        """Read back by meshio: groups of faces, curves and points."""
        meshio = reader("meshio")
        reader("h5py")
        path = self.path("m.med")
        done = run("mesh", os.path.join(SHAPES, "touching.brep"), "-o", path, "--size", "0.5", *RULES)
        if "libmedc" in done.stderr:
            self.skipTest("built without MED")
        self.assertEqual(done.returncode, 0, done.stderr)
        read = meshio.read(path)
        families = {name: family for family, names in read.cell_tags.items() for name in names}
        self.assertLessEqual({"base", "steel", "edges"}, set(families))
        counts = {block.type: collections.Counter(tags.tolist()) for block, tags in zip(read.cells, read.cell_data["cell_tags"])}

        def cells(kind, group):
            return sum(counts[kind][family] for family, names in read.cell_tags.items() if group in names)
        faces, refs = triangles(self.mesh("m.mesh", "--size", "0.5", *RULES))
        self.assertEqual(cells("triangle", "base"), refs.count(1) + refs.count(2))
        self.assertGreater(cells("line", "edges"), 2)
        foot = [family for family, names in read.point_tags.items() if "foot" in names]
        self.assertEqual(sum((read.point_data["point_tags"] == family).sum() for family in foot), 1)

    def test_one_marker_a_group(self):
        su2 = content(self.mesh("m.su2", "--size", "0.5", *RULES))
        markers = re.findall(r"MARKER_TAG= (\w+)", su2)
        self.assertEqual(len(markers), len(set(markers)))
        self.assertEqual({"base", "steel"} & set(markers), {"base", "steel"})
        self.assertEqual(len(markers), 12 - 2 - 6 + 2)  # the other faces have markers of their own
        solids = re.findall(r"(?m)^solid (\w+)", content(self.mesh("m.stl", "--size", "0.5", "--group-by", "part", shape="press.step")))
        self.assertEqual({name: solids.count(name) for name in solids}, {"plate": 6, "stamp": 6, "stamp_2": 6})

    def test_meshio_and_vtk_read_the_groups(self):
        meshio = reader("meshio")
        for name, format in (("m.msh", "gmsh"), ("m.msh2", "gmsh"), ("m.inp", "abaqus"), ("m.vtu", "vtu")):
            read = meshio.read(self.mesh(name, "--size", "0.5", *RULES), format)
            area = 0
            for block in read.cells_dict.get("triangle", []):
                a, b, c = (read.points[k] for k in block)
                u, v = b - a, c - a
                area += math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2
            self.assertAlmostEqual(area, 2 * 16 + 16 + 6 * 4, places=9)
            if format == "gmsh":
                self.assertLessEqual({"base", "edges", "foot", "steel"}, set(read.field_data))
            if format == "abaqus":
                self.assertLessEqual({"base", "steel"}, set(read.cell_sets))
                self.assertLessEqual({"edges", "foot"}, set(read.point_sets))

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not there")
    def test_calculix_takes_the_groups(self):
        """A square without the quarter of a disc: forces on three vertices, nodes of an edge held: the reaction is their sum."""
        self.mesh("part.inp", "--size", "0.1", "--group", "base=face:1", "--group", "edges=edge:1", "--group", "foot=vertex:3-5", shape="quarter_plate.step")
        self.path("deck.inp", """*INCLUDE, INPUT=part.inp
*MATERIAL, NAME=steel
*ELASTIC
210000, 0.3
*SHELL SECTION, MATERIAL=steel, ELSET=all_faces
0.1
*BOUNDARY
edges, 1, 3
*STEP
*STATIC
*CLOAD
foot, 1, 7
*NODE PRINT, NSET=edges, TOTALS=ONLY
RF
*NODE PRINT, NSET=foot
U
*EL PRINT, ELSET=base, TOTALS=ONLY
EVOL
*END STEP
""")
        done = subprocess.run(["ccx", "deck"], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:])
        result = content(self.path("deck.dat"))

        def values(title):
            return [float(x) for x in result.split(title)[1].split("\n")[2].split()]
        self.assertAlmostEqual(values("total volume")[0], 0.1 * (1 - math.pi / 16), places=3)
        self.assertAlmostEqual(values("total force")[0], -21, places=4)
        self.assertEqual(len(result.split("displacements")[1].split("\n\n")[1].splitlines()), 3)  # the vertices

    def test_dolfinx_reads_the_tags(self):
        """From Gmsh's model; a group of solids has no cells, which dolfinx rejects: version 2.2 has no such group, version 4.1 without them."""
        reader("dolfinx"), reader("gmsh")
        script = """
import sys
import gmsh
from mpi4py import MPI
from dolfinx.io import gmshio
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.open(sys.argv[1])
names = {gmsh.model.getPhysicalName(*group): group for group in gmsh.model.getPhysicalGroups()}
mesh, cells, facets = gmshio.model_to_mesh(gmsh.model, MPI.COMM_WORLD, 0, gdim=3)
print(len(cells.values), *(list(cells.values).count(names[name][1]) for name in ("base", "steel")), list(facets.values).count(names["edges"][1]))
"""
        refs = triangles(self.mesh("d.mesh", "--size", "0.5", *RULES))[1]
        for path in (self.mesh("d.msh2", "--size", "0.5", *RULES), self.mesh("d.msh", "--size", "0.5", *RULES, "--set", "solid_groups=0")):
            done = subprocess.run([sys.executable, "-c", script, path], capture_output=True, text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr[-1500:])
            cells, base, steel, edges = (int(x) for x in done.stdout.split()[-4:])
            self.assertEqual(cells, len(refs))
            self.assertEqual(base, refs.count(1) + refs.count(2))
            self.assertEqual(steel, sum(ref > 6 for ref in refs))
            self.assertGreater(edges, 2)

    def test_annotations_and_construction_geometry_stay_out(self):
        text = content(os.path.join(SHAPES, "named_faces.step"))
        context = re.search(r"ADVANCED_BREP_SHAPE_REPRESENTATION\('[^']*',\([^)]*\),#(\d+)\)", text.replace("\n", ""))
        shape = re.search(r"#(\d+) *= *ADVANCED_BREP_SHAPE_REPRESENTATION", text)
        added = PMI.format(context=context[1], shape=shape[1])
        head, tail = text.rsplit("ENDSEC;", 1)
        path = self.path("pmi.step", head + added + "ENDSEC;" + tail)
        for option in ((), ("--loose-edges",)):
            done = run("mesh", path, "-o", self.path("pmi.mesh"), "--size", "0.25", *option)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(content(self.path("pmi.mesh")), content(self.mesh("plain.mesh", "--size", "0.25", *option, shape="named_faces.step")))

    def test_wires_on_faces_are_embedded(self):
        path = os.path.join(SHAPES, "scribed.brep")
        done = run("mesh", path, "-o", self.path("scribed.mesh"), "--size", "0.2", "--embed-wires")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("is not embedded"), 1, done.stderr)
        vertices, edges = [], []
        words = content(self.path("scribed.mesh")).split()
        for key, rows, width in (("Vertices", vertices, 4), ("Edges", edges, 3)):
            at = words.index(key)
            values = words[at + 2:at + 2 + width * int(words[at + 1])]
            rows += [tuple(map(float, values[i:i + width])) for i in range(0, len(values), width)]
        lengths = {}
        for a, b, ref in edges:
            lengths[ref] = lengths.get(ref, 0) + math.dist(vertices[int(a) - 1][:3], vertices[int(b) - 1][:3])
        # Twelve edges of the cube, two edges on it, and the edge that leaves it.
        for expected, count in ((1, 13), (math.hypot(0.8, 0.2), 1), (math.hypot(0.1, 0.8), 1)):
            self.assertEqual(sum(abs(length - expected) < 1e-9 for length in lengths.values()), count, lengths)
        self.assertEqual(run("mesh", os.path.join(SHAPES, "wires.brep"), "-o", self.path("none.mesh"), "--embed-wires").returncode, 2)

    def test_bytes_that_are_no_shape(self):
        for name, data, said in (("noise.step", bytes(range(256)), "noise.step"), ("short.brep", b"DBRep_DrawableShape\n", "short.brep"),
                                 ("empty.iges", b"", "empty.iges"), ("page.step", b"<html></html>", "page.step")):
            path = self.path(name)
            with open(path, "wb") as file:
                file.write(data)
            done = run("mesh", path, "-o", self.path("none.mesh"))
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(said, done.stderr)
            self.assertFalse(os.path.exists(self.path("none.mesh")))


if __name__ == "__main__":
    subprocess.run([MAKE_SHAPES, SHAPES], check=True, stdout=subprocess.DEVNULL)
    try:
        unittest.main(argv=sys.argv[:1], verbosity=2)
    finally:
        shutil.rmtree(SHAPES)
