#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""command_mesh_test.py CARREAU MAKE_SHAPES SLOW_RENAME: `carreau mesh` on files that OpenCASCADE makes."""
import json
import math
import os
import pty
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, MAKE_SHAPES, SLOW_RENAME = sys.argv[1:4]
SHAPES = tempfile.mkdtemp(prefix="carreau shapes ")


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, **options)


def content(path, binary=False):
    with open(path, "rb" if binary else "r") as file:
        return file.read()


def figures(path, *options):
    """The output of `carreau check`, by the first word of each line."""
    done = run("check", path, *options)
    return {line[:12].strip(): line[12:] for line in done.stdout.splitlines()} | {"status": done.returncode}


def read_mesh(path):
    """Vertices and triangles (with reference) of a .mesh file."""
    words = iter(content(path).split())
    vertices, triangles = [], []
    for word in words:
        if word == "Vertices":
            vertices = [[float(next(words)) for _ in range(4)][:3] for _ in range(int(next(words)))]
        elif word == "Triangles":
            triangles = [[int(next(words)) for _ in range(4)] for _ in range(int(next(words)))]
    return vertices, triangles


def volume(path):
    vertices, triangles = read_mesh(path)
    total = 0
    for i, j, k, _ in triangles:
        (a, b, c), (d, e, f), (g, h, m) = vertices[i - 1], vertices[j - 1], vertices[k - 1]
        total += a * (e * m - f * h) + b * (f * g - d * m) + c * (d * h - e * g)
    return total / 6


