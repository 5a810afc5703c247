#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""first_hour_test.py CARREAU TEAPOT.BPT: the first hour of a user: wrong options, help, JSON, faces that are looked for, pictures."""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from mesh_files import read_png

PROGRAM, TEAPOT = sys.argv[1:3]

# The unit square, z = 0, and a cylinder of radius 1 and height 2 over a quarter circle (polynomial: about 1.0003 of the true radius).
K = 4 * (math.sqrt(2) - 1) / 3


def bezier(patches):
    """Text of a .bpt file: patches of control points, rows along u."""
    text = f"{len(patches)}\n"
    for rows in patches:
        text += f"{len(rows) - 1} {len(rows[0]) - 1}\n" + "".join("%r %r %r\n" % tuple(map(float, p)) for row in rows for p in row)
    return text


SQUARE = [[(0, 0, 0), (0, 1, 0)], [(1, 0, 0), (1, 1, 0)]]
STRIP = [[(5, 0, 0), (5, 0.1, 0)], [(15, 0, 0), (15, 0.1, 0)]]
QUARTER = [[(x, y, 0), (x, y, 2)] for x, y in ((1, 10), (1, 10 + K), (K, 11), (0, 11))]

BLACK = """<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid><Piece NumberOfPoints="6" NumberOfCells="4">
<PointData/><CellData><DataArray type="Int32" Name="reference" format="ascii">1 2 3 4</DataArray></CellData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 4 0 4 3 1 2 5 1 5 4</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3 6 9 12</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5 5 5 5</DataArray></Cells></Piece>
<FieldData><DataArray type="Int32" Name="face_reference" format="ascii">1 2 3 4</DataArray>
<DataArray type="Int32" Name="face_status" format="ascii">1 1 1 1</DataArray>
<DataArray type="Int32" Name="face_rgb" format="ascii">0 0 0 0</DataArray></FieldData></UnstructuredGrid></VTKFile>
"""


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, **options)


