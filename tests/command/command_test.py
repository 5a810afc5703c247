#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""command_test.py CARREAU: the program `carreau`: pictures, checks, parameters, exit codes."""
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

from mesh_files import read_png

PROGRAM = sys.argv[1]

# The unit square in the plane z = 1, two triangles with references 1 and 2.
SQUARE = """MeshVersionFormatted 2
Dimension 3
Vertices 4
0 0 1 0
1 0 1 0
1 1 1 0
0 1 1 0
Triangles 2
1 2 3 1
1 3 4 2
End
"""


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60)


class Command(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau command ")
        self.mesh = self.write("square.mesh", SQUARE)
        self.png = os.path.join(self.folder, "out.png")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def picture(self, *arguments, mesh=None):
        done = run("picture", mesh or self.mesh, "-o", self.png, *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return read_png(self.png)

    def fails(self, *arguments, sentence, code=2):
        done = run(*arguments)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertIn(sentence, done.stderr)

    def test_a_square_from_the_top_fills_92_percent_of_the_height(self):
        rows = self.picture("--view", "top", "--size", "300x200", "--no-edges", "--color", "none")
        self.assertEqual((len(rows), len(rows[0])), (200, 300))
        inside = [(x, y) for y in range(200) for x in range(300) if rows[y][x][0] < 220]
        xs, ys = [x for x, _ in inside], [y for _, y in inside]
        # 184 pixels each way, in the middle; the ends are mixed with the ground.
        for low, high, middle in ((min(xs), max(xs), 150), (min(ys), max(ys), 100)):
            self.assertAlmostEqual(high - low + 1, 184, delta=2)
            self.assertAlmostEqual((high + low + 1) / 2, middle, delta=1)
        self.assertAlmostEqual(len(inside), 184 * 184, delta=4 * 184)

    def test_references_have_colours_and_a_dark_line_lies_between_them(self):
        rows = self.picture("--view", "top", "--size", "200x200", "--color", "face")
        lower, upper, between = rows[140][140], rows[60][60], rows[100][99]
        self.assertNotEqual(lower, upper)
        self.assertLess(sum(between), min(sum(lower), sum(upper)) / 2)

    def test_quality_of_a_right_triangle_and_of_an_equilateral_one_differ(self):
        height = math.sqrt(3) / 2
        even = self.write("even.mesh", SQUARE.replace("Triangles 2\n1 2 3 1\n1 3 4 2", "Triangles 1\n1 2 3 1")
                          .replace("1 1 1 0", f"0.5 {height!r} 1 0").replace("Vertices 4", "Vertices 3")
                          .replace("0 1 1 0\n", ""))
        middle = self.picture("--view", "top", "--size", "200x200", "--color", "quality", "--no-edges", mesh=even)[130][100]
        right = self.picture("--view", "top", "--size", "200x200", "--color", "quality", "--no-edges")[140][140]
        self.assertGreater(middle[0], middle[1])  # yellow: 1
        self.assertGreater(right[1], right[0])    # Q2 = sqrt(3) / 2 = 0.87: yellow-green
        self.assertGreater(min(middle[0], right[0]), max(middle[2], right[2]) + 50)

    def test_things_in_front_hide_things_behind(self):
        # A second square, of reference 3, above the first.
        both = self.write("both.mesh", SQUARE.replace("Vertices 4", "Vertices 8").replace("Triangles 2", "Triangles 4")
                          .replace("0 1 1 0\n", "0 1 1 0\n0 0 2 0\n1 0 2 0\n1 1 2 0\n0 1 2 0\n")
                          .replace("1 3 4 2\n", "1 3 4 2\n5 6 7 3\n5 7 8 3\n"))
        options = ("--size", "100x100", "--no-edges")
        top = self.picture("--view", "top", *options, mesh=both)
        bottom = self.picture("--view", "bottom", *options, mesh=both)
        self.assertEqual(top[30][60], top[60][30])           # one colour: the upper square
        self.assertNotEqual(bottom[30][60], bottom[60][30])  # two colours: the lower one, mirrored

    def test_views_are_put_side_by_side(self):
        single = self.picture("--view", "top", "--size", "100x100")
        double = self.picture("--view", "top", "--view", "0,0,5", "--size", "200x100")
        for y in range(10, 90):  # away from the ground, which is shaded over the whole height
            for x in range(10, 90):
                self.assertEqual(double[y][x], single[y][x])
                self.assertEqual(double[y][x + 100], single[y][x])

    def test_the_same_mesh_gives_the_same_picture(self):
        self.assertEqual(self.picture("--size", "64x64"), self.picture("--size", "64x64"))

    def test_check_prints_exact_figures(self):
        done = run("check", self.mesh)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        values = {line[:12].strip(): line[12:] for line in done.stdout.splitlines()}
        self.assertEqual((values["vertices"], values["triangles"], values["faces"]), ("4", "2", "2"))
        self.assertEqual(values["edges"], "5 (4 with one triangle)")
        self.assertEqual(values["area"], "1")
        self.assertEqual(values["angles"], "45 to 90 degrees")
        self.assertEqual(values["defects"], "none")
        q2 = 4 * math.sqrt(3) * 0.5 / 4
        self.assertEqual(values["shape Q2"], f"mean {q2:.4f}, first percentile {q2:.4f}, worst {q2:.4f}")

    def test_sizes_of_triangles_have_colours_from_violet_to_yellow(self):
        # Beside a large triangle a small one, by 100 in area: violet the small one.
        two = self.write("two.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 6\n0 0 0 0\n10 0 0 0\n5 8.66 0 0\n12 0 0 0\n13 0 0 0\n"
                         "12.5 .866 0 0\nTriangles 2\n1 2 3 1\n4 5 6 1\nEnd\n")
        rows = self.picture("--view", "top", "--size", "320x220", "--color", "size", "--no-edges", mesh=two)
        colours = {pixel for row in rows for pixel in row}
        self.assertTrue(any(r > 1.5 * g and b > 1.5 * g and g < 60 for r, g, b in colours))  # dark violet
        self.assertTrue(any(r > g > 2 * b for r, g, b in colours))                           # yellow

    def check_json(self, name, vertices, triangles, *options, code=0):
        text = (f"MeshVersionFormatted 2\nDimension 3\nVertices {len(vertices)}\n" + "".join(f"{x} {y} {z} 0\n" for x, y, z in vertices) +
                f"Triangles {len(triangles)}\n" + "".join(f"{i} {j} {k} {ref}\n" for i, j, k, ref in triangles) + "End\n")
        done = run("check", self.write(name, text), "--json", *options)
        self.assertEqual((done.returncode, done.stderr), (code, ""))
        return json.loads(done.stdout)

    TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(1, 3, 2, 1), (1, 2, 4, 2), (1, 4, 3, 3), (2, 3, 4, 4)]

    def test_check_of_a_closed_mesh_as_json(self):
        result = self.check_json("t.mesh", *self.TETRAHEDRON, "--closed")
        report, quality = result["report"], result["quality"]
        self.assertEqual((result["defects"], report["borders"], report["parts"], report["euler"]), ([], [], 1, 2))
        self.assertEqual([report[name]["count"] for name in ("shared_edges", "turned_triangles", "folds", "double_points")], 4 * [0])
        right, even = 2 * math.sqrt(3) / 4, 1  # Q2 of the three right triangles and of the equilateral one
        self.assertEqual((sum(report["q2_classes"]), report["q2_classes"][8], report["q2_classes"][9]), (4, 3, 1))
        self.assertEqual((sum(report["q1_classes"]), report["q1_classes"][7], report["q1_classes"][9]), (4, 3, 1))  # 0.717
        self.assertAlmostEqual(quality["q2_mean"], (3 * right + even) / 4)
        self.assertEqual([face["reference"] for face in report["faces"]], [1, 2, 3, 4])
        self.assertAlmostEqual(report["faces"][3]["area"], math.sqrt(3) / 2)
        self.assertAlmostEqual(report["faces"][0]["edge_mean"], (2 + math.sqrt(2)) / 3)
        self.assertEqual(len(report["worst"]), 3)
        self.assertAlmostEqual(report["worst"][0]["q2"], right)
        self.assertEqual(len(self.check_json("t.mesh", *self.TETRAHEDRON, "--worst", "0")["report"]["worst"]), 0)
        for number in ("-1", "99999999999", "many"):
            self.fails("check", self.mesh, "--worst", number, sentence="0 to 1000000")

    def test_check_finds_borders_and_their_lengths(self):
        vertices, triangles = self.TETRAHEDRON
        report = self.check_json("open.mesh", vertices, triangles[:3])["report"]
        border, = report["borders"]
        self.assertEqual((border["edges"], border["loop"], report["euler"]), (3, True, 1))
        self.assertAlmostEqual(border["length"], 3 * math.sqrt(2))
        two = self.check_json("two.mesh", vertices, [triangles[0], (1, 2, 4, 1)])["report"]
        self.assertEqual([b["edges"] for b in two["borders"]], [4])
        apart = self.check_json("apart.mesh", vertices + [(5 + x, y, z) for x, y, z in vertices[:3]], triangles + [(5, 6, 7, 9)])["report"]
        self.assertEqual(([b["edges"] for b in apart["borders"]], apart["parts"], apart["euler"]), ([3], 2, 3))

    def test_check_finds_what_is_turned_shared_folded_and_double(self):
        vertices, triangles = self.TETRAHEDRON
        turned = self.check_json("turned.mesh", vertices, triangles[:3] + [(2, 4, 3, 4)])["report"]
        self.assertEqual(turned["turned_triangles"]["count"], 1)
        self.assertEqual([round(3 * x, 9) for x in turned["turned_triangles"]["at"][0]], [1, 1, 1])
        fin = self.check_json("fin.mesh", vertices + [(0.5, -1, 0)], triangles + [(1, 2, 5, 5)])["report"]
        self.assertEqual((fin["shared_edges"]["count"], fin["shared_edges"]["at"]), (1, [[0.5, 0, 0]]))
        # The second triangle lies back on the first one.
        folded = self.check_json("folded.mesh", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.2, 0.9, 0.01)], [(1, 2, 3, 1), (1, 4, 2, 1)])["report"]
        self.assertEqual((folded["folds"]["count"], folded["folds"]["at"]), (1, [[0.5, 0, 0]]))
        crease = self.check_json("crease.mesh", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.2, 0.9, 0.01)], [(1, 2, 3, 1), (1, 4, 2, 2)])["report"]
        self.assertEqual(crease["folds"]["count"], 0)  # faces may meet like that
        apart = self.check_json("double.mesh", [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 0, 1e-10), (1, 1, 0), (0, 1, 1e-7)],
                                [(1, 2, 3, 1), (4, 5, 6, 1)])["report"]
        self.assertEqual(apart["double_points"]["count"], 1)  # the third is 1e-7 away: another place

    # A triangle of face 7 through the square, above and below it.
    CROSSING = ([(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1), (0.5, 0.25, 0), (0.5, 0.25, 2), (0.75, 0.25, 2)],
                [(1, 2, 3, 1), (1, 3, 4, 2), (5, 6, 7, 7)])

    def test_check_finds_triangles_that_cross(self):
        told = self.check_json("crossing.mesh", *self.CROSSING, code=1)
        self.assertIn("1 pair of triangles crosses", told["defects"])
        self.check_json("crossing.mesh", *self.CROSSING, "--no-crossings", code=1)  # of earlier scripts: it changes nothing
        allowed = self.check_json("crossing.mesh", *self.CROSSING, "--allow-crossings", code=0)
        self.assertEqual(allowed["defects"], [])
        found = allowed["intersections"]
        self.assertEqual(found["pairs"], 1)
        pair, = found["faces"]
        self.assertEqual((pair["faces"], pair["pairs"], pair["triangles"]), ([1, 7], 1, [0, 2]))
        self.assertEqual((pair["at"][1], pair["at"][2]), (0.25, 1))
        text = run("check", os.path.join(self.folder, "crossing.mesh")).stdout
        self.assertIn("crossing    1 pairs of triangles\n  faces 1 and 7: 1 pair of triangles crosses, first triangles 1 and 3 at (0.5", text)
        self.assertEqual(self.check_json("t.mesh", *self.TETRAHEDRON)["intersections"], {"pairs": 0, "faces": []})

    def test_check_prints_places_and_faces_for_a_person(self):
        text = run("check", self.mesh, "--faces").stdout
        self.assertRegex(text, r"(?m)^worst +Q2 0\.8660: triangle [12] of face [12] at \(0\.\d+, 0\.\d+, 1\)$")
        self.assertRegex(text, r"(?m)^  loop of 4 edges, length 4, at \(")
        self.assertRegex(text, r"(?m)^Q2 classes   from 0 to 1 by tenths: 0 0 0 0 0 0 0 0 2 0 \(0.0 % below 0.5\)$")
        self.assertRegex(text, r"(?m)^ +1 +1 +0\.5 +0\.8660 +0\.8660 +1 +1\.13807 +1\.41421$")

    def test_check_of_indices_that_do_not_exist_or_of_no_triangle_is_reported(self):
        wrong = run("check", self.write("wrong.mesh", SQUARE.replace("1 3 4 2", "1 3 9 2")), "--json")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("wrong.mesh", wrong.stderr)
        none = run("check", self.write("none.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 0\nEnd\n"))
        self.assertEqual(none.returncode, 1)
        self.assertIn("no triangle", none.stdout)

    def test_output_that_cannot_be_written_is_reported(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([PROGRAM, "check", self.mesh], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.returncode, 2)
        self.assertIn("standard output cannot be written: No space left", done.stderr)

    def test_meshes_of_all_formats_are_checked_and_drawn(self):
        plate = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        triangles = [(0, 1, 2), (0, 2, 3)]
        text = "".join(
            "solid side\n" + "facet normal 0 0 1\nouter loop\n" +
            "".join("vertex %g %g %g\n" % plate[v] for v in t) + "endloop\nendfacet\nendsolid side\n" for t in triangles)
        binary = b" " * 80 + struct.pack("<I", 2) + b"".join(
            struct.pack("<12f2x", 0, 0, 1, *(x for v in t for x in plate[v])) for t in triangles)
        gmsh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n" + "".join(
            "%d %g %g %g\n" % (v + 1, *p) for v, p in enumerate(plate)) + "$EndNodes\n$Elements\n2\n" + "".join(
            "%d 2 2 0 %d %d %d %d\n" % (i + 1, i + 1, *(v + 1 for v in t)) for i, t in enumerate(triangles)) + "$EndElements\n"
        array = "<DataArray type='%s' Name='%s' NumberOfComponents='%d' format='ascii'>%s</DataArray>"
        vtu = ("<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='4' NumberOfCells='2'><Points>" +
               array % ("Float64", "Points", 3, " ".join("%g %g %g" % p for p in plate)) + "</Points><Cells>" +
               array % ("Int32", "connectivity", 1, "0 1 2 0 2 3") + array % ("Int32", "offsets", 1, "3 6") +
               array % ("UInt8", "types", 1, "5 5") + "</Cells></Piece></UnstructuredGrid></VTKFile>")
        files = {"text.stl": text, "binary.stl": binary, "a.msh": gmsh, "b.msh2": gmsh, "c.vtu": vtu}
        for name, content in files.items():
            with self.subTest(name):
                path = os.path.join(self.folder, name)
                with open(path, "wb") as file:
                    file.write(content if isinstance(content, bytes) else content.encode())
                result = run("check", path, "--json")
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                found = json.loads(result.stdout)
                self.assertEqual((found["vertices"], found["triangles"], found["quality"]["open_edges"]), (4, 2, 4))
                self.assertEqual(found["quality"]["area"], 1)
                picture = os.path.join(self.folder, name + ".png")
                self.assertEqual(run("picture", path, "-o", picture, "--view", "top").returncode, 0)
                self.assertNotEqual(read_png(picture)[450][600], (255, 255, 255))
                with open(path, "wb") as file:
                    file.write(b"\0 no mesh")
                result = run("check", path)
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertIn(path, result.stderr)
        result = run("check", os.path.join(self.folder, "part.step"))
        self.assertEqual(result.returncode, 2)
        self.assertIn("does not have a suffix of mesh files: .mesh, .meshb, .vtu, .stl, .msh, .msh2, .bl2d, .inp, .bdf, .unv, .su2, .off, .obj, .ply", result.stderr)

    def test_defects_give_exit_code_1(self):
        line = self.write("line.mesh", SQUARE.replace("1 1 1 0", "2 0 1 0"))
        done = run("check", line)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("defects     1\n", done.stdout)
        self.assertEqual(run("check", self.mesh, "--closed").returncode, 1)

    def test_wrong_command_lines_and_files_give_a_sentence_and_exit_code_2(self):
        self.fails(sentence="No command given. Commands: mesh, volume, plane, adapt, refine, info, areas, curve, project, check, picture, report, fields, params, completion.")
        self.fails("draw", sentence="draw")
        self.fails("picture", self.mesh, sentence="--output")
        for size in ("12", "x", "12x", "x12", "15x200", "99999999999x20", "20001x20", "100x100x100", "-20x20", "100 x100"):
            self.fails("picture", self.mesh, "-o", self.png, "--size=" + size, sentence="WIDTHxHEIGHT")
        self.fails("picture", self.mesh, "-o", self.png, "--view", "0,0,0", sentence="direction")
        self.fails("picture", self.mesh, "-o", self.png, "--color", "red", sentence="red")
        self.fails("check", self.mesh + "x", sentence="square.meshx")
        self.fails("check", os.path.join(self.folder, "no.mesh"), sentence="no.mesh")
        self.fails("picture", self.write("cut.mesh", SQUARE[:60]), "-o", self.png, sentence="cut.mesh")
        self.fails("picture", self.mesh, "-o", os.path.join(self.folder, "no", "a.png"), sentence="a.png")
        self.fails("params", "hphydeff", sentence="hphydeff")
        self.assertEqual(os.listdir(self.folder), [name for name in os.listdir(self.folder) if name.endswith(".mesh")])

    def test_parameters_match_the_manual(self):
        done = run("params")
        self.assertEqual(done.returncode, 0)
        names = [line.split()[0] for line in done.stdout.splitlines() if not line.startswith(" ")]
        manual = ("CheckAdjacentEdges CheckCloseEdges CheckWellDefined CoefRectangle LSS angle_mesh angle_smo element "
                  "eps_collapse eps_ends eps_glue eps_glue_open flag format frontal hgeo_flag hgeomax hgeomin hinterpol_flag hmean_flag "
                  "hphy_flag hphydef hphymax hphymin option pref refs verb").split()  # RT-0232 fig. 13, without `call`
        self.assertEqual(set(manual) - set(names), set())
        self.assertIn("default 0.02 diag", run("params", "hphydef").stdout)
        synonyms = ["certify", "crossing_rounds", "measure_bounds", "measure_distances", "shape_trials"]
        self.assertEqual(set(synonyms) & set(names), set())
        self.assertIn("synonyms of effort: " + ", ".join(synonyms), done.stdout)
        for name in synonyms:
            self.assertIn("follows effort", run("params", name).stdout)

    def test_the_manual_lists_the_settings_of_the_command(self):
        root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
        with open(os.path.join(root, "docs", "man", "carreau-mesh.1")) as file:
            section = file.read().split(".SH PARAMETERS")[1].split(".SH")[0]
        listed = {name for line in re.findall(r"^\.B (.*)", section, re.MULTILINE) for name in re.findall(r"(\w+)=", line)}
        with open(os.path.join(root, "cad_adapters", "command", "mesh", "mesh_parameters.cpp")) as file:
            body = file.read().split("void set_own_choices(")[1].split("\n}")[0]
        chosen = set(re.findall(r'\(session, "(\w+)"', body))
        self.assertIn("CheckCloseEdges", chosen)
        self.assertEqual(chosen - listed, set())
        for name in listed:
            self.assertEqual(run("params", name).returncode, 0, name)

    def test_help_and_version(self):
        for arguments in (["--help"], ["picture", "--help"], ["check", "--help"], ["params", "--help"], ["fields", "--help"], ["--version"]):
            done = run(*arguments)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertTrue(done.stdout)


unittest.main(argv=sys.argv[:1])
