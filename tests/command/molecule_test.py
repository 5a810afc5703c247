#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""molecule_test.py CARREAU DATA: `carreau areas`, and `carreau mesh` on molecules. DATA: tests/data/molecule."""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import mesh_files

PROGRAM, DATA = sys.argv[1:3]
TWO = "0 0 0 1.7\n1.5 0 0 1.7\n"


class Molecules(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau molecule ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def run_command(self, *arguments, code=0):
        done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_a_probe_alone_makes_the_surface_that_excludes_the_solvent(self):
        file = os.path.join(DATA, "caffeine.xyzr")
        areas = [json.loads(self.run_command("mesh", file, *options, "--size", "0.5", "-o", "a.mesh", "--json").stdout)["mesh"]["area"]
                 for options in (["--probe", "1.4"], ["--surface", "ses", "--probe", "1.4"], ["--surface", "vws", "--probe", "1.4"])]
        self.assertEqual(areas[0], areas[1])
        self.assertNotEqual(areas[0], areas[2])

    def test_areas_of_two_balls_match_the_closed_form(self):
        areas = json.loads(self.run_command("areas", self.write("two.xyzr", TWO), "--atoms", "--json").stdout)
        self.assertEqual(areas["format"], "carreau areas 1")
        found = {surface["surface"]: surface for surface in areas["surfaces"]}
        for name, area in (("vws", 52.3389), ("sas", 149.9796), ("ses", 52.0752)):
            self.assertAlmostEqual(found[name]["area"], area, delta=2e-4)
            self.assertEqual(found[name]["euler_number"], 2)
            self.assertEqual([atom["atom"] for atom in found[name]["atom_list"]], [1, 2])

    def test_every_element_has_a_radius_and_a_file_replaces_it(self):
        iron, radii = self.write("iron.xyz", "1\n\nFe 0 0 0\n"), self.write("radii.txt", "Fe 2.0\n")
        for options, radius in (([], 2.44), (["--radii", radii], 2.0)):
            areas = json.loads(self.run_command("areas", iron, "--json", *options).stdout)
            found = {surface["surface"]: surface["area"] for surface in areas["surfaces"]}
            self.assertAlmostEqual(found["vws"], 4 * math.pi * radius ** 2, delta=1e-9)
            self.assertAlmostEqual(found["sas"], 4 * math.pi * (radius + 1.4) ** 2, delta=1e-9)
        self.run_command("mesh", iron, "--radii", radii, "--size", "0.5", "-q", "-o", "iron.mesh")
        self.run_command("check", "iron.mesh", "--closed")

    def test_excess_parts_of_a_file_are_reported_once(self):
        done = self.run_command("areas", os.path.join(DATA, "1bna.pdb"))
        self.assertEqual(done.stderr.count("80 atoms of waters are left out"), 1)
        self.assertIn("4659.5", done.stdout)

    def test_each_surface_is_a_closed_mesh_without_crossings(self):
        for surface in ("vws", "sas", "ses"):
            self.run_command("mesh", os.path.join(DATA, "caffeine.xyzr"), "--surface", surface, "--size", "0.4", "-q",
                             "-o", surface + ".mesh")
            self.run_command("check", surface + ".mesh", "--closed")

    def test_the_excluded_surface_of_dna_is_closed_and_has_good_triangles(self):
        run = json.loads(self.run_command("mesh", os.path.join(DATA, "1bna.xyzr"), "--surface", "ses", "--probe", "1.4", "--size", "0.4", "-q", "--json",
                                          "-o", "dna.meshb").stdout)
        self.assertTrue(run["closed"])
        self.assertEqual(run["intersections"]["pairs"], 0)
        self.assertGreaterEqual(run["mesh"]["q2_mean"], 0.93)
        self.assertEqual(run["mesh"]["vertices"] - run["mesh"]["triangles"] // 2, 2)

    def test_references_are_serial_numbers(self):
        line = "HETATM {:4d}  C   XYZ A   1    {:8.3f}   0.000   0.000  1.00  0.00           C\n"
        path = self.write("two.pdb", line.format(17, 0) + line.format(42, 1.5))
        self.run_command("mesh", path, "--size", "0.5", "-q", "-o", "two.mesh")
        mesh = mesh_files.read_mesh(os.path.join(self.folder, "two.mesh"))
        self.assertEqual(set(mesh.refs), {17, 42})

    def test_info_counts_faces(self):
        self.assertIn("faces       2", self.run_command("info", self.write("two.xyzr", TWO)).stdout)

    def test_mistakes_are_reported_with_the_line(self):
        for name, text, sentence in (("a.xyzr", "0 0 0 1\n0 0 0\n", "line 2: the radius is missing"),
                                     ("b.xyz", "1\n\nQq 0 0 0\n", "line 3: 'Qq' is not an element of the periodic table"),
                                     ("c.pdb", "", "the file holds no atom")):
            for command in (["areas"], ["mesh", "-o", "x.mesh"]):
                done = self.run_command(command[0], self.write(name, text), *command[1:], code=2)
                self.assertIn(sentence, done.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "x.mesh")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
