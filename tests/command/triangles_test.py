#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""triangles_test.py CARREAU: surfaces given as triangles, from file to mesh; a sentence for each mistake."""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv[1])


def cylinder(n=36, height=2.0):
    """Vertices and triangles of a closed cylinder of radius 1."""
    x = [(math.cos(2 * math.pi * i / n), math.sin(2 * math.pi * i / n), z) for i in range(n) for z in (0.0, height)]
    x += [(0.0, 0.0, 0.0), (0.0, 0.0, height)]
    t = []
    for i in range(n):
        a, b = 2 * i, 2 * ((i + 1) % n)
        t += [(a, b, b + 1), (a, b + 1, a + 1), (b, a, 2 * n), (a + 1, b + 1, 2 * n + 1)]
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

    def test_mistakes_are_told(self):
        x, t = cylinder()
        flat = self.path("flat.off", off(x + [(0, 0, 3), (0, 0, 4)], t + [(73, 74, 75)]))
        self.assertIn("has no area: it cannot be dropped without a hole", self.run_command("info", flat, code=2).stderr)
        twice = self.run_command("info", self.path("twice.off", off(x, t + [t[3]])))
        self.assertIn("has the vertices of triangle 3: dropped", twice.stderr)
        done = self.run_command("mesh", self.path("a.off", off(x, t)), "-o", self.path("b.mesh"), "--face-size", "1=2", code=2)
        self.assertIn("have no sizes of their own", done.stderr)
        done = self.run_command("mesh", self.path("a.off"), "-o", self.path("b.mesh"), "--size", "1e-6", code=2)
        self.assertIn("beyond the limit of 100000000 (parameter max_triangles)", done.stderr)
        done = self.run_command("fields", self.path("a.off"), "-o", self.path("a.exr"), code=2)
        self.assertIn("has no fields over parameter domains", done.stderr)
        self.assertIn("is no file of triangles", self.run_command("refine", "a.step", "-o", self.path("b.mesh"), code=2).stderr)

    def test_size_maps_and_adaptation_work_as_on_other_geometries(self):
        source, target = self.path("a.off", off(*cylinder())), self.path("b.mesh")
        self.run_command("mesh", source, "-o", target, "--size-map", "0.05 + 0.1 * z", "--gradation", "1.4")
        self.run_command("check", target, "--closed")
        self.run_command("adapt", source, "--formula", "tanh(10 * (z - 1))", "--tolerance", "0.05", "--iterations", "2", "--max", "0.3",
                         "-o", self.path("c.mesh"))
        self.run_command("check", self.path("c.mesh"), "--closed")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