class Mesh(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau mesh ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def out(self, name):
        return os.path.join(self.folder, name)

    def mesh(self, shape, *options, output="out.mesh", status=0):
        path = self.out(output)
        done = run("mesh", os.path.join(SHAPES, shape), "-o", path, *options)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(done.stdout, "")
        return path

    def refused(self, *arguments, sentence):
        before = sorted(os.listdir(self.folder))
        done = run("mesh", *arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(sentence, done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_step_and_brep_of_a_sphere_give_its_area_and_volume(self):
        for suffix in ("step", "brep"):
            path = self.mesh("sphere." + suffix, "--size", "0.05")
            values = figures(path, "--closed")
            self.assertEqual((values["status"], values["defects"], values["faces"]), (0, "none", "1"))
            self.assertAlmostEqual(float(values["area"]) / (4 * math.pi), 1, delta=1e-3)
            self.assertAlmostEqual(volume(path) / (4 * math.pi / 3), 1, delta=2e-3)

    def test_solids_that_touch_or_overlap_are_named_before_and_after_meshing(self):
        boxes = os.path.join(SHAPES, "boxes.brep")
        info = json.loads(run("info", boxes, "--json").stdout)
        self.assertEqual([(c["solids"], c["overlap"]) for c in info["contacts"]], [([1, 3], True), ([1, 2], False)])
        text = run("info", boxes).stdout
        self.assertRegex(text, r"overlapping solids: 1\n  solids 1 and 3 overlap at \(")
        self.assertRegex(text, r"touching solids: 1\n  solids 1 and 2 touch at \(10, ")
        self.assertEqual(json.loads(run("info", os.path.join(SHAPES, "sphere.brep"), "--json").stdout)["contacts"], [])
        done = run("mesh", boxes, "-o", self.out("a.mesh"), "--size", "1", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)["crossing_parts"]
        self.assertEqual(found["pairs"], sum(part["pairs"] for part in found["parts"]))
        self.assertLessEqual(found["triangles"], 2 * found["pairs"])
        self.assertIn(("solid", [1, 3]), [(part["kind"], part["numbers"]) for part in found["parts"]])
        last = done.stderr.rstrip().splitlines()[-len(found["parts"]) - 2:]
        self.assertRegex(last[0], r"^crossing: \d+ triangles cross others, in \d+ pairs: \d pairs? of solids touch(es)? or overlaps?$")
        self.assertTrue(any(line.startswith("  solids 1 and 3: ") for line in last[1:-1]), last)
        self.assertEqual(figures(self.out("a.mesh"))["status"], 1)
        self.assertNotIn("crossing:", run("mesh", os.path.join(SHAPES, "sphere.brep"), "-o", self.out("b.mesh")).stderr)

    def test_a_file_without_sizes_follows_its_curvature(self):
        """15 degrees: 180 / 15 = 12 edges on each circle, whatever its radius."""
        default, uniform = (run("mesh", os.path.join(SHAPES, "bracket.step"), "-o", self.out(f"{name}.mesh"), *options)
                            for name, options in (("default", []), ("uniform", ["--size", "5%"])))
        self.assertIn("sizes by curvature (default): angle 15 degrees, at most 5%, gradation 1.3", default.stderr)
        self.assertNotIn("default", uniform.stderr.replace(self.out("default"), ""))
        with open(self.out("default.mesh")) as file:
            words = file.read().split()
        at, ends = words.index("Edges"), {}
        for k in range(int(words[at + 1])):
            a, b, curve = words[at + 2 + 3 * k:at + 5 + 3 * k]
            ends.setdefault(curve, []).extend((a, b))
        circles = [len(each) // 2 for each in ends.values() if all(each.count(vertex) == 2 for vertex in each)]
        self.assertEqual(len(circles), 13)
        for edges in circles:
            self.assertGreaterEqual(edges, 12)
        self.assertGreaterEqual(circles.count(12), 8)

    def test_a_size_may_be_a_share_of_the_diagonal(self):
        # The box of the sphere has the diagonal 2 sqrt(3).
        mean = float(figures(self.mesh("sphere.step", "--size", "2%"))["edge length"].split()[-1])
        self.assertAlmostEqual(mean / (0.02 * 2 * math.sqrt(3)), 1, delta=0.05)
        again = float(figures(self.mesh("sphere.step", "--size", repr(0.02 * 2 * math.sqrt(3))))["edge length"].split()[-1])
        self.assertAlmostEqual(mean, again, delta=1e-9)

    def test_an_angle_makes_sizes_follow_the_curvature(self):
        # Edges of length 2 r sin(angle) on the unit sphere; a size beside it is an upper bound.
        for angle in (4, 8):
            mean = float(figures(self.mesh("sphere.step", "--angle", str(angle)))["edge length"].split()[-1])
            self.assertAlmostEqual(mean / (2 * math.sin(math.radians(angle))), 1, delta=0.06)
        values = figures(self.mesh("sphere.step", "--angle", "8", "--max", "0.1"))
        self.assertAlmostEqual(float(values["edge length"].split()[-1]) / 0.1, 1, delta=0.06)
        values = figures(self.mesh("sphere.step", "--angle", "1", "--min", "0.2"))
        self.assertAlmostEqual(float(values["edge length"].split()[-1]) / 0.2, 1, delta=0.06)

    def test_elements_of_order_three_and_four_are_valid(self):
        for name, elements in (("bracket", ("p3", "q3")), ("pinhole", ("p3", "q3")), ("thin_bore", ("p3",)), ("waist", ("p3", "q3", "p4"))):
            for element in elements:
                path = self.mesh(name + ".step", "--size", "20%", "--element", element, "-q", output="curved.msh")
                self.assertEqual(json.loads(run("check", path, "--json").stdout)["elements"]["invalid"], 0, (name, element))

    def test_an_independent_mesh_crosses_the_seam_of_a_sphere_and_stays_sound(self):
        values = figures(self.mesh("sphere.step", "--size", "0.2", "--independent"), "--closed")
        self.assertEqual((values["status"], values["defects"], values["faces"]), (0, "none", "1"))
        path = self.mesh("cone.step", "--size", "0.2", "--independent", "--sharp-angle", "30")
        self.assertEqual(figures(path, "--closed")["defects"], "none")
        self.refused(os.path.join(SHAPES, "cone.step"), "-o", self.out("x.mesh"), "--sharp-angle", "30",
                     sentence="--cross-patch")

    def test_all_formats_appear_together(self):
        names = ["a.mesh", "a.meshb", "a.vtu", "a.stl", "a.msh", "a.msh2"]
        arguments = [word for name in names for word in ("-o", self.out(name))]
        done = run("mesh", os.path.join(SHAPES, "cone.step"), *arguments, "--size", "0.2", "-q")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(names))
        ascii_figures = figures(self.out("a.mesh"))
        self.assertEqual(ascii_figures, figures(self.out("a.meshb")))
        facets = int(ascii_figures["triangles"])
        self.assertEqual(content(self.out("a.stl")).count("outer loop"), facets)
        self.assertIn(f'NumberOfCells="{facets + int(ascii_figures["curve edges"])}"',
                      content(self.out("a.vtu"), True).decode("latin-1"))

    def test_names_of_faces_and_parts_reach_the_files(self):
        text = content(self.mesh("named_faces.step", output="named.msh"))
        names = set(re.findall(r'^2 \d+ "(.*)"$', text, re.M))
        self.assertEqual(names, {"bottom", "top", "side"})
        solids = re.findall(r"^solid (.*)$", content(self.mesh("assembly.step", output="rig.stl")), re.M)
        self.assertEqual(sorted(solids), ["ball"] + 12 * ["block"])

    def test_names_that_are_no_ascii_are_utf_8_or_of_western_europe(self):
        whole = content(os.path.join(SHAPES, "named_faces.step"), binary=True)
        name = "Pi\u00e8ce d'\u00e9t\u00e9 \u20ac"
        for code in ("utf-8", "cp1252"):
            path = self.out(code + ".step")
            with open(path, "wb") as file:
                file.write(whole.replace(b"'top'", name.replace("'", "''").join("''").encode(code)))
            done = run("mesh", path, "-o", self.out("a.mesh"), "--json", "-q")
            self.assertEqual({face["name"] for face in json.loads(done.stdout)["faces"]}, {"bottom", name, "side"})

    def test_parts_of_an_assembly_stand_at_its_placements(self):
        path = self.mesh("assembly.step", "--size", "0.5")
        vertices, _ = read_mesh(path)
        for axis, low, high in ((0, -1, 21), (1, -1, 2), (2, 0, 11)):
            self.assertAlmostEqual(min(p[axis] for p in vertices), low, delta=0.1)
            self.assertAlmostEqual(max(p[axis] for p in vertices), high, delta=0.1)
        self.assertEqual(figures(path, "--closed")["faces"], "13")
        self.assertAlmostEqual(volume(path) / (12 + 4 * math.pi / 3), 1, delta=0.04)

    def test_units_are_millimetres(self):
        self.assertAlmostEqual(volume(self.mesh("inch.step", "--size", "10")), 25.4**3, delta=1e-6)

    def test_triangles_of_a_reversed_solid_follow_its_orientation(self):
        path = self.mesh("free.brep", "--size", "0.5")
        vertices, triangles = read_mesh(path)
        sheet = [t for t in triangles if vertices[t[0] - 1][0] < 5]
        self.assertAlmostEqual(volume(path), -1, delta=1e-9)  # the sheet lies in z = 0 and encloses nothing
        # The edge inside the sheet from (1, 1) to (3, 2) is made of edges of triangles.
        inside = {i for t in sheet for i in t[:3]
                  if abs((vertices[i - 1][1] - 1) - (vertices[i - 1][0] - 1) / 2) < 1e-9 and 1 <= vertices[i - 1][0] <= 3}
        self.assertGreaterEqual(len(inside), 4)
        self.assertEqual(figures(path)["defects"], "none")

    def test_unsewn_faces_of_iges_are_meshed(self):
        values = figures(self.mesh("open.igs", "--size", "0.4"))
        self.assertEqual((values["faces"], values["defects"]), ("5", "none"))
        self.assertAlmostEqual(float(values["area"]), 20, delta=1e-6)
        # The sixth side of the box is missing: its four edges are 2 long.
        done = run("mesh", os.path.join(SHAPES, "open.igs"), "-o", self.out("a.mesh"), "--size", "0.4", "-q", "--json")
        summary = json.loads(done.stdout)
        self.assertEqual(summary["mesh"]["open_edges"], 20)
        told = [each for each in summary["warnings"] if "glued" in each]
        self.assertEqual(len(told), 1)
        self.assertRegex(told[0], r"the mesh stays open: 20 free edges, on curves (\d+ \(face \d\)(, |\.)){4}$")

    def test_a_face_can_have_a_size_of_its_own(self):
        for face in ("top", "6"):
            _, triangles = read_mesh(self.mesh("named_faces.step", "--size", "0.25", "--face-size", face + "=0.05"))
            count = {ref: sum(t[3] == ref for t in triangles) for ref in range(1, 7)}
            fine = [ref for ref in count if count[ref] > 600]
            self.assertEqual(len(fine), 1)
            self.assertAlmostEqual(count[fine[0]] / (1 / (math.sqrt(3) / 4 * 0.05**2)), 1, delta=0.1)

    def test_any_parameter_can_be_set(self):
        self.mesh("cylinder.step", "--set", "option=onesurf2d", "--set", "refs=2")
        self.assertEqual(figures(self.out("out.mesh"))["faces"], "1")
        self.refused(os.path.join(SHAPES, "cone.step"), "-o", self.out("a.mesh"), "--set", "hphydeff=1", sentence="hphydef")

    def test_fields_of_a_cad_file_are_an_image_a_face(self):
        # The content of such files is tested in tests/command/fields_test.py and tests/cpp/fields.
        done = run("fields", os.path.join(SHAPES, "sphere.step"), "-o", self.out("s.exr"), "--pixels", "30", "--set",
                   "hgeo_flag=1")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        files = done.stdout.splitlines()
        self.assertEqual(files, [self.out("s.face.1.exr")])
        self.assertEqual(content(files[0], binary=True)[:4], b"\x76\x2f\x31\x01")

    def test_files_that_cannot_be_read_are_reported(self):
        def write(name, data):
            path = self.out(name)
            with open(path, "wb") as file:
                file.write(data)
            return path
        step = content(os.path.join(SHAPES, "box_with_hole.step"), True)
        brep = content(os.path.join(SHAPES, "torus.brep"), True)
        for name, data, sentence in (("no.step", b"", "no.step"), ("png.step", b"\x89PNG\r\n\x1a\n" * 40, "png.step"),
                                     ("brep.step", brep, "suffix"), ("step.brep", step, "suffix"),
                                     ("cut.step", step[:len(step) // 2], "cut.step"), ("cut.brep", brep[:len(brep) // 2], "cut.brep"),
                                     ("cut.igs", content(os.path.join(SHAPES, "open.igs"), True)[:2000], "cut.igs"),
                                     ("part.xyz", b"hello", "part.xyz")):
            self.refused(write(name, data), "-o", self.out("a.mesh"), sentence=sentence)
        self.refused(self.out("missing.step"), "-o", self.out("a.mesh"), sentence="missing.step")
        self.refused(self.folder, "-o", self.out("a.mesh"), sentence=os.path.basename(self.folder))

    def test_files_that_cannot_be_written_are_reported_before_the_work(self):
        cone = os.path.join(SHAPES, "cone.step")
        self.refused(cone, "-o", self.out("a.xyz"), sentence=".vtu")
        self.refused(cone, "-o", self.out("no/a.mesh"), sentence="no")
        self.refused(cone, "-o", self.out("a.mesh"), "-o", self.out("a.mesh"), sentence="twice")
        self.refused(cone, sentence="--output")
        for wrong in ("0", "-1", "1m", "%", "", "nan", "inf", "1%%"):
            self.refused(cone, "-o", self.out("a.mesh"), "--size=" + wrong, sentence="--size")
        self.refused(cone, "-o", self.out("a.mesh"), "--min", "2", "--max", "1", sentence="--max")
        self.refused(cone, "-o", self.out("a.mesh"), "--face-size", "lid=1", sentence="lid")
        self.refused(cone, "-o", self.out("a.mesh"), "--size", "1e-9", sentence="edges")

    def test_a_summary_is_printed_on_request(self):
        done = run("mesh", os.path.join(SHAPES, "named_faces.step"), "-o", self.out("a.mesh"), "--size", "0.2", "-q", "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        summary = json.loads(done.stdout)
        self.assertEqual(sorted(face["name"] for face in summary["faces"]), ["bottom"] + 4 * ["side"] + ["top"])
        self.assertEqual({face["status"] for face in summary["faces"]}, {"meshed"})
        self.assertEqual(sum(face["triangles"] for face in summary["faces"]), summary["mesh"]["triangles"])
        self.assertAlmostEqual(summary["mesh"]["area"], 6, delta=1e-9)
        self.assertAlmostEqual(summary["diagonal"], math.sqrt(3), delta=1e-9)
        self.assertTrue(summary["closed"])

    def test_warnings_of_one_kind_are_reported_by_a_few(self):
        done = run("mesh", os.path.join(SHAPES, "named_faces.step"), "-o", self.out("a.mesh"), "--size", "0.2", "--json",
                   "--set", "eps_ends=100")
        told = re.findall(r"(?m)^warning: (.*)$", done.stderr)
        warnings = json.loads(done.stdout)["warnings"]
        self.assertEqual(len(warnings), 24)  # each curve of each face is shorter than that
        self.assertEqual(told, warnings[:4] + ["20 more like these"])

    def test_bends_inside_faces_that_cannot_be_cut_are_reported_where_sizes_follow_the_curvature(self):
        for name, bent in (("torn_roof.brep", True), ("roof.brep", False)):
            for options, by_curvature in ((["--angle", "8"], True), (["--chord", "1%"], True), (["--size", "0.2"], False)):
                with self.subTest(name=name, options=options):
                    done = run("mesh", os.path.join(SHAPES, name), "-o", self.out("a.mesh"), "-q", "--json", *options)
                    warnings = json.loads(done.stdout)["warnings"]
                    told = [w for w in warnings if w.startswith("face 1: 60 degrees of bend inside it, at u = 0.25; it cannot")]
                    self.assertEqual(told != [], bent and by_curvature)
            told = run("info", os.path.join(SHAPES, name)).stdout
            self.assertIn("60 degrees of bend inside it, at u = 0.25" + ("; it cannot be cut" if bent else ", where it is cut"), told)

    def test_faces_are_cut_where_they_bend_and_stay_one_face(self):
        for options in (["--angle", "15"], ["--angle", "15", "--chord", "0.5%", "--anisotropic"], ["--size", "5%"]):
            with self.subTest(options):
                path = self.out("bent.vtu")
                done = run("mesh", os.path.join(SHAPES, "bent.step"), "-o", path, "-q", "--json", *options)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                summary = json.loads(done.stdout)
                self.assertEqual([(f["reference"], f["name"], f["status"]) for f in summary["faces"]],
                                 [(1, "side", "meshed"), (2, "prism", "meshed"), (3, "prism", "meshed")])
                self.assertTrue(summary["closed"])
                self.assertLessEqual({face for i in summary["interfaces"] for face in i["faces"]}, {1, 2, 3})
                found = json.loads(run("check", path, "--closed", "--json").stdout)
                self.assertEqual(found["defects"], [])
                for face, area in zip(found["report"]["faces"], (24, 4, 4), strict=True):
                    self.assertAlmostEqual(face["area"], area, delta=1e-9)

    def test_sizes_of_faces_that_were_cut(self):
        _, triangles = read_mesh(self.mesh("bent.step", "--size", "0.5", "--face-size", "side=0.1"))
        fine = sum(t[3] == 1 for t in triangles)
        self.assertAlmostEqual(fine / (24 / (math.sqrt(3) / 4 * 0.1**2)), 1, delta=0.05)

    def test_requested_narrow_faces_have_the_ratio_of_the_library(self):
        # 9e-4 of the size: more than the width that always vanishes, less than a tenth.
        sliver = os.path.join(SHAPES, "sliver.step")
        env = self.out("narrow.env")
        with open(env, "w", encoding="utf-8") as file:
            file.write("narrow_faces one_layer\n")

        def reasons(*more):
            done = run("mesh", sliver, "-o", self.out("a.mesh"), "--size", "0.2", "-q", "--json", *more)
            return [face["why"] for face in json.loads(done.stdout)["faces"] if "narrow" in face["why"]]

        self.assertEqual(reasons(), [])
        self.assertEqual(reasons("--set", "narrow_faces=keep"), [])
        for asked in (("--env", env), ("--set", "narrow_faces=one_layer")):
            self.assertTrue(any("one layer" in why for why in reasons(*asked)), asked)
        self.assertTrue(any("vanished" in why for why in reasons("--set", "narrow_faces=collapse")))
        self.assertEqual(reasons("--env", env, "--set", "narrow_ratio=1e-4"), [])

    def test_sizes_beyond_bounds_are_reported(self):
        sphere = os.path.join(SHAPES, "sphere.step")

        def told(*options):
            done = run("mesh", sphere, "-o", self.out("a.mesh"), "-q", "--json", *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            return json.loads(done.stdout)["warnings"]

        self.assertEqual(told("--size", "0.3", "--min", "0.4"), ["--size 0.3 is below --min 0.4, which counts."])
        self.assertEqual(told("--size", "0.4", "--max", "0.3"), ["--size 0.4 is above --max 0.3, which counts."])
        self.assertEqual(told("--size", "0.4", "--face-size", "1=0.2", "--min", "0.3"),
                         ["--face-size 1=0.2 is below --min 0.3, which counts."])
        self.assertEqual(told("--size", "0.4", "--min", "0.3", "--max", "0.5"), [])
        # A tenth of the diagonal of a ball is more than 0.2, whatever it is of 1.
        self.assertEqual(told("--angle", "20", "--min", "0.2", "--max", "10%"), [])

    def test_edges_below_the_smallest_size_are_reported(self):
        sliver = os.path.join(SHAPES, "sliver.step")
        wide = json.loads(run("mesh", sliver, "-o", self.out("a.mesh"), "--size", "0.2", "-q", "--json").stdout)
        self.assertEqual((wide["below_minimum"]["edges"], wide["below_minimum"]["faces"]), (0, []))
        done = run("mesh", sliver, "-o", self.out("a.mesh"), "--size", "0.2", "--min", "0.1", "--json")
        told = json.loads(done.stdout)["below_minimum"]
        self.assertEqual(told["minimum"], 0.1)
        # The sliver is 1e-4 of the diagonal wide; its sides are curves of two ends and two faces beside it.
        self.assertLessEqual(told["shortest"], 1e-4 * math.sqrt(3) * 1.0001)
        self.assertAlmostEqual(told["shortest"], json.loads(done.stdout)["mesh"]["edge_min"], delta=1e-12)
        self.assertGreaterEqual(len(told["faces"]), 5)
        self.assertRegex(done.stderr, r"(?m)^short +%d edges, down to \S+, below the smallest size of 0\.1: " % told["edges"])

    def test_a_log_has_plain_lines_and_a_terminal_a_bar(self):
        done = run("mesh", os.path.join(SHAPES, "torus.step"), "-o", self.out("a.mesh"), "--size", "1%")
        self.assertNotIn("\r", done.stderr)
        self.assertNotIn("\033", done.stderr)
        self.assertRegex(done.stderr, r"(?m)^reading .*torus\.step$")
        self.assertRegex(done.stderr, r"(?m)^ *\d+ % of the run: meshing faces, face 1$")
        self.assertRegex(done.stderr, r"(?m)^1 face: \d+ vertices")
        # Both curves of the torus are circles with exact images, but for digits of the file: below its tolerance.
        gap = float(re.search(r"(?m)^gaps +largest (\S+) \(edge \d on face [01]\); 0 above twice", done.stderr)[1])
        self.assertLess(gap, 1e-7)
        master, slave = pty.openpty()
        process = subprocess.Popen([PROGRAM, "mesh", os.path.join(SHAPES, "torus.step"), "-o", self.out("b.mesh")],
                                   stderr=slave, stdout=subprocess.DEVNULL)
        os.close(slave)
        text = b""
        while True:
            try:
                block = os.read(master, 65536)
            except OSError:
                break
            if not block:
                break
            text += block
        self.assertEqual(process.wait(timeout=60), 0)
        self.assertRegex(text, rb"\r\033\[K\[(\033\[32m)?#*\.*(\033\[0m)?\] +\d+ % of the run: meshing faces, face 1")

    def interrupt(self, *options, after="", delay=0.05, number=signal.SIGINT):
        """Exit code, and the output after the line with `after` ("": at once)."""
        process = subprocess.Popen([PROGRAM, "mesh", os.path.join(SHAPES, "torus.step"), "-o", self.out("a.mesh"), "-o", self.out("a.msh"), *options],
                                   stderr=subprocess.PIPE, text=True)
        for line in process.stderr if after else ():
            if after in line:
                break
        time.sleep(delay)
        process.send_signal(number)
        _, rest = process.communicate(timeout=60)
        return process.returncode, rest

    def test_a_signal_stops_and_leaves_no_file(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with open(self.out("a.mesh"), "w") as old:
                old.write("old")
            status, rest = self.interrupt("--size", "0.08%", after="meshing faces", number=number)
            self.assertEqual(status, -number)  # as a shell expects that goes on, or not, with its script
            self.assertIn("stopped; nothing was written", rest)
            self.assertEqual(os.listdir(self.folder), ["a.mesh"])
            self.assertEqual(content(self.out("a.mesh")), "old")

    def test_files_are_whole_or_not_there_whenever_a_signal_comes(self):
        names = ["a.mesh", "a.msh"]
        whole = None
        for moment in range(24):
            # From the start of the program over reading, meshing and writing to its end.
            status, rest = self.interrupt("--size", "0.25%", delay=0.02 + 0.05 * moment, number=(signal.SIGINT, signal.SIGTERM)[moment % 2])
            found = sorted(os.listdir(self.folder))
            self.assertIn(found, ([], names))
            if found:
                self.assertTrue(status == 0 or "the files are written" in rest, (status, rest))
                texts = [content(self.out(name)) for name in names]
                whole = whole or texts
                self.assertEqual(texts, whole)
                for name in names:
                    os.remove(self.out(name))
            else:
                self.assertIn(status, (-signal.SIGINT, -signal.SIGTERM))

    def test_a_signal_while_files_get_their_names_waits_for_the_last_one(self):
        # Threads that mesh are still there, and would take a signal that the thread that writes does not.
        environment = os.environ | {"LD_PRELOAD": SLOW_RENAME, "SLOW_RENAME": "300000", "ASAN_OPTIONS": "verify_asan_link_order=0"}
        process = subprocess.Popen([PROGRAM, "mesh", os.path.join(SHAPES, "torus.step"), "-o", self.out("a.mesh"), "-o", self.out("a.vtu"),
                                    "--size", "1%", "--threads", "2"], stderr=subprocess.PIPE, text=True, env=environment)
        deadline = time.monotonic() + 60
        while not os.path.exists(self.out("a.mesh")) and time.monotonic() < deadline:
            time.sleep(0.005)
        process.send_signal(signal.SIGINT)
        _, told = process.communicate(timeout=60)
        self.assertEqual(process.returncode, -signal.SIGINT)
        self.assertIn("stopped; the files are written", told)
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.mesh", "a.vtu"])

    def test_output_does_not_reach_files_where_standard_files_are_closed(self):
        cone, names = os.path.join(SHAPES, "cone.step"), ["a" + suffix for suffix in (".mesh", ".meshb", ".vtu", ".stl", ".msh", ".exr")]
        outputs = [word for name in names for word in ("-o", self.out(name))]
        self.assertEqual(run("mesh", cone, *outputs).returncode, 0)
        whole = [content(self.out(name), True) for name in names]
        for closed in ([2], [1, 2], [0, 1, 2]):
            for name in names:
                os.remove(self.out(name))
            done = subprocess.run([PROGRAM, "mesh", cone, *outputs], timeout=120,
                                  preexec_fn=lambda files=tuple(closed): [os.close(file) for file in files])
            self.assertEqual(done.returncode, 0)
            self.assertEqual([content(self.out(name), True) for name in names], whole, closed)

    def test_links_stay_and_files_appear_where_they_lead(self):
        cone, target = os.path.join(SHAPES, "cone.step"), tempfile.mkdtemp(dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None)
        try:
            # To another file system as a rule, where no file can be renamed to; to a file that is there, and to one that is not.
            for folder in (target, self.folder):
                for old in (True, False):
                    for name in ("a.mesh", "b.vtu"):
                        if old:
                            open(os.path.join(folder, "of_" + name), "w").close()
                        os.symlink(os.path.join(folder, "of_" + name), self.out(name))
                    done = run("mesh", cone, "-o", self.out("a.mesh"), "-o", self.out("b.vtu"), "-o", self.out("c.mesh"))
                    self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
                    whole = content(self.out("c.mesh"))
                    for name in ("a.mesh", "b.vtu"):
                        self.assertTrue(os.path.islink(self.out(name)))
                        os.remove(self.out(name))
                    self.assertEqual(content(os.path.join(folder, "of_a.mesh")), whole)
                    self.assertTrue(content(os.path.join(folder, "of_b.vtu"), True).rstrip().endswith(b"</VTKFile>"))
                    self.assertEqual({name for name in os.listdir(folder) if name.startswith(".")}, set())
                    os.remove(os.path.join(folder, "of_a.mesh"))
                    os.remove(os.path.join(folder, "of_b.vtu"))
            os.symlink(self.out("round.mesh"), self.out("round.mesh"))
            self.refused(cone, "-o", self.out("round.mesh"), sentence="Too many levels of symbolic links")
            os.symlink(self.out("no/such.mesh"), self.out("lost.mesh"))
            self.refused(cone, "-o", self.out("lost.mesh"), sentence="No such file or directory")
            # Two links of one name.
            for folder in ("one", "two"):
                os.mkdir(self.out(folder))
                os.symlink(os.path.join(target, folder + ".mesh"), self.out(folder + "/x.mesh"))
            self.assertEqual(run("mesh", cone, "-o", self.out("one/x.mesh"), "-o", self.out("two/x.mesh")).returncode, 0)
            self.assertEqual(sorted(os.listdir(target)), ["one.mesh", "two.mesh"])
            self.assertEqual(content(self.out("one/x.mesh")), content(self.out("two/x.mesh")))
        finally:
            shutil.rmtree(target)

    def test_a_disk_that_is_full_is_reported_and_old_files_stay(self):
        def small_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        cone = os.path.join(SHAPES, "cone.step")
        with open(self.out("a.mesh"), "w") as old:
            old.write("old")
        for suffix in (".mesh", ".meshb", ".vtu", ".stl", ".msh", ".msh2", ".exr"):
            done = run("mesh", cone, "-o", self.out("a.mesh"), "-o", self.out("b" + suffix), "--size", "1%", preexec_fn=small_files)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr, r"cannot write '%s/[ab]\.\w+': File too large" % os.path.realpath(self.folder))
            self.assertEqual(os.listdir(self.folder), ["a.mesh"])
            self.assertEqual(content(self.out("a.mesh")), "old")

    def test_colours_are_for_terminals_and_can_be_switched_off(self):
        def terminal_text(environment):
            master, slave = pty.openpty()
            process = subprocess.Popen([PROGRAM, "mesh", os.path.join(SHAPES, "torus.step"), "-o", self.out("no/a.mesh")], stderr=slave,
                                       stdout=subprocess.DEVNULL, env=os.environ | {"TERM": "xterm", "NO_COLOR": ""} | environment)
            os.close(slave)
            text = b""
            try:
                while block := os.read(master, 65536):
                    text += block
            except OSError:
                pass
            os.close(master)
            self.assertEqual(process.wait(timeout=60), 2)
            return text
        self.assertIn(b"\033[31mcarreau:\033[0m", terminal_text({}))
        self.assertNotIn(b"\033", terminal_text({"NO_COLOR": "1"}))
        self.assertNotIn(b"\033", terminal_text({"TERM": "dumb"}))

    def test_potential_problems_are_printed_as_json_too(self):
        result = json.loads(run("info", os.path.join(SHAPES, "sliver.step"), "--json").stdout)
        text = run("info", os.path.join(SHAPES, "sliver.step"), "--limit", "1000").stdout
        self.assertTrue(result["dangers"])
        for danger in result["dangers"]:
            self.assertIn("  " + danger["text"] + "\n", text)
            self.assertIn(danger["kind"] + ": ", text)
        self.assertIn(f"faces       {result['faces']}\n", text)
        self.assertEqual(json.loads(run("info", os.path.join(SHAPES, "sphere.step"), "--json").stdout)["surfaces"], {"sphere": 1})


if __name__ == "__main__":
    try:
        subprocess.run([MAKE_SHAPES, SHAPES], check=True, timeout=120, stdout=subprocess.DEVNULL)
        unittest.main(argv=sys.argv[:1])
    finally:
        shutil.rmtree(SHAPES)
