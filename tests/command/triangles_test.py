#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""triangles_test.py CARREAU: surfaces given as triangles, from file to mesh; a sentence for each mistake."""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv[1])
DATA = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "data", "triangles")


def cylinder(n=36, height=2.0):
    """Vertices and triangles of a closed cylinder of radius 1."""
    x = [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), z) for i in range(n) for z in (0.0, height)]
    x += [(0.0, 0.0, 0.0), (0.0, 0.0, height)]
    t = []
    for i in range(n):
        a, b = 2 * i, 2 * ((i + 1) % n)
        t += [(a, b, b + 1), (a, b + 1, a + 1), (b, a, 2 * n), (a + 1, b + 1, 2 * n + 1)]
    return x, t


def countersink(n=36, slope=41.0):
    """Vertices and triangles of a washer of radii 1 and 4 and height 2, whose hole has a cone from radius 2 on."""
    profile = [(1, 0), (4, 0), (4, 2), (2, 2), (1, 2 - math.tan(math.radians(slope)))]
    m = len(profile)
    x = [(r * math.cos(2 * math.pi * i / n), r * math.sin(2 * math.pi * i / n), float(z)) for i in range(n) for r, z in profile]
    t = []
    for i in range(n):
        for k in range(m):
            a, b, c, d = i * m + k, i * m + (k + 1) % m, (i + 1) % n * m + (k + 1) % m, (i + 1) % n * m + k
            t += [(a, b, c), (a, c, d)]
    return x, t


def hinge(thickness=0.4, width=3.0):
    """Vertices and triangles of a leaf that kinks by 25 and by -35 degrees and ends in a barrel of 16 facets of 12 degrees."""
    path, angle = [(0.0, 0.0)], 0.0
    for turn, length in [(0, 3), (25, 2), (-35, 2)] + [(12, 0.8 * math.radians(12))] * 16:
        angle += math.radians(turn)
        path.append((path[-1][0] + length * math.cos(angle), path[-1][1] + length * math.sin(angle)))
    n, x, t = len(path), [], []
    for i, p in enumerate(path):
        before, after = path[max(i - 1, 0)], path[min(i + 1, n - 1)]
        normals = [(q[1] - r[1], r[0] - q[0]) for q, r in ((before, p), (p, after)) if q != r]
        normals = [(u / math.hypot(u, v), v / math.hypot(u, v)) for u, v in normals]
        u, v = sum(m[0] for m in normals), sum(m[1] for m in normals)
        share = thickness * len(normals) / (u * u + v * v)
        for q in (p, (p[0] + share * u, p[1] + share * v)):
            x += [(q[0], q[1], 0.0), (q[0], q[1], width)]

    def quad(a, b, c, d):
        t.extend([(a, b, c), (a, c, d)])

    for i in range(n - 1):
        a, b = 4 * i, 4 * (i + 1)
        quad(a, b, b + 1, a + 1)
        quad(b + 2, a + 2, a + 3, b + 3)
        quad(b, a, a + 2, b + 2)
        quad(a + 1, b + 1, b + 3, a + 3)
    last = 4 * (n - 1)
    quad(0, 1, 3, 2)
    quad(last + 2, last + 3, last + 1, last)
    return x, t


def stl(x, t):
    facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.17g %.17g %.17g\n" % x[v] for v in c) +
                     "endloop\nendfacet\n" for c in t)
    return "solid x\n" + facets + "endsolid\n"


def off(x, t):
    return "OFF\n%d %d 0\n" % (len(x), len(t)) + "".join("%.17g %.17g %.17g\n" % p for p in x) + "".join("3 %d %d %d\n" % c for c in t)


