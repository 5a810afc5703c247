#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The driver of FORTRAN 77: a host in fixed form that is linked by hand, by the names of several compilers.

    f77_test.py <gfortran> <objcopy> <folder of libcarreau.so> <libcarreau_f77.a> <folder with host.f, x.pardom, blsurf.env> [<carreau>]
"""
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

GFORTRAN, OBJCOPY, LIBRARY, DRIVER, SOURCE = sys.argv[1:6]
COMMAND = sys.argv[6] if len(sys.argv) > 6 else None
HOST_NAMES = ("cad_init", "surf0", "surf1", "surf2", "curv_int", "curv0", "curv1", "curv2")
DRIVER_NAMES = ("crinit", "crrun", "crgetn", "crgetv", "crgett", "crgete", "crerr", "crend")


def area_of_paraboloid(n=200):
    """Simpson's rule for the area of z = (u^2 + v^2) / 2 over [-2.5, 2.5]^2."""
    h = 5 / n
    weights = [1 if i in (0, n) else 4 if i % 2 else 2 for i in range(n + 1)]
    places = [-2.5 + i * h for i in range(n + 1)]
    return sum(a * b * math.sqrt(1 + u * u + v * v) for a, u in zip(weights, places) for b, v in zip(weights, places)) * h * h / 9


class Fortran77(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau f77 ")
        self.addCleanup(shutil.rmtree, self.folder)
        for name in ("x.pardom", "blsurf.env"):
            shutil.copy(os.path.join(SOURCE, name), self.folder)

    def build(self, *flags, rename=None, edit=lambda text: text):
        with open(os.path.join(SOURCE, "host.f")) as file, open(os.path.join(self.folder, "host.f"), "w") as out:
            out.write(edit(file.read()))
        run = lambda *command: subprocess.run(command, cwd=self.folder, check=True)
        run(GFORTRAN, "-std=legacy", "-ffixed-form", *flags, "-c", "host.f")
        if rename:
            run(OBJCOPY, *[f"--redefine-sym={old}={new}" for old, new in rename.items()], "host.o")
        run(GFORTRAN, "host.o", DRIVER, "-L" + LIBRARY, "-lcarreau", "-Wl,-rpath," + LIBRARY, "-o", "host")

    def run_host(self):
        return subprocess.run([os.path.join(self.folder, "host")], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def check_mesh(self):
        done = self.run_host()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        found = re.search(r"(\d+) VERTICES +(\d+) TRIANGLES +(\d+) EDGES +(\d+) CORNERS, AREA +([\d.]+)", done.stdout)
        vertices, triangles, edges, corners = map(int, found.groups()[:4])
        self.assertEqual((edges, corners), (216, 4))  # RT-0232 sec. 6.1
        self.assertEqual(vertices - (triangles + edges) // 2, 1)  # triangles of a disc: 2 v - t - e = 2
        # Chords of length .154 on curvatures up to 1 lose about h^2 / 24 of the area.
        self.assertAlmostEqual(float(found.group(5)) / area_of_paraboloid(), 1, delta=.154 ** 2 / 24)
        with open(os.path.join(self.folder, "x.mesh")) as file:
            words = file.read().split()
        self.assertEqual(int(words[words.index("Triangles") + 1]), triangles)

    def test_gfortran_and_ifort(self):
        self.build()
        self.check_mesh()

    def test_two_underscores_of_g77_and_f2c(self):
        self.build("-fsecond-underscore")
        self.check_mesh()

    def test_no_underscore(self):
        self.build("-fno-underscoring")
        self.check_mesh()

    def test_upper_case(self):
        self.build(rename={name + "_": name.upper() for name in HOST_NAMES + DRIVER_NAMES})
        self.check_mesh()

    def test_a_routine_that_changes_its_arguments(self):
        spoil = "      UV(1) = 99.D0\n      REFS = 77\n      END\n\n      SUBROUTINE SURF1"
        self.build(edit=lambda text: text.replace("      END\n\n      SUBROUTINE SURF1", spoil))
        self.check_mesh()

    def test_a_result_that_is_not_set(self):
        self.build(edit=lambda text: text.replace("      S(2) = UV(2)\n", ""))
        done = self.run_host()
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r"ERROR  4: .*face 1")

    def test_without_optional_routines(self):
        def without(text):
            for name in ("SURF1", "SURF2", "CURV1", "CURV2"):
                text = re.sub(rf"      SUBROUTINE {name} .*?\n      END\n", "", text, flags=re.DOTALL)
            return text
        self.build(edit=without)
        self.check_mesh()

    @unittest.skipUnless(COMMAND, "the command is not built")
    def test_the_command_makes_the_same_mesh(self):
        def mesh(name):
            with open(os.path.join(self.folder, name)) as file:
                words = file.read().split()
            lists = {}
            for section, width in (("Vertices", 4), ("Triangles", 4)):
                at = words.index(section)
                lists[section] = words[at + 2:at + 2 + width * int(words[at + 1])]
            return lists
        self.build()
        with open(os.path.join(self.folder, "host.f")) as file:
            text = file.read()
        with open(os.path.join(self.folder, "routines.f"), "w") as file:
            file.write(text[text.index("      SUBROUTINE CAD_INIT"):])
        subprocess.run([GFORTRAN, "-std=legacy", "-ffixed-form", "-shared", "-fPIC", "routines.f", "-o", "libhost.so"], cwd=self.folder, check=True)
        for env in ("", "hphydef 0.5\n", "hphy_flag 0\nhgeo_flag 1\nangle_mesh 12\nhgeomax 0.4\n"):
            with open(os.path.join(self.folder, "blsurf.env"), "w") as file:
                file.write(env + "call inimesh\ncall export\ncall exit\n")
            self.assertEqual(self.run_host().returncode, 0)
            subprocess.run([COMMAND, "mesh", "x.pardom", "--host", "./libhost.so", "--env", "blsurf.env", "-o", "y.mesh", "-q"], cwd=self.folder, check=True)
            self.assertEqual(mesh("x.mesh"), mesh("y.mesh"))

    def test_errors_have_sentences(self):
        self.build(edit=lambda text: text.replace("SUBROUTINE SURF0", "SUBROUTINE OTHER"))
        done = self.run_host()
        self.assertEqual(done.returncode, 1)
        self.assertIn("ERROR  1: the program lacks one of the subroutines SURF0, CURV_INT, CURV0", done.stdout)
        self.build(edit=lambda text: text.replace("MT = 20000", "MT = 100"))
        self.assertRegex(self.run_host().stdout, r"ERROR  1: .*100")
        self.build(edit=lambda text: text.replace("      CALL CRINIT\n", ""))
        self.assertIn("ERROR  9: no session is open: CALL CRINIT comes first", self.run_host().stdout)
        self.build()
        os.remove(os.path.join(self.folder, "blsurf.env"))
        self.assertRegex(self.run_host().stdout, r"ERROR  3: cannot read '.*blsurf.env'")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