class FirstHour(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau hour ")
        self.three = self.write("three.bpt", bezier([SQUARE, STRIP, QUARTER]))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
        return self.path(name)

    def refused(self, *arguments, sentence):
        done = run(*arguments)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertEqual(done.stderr, "carreau: " + sentence + "\n")

    def test_each_wrong_word_gets_a_suggestion(self):
        self.refused("msh", sentence="There is no command 'msh'; did you mean 'mesh'? There are mesh, volume, plane, adapt, refine, info, areas, curve, project, check, picture, report, fields, params, completion.")
        self.refused("mesh", "a.step", "--sze", "3", "-o", "a.vtu", sentence="carreau mesh has no option '--sze'; did you mean '--size'?")
        self.refused("mesh", "a.step", "--size-mapp=3", "-o", "a.vtu", sentence="carreau mesh has no option '--size-mapp'; did you mean '--size-map'?")
        self.refused("check", "a.mesh", "--zzzzzz", sentence="carreau check has no option '--zzzzzz'.")
        self.refused("mesh", "a.step", "--angle", "x", "-o", "a.vtu", sentence="--angle 'x' is not a number from 0.01 to 89")
        self.refused("check", "a.mesh", "--limit", "all", sentence="--limit 'all' is not a number from 1 to 1000000")
        self.refused("picture", "a.mesh", "-o", "a.png", "--color", "qualty",
                     sentence="--color 'qualty' is not one of: face, reference, quality, size, none; did you mean 'quality'?")
        self.refused("params", "hphydf", sentence="There is no parameter 'hphydf'; did you mean 'hphydef'? `carreau params` lists them all.")
        self.refused("params", "qqqqqqqq", sentence="There is no parameter 'qqqqqqqq'. `carreau params` lists them all.")

    def test_settings_are_judged_before_a_file_is_read(self):
        # The file is not there: the first message is about the first check.
        self.refused("mesh", "none.step", "-o", "a.vtu", "--set", "hphydf=1",
                     sentence="--set 'hphydf=1': there is no parameter 'hphydf'; did you mean 'hphydef'? `carreau params` lists them all.")
        for setting, sentence in (("hphydef=x", "number"), ("frontal=7", "frontal"), ("geo_rule=cord", "geo_rule")):
            for command in ("mesh", "fields"):
                done = run(command, "none.bpt", "-o", "a.mesh" if command == "mesh" else "a.exr", "--set", setting)
                self.assertEqual(done.returncode, 2)
                self.assertIn(sentence, done.stderr)
                self.assertNotIn("none.bpt", done.stderr)
        self.assertEqual(run("mesh", self.three, "-o", self.path("a.mesh"), "--set", "hphydef=3%", "-q").returncode, 0)

    def test_details_of_a_run_come_with_verbose_only(self):
        plain, verbose = (run("mesh", TEAPOT, "-o", os.path.join(self.folder, "a.mesh"), "--angle", "12", "--gradation", "1.3", *options).stderr
                          for options in ([], ["--verbose"]))
        for detail in ("evaluations of surfaces", "sizes graded on"):
            self.assertNotIn(detail, plain)
            self.assertIn(detail, verbose)

    def test_help_is_a_command(self):
        self.assertEqual(run("help").stdout, run("--help").stdout)
        for command in ("mesh", "info", "check", "picture", "fields", "params", "completion"):
            done = run("help", command)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("Usage: carreau " + command, done.stdout)
        self.refused("help", "pictur", sentence="There is no command 'pictur'; did you mean 'picture'? There are mesh, volume, plane, adapt, refine, info, areas, curve, project, check, picture, report, fields, "
                     "params, completion.")

    def json_of(self, *arguments, code=0):
        done = run(*arguments, "--json")
        self.assertEqual(done.returncode, code, done.stderr)
        value = json.loads(done.stdout)
        self.assertEqual((list(value)[0], value["format"]), ("format", f"carreau {arguments[0]} 1"))
        return value

    def test_json_has_a_format_and_an_error_object_in_every_command(self):
        mesh = self.path("a.mesh")
        self.assertEqual(self.json_of("mesh", self.three, "-o", mesh, "--size", "0.5")["outputs"], [mesh])
        self.assertEqual(self.json_of("info", self.three)["faces"], 3)
        self.assertEqual(self.json_of("check", mesh)["intersections"]["pairs"], 0)
        self.assertEqual(self.json_of("picture", mesh, "-o", self.path("a.png"), "--view", "top")["views"], ["top"])
        files = self.json_of("fields", self.three, "-o", self.path("a.png"), "--pixels", "20")["files"]
        self.assertEqual(files, [self.path(f"a.face.{k}.png") for k in (1, 2, 3)])
        self.assertTrue(all(os.path.exists(file) for file in files))
        row, = self.json_of("params", "hphydef")["parameters"]
        self.assertEqual((row["name"], row["type"], row["default"], row["of_diagonal"]), ("hphydef", "real", 0.02, True))
        self.assertGreater(len(self.json_of("params")["parameters"]), 50)
        for arguments in (("mesh", "none.bpt", "-o", "a.mesh"), ("info", "none.bpt"), ("check", "none.mesh"), ("picture", "none.mesh", "-o", "a.png"),
                          ("fields", "none.bpt", "-o", "a.exr"), ("params", "none"), ("mesh", "--sze", "3"), ("check", "a.mesh", "--limit", "x")):
            with self.subTest(arguments=arguments):
                error = self.json_of(*arguments, code=2)["error"]
                self.assertEqual((sorted(error), error["exit"]), (["exit", "sentence"], 2))

    def test_faces_are_listed_with_what_they_are_known_by(self):
        faces = {face["face"]: face for face in self.json_of("info", self.three, "--faces")["face_list"]}
        self.assertEqual(sorted(faces), [1, 2, 3])
        self.assertEqual([faces[k]["kind"] for k in (1, 2, 3)], ["Bezier 1 x 1", "Bezier 1 x 1", "Bezier 3 x 1"])
        for face, area, narrowness in ((1, 1, 1), (2, 1, 100), (3, math.pi, 2 / (math.pi / 2))):
            self.assertAlmostEqual(faces[face]["area"] / area, 1, delta=0.02)
            self.assertAlmostEqual(faces[face]["narrowness"] / max(narrowness, 1 / narrowness), 1, delta=0.03)
        for x, y in zip(faces[3]["box"][0] + faces[3]["box"][1], (0, 10, 0, 1, 11, 2)):
            self.assertAlmostEqual(x, y, delta=2e-3)
        text = run("info", self.three, "--faces").stdout
        self.assertRegex(text, r"(?m)^ +2  Bezier 1 x 1 +1 +100 +\(5, 0, 0\) - \(15, 0\.1, 0\)")

    def test_unknown_faces_are_reported_with_near_ones(self):
        done = run("mesh", self.three, "-o", self.path("a.mesh"), "--face-size", "4=1")
        self.assertIn("there is no face '4'", done.stderr)
        self.assertIn("did you mean '1', '2' or '3'?", done.stderr)
        self.assertIn("carreau info --faces", done.stderr)

    def picture(self, mesh, *options, name="p.png"):
        done = run("picture", mesh, "-o", self.path(name), "--view", "top", "--no-edges", *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return read_png(self.path(name))

    def test_numbers_of_faces_are_drawn_where_they_are_seen(self):
        mesh = self.write("black.vtu", BLACK)
        labels = self.json_of("picture", mesh, "-o", self.path("l.png"), "--view", "top", "--label", "faces", "--size", "1200x900")["labels"]
        self.assertEqual(sorted(label["face"] for label in labels), [1, 2, 3, 4])
        # The mesh is 2 x 1: its width is 92 % of the picture's.
        scale = 0.92 * 1200 / 2
        for label in labels:
            x, y = 1 + (label["x"] - 600) / scale, 0.5 - (label["y"] - 450) / scale
            upper = y > x - math.floor(x)  # of the diagonal of its cell
            self.assertEqual(label["face"], 1 + 2 * (x > 1) + upper, (x, y))
        plain = self.picture(mesh)
        run("picture", mesh, "-o", self.path("l.png"), "--view", "top", "--no-edges", "--label", "faces")
        changed = read_png(self.path("l.png"))
        for label in labels:
            around = [(label["y"] + j, label["x"] + i) for j in range(-4, 5) for i in range(-4, 5)]
            self.assertTrue(any(plain[j][i] != changed[j][i] for j, i in around), label)
        self.assertEqual(plain[5][5], changed[5][5])

    def test_references_have_distinct_colours_on_black_parts(self):
        mesh = self.write("black.vtu", BLACK)
        places = [(0.7, 0.2), (0.3, 0.8), (1.7, 0.2), (1.3, 0.8)]
        scale = 0.92 * 1200 / 2

        def colours(*options):
            image = self.picture(mesh, *options)
            return [image[round(450 - (y - 0.5) * scale)][round(600 + (x - 1) * scale)] for x, y in places]
        black, distinct = colours(), colours("--color", "reference")
        self.assertTrue(all(max(colour) < 90 for colour in black))  # their own colour
        self.assertEqual(len(set(distinct)), 4)
        for i, a in enumerate(distinct):
            for b in distinct[:i]:
                self.assertGreater(max(abs(x - y) for x, y in zip(a, b)), 25)

    def test_pictures_of_quality_and_sizes_have_legends(self):
        mesh = self.write("black.vtu", BLACK)
        without, quality, sizes = self.picture(mesh), self.picture(mesh, "--color", "quality"), self.picture(mesh, "--color", "size")
        lower_left = [(j, i) for j in range(850, 900) for i in range(0, 320)]
        white = {without[j][i] for j, i in lower_left}
        self.assertTrue(all(min(colour) > 220 for colour in white))
        for image in (quality, sizes):
            colours = {image[j][i] for j, i in lower_left}
            self.assertTrue(any(max(colour) < 60 for colour in colours))  # numbers
            # The bar: from dark violet to yellow, lighter with each step, so that it is read without hues, too.
            bar = max(([image[j][i] for i in range(0, 320)] for j in range(850, 900)), key=lambda row: len(set(row)))
            bar = [colour for colour in bar if max(colour) - min(colour) > 30]
            self.assertLess(max(abs(a - b) for a, b in zip(bar[0], (0x44, 0x01, 0x54))), 6)
            self.assertLess(max(abs(a - b) for a, b in zip(bar[-1], (0xfd, 0xe7, 0x25))), 6)
            light = [sum(weight * (value / 255) ** 2.2 for weight, value in zip((0.2126, 0.7152, 0.0722), colour)) for colour in bar]
            self.assertTrue(all(b > a - 2e-3 for a, b in zip(light, light[1:])))
        self.assertEqual(without[100][600], quality[100][600])

    def test_fields_show_the_mesh_of_carreau_mesh(self):
        options = ("--angle", "20", "--max", "10%", "--gradation", "1.4", "--set", "angle_smo=0.5")
        whole = self.json_of("mesh", TEAPOT, "-o", self.path("t.vtu"), *options)
        triangles = {face["reference"]: face["triangles"] for face in whole["faces"]}
        fields = self.json_of("fields", TEAPOT, "-o", self.path("f.exr"), "--pixels", "24", *options)
        self.assertTrue(fields["complete"])
        for face in (1, 7, 32):
            with open(self.path(f"f.face.{face}.exr"), "rb") as file:
                data = file.read(20000)
            at = data.index(b"triangle.count\0int\0") + len(b"triangle.count\0int\0") + 4
            self.assertEqual(int.from_bytes(data[at:at + 4], "little"), triangles[face])

    def test_fields_are_pictures_too(self):
        files = self.json_of("fields", self.three, "-o", self.path("f.png"), "--size", "0.25", "--pixels", "120")["files"]
        image = read_png(files[0])
        self.assertEqual((len(image), len(image[0])), (120, 120))  # a square
        dark = sum(max(pixel) < 130 for row in image for pixel in row)
        self.assertGreater(dark, 300)                            # sides of triangles and curves
        self.assertGreater(len({pixel for row in image for pixel in row}), 3)
        strip = read_png(files[1])
        self.assertTrue(len(strip) < 20 and len(strip[0]) == 120)  # 10 x 0.1
        self.refused("fields", self.three, "-o", self.path("g.png"), "--multi-part",
                     sentence=f"--multi-part: a .png file holds one face, not all as '{self.path('g.png')}' should.")

    def test_progress_never_goes_back(self):
        for options in (("--size", "0.1", "--set", "measure=1"), ("--angle", "10", "--gradation", "1.3", "-o", self.path("b.exr"), "-o", self.path("c.vtu"))):
            done = run("mesh", TEAPOT, "-o", self.path("a.vtu"), *options)
            percent = [int(number) for number in re.findall(r"(?m)^ *(\d+) % of the run: \w", done.stderr)]
            self.assertGreater(len(percent), 5)
            self.assertEqual(percent, sorted(percent), done.stderr)
            self.assertEqual(percent[-1], 100)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
