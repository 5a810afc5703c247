#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""mesh_test.py CARREAU FORMULAS TEAPOT HOST...: `carreau mesh` without OpenCASCADE: Bezier patches, and hosts in shared libraries. FORMULAS:
1 when the program has them. Each host is the paraboloid z = (x^2 + y^2) / 2 over [-2.5, 2.5]^2; face 2 of the first one fails."""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import mesh_files

PROGRAM, FORMULAS, TEAPOT, HOSTS = sys.argv[1], sys.argv[2] == "1", sys.argv[3], sys.argv[4:]
FACE = "{0} 1 4  1 0 0 0  1 0 0 0  1 0 0 0  1 0 0 0  0\n"  # reference, orientation, four curves, no point

# A square of side 2 in the plane z = 0, from (-1, -1), as one patch of degrees 1 and 1; a second one beside it, from x = 1.
SQUARE = "1\n1 1\n-1 -1 0\n-1 1 0\n1 -1 0\n1 1 0\n"
TWO_SQUARES = SQUARE.replace("1\n", "2\n", 1) + "1 1\n1 -1 0\n1 1 0\n3 -1 0\n3 1 0\n"


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau mesh ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "wb" if isinstance(text, bytes) else "w") as file:
            file.write(text)
        return self.path(name)

    def run_mesh(self, *arguments, code=0, **options):
        done = subprocess.run([PROGRAM, "mesh", *arguments], capture_output=True, text=True, timeout=120, cwd=self.folder, **options)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def mesh(self, *arguments, code=0):
        """The mesh that these arguments give."""
        done = self.run_mesh(*arguments, "-o", "out.mesh", code=code)
        self.assertEqual(done.stdout, "")
        return mesh_files.read_mesh(self.path("out.mesh"))

    def refused(self, *arguments, sentence):
        before = sorted(os.listdir(self.folder))
        done = self.run_mesh(*arguments, code=2)
        self.assertIn(sentence, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        return done


def mean(values):
    return sum(values) / len(values)


def lengths_near(mesh, inside):
    """Lengths of the edges whose middle satisfies `inside`."""
    edges = {tuple(sorted((t[k], t[k - 1]))) for t in mesh.triangles for k in range(3)}
    ends = [(mesh.vertices[i], mesh.vertices[j]) for i, j in edges]
    return [math.dist(a, b) for a, b in ends if inside(*((x + y) / 2 for x, y in zip(a, b)))]


class Inputs(Folder):
    def test_bezier_patches_of_the_teapot_are_one_conforming_mesh(self):
        mesh = self.mesh(TEAPOT, "--size", "0.1")
        self.assertEqual(set(mesh.refs), set(range(1, 33)))
        # The spout is open where it meets the body, and the body under the lid: HDR's teapot is 52.5 with these.
        self.assertAlmostEqual(len(mesh.triangles) / 12282, 1, delta=0.02)
        self.assertAlmostEqual(mean(mesh.lengths()) / 0.1, 1, delta=0.02)
        # Every place is one vertex: no border along the sides that patches share.
        self.assertEqual(len(set(mesh.vertices)), len(mesh.vertices))

    def test_degrees_of_patches_may_be_any_up_to_15(self):
        # z = u^15 / 15 v^2 as a patch of degrees 15 and 2, over the unit square: S(1, 1).z = 1 / 15.
        rows = "".join(f"{i / 15!r} {j / 2!r} {1 / 15 if i == 15 and j == 2 else 0!r}\n" for i in range(16) for j in range(3))
        mesh = self.mesh(self.write("steep.bpt", "1\n15 2\n" + rows), "--size", "0.02")
        for x, y, z in mesh.vertices:
            self.assertAlmostEqual(z, x ** 15 * y ** 2 / 15, delta=1e-14)
        for words in ("0 2", "16 2", "-1 2", "3 99999999"):
            self.refused(self.write("wrong.bpt", f"1\n{words}\n" + rows), "-o", "a.mesh", sentence="line 2: the degree")

    def test_hosts_in_c_and_fortran_give_the_same_mesh(self):
        pardom = self.write("x.pardom", "1\n" + FACE.format(1))
        meshes = [self.mesh(pardom, "--host", host, "--size", "0.2") for host in HOSTS]
        for mesh in meshes:
            for x, y, z in mesh.vertices:
                self.assertAlmostEqual(z, (x * x + y * y) / 2, delta=1e-12)
            self.assertEqual(mesh.triangles, meshes[0].triangles)
        self.assertAlmostEqual(mean(meshes[0].lengths()) / 0.2, 1, delta=0.03)
        # No file of references beside the input: the command does not change its input.
        self.assertEqual(sorted(os.listdir(self.folder)), ["out.mesh", "x.pardom"])

    def test_a_face_that_fails_leaves_the_other_one_and_the_status_is_1(self):
        both = self.write("both.pardom", "2\n" + FACE.format(1) + FACE.format(2))
        done = self.run_mesh(both, "--host", HOSTS[0], "-o", "out.mesh", "--size", "0.3", "--json", code=1)
        self.assertIn("1 of 2 faces have no mesh: 2", done.stderr)
        self.assertEqual(set(mesh_files.read_mesh(self.path("out.mesh")).refs), {1})
        faces = json.loads(done.stdout)["faces"]
        self.assertEqual([(face["reference"], face["status"]) for face in faces], [(1, "meshed"), (2, "failed")])
        self.assertIn("face 2", faces[1]["why"])
        self.run_mesh(both, "--host", HOSTS[0], "-o", "out.vtu", "--size", "0.3", code=1)
        vtu = mesh_files.read_vtu(self.path("out.vtu"))
        self.assertEqual((vtu.arrays["FieldData", "face_reference"], vtu.arrays["FieldData", "face_status"]), ([1, 2], [1, 3]))
        self.run_mesh(both, "--host", HOSTS[0], "-o", "none.mesh", "--size", "0.3", "--set", "failing_faces=stop", code=2)
        self.assertGreater(faces[0]["triangles"], 100)

    def test_the_domain_and_fields_of_a_failed_face_are_dumped(self):
        both = self.write("both.pardom", "2\n" + FACE.format(1) + FACE.format(2))
        done = self.run_mesh(both, "--host", HOSTS[0], "-o", "out.mesh", "--size", "0.3", "--json", "--dump-failed", "dump", code=1)
        self.assertEqual(sorted(os.listdir(self.path("dump"))), ["face_2.exr", "face_2.mesh"])
        self.assertEqual(json.loads(done.stdout)["dumped"], ["dump/face_2.mesh", "dump/face_2.exr"])
        self.assertRegex(done.stderr, r"(?m)^  face 2 failed: .+$")
        self.assertRegex(done.stderr, r"(?m)^dumped +dump/face_2\.mesh$")
        with open(self.path("dump/face_2.mesh")) as file:
            self.assertRegex(file.read(), r"Dimension\s+2")
        domain = mesh_files.read_mesh(self.path("dump/face_2.mesh"), dimension=2)
        self.assertEqual({abs(x) for x, y in domain.vertices if abs(y) < 2.5}, {2.5})  # the square of the host
        self.assertEqual(len(domain.edges), len(domain.vertices) - 4)  # of each side a polyline
        subprocess.run([PROGRAM, "picture", "dump/face_2.mesh", "-o", "domain.png", "--size", "100x100"], check=True, timeout=60, cwd=self.folder)
        rows = mesh_files.read_png(self.path("domain.png"))
        self.assertLess(min(max(pixel) for pixel in rows[50][3:6]), 200)  # a side of the square, 4 % from the border
        self.assertGreater(min(rows[50][50]), 240)  # nothing inside
        with open(self.path("dump/face_2.exr"), "rb") as file:
            self.assertEqual(file.read(4), b"\x76\x2f\x31\x01")
        # A domain that is the outside of its boundary: the mesher has seen it, and the mesh reports it.
        turned = self.write("turned.pardom", "2\n" + FACE.format(1) + FACE.format(3).replace("3 1 4", "3 -1 4"))
        done = self.run_mesh(turned, "--host", HOSTS[0], "-o", "turned.vtu", "--size", "0.5", "--dump-failed", "turned", code=1)
        self.assertEqual(sorted(os.listdir(self.path("turned"))), ["face_3.exr", "face_3.mesh"])
        self.assertRegex(done.stderr, r"(?m)^  face 3 failed: curve 1: the boundary is turned the wrong way")
        vtu = mesh_files.read_vtu(self.path("turned.vtu"))
        self.assertEqual((vtu.arrays["FieldData", "face_reference"], vtu.arrays["FieldData", "face_status"]), ([1, 3], [1, 3]))
        checked = subprocess.run([PROGRAM, "check", "turned.vtu"], capture_output=True, text=True, timeout=60, cwd=self.folder)
        self.assertIn("failed      face 3: curve 1: the boundary is turned", checked.stdout)
        domain = mesh_files.read_mesh(self.path("turned/face_3.mesh"), dimension=2)
        self.assertEqual({abs(x) for x, y in domain.vertices if abs(y) < 2.5}, {2.5})
        # Nothing fails: an empty folder. No face is left: the dump is there all the same.
        self.run_mesh(TEAPOT, "-o", "a.mesh", "--size", "0.5", "--dump-failed", "none")
        self.assertEqual(os.listdir(self.path("none")), [])
        bad = self.write("bad.pardom", "1\n" + FACE.format(2))
        done = self.run_mesh(bad, "--host", HOSTS[0], "-o", "b.mesh", "--dump-failed", "last", code=2)
        self.assertEqual(sorted(os.listdir(self.path("last"))), ["face_2.exr", "face_2.mesh"])
        self.assertRegex(done.stderr, r"(?m)^dumped +last/face_2\.exr$")
        self.write("file", "")
        self.refused(both, "--host", HOSTS[0], "-o", "c.mesh", "--dump-failed", "file", sentence="the folder 'file' cannot be used: it is not a folder")
        self.refused(both, "--host", HOSTS[0], "-o", "c.mesh", "--dump-failed", "no/such", sentence="the folder 'no/such' cannot be used: No such file")

    def test_a_file_is_not_written_twice_nor_over_what_is_read(self):
        square = self.write("square.bpt", SQUARE)
        os.mkdir(self.path("d"))
        os.symlink(self.path("a.mesh"), self.path("link.mesh"))
        self.write("a.mesh", "old")
        for name in ("a.mesh", "./a.mesh", "d/../a.mesh", "link.mesh", self.path("a.mesh")):
            self.refused(square, "-o", "a.mesh", "-o", name, sentence="'" + name + "' cannot be written: it is named twice")
        self.refused(square, "-o", "d/b.mesh", "-o", "d/../d/b.mesh", sentence="it is named twice")
        self.write("a.sol", "")
        self.refused(square, "-o", "link.mesh", "--size-map", "a.sol", sentence="'link.mesh' cannot be written: it is an input")

    def test_no_face_with_a_mesh_is_status_2_and_no_file(self):
        self.refused(self.write("bad.pardom", "1\n" + FACE.format(2)), "--host", HOSTS[0], "-o", "out.mesh", "--size", "0.3",
                     sentence="face 2")

    def test_files_that_cannot_be_read_are_reported(self):
        cases = (("empty.bpt", "", "empty.bpt, line 1: the file ends"),
                 ("none.bpt", "0\n", "no face"), ("cut.bpt", SQUARE[:-4], "line 6: the file ends where a coordinate should be"),
                 ("words.bpt", SQUARE.replace("-1 1 0", "-1 one 0"), "line 4: a coordinate should be where 'one' stands"),
                 ("more.bpt", SQUARE + "7\n", "line 7: there is more than the 1 patches"),
                 ("nan.bpt", SQUARE.replace("-1 1 0", "-1 nan 0"), "line 4"), ("huge.bpt", SQUARE.replace("-1 1 0", "-1 1e300 0"), "line 4"),
                 ("flat.bpt", "1\n1 1\n" + 4 * "2 3 4\n", "extent"),
                 ("png.bpt", b"\x89PNG\r\n\x1a\n" * 40, "png.bpt, line 1: the number of patches should be where '?PNG' stands"),
                 ("million.bpt", "1000000000\n1 1\n", "line 3: the file ends"))
        for name, text, sentence in cases:
            with self.subTest(name=name):
                self.refused(self.write(name, text), "-o", "a.mesh", sentence=sentence)
        self.refused("missing.bpt", "-o", "a.mesh", sentence="missing.bpt': No such file")
        os.mkdir(self.path("folder.bpt"))
        self.refused("folder.bpt", "-o", "a.mesh", sentence="folder.bpt': it is a folder")
        self.refused(self.write("a.pardom", "1\n"), "-o", "a.mesh", sentence="--host names the shared library")
        self.refused(self.write("a.pardom", "1\n"), "-o", "a.mesh", "--host", HOSTS[0], sentence="a.pardom")
        self.refused(self.write("b.pardom", "1\n" + FACE.format(1)), "-o", "a.mesh", "--host", "no.so", sentence="no.so")
        self.refused("b.stl", "-o", "a.mesh", sentence="b.stl': No such file")
        self.refused(TEAPOT, "-o", "a.mesh", "--host", HOSTS[0], sentence="--host goes with a .pardom file")


@unittest.skipUnless(FORMULAS, "built without muParser")
class Formulas(Folder):
    def test_a_paraboloid_has_its_area(self):
        mesh = self.mesh("z = (x^2 + y^2) / 2", "--domain", "disc:0,0,2", "--size", "0.05")
        self.assertAlmostEqual(mesh_files.area(mesh), 2 * math.pi / 3 * (5**1.5 - 1), delta=3e-3)
        for x, y, z in mesh.vertices:
            self.assertAlmostEqual(z, (x * x + y * y) / 2, delta=1e-12)

    def test_a_torus_is_closed(self):
        box = "box:0,0,6.283185307179586,6.283185307179586"
        formulas = "x = cos(u) * (2 + cos(v)); y = sin(u) * (2 + cos(v)); z = sin(v)"
        mesh = self.mesh(formulas, "--domain", box, "--size", "0.1")
        self.assertAlmostEqual(mesh_files.area(mesh), 8 * math.pi**2, delta=0.1)
        done = subprocess.run([PROGRAM, "check", self.path("out.mesh"), "--closed"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_a_ring_has_a_hole(self):
        mesh = self.mesh("z = 0", "--domain", "ring:1,0,0.5,1", "--size", "0.02")
        self.assertAlmostEqual(mesh_files.area(mesh), math.pi * 0.75, delta=1e-3)

    def test_info_and_fields_know_them(self):
        done = subprocess.run([PROGRAM, "info", "z = x * y", "--json"], capture_output=True, text=True)
        self.assertEqual(json.loads(done.stdout)["faces"], 1, done.stderr)

    def test_the_front_of_hdr_4_8_2_needs_few_triangles_by_direction(self):
        # HDR fig. 4.35 and 4.36: 8 736 by the largest curvature, 2 110 by both.
        front = ("z = tanh((sin(x) - y) / 0.03)", "--domain", "disc:0,0,3", "--angle", "8")
        isotropic, by_direction = self.mesh(*front), self.mesh(*front, "--anisotropic", "--gradation", "2")
        self.assertLess(abs(len(by_direction.triangles) / 2110 - 1), 0.15)
        self.assertGreater(len(isotropic.triangles), 2.5 * len(by_direction.triangles))

    def test_input_without_a_surface_is_reported(self):
        for given, sentence in ((("z = x + z",), "position"), (("x = u; y = v",), "A surface is"), (("z = x; z = y",), "two equations of z"),
                                (("z = x", "--domain", "disc:0,0,0"), "is not a domain"), (("z = x", "--domain", "box:0,0,1"), "is not a domain"),
                                (("z = x", "--domain", "box:1,0,0,1"), "is not a domain"), (("z = 1 / x",), "the formula has no value there"),
                                (("z = x; w = 2",), "is not an equation"), (("z = 0 * u; x = 0; y = 0",), "no extent")):
            self.refused(*given, "-o", "out.mesh", sentence=sentence)
        self.refused(TEAPOT, "--domain", "disc:0,0,1", "-o", "out.mesh", sentence="--domain goes with a surface by formulas")

    def test_options_that_mean_nothing_for_an_input_are_rejected_by_name(self):
        inputs = {"cad": "x.step", "bezier": TEAPOT, "molecule": "x.pdb", "grid": "x.fmt", "triangles": "x.stl"}
        scopes = {"--probe=1": ("molecule",), "--drop-cavities": ("molecule",), "--surface=ses": ("molecule",),
                  "--reach=2": (), "--border=cubic": (),
                  "--smooth=3": ("grid",), "--lengths": ("grid",), "--join=10": ("grid",), "--fill": ("grid",), "--step=1": ("grid",),
                  "--join-nodes=.1": ("grid",), "--domain=disc:0,0,1": (), "--host=a.so": (), "--sharp=30": ("triangles",),
                  "--corner=30": ("triangles",), "--given-edges": ("triangles",), "--ignore-references": ("triangles",)}
        for option, kinds in scopes.items():
            name = option.split("=")[0]
            for kind, path in inputs.items():
                if kind not in kinds:
                    with self.subTest(option=option, input=path):
                        self.refused(path, option, "-o", "a.mesh", sentence=f"{name} goes with ")
        done = subprocess.run([PROGRAM, "info", "x.step", "--sharp", "30"], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--sharp goes with triangles, not with 'x.step'.", done.stderr)
        done = subprocess.run([PROGRAM, "adapt", TEAPOT, "--smooth", "-o", "a.mesh"], capture_output=True, text=True, cwd=self.folder)
        self.assertIn("--smooth goes with a plane domain, not with", done.stderr)

    def test_patches_that_cross_are_reported_in_the_summary(self):
        crossed = self.write("crossed.bpt", SQUARE.replace("1\n", "2\n", 1) + "1 1\n-.9 .1 -1\n.9 .1 -1\n-.9 .1 1\n.9 .1 1\n")
        done = self.run_mesh(crossed, "-o", "a.mesh", "--size", ".2", "--json")
        found = json.loads(done.stdout)["crossing_parts"]
        part, = found["parts"]
        self.assertEqual((part["kind"], part["numbers"]), ("face", [1, 2]))
        self.assertGreater(part["pairs"], 9)  # the line of 1.8 in edges of .2
        self.assertEqual(part["pairs"], found["pairs"])
        self.assertAlmostEqual(part["at"][1], 0.1, delta=1e-9)
        self.assertAlmostEqual(part["at"][2], 0, delta=1e-9)
        self.assertRegex(done.stderr, r"(?m)^crossing: \d+ triangles cross others, in \d+ pairs: 1 pair of faces touches or overlaps\n  faces 1 and 2: \d+ pairs of triangles")

    def test_contradicting_sizes_of_a_face_are_reported_and_the_last_one_holds(self):
        def counts(*rules):
            done = subprocess.run([PROGRAM, "mesh", TEAPOT, "-o", "a.mesh", "--size", "20%", *(w for r in rules for w in ("--face-size", r)), "--json"],
                                  capture_output=True, text=True, cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            told = json.loads(done.stdout)
            return [f["triangles"] for f in told["faces"]], [w for w in told["warnings"] if "face-size" in w]
        once, none = counts("1=.2")
        self.assertEqual(none, [])
        twice, warned = counts("1=.7", "1=.2")
        self.assertEqual(twice, once)
        self.assertEqual(warned, ["--face-size 1=.7 and --face-size 1=.2 both name face 1: the last one holds"])
        self.assertEqual(counts("1=.2", "1=.2")[1], [])


class Sizes(Folder):
    def setUp(self):
        super().setUp()
        self.square = self.write("square.bpt", SQUARE)
        self.two = self.write("two.bpt", TWO_SQUARES)

    def test_lengths_may_be_shares_of_the_diagonal(self):
        share = 100 * 0.1 / math.sqrt(8)
        as_length = self.mesh(self.square, "--size", "0.1")
        for options in (("--size", f"{share!r}%"), ("--max", f"{share!r}%", "--size", "1"), ("--min", f"{share!r}%", "--size", "1e-3"),
                        ("--face-size", f"1={share!r}%"), ("--set", f"hphydef={share!r}%", "--set", "hphymax=9")):
            mesh = self.mesh(self.square, *options)
            self.assertAlmostEqual(len(mesh.triangles) / len(as_length.triangles), 1, delta=0.02, msg=options)
        self.refused(self.square, "-o", "a.mesh", "--set", "angle_mesh=1%", sentence="angle_mesh")

    def test_a_face_can_have_a_size_of_its_own(self):
        mesh = self.mesh(self.two, "--size", "0.3", "--face-size", "2=0.05")
        for face, size in ((1, 0.3), (2, 0.05)):
            inside = lengths_near(mesh, lambda x, y, z: (x > 1.1 if face == 2 else x < 0) and abs(y) < 0.9)
            self.assertAlmostEqual(mean(inside) / size, 1, delta=0.15)
        # The curve between takes the smaller one.
        between = [math.dist(mesh.vertices[i], mesh.vertices[j]) for i, j, _ in mesh.edges
                   if mesh.vertices[i][0] == mesh.vertices[j][0] == 1]
        self.assertAlmostEqual(mean(between), 0.05, delta=0.005)
        self.refused(self.two, "-o", "a.mesh", "--face-size", "3=1", sentence="there is no face '3'")
        self.refused(self.two, "-o", "a.mesh", "--face-size", "1", sentence="NAME=VALUE")
        self.refused(self.two, "-o", "a.mesh", "--face-size", "1=x", sentence="'x' is not a length")

    def test_edges_of_a_curve_can_be_prescribed(self):
        # Curve 2 of the first square is the first side of the second one, from (1, -1) to (1, 1) or back.
        def between(*options):
            mesh = self.mesh(self.two, "--size", "0.5", *options)
            ends = sorted({mesh.vertices[v][1] for i, j, _ in mesh.edges for v in (i, j)
                           if mesh.vertices[i][0] == mesh.vertices[j][0] == 1})
            return [b - a for a, b in zip(ends, ends[1:])]
        for told in (7 * [2 / 7], 3 * [2 / 3]):
            for face in ("1/2", "1/3", "1/4", "1/1"):
                if len(lengths := between("--curve-edges", f"{face}={len(told)}")) == len(told) != 4:
                    break
            self.assertEqual(len(lengths), len(told))
            for length, expected in zip(lengths, told):
                self.assertAlmostEqual(length, expected, delta=1e-10)
        for progression, ratios in (("geometric:1.5", [1.5] * 5), ("arithmetic:3", [7 / 5, 9 / 7, 11 / 9, 13 / 11, 15 / 13])):
            lengths = between("--curve-edges", f"{face}=6,{progression}")
            lengths = lengths if lengths[0] < lengths[-1] else lengths[::-1]
            self.assertEqual(len(lengths), 6)
            for a, b, ratio in zip(lengths, lengths[1:], ratios):
                self.assertAlmostEqual(b / a, ratio, delta=1e-9)
        lengths = sorted(between("--curve-vertices", f"{face}=0.125,0.5"))
        self.assertEqual(lengths, [0.25, 0.75, 1])
        for wrong, sentence in ((("--curve-edges", "1/2=0"), "a number of edges"), (("--curve-edges", "1/2=5,cubic:2"), "geometric:RATIO"),
                                (("--curve-edges", "1/9=5"), "the face has no such curve"), (("--curve-edges", "x=5"), "FACE/RANK"),
                                (("--curve-edges", "3=5"), "no numbers yet"), (("--curve-edges", "1/2=5,geometric:-1"), "geometric:RATIO"),
                                (("--curve-vertices", "1/2=0.5,0.2"), "increasing parameters"),
                                (("--curve-vertices", "1/2=0.5,2"), "does not lie between")):
            with self.subTest(wrong=wrong):
                self.refused(self.two, "-o", "a.mesh", *wrong, sentence=sentence)

    def test_empty_words_are_rejected(self):
        self.refused("", "-o", "a.mesh", sentence="The name of the input is empty")
        for option in ("--size", "--size-map", "--env"):
            self.refused(self.two, "-o", "a.mesh", option, "", sentence=option)

    @unittest.skipUnless(FORMULAS, "built without muParser")
    def test_a_formula_gives_the_size_at_each_place(self):
        mesh = self.mesh(self.square, "--size-map", "x < 0 ? 0.02 : 0.02 + x / 5")
        left, right = (mean(lengths_near(mesh, test)) for test in (lambda x, y, z: x < -0.1, lambda x, y, z: x > 0.9))
        self.assertAlmostEqual(left / 0.02, 1, delta=0.05)
        self.assertAlmostEqual(right / 0.21, 1, delta=0.15)
        # u runs along x here, from 0 to 1.
        for formula in ("0.05 + u / 10", "0.05 + (x + 1) / 20", "0.05+min(u,2)/10+0*pi*sin(v)"):
            self.assertEqual(self.mesh(self.square, "--size-map", formula).triangles,
                             self.mesh(self.square, "--size-map", "0.05 + u / 10").triangles, formula)
        # A size beside it is an upper bound, as is the size of a face.
        bounded = self.mesh(self.square, "--size-map", "x < 0 ? 0.05 : 1", "--size", "0.1")
        self.assertAlmostEqual(mean(lengths_near(bounded, lambda x, y, z: x > 0.3)) / 0.1, 1, delta=0.05)
        both = self.mesh(self.two, "--size-map", "0.2", "--face-size", "2=0.05")
        self.assertAlmostEqual(mean(lengths_near(both, lambda x, y, z: x > 1.2)) / 0.05, 1, delta=0.05)
        self.assertAlmostEqual(mean(lengths_near(both, lambda x, y, z: x < 0)) / 0.2, 1, delta=0.2)

    @unittest.skipUnless(FORMULAS, "built without muParser")
    def test_the_mesh_of_a_formula_does_not_depend_on_threads(self):
        meshes = [self.mesh(TEAPOT, "--size-map", "0.1 + z / 20", "--threads", str(n)) for n in (1, 2, 8)]
        for mesh in meshes[1:]:
            self.assertEqual((mesh.vertices, mesh.triangles), (meshes[0].vertices, meshes[0].triangles))

    @unittest.skipUnless(FORMULAS, "built without muParser")
    def test_a_formula_that_is_wrong_is_reported_with_the_position(self):
        for formula, sentence in (("x + * 2", "position 5"), ("x +", "position 4"), ("(x", "position 3"), ("0.1 + size", "position 7"),
                                  ("x y", "position 3"), ("x = 2", "'=' assigns"), ("1, 2", "more than one value"), ("  ", "empty"),
                                  ('"a"', "strings"), ("0.1 + \u00e9", "'0.1 + ...' is wrong at position 7: a character that is not plain text"), ("x" * 5000, "4096")):
            with self.subTest(formula=formula):
                self.refused(self.square, "-o", "a.mesh", "--size-map", formula, sentence=sentence)
        done = self.refused(self.square, "-o", "a.mesh", "--size-map", "x", sentence="which is not a size, on face 1 at x = ")
        self.assertIn("the size map 'x' gives -", done.stderr)
        done = self.refused(self.two, "-o", "a.mesh", "--size-map", "0.9 - x", sentence="which is not a size, on face ")
        self.assertNotIn("meshing again", done.stderr)
        self.refused(self.square, "-o", "a.mesh", "--size-map", "sqrt(x)", sentence="gives nan")
        self.refused(self.square, "-o", "a.mesh", "--size-map", "1/(x - x)", sentence="gives inf")

    @unittest.skipIf(FORMULAS, "built with muParser")
    def test_without_muparser_a_formula_is_rejected(self):
        self.refused(self.square, "-o", "a.mesh", "--size-map", "x", sentence="built without muParser")

    def test_a_background_mesh_gives_the_sizes_at_its_vertices(self):
        self.write("bg.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 4\n-1 -1 0 0\n1 -1 0 0\n1 1 0 0\n-1 1 0 0\nTriangles 2\n"
                   "1 2 3 0\n1 3 4 0\nEnd\n")
        self.write("bg.sol", "MeshVersionFormatted 2\nDimension 3\nSolAtVertices 4\n1 1\n0.05\n0.25\n0.25\n0.05\nEnd\n")
        meshes = [self.mesh(self.square, "--size-map", name) for name in ("bg.mesh", "bg.sol")]
        self.assertEqual(meshes[0].triangles, meshes[1].triangles)
        # h = 0.15 + x / 10: the number of edges across is the integral of 1 / h = 10 ln 5, in a strip along y.
        for low, high in ((-1, -0.5), (0, 0.5)):
            edges = lengths_near(meshes[0], lambda x, y, z: low < x < high)
            self.assertAlmostEqual(mean(edges) / (0.15 + (low + high) / 20), 1, delta=0.12)
        bounded = self.mesh(self.square, "--size-map", "bg.mesh", "--size", "0.1")
        self.assertAlmostEqual(mean(lengths_near(bounded, lambda x, y, z: x > 0)) / 0.1, 1, delta=0.05)
        self.refused(self.square, "-o", "a.mesh", "--size-map", "no.mesh", sentence="there is no such file")
        self.write("lone.mesh", "MeshVersionFormatted 2\n")
        self.refused(self.square, "-o", "a.mesh", "--size-map", "lone.mesh", sentence="neither 'lone.sol' nor 'lone.solb'")
        for name in ("bg.vtu", "bg.MSH", "bg.stl"):  # of other formats, whether they are there or not
            self.refused(self.square, "-o", "a.mesh", "--size-map", name, sentence="a background mesh is a file .mesh or .meshb")
        self.write("lone.sol", "MeshVersionFormatted 2\n")
        self.refused(self.square, "-o", "a.mesh", "--size-map", "lone.mesh", sentence="lone.mesh")

    def test_a_chord_bounds_the_distance_of_the_mesh_from_its_surface(self):
        pardom = self.write("x.pardom", "1\n" + FACE.format(1))
        counts = []
        for chord in ("0.02", "0.005", "0.1%"):
            mesh = self.mesh(pardom, "--host", HOSTS[0], "--chord", chord)
            counts.append(len(mesh.triangles))
            bound = float(chord) if "%" not in chord else 0.001 * math.sqrt(25 + 25 + 6.25 ** 2)
            # The surface above the middle of a triangle, along z: not above 1.3 times the chord, as README promises.
            heights = []
            for t in mesh.triangles:
                x, y, z = (sum(c) / 3 for c in zip(*(mesh.vertices[v] for v in t)))
                heights.append(abs(z - (x * x + y * y) / 2) / math.sqrt(1 + x * x + y * y))
            self.assertLess(max(heights), 1.3 * bound)
            self.assertGreater(max(heights), bound / 4)
        self.assertAlmostEqual(counts[1] / counts[0], 4, delta=1)  # size goes with the root of the chord

    def test_anisotropic_sizes_need_fewer_triangles_and_the_ratio_is_bounded(self):
        # A quarter of a cylinder nearly: bent along u only, radius 1, length 4.
        k = 4 / 3 * (math.sqrt(2) - 1)
        rows = "".join(f"{x!r} {y!r} {z}\n" for x, y in ((1, 0), (1, k), (k, 1), (0, 1)) for z in (0, 4))
        bent = self.write("bent.bpt", "1\n3 1\n" + rows)
        counts = [len(self.mesh(bent, "--angle", "3", *options).triangles)
                  for options in ((), ("--anisotropic=2",), ("--anisotropic=5",), ("--anisotropic",))]
        self.assertGreater(counts[0] / counts[1], 1.4)
        self.assertGreater(counts[1] / counts[2], 1.5)
        self.assertGreaterEqual(counts[2], counts[3])
        # Around a sharp bend stretched sizes grow gently unless this is switched off.
        rows = "".join(f"{x} {y} {z}\n" for x, y in ((4, 0), (0.2, 0), (0, 0.2), (0, 4)) for z in (0, 4))
        sharp = self.write("sharp.bpt", "1\n3 1\n" + rows)
        usual, graded, free, by_set = (self.mesh(sharp, "--angle", "6", "--anisotropic", *options).triangles for options in
                                       ((), ("--gradation", "1.3"), ("--gradation", "0"), ("--set", "gradation=0")))
        self.assertEqual(usual, graded)
        self.assertEqual(free, by_set)
        self.assertGreater(len(usual), len(free))
        env = self.write("graded.env", "hphy_flag 0\ngradation 1.1\n")
        self.assertEqual(self.mesh(sharp, "--angle", "6", "--anisotropic", "--env", env).triangles,
                         self.mesh(sharp, "--angle", "6", "--anisotropic", "--gradation", "1.1").triangles)
        self.refused(bent, "-o", "a.mesh", "--anisotropic", sentence="--angle or --chord")
        self.refused(bent, "-o", "a.mesh", "--angle", "3", "--anisotropic=0.5", sentence="--anisotropic")
        self.refused(bent, "-o", "a.mesh", "--angle", "3", "--anisotropic=x", sentence="--anisotropic")

    def test_elements_of_six_kinds(self):
        # A quarter of a cylinder of radius 1 and length 2 nearly: its area is pi.
        k = 4 / 3 * (math.sqrt(2) - 1)
        rows = "".join(f"{x!r} {y!r} {z}\n" for x, y in ((1, 0), (1, k), (k, 1), (0, 1)) for z in (0, 2))
        bent = self.write("bent.bpt", "1\n3 1\n" + rows)
        exact, kinds = math.pi, {"p2": "triangles6", "q1.0": "quads4", "q1.1": "quads4", "q2.0": "quads8", "q2.1": "quads8"}
        for element, kind in kinds.items():
            self.run_mesh(bent, "--size", "0.2", "--element", element, "-o", "a.vtu", "-o", "a.stl", "-q")
            done = subprocess.run([PROGRAM, "check", self.path("a.vtu"), "--json"], capture_output=True, text=True, check=True)
            found = json.loads(done.stdout)["elements"]
            self.assertEqual(found["invalid"], 0)
            self.assertGreater(found[kind], 0)
            self.assertLess(found["triangle_share"] if element != "p2" else 0, 0.05 if element.endswith("0") else 1e-12)
            # An edge of .2 turns by .2: the area between chord and arc is a share of .2^2 / 24 of it; for a parabola it is far
            # less.
            error = abs(found["area"] / exact - 1)
            self.assertLess(error, 1e-3 if element.endswith(("2", "2.0", "2.1")) and element[:2] != "q1" else 3e-3)
            subprocess.run([PROGRAM, "picture", self.path("a.vtu"), "-o", self.path("a.png")], check=True, capture_output=True)
            self.assertEqual(json.loads(subprocess.run([PROGRAM, "check", self.path("a.stl"), "--json"], capture_output=True,
                                                       text=True, check=True).stdout).get("elements"), None)
            os.remove(self.path("a.png"))
        env = self.write("p2.env", "element p2\n")
        self.run_mesh(bent, "--size", "0.2", "--env", env, "-o", "b.vtu", "-q")
        done = subprocess.run([PROGRAM, "check", self.path("b.vtu"), "--json"], capture_output=True, text=True, check=True)
        self.assertGreater(json.loads(done.stdout)["elements"]["triangles6"], 0)
        self.refused(bent, "-o", "c.bl2d", "--element", "p2", sentence="holds straight triangles (p1) only")
        self.refused(bent, "-o", "c.mesh", "--element", "p5", sentence="--element")

    def test_meshes_are_halved_carried_and_of_order_three_and_four(self):
        k = 4 / 3 * (math.sqrt(2) - 1)

        def bent(radius):
            return "1\n3 1\n" + "".join(f"{radius * x!r} {radius * y!r} {radius * z!r}\n" for x, y in ((1, 0), (1, k), (k, 1), (0, 1)) for z in (0, 2))
        first, second = self.write("first.bpt", bent(1)), self.write("second.bpt", bent(1.5))

        def figures(name):
            return json.loads(subprocess.run([PROGRAM, "check", self.path(name), "--json"], capture_output=True, text=True, check=True).stdout)
        self.run_mesh(first, "--size", "0.4", "-o", "a.vtu", "-q")
        self.run_mesh(first, "--size", "0.4", "-o", "b.vtu", "--halvings", "2", "-q")
        self.run_mesh(second, "--size", "0.4", "-o", "c.vtu", "--carry-from", first, "-q")
        a, b, c = (figures(name) for name in ("a.vtu", "b.vtu", "c.vtu"))
        self.assertEqual(b["triangles"], 16 * a["triangles"])
        self.assertEqual(c["triangles"], a["triangles"])
        self.assertAlmostEqual(c["quality"]["area"] / a["quality"]["area"], 2.25, places=9)
        for name in ("same.mesh", "carried.mesh"):  # a geometry that has not changed keeps each bit
            self.run_mesh(first, "--size", "0.3", "-o", name, "-q", *(("--carry-from", first) if name == "carried.mesh" else ()))
        with open(self.path("same.mesh"), "rb") as same, open(self.path("carried.mesh"), "rb") as carried:
            self.assertEqual(same.read(), carried.read())
        self.refused(self.write("two.bpt", TWO_SQUARES), "-o", "d.vtu", "--carry-from", first, sentence="topologies differ")
        self.refused(first, "-o", "d.vtu", "--match", "name", sentence="--carry-from")
        for element, kinds in (("p3", " 21 "), ("p4", " 23 "), ("q3", " 36 "), ("q4", " 37 "), ("q3.1", " 36 "), ("q4.1", " 37 ")):
            self.run_mesh(first, "--size", "0.4", "--element", element, "--nodes", "gauss-lobatto", "-o", "x.msh", "-o", "x.msh2", "-o", "x.vtu",
                          "-o", "x.mesh", "-q")
            arc = [((1 - t) ** 3 + 3 * t * (1 - t) ** 2 + 3 * k * t * t * (1 - t), t ** 3 + 3 * t * t * (1 - t) + 3 * k * t * (1 - t) ** 2)
                   for t in (i / 2000 for i in range(2001))]
            area = 2 * sum(math.dist(p, q) for p, q in zip(arc, arc[1:]))
            found = [figures(name)["elements"] for name in ("x.msh", "x.msh2", "x.vtu", "x.mesh")]
            for each in found:
                self.assertEqual((each["order"], each["invalid"]), (int(element[1]), 0))
                self.assertAlmostEqual(each["area"], area, delta=2e-4)
                self.assertAlmostEqual(each["area"], found[0]["area"], places=12)
                self.assertAlmostEqual(each["least_jacobian_min"], found[0]["least_jacobian_min"], places=9)
                self.assertGreater(each["least_jacobian_min"], 0)
                if element.endswith(".1"):
                    self.assertEqual(each["triangles6"], 0)
            subprocess.run([PROGRAM, "picture", self.path("x.mesh"), "-o", self.path("x.png")], check=True, capture_output=True)
            with open(self.path("x.msh")) as file:
                self.assertRegex(file.read(), rf"\n2 1{kinds}\d+\n")
            with open(self.path("x.mesh")) as file:
                self.assertIn(f"L2_T1_2D_P{element[1]}", file.read())
        self.run_mesh(first, "--size", "0.4", "--element", "q2.1", "--centre-nodes", "-o", "x.msh", "-q")
        with open(self.path("x.msh")) as file:
            self.assertRegex(file.read(), r"\n2 1 10 \d+\n")
        self.refused(first, "-o", "x.msh", "--centre-nodes", sentence="--centre-nodes requires --element p2, q2.0 or q2.1")
        self.refused(first, "-o", "x.msh", "--nodes", "gauss-lobatto", sentence="--nodes gauss-lobatto requires")
        self.refused(first, "-o", "x.stl", "--association", sentence="--association requires an output .msh")
        self.refused(first, "-o", "x.stl", "--element", "p3", sentence=".msh, .msh2, .vtu and .mesh (of MFEM) can")

    def test_a_gradation_lets_sizes_grow_gently(self):
        sharp = self.mesh(self.two, "--size", "0.5", "--face-size", "2=0.02")
        soft = self.mesh(self.two, "--size", "0.5", "--face-size", "2=0.02", "--gradation", "1.2")
        self.assertGreater(len(soft.triangles), len(sharp.triangles))
        # ln(1.2) per edge: at the distance d from the small face sizes are at most 0.02 + ln(1.2) d.
        near = lengths_near(soft, lambda x, y, z: 0.6 < x < 0.9)
        self.assertLess(mean(near), 0.02 + math.log(1.2) * 0.4)
        for ratio in ("0.9", "1", "-1"):
            self.refused(self.two, "-o", "a.mesh", "--gradation", ratio, sentence="--gradation")
        self.assertEqual(self.mesh(self.two, "--size", "0.5", "--face-size", "2=0.02", "--gradation", "0").triangles,
                         sharp.triangles)

    def test_effort_has_levels_and_synonyms(self):
        def mesh(*options):
            self.mesh(TEAPOT, "--size", "0.3", *options)
            with open(self.path("out.mesh"), "rb") as file:
                return file.read()
        usual, none = mesh(), mesh("--effort", "0")
        self.assertEqual(usual, mesh("--effort", "1"))
        self.assertEqual(usual, mesh("--set", "effort=1"))
        self.assertEqual(none, mesh("--set", "shape_trials=0", "--set", "crossing_rounds=0"))
        self.assertNotEqual(usual, none)
        env = self.write("blsurf.env", "shape_trials 0\ncrossing_rounds 0\n")
        self.assertEqual(none, mesh("--env", env))
        self.assertEqual(usual, mesh("--env", env, "--effort", "1"))
        self.assertEqual(none, mesh("--env", self.write("effort.env", "effort 0\n")))
        self.refused(TEAPOT, "-o", "a.mesh", "--effort", "3", sentence="--effort")

    def test_an_env_file_sets_parameters_and_the_command_line_wins(self):
        env = self.write("blsurf.env", "hphydef 0.1 ! edges\nhphymax 1\nangle_mesh 4\ncall inimesh\nhphydef 7\npref other\ncall export\ncall exit\n")
        by_env = self.mesh(self.square, "--env", env)
        self.assertAlmostEqual(mean(by_env.lengths()) / 0.1, 1, delta=0.03)
        wins = self.mesh(self.square, "--env", env, "--size", "0.2")
        self.assertAlmostEqual(mean(wins.lengths()) / 0.2, 1, delta=0.05)
        last = self.mesh(self.square, "--env", env, "--size", "0.2", "--set", "hphydef=0.15")
        self.assertAlmostEqual(mean(last.lengths()) / 0.15, 1, delta=0.05)
        bounded = self.mesh(self.square, "--env", env, "--max", "0.05")
        self.assertAlmostEqual(mean(bounded.lengths()) / 0.05, 1, delta=0.03)
        self.assertEqual(sorted(os.listdir(self.folder)), ["blsurf.env", "out.mesh", "square.bpt", "two.bpt"])  # no action was run
        curved = self.write("curved.env", "hphy_flag 0 hgeo_flag 1 angle_mesh 4\n")
        pardom = self.write("x.pardom", "1\n" + FACE.format(1))
        same = [self.mesh(pardom, "--host", HOSTS[0], *options).triangles
                for options in (("--env", curved), ("--angle", "4"), ("--env", curved, "--set", "angle_mesh=4"))]
        self.assertEqual(same[0], same[2])
        self.assertAlmostEqual(len(same[0]) / len(same[1]), 1, delta=0.02)
        self.refused(self.square, "-o", "a.mesh", "--env", self.write("bad.env", "hphydef 1\nhphydeff 2\n"),
                     sentence="bad.env, line 2: there is no parameter 'hphydeff'; did you mean 'hphydef'?")
        self.refused(self.square, "-o", "a.mesh", "--env", "no.env", sentence="no.env")


class Results(Folder):
    def test_exr_holds_the_fields_of_the_mesh(self):
        self.run_mesh(self.write("two.bpt", TWO_SQUARES), "-o", "f.exr", "-o", "out.mesh", "--size", "0.2")
        with open(self.path("f.exr"), "rb") as file:
            head = file.read(20000)
        self.assertEqual(head[:4], b"\x76\x2f\x31\x01")
        for word in (b"face.1", b"face.2", b"size.h\0", b"triangle\0"):
            self.assertTrue(word in head, word)

    def test_all_cores_are_used_by_default(self):
        square = self.write("square.bpt", SQUARE)
        summary = json.loads(self.run_mesh(square, "-o", "a.mesh", "-q", "--json").stdout)
        self.assertEqual(summary["threads"], len(os.sched_getaffinity(0)))
        summary = json.loads(self.run_mesh(square, "-o", "a.mesh", "-q", "--json", "--threads", "3").stdout)
        self.assertEqual(summary["threads"], 3)

    def test_a_summary_ends_the_run_and_a_quiet_run_prints_nothing(self):
        done = self.run_mesh(TEAPOT, "-o", "a.mesh", "-o", "a.vtu", "--size", "0.3")
        for pattern in (r"(?m)^faces +32 meshed, 0 repaired, 0 failed$", r"(?m)^edges +[\d.e-]+ to [\d.]+, mean 0\.\d+; \d+ open$", r"(?m)^written +a\.mesh$",
                        r"(?m)^written +a\.vtu$", r"(?m)^interfaces \d+ curves of two faces, 0 seams, \d+ open", r"(?m)^seconds +reading \d+\.\d+, meshing", r"(?m)^shape quality Q2: mean 0\.9",
                        r"\d+ triangles"):
            self.assertRegex(done.stderr, pattern)
        self.assertEqual(done.stdout, "")
        quiet = self.run_mesh(TEAPOT, "-o", "a.mesh", "--size", "0.3", "-q")
        self.assertEqual((quiet.stdout, quiet.stderr), ("", ""))

    def test_json_has_the_measures_of_the_delivered_mesh(self):
        square = self.write("square.bpt", SQUARE)
        plain = json.loads(self.run_mesh(square, "-o", "a.mesh", "--size", "0.2", "--json").stdout)
        self.assertNotIn("delivered", plain)
        done = self.run_mesh(square, "-o", "a.mesh", "--size", "0.2", "--json", "--set", "measure=1")
        self.assertNotIn("inf", done.stderr)  # distances that are all zero have no classes
        told = json.loads(done.stdout)
        measures = told["delivered"]["measures"]
        length, triangles = measures["metric_length"], told["mesh"]["triangles"]
        self.assertEqual((length["of"], length["count"]), ("edge", told["mesh"]["edges"]))
        # In a plane lengths in the metric of one size are lengths over the size, and there is neither distance nor angle.
        self.assertAlmostEqual(length["mean"] * 0.2, told["mesh"]["edge_mean"], places=9)
        self.assertAlmostEqual(length["max"] * 0.2, told["mesh"]["edge_max"], places=9)
        self.assertAlmostEqual(measures["Q2"]["mean"], told["mesh"]["q2_mean"], places=9)
        self.assertEqual((measures["A1"]["of"], measures["A1"]["count"], measures["A1"]["limit"]), ("triangle", triangles, None))
        self.assertLess(max(measures["A0"]["max"], measures["A1"]["max"]), 1e-5)
        for measure in measures.values():
            self.assertEqual(sum(measure["histogram"]["counts"]), measure["count"])
            self.assertEqual(len(measure["histogram"]["bounds"]) + 1, len(measure["histogram"]["counts"]))
        outside = 1 - told["delivered"]["lengths_in_range"]  # "1 of 365 edges (0.27 %) have metric lengths outside [0.7071, 1.414]: ..."
        self.assertEqual([sentence.split(" edges")[0] for sentence in told["delivered"]["not_met"]],
                         ["%d of %d" % (round(outside * length["count"]), length["count"])] if outside > 0 else [])
        bowl = self.run_mesh(TEAPOT, "-o", "a.mesh", "--size", "0.8", "--angle", "4", "--json", "--set", "measure=1").stdout
        self.assertTrue(all(" of " in sentence for sentence in json.loads(bowl)["delivered"]["not_met"]))
        self.assertTrue(json.loads(bowl)["delivered"]["not_met"])

    def test_json_has_the_reason_for_a_missing_mesh(self):
        self.write("broken.bpt", "2 1\n")
        self.write("broken.mesh", "Vertices 1\n")
        square = self.write("square.bpt", SQUARE)
        for arguments in (("mesh", "none.bpt", "-o", "a.mesh"), ("mesh", "broken.bpt", "-o", "a.mesh"), ("mesh", square, "-o", "a.nosuch"),
                          ("mesh", square, "-o", "a.mesh", "--set", "max_triangles=1"), ("check", "broken.mesh"), ("check", "none.mesh"), ("info", "none.bpt")):
            with self.subTest(arguments=arguments):
                done = subprocess.run([PROGRAM, *arguments, "--json"], capture_output=True, text=True, timeout=120, cwd=self.folder)
                self.assertEqual(done.returncode, 2, done.stderr)
                told = json.loads(done.stdout)
                self.assertEqual((list(told), told["format"]), (["format", "error"], f"carreau {arguments[0]} 1"))
                self.assertIn(told["error"]["sentence"], done.stderr)
                self.assertEqual(told["error"]["exit"], 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