class Triangles(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau triangles ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name, text=None):
        path = os.path.join(self.folder, name)
        if text is not None:
            with open(path, "w") as file:
                file.write(text)
        return path

    def run_command(self, *arguments, code=0):
        done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def info(self, path, *options):
        return json.loads(self.run_command("info", path, "--json", *options).stdout)

    def test_a_cylinder_has_two_lines_in_any_format(self):
        for name, text in (("a.stl", stl(*cylinder())), ("a.off", off(*cylinder()))):
            found = self.info(self.path(name, text))
            self.assertEqual((found["lines"], found["corners"], found["regions"], found["sharp_edges"]), (2, 0, 3, 72))
            self.assertEqual((found["vertices"], found["euler_number"], found["shells"]), (74, 2, 1))
            self.assertEqual(self.info(self.path(name), "--sharp", "95")["lines"], 0)
        self.assertIn("sharp edges        72\n", self.run_command("info", self.path("a.off")).stdout)

    def test_features_below_45_degrees_stay_and_a_lost_one_is_reported_with_its_place(self):
        source, target = self.path("a.stl", stl(*countersink())), self.path("b.mesh")
        found = self.info(source)
        self.assertEqual((found["lines"], found["regions"], found["sharp_edges"]), (5, 5, 5 * 36))
        self.assertGreaterEqual(found["sharp_angle"], 20)
        self.assertLess(found["sharp_angle"], 40)
        self.assertEqual(self.info(source, "--sharp", "45")["sharp_angle"], 45)
        kept = self.run_command("mesh", source, "-o", target, "--size", "0.3").stderr
        self.assertNotIn("away from the triangles", kept)
        distance = float(re.search(r"(?m)^distance +(\S+) at most", kept)[1])
        self.assertLess(distance, 0.03)
        lost = self.run_command("mesh", source, "-o", target, "--size", "0.3", "--sharp", "45").stderr
        place = re.search(r"warning: the mesh is (\S+) away from the triangles at \((\S+), (\S+), (\S+)\), (\S+) of the size there", lost)
        self.assertGreater(float(place[5]), 0.1)
        self.assertLess(math.hypot(float(place[2]), float(place[3])), 4.1)

    def test_kinks_of_a_hinge_stay_and_a_lost_one_is_reported_with_its_place(self):
        source, target = self.path("a.stl", stl(*hinge())), self.path("b.mesh")
        found = self.info(source)
        self.assertEqual((found["euler_number"], found["border_edges"], found["regions"]), (2, 0, 10))
        self.assertLess(found["sharp_angle"], 25)
        self.assertEqual(self.info(source, "--sharp", "45")["regions"], 6)
        for size in (0.2, 0.3):
            kept = self.run_command("mesh", source, "-o", target, "--size", str(size)).stderr
            self.assertNotIn("away from the triangles", kept)
            lost = self.run_command("mesh", source, "-o", target, "--size", str(size), "--sharp", "45").stderr
            place = re.search(r"warning: the mesh is (\S+) away from the triangles at \((\S+), (\S+), (\S+)\), (\S+) of the size there", lost)
            self.assertGreater(float(place[5]), 0.1)
            self.assertLess(float(place[2]), 7)  # on the leaf, not on the barrel
            self.assertLess(float(re.search(r"(?m)^distance +(\S+) at most", kept)[1]), 0.5 * float(place[1]))

    def test_meshes_lie_on_the_cylinder_that_the_triangles_stand_for(self):
        source, target = self.path("a.stl", stl(*cylinder())), self.path("b.mesh")
        done = self.run_command("mesh", source, "-o", target, "--size", "0.1")
        self.assertIn("from the mesh to the triangles", done.stderr)
        checked = json.loads(self.run_command("check", target, "--json", "--closed").stdout)
        self.assertEqual(checked["quality"]["open_edges"], 0)
        exact = 2 * math.pi * 2 + 2 * math.pi
        self.assertLess(abs(checked["quality"]["area"] - exact) / exact, 1e-3)  # that of the triangles: 3.5e-3
        found = self.info(target, "--given-edges")
        self.assertEqual((found["lines"], found["regions"]), (2, 3))

    def test_refinement_writes_lines_that_can_be_given_back(self):
        source, target = self.path("a.off", off(*cylinder())), self.path("b.mesh")
        found = json.loads(self.run_command("refine", source, "--angle", "2", "-o", target, "--json").stdout)
        self.assertGreater(found["triangles"], 144)
        self.assertGreater(found["sharp_edges"], 72)
        again = self.info(target, "--given-edges")
        self.assertEqual((again["lines"], again["sharp_edges"]), (2, found["sharp_edges"]))
        self.run_command("picture", source, "--sharp", "45", "-o", self.path("a.png"))
        self.assertGreater(os.path.getsize(self.path("a.png")), 1000)

    def test_all_elements_are_made(self):
        x, t = cylinder()
        for element in ("p2", "q1.0", "q1.1", "q2.0", "q2.1"):
            made = self.path(element + ".mesh")
            self.run_command("mesh", self.path("a.off", off(x, t)), "-o", made, "--size", "8%", "--element", element)
            found = json.loads(self.run_command("check", made, "--json").stdout)
            self.assertEqual((found["elements"]["invalid"], found["quality"]["open_edges"]), (0, 0), element)
            kinds = {kind for kind in ("triangles3", "triangles6", "quads4", "quads8") if found["elements"][kind] > 0}
            allowed = {"p2": {"triangles6"}, "q1.0": {"quads4", "triangles3"}, "q1.1": {"quads4"}, "q2.0": {"quads8", "triangles6"}, "q2.1": {"quads8"}}
            self.assertTrue(kinds & {"triangles6", "quads4", "quads8"}, element)
            self.assertLessEqual(kinds, allowed[element], element)

    def test_mistakes_are_reported(self):
        x, t = cylinder()
        flat = self.path("flat.off", off(x + [(0, 0, 3), (0, 0, 4)], t + [(73, 74, 75)]))
        self.assertIn("1 triangles have no area, the first is triangle 144 (from 0): dropped", self.run_command("info", flat).stderr)
        twice = self.run_command("info", self.path("twice.off", off(x, t + [t[3]])))
        self.assertIn("has the vertices of triangle 3: dropped", twice.stderr)
        done = self.run_command("mesh", self.path("a.off", off(x, t)), "-o", self.path("b.mesh"), "--face-size", "1=2", code=2)
        self.assertIn("have no sizes of their own", done.stderr)
        done = self.run_command("mesh", self.path("a.off"), "-o", self.path("b.mesh"), "--size", "1e-6", code=2)
        self.assertIn("beyond the limit of 100000000 (parameter max_triangles)", done.stderr)
        done = self.run_command("fields", self.path("a.off"), "-o", self.path("a.exr"), code=2)
        self.assertIn("has no fields over parameter domains", done.stderr)
        for command in ("refine", "mesh", "info"):
            told = self.run_command(command, self.path("a.cml", "<molecule/>"), *([] if command == "info" else ["-o", self.path("b.mesh")]), code=2).stderr
            self.assertIn("cannot be read: the suffix .cml is not known.", told)
            self.assertIn(".vtu, .vtk, .msh", told)
            self.assertEqual(".pdb" in told, command != "refine", told)
        told = self.run_command("mesh", self.path("a.poly", "0"), "-o", self.path("b.mesh"), code=2).stderr
        self.assertIn("The command plane reads .poly.", told)

    def test_size_maps_and_adaptation_work_as_on_other_geometries(self):
        source, target = self.path("a.off", off(*cylinder())), self.path("b.mesh")
        self.run_command("mesh", source, "-o", target, "--size-map", "0.05 + 0.1 * z", "--gradation", "1.4")
        self.run_command("check", target, "--closed")
        self.run_command("adapt", source, "--formula", "tanh(10 * (z - 1))", "--tolerance", "0.05", "--iterations", "2", "--max", "0.3",
                         "-o", self.path("c.mesh"))
        self.run_command("check", self.path("c.mesh"), "--closed")

    def test_each_defect_is_reported_repaired_or_rejected(self):
        # Repairs and reports: figures of `carreau info`, and words of the warning with its place.
        for name, figures, words in (
                ("turned.off", {"turned_triangles": 1, "border_edges": 0, "euler_number": 2, "triangles": 8},
                 "triangle 1 (from 0) at (-1, 0, 0) ran against its neighbours: turned"),
                ("hole.off", {"border_edges": 3, "triangles": 7, "euler_number": 1},
                 "3 edges have one triangle: borders, the first from (-1, 0, 0) to (0, 1, 0)"),
                ("repeated.off", {"repeated_triangles": 1, "triangles": 8, "border_edges": 0},
                 "triangle 8 (from 0) at (1, 0, 0) has the vertices of triangle 0: dropped"),
                ("two_corners.off", {"flat_triangles": 1, "triangles": 8, "vertices": 6},
                 "triangle 8 (from 0) at (1, 0, 0) has two corners at one place: dropped"),
                ("flat.off", {"flat_triangles": 1, "triangles": 8, "border_edges": 0},
                 "1 triangles have no area, the first is triangle 8 (from 0): dropped, and their longest sides are divided"),
                ("shells.off", {"shells": 2, "euler_number": 4, "border_edges": 0}, ""),
                ("fin.off", {"manifold_breaks": 1, "border_edges": 2, "triangles": 9},
                 "1 edges have three triangles or more, the first from (1, 0, 0) to (0, 1, 0)"),
                ("pinched.off", {"pinched_vertices": 1, "shells": 2, "euler_number": 3},
                 "1 vertices join triangles that share no edge, the first at (1, 0, 0)"),
                ("one_sided.off", {"one_sided_edges": 1, "euler_number": 0, "border_edges": 40},
                 "1 edges have no orientation on which both triangles agree, the first from (-0.9956899215000512, "),
                ("fading_line.off", {"faded_ends": 1}, "a sharp line fades out at (")):
            path = os.path.join(DATA, name)
            found = self.info(path)
            self.assertEqual({key: found[key] for key in figures}, figures, name)
            told = self.run_command("info", path).stderr
            self.assertIn(words, told, name)
            self.assertEqual(told == "", words == "", told)
            # All of them have meshes.
            made = self.path(name + ".mesh")
            self.run_command("mesh", path, "-o", made, "--size", "10%", "-q")
            self.run_command("check", made)
        # Rejected input.
        for name, words in (("out_of_range.off", "line 12: "), ("not_a_number.stl", "line 34: ")):
            told = self.run_command("info", os.path.join(DATA, name), code=2).stderr
            self.assertIn(words, told, name)

    def test_several_files_are_one_mesh(self):
        lower, upper = (os.path.join(DATA, name) for name in ("lower.off", "upper.off"))
        made = self.path("cube.mesh")
        done = self.run_command("mesh", lower, upper, "-o", made, "--size", "10%")
        self.assertIn("16 vertices belong to other surfaces of triangles", done.stderr)
        found = json.loads(self.run_command("check", made, "--json", "--closed").stdout)
        self.assertEqual((found["quality"]["open_edges"], found["defects"]), (0, []))
        self.assertLess(abs(found["quality"]["area"] - 24), 1e-9)
        lines = self.info(made, "--given-edges")
        self.assertEqual((lines["regions"], lines["lines"], lines["euler_number"]), (10, 20, 2))
        # Quadrilaterals beside the flat line between the halves: the places of its vertices agree on both sides.
        for size in ("0.2", "5%"):
            for element in ("q1.1", "q2.1"):
                self.run_command("mesh", lower, upper, "-o", made, "--size", size, "--element", element, "-q")
                cells = json.loads(self.run_command("check", made, "--json", "--closed").stdout)["elements"]
                self.assertEqual((cells["invalid"], cells["triangle_share"]), (0, 0), (size, element))
                self.assertLess(abs(cells["area"] - 24), 1e-9)
        # A cylinder of triangles, five units off, and a patch: three geometries, a face number each after the last one.
        x, t = cylinder()
        far = self.path("far.stl", stl([(p[0] + 5, p[1], p[2]) for p in x], t))
        patch = self.path("a.bpt", "1\n1 1\n10 0 0\n10 1 0\n11 0 0\n11 1 0\n")
        done = self.run_command("mesh", self.path("a.off", off(x, t)), patch, far, "-o", made, "--size", "0.2", "--json")
        summary = json.loads(done.stdout)
        self.assertEqual([face["reference"] for face in summary["faces"]], [1, 2, 3, 4, 5, 6, 7])
        self.assertEqual({face["status"] for face in summary["faces"]}, {"meshed"})
        self.assertEqual(summary["more_inputs"], [patch, far])
        self.assertNotIn("given by triangles", done.stderr)  # a face that is meshed another way has not failed
        missing = 2 * 6 * math.pi + 1 - summary["mesh"]["area"]  # 31 chords around: .064 of each cylinder
        self.assertGreater(missing, 0)
        self.assertLess(missing, 0.14)
        self.run_command("check", made)
        done = self.run_command("mesh", lower, "z = x", "-o", made, code=2)
        self.assertIn("cannot be meshed beside other files", done.stderr)
        done = self.run_command("mesh", lower, lower, "-o", made, code=2)
        self.assertIn("all triangles belong to surfaces of the session already", done.stderr)
        self.run_command("mesh", lower, upper, "-o", upper, code=2)  # an input is not written over

    def test_distances_are_bounded(self):
        path, made = self.path("a.off", off(*cylinder())), self.path("b.mesh")
        done = self.run_command("mesh", path, "-o", made, "--size", "0.1")
        self.assertRegex(done.stderr, r"distance +\S+ at most from the mesh to the triangles, \S+ back")
        # A circle is off its polygon of 36 sides by 1 - cos 5 degrees at most.
        far = float(done.stderr.split("distance")[1].split()[0])
        self.assertGreater(far, 0.8 * (1 - math.cos(math.radians(5))))
        self.assertLess(far, 1.1 * (1 - math.cos(math.radians(5))))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
