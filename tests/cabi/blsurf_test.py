#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The program of RT-0232 sec. 5 around an unchanged cad_m: its files, its messages, its exit codes.

    blsurf_test.py <blsurf> <folder with x.pardom>
    blsurf_test.py --by-hand <gfortran> <cabi/fortran> <folder of libcarreau.so> <folder with cad_m.f90 and x.pardom> [<flag>...]

--by-hand compiles the program by README's steps for users without CMake, with the given flags.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = DATA = None


def read_mesh(path):
    with open(path) as file:
        words = file.read().split()
    counts = {}
    for section in ("Vertices", "Triangles", "Edges"):
        if section in words:
            counts[section] = int(words[words.index(section) + 1])
    counts["Dimension"] = int(words[words.index("Dimension") + 1])
    return counts


class Blsurf(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau blsurf ")  # a path with a blank
        shutil.copy(os.path.join(DATA, "x.pardom"), self.folder)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def run_env(self, text, *arguments, name="blsurf.env"):
        with open(os.path.join(self.folder, name), "w") as env:
            env.write(text)
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_all_defaults(self):
        done = self.run_env("call inimesh\nflag 1\ncall export\ncall exit\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(read_mesh(self.path("x.mesh"))["Edges"], 216)  # RT-0232 sec. 6.1
        self.assertTrue(os.path.exists(self.path("x.pardom.new")))

    def test_sizes_of_the_module_and_several_exports(self):
        done = self.run_env("hphy_flag 2\ncall inimesh\ncall export\noption onesurf2d\npref 2d\ncall export\ncall exit\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        mesh, plane = read_mesh(self.path("x.mesh")), read_mesh(self.path("2d.mesh"))
        self.assertEqual(mesh["Triangles"], plane["Triangles"])
        self.assertEqual(plane["Dimension"], 2)
        # cad_hphys answers 0.5 everywhere: triangles of that side on the area of the paraboloid (about 54.3).
        self.assertAlmostEqual(mesh["Triangles"], 54.3 / (0.25 * 3 ** 0.5 / 4), delta=0.15 * 500)

    def test_another_file_is_an_argument(self):
        done = self.run_env("hphydef 1.5\nhphymax 1.5\ncall inimesh\nflag 1\ncall export\n", "coarse.env", name="coarse.env")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(read_mesh(self.path("x.mesh"))["Edges"], 24)  # RT-0232 sec. 6.1

    def test_errors_end_the_program_with_a_sentence(self):
        done = self.run_env("hphydef 0.5\nhphydeff 1\ncall inimesh\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("blsurf.env, line 2: there is no parameter 'hphydeff'; did you mean 'hphydef'?", done.stderr)
        self.assertFalse(os.path.exists(self.path("x.mesh")))

    def test_a_missing_file_is_named(self):
        done = subprocess.run([PROGRAM], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 1)
        self.assertIn("blsurf.env", done.stderr)

    def test_verb_0_prints_nothing(self):
        done = self.run_env("verb 0\nhphydef 0.5\ncall inimesh\nverb 0\ncall export\n")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))


class WithoutOptionalRoutines(unittest.TestCase):
    """RT-0232 sec. 3.1: routines other than surface and curve routines are "facultatives"."""

    @unittest.skipUnless("--by-hand" in sys.argv, "needs a compiler")
    def test_a_module_without_them_links_and_runs(self):
        with open(os.path.join(DATA, "cad_m.f90")) as file:
            text = file.read()
        corners = re.search(r"corner = (reshape.*)", text).group(1)
        text = re.sub(r"  subroutine (cad_\w+).*?end subroutine \1\n", "", text, flags=re.DOTALL)
        self.assertNotIn("subroutine cad_", text)
        # Names that a wrapper might have, too.
        text = text.replace("corner(2, 5)", f"corner(2, 5) = &\n    {corners}\n  double precision :: refs, uv, h, ic, t, rho, x, r, p")
        folder = tempfile.mkdtemp(prefix="carreau by hand ")
        self.addCleanup(shutil.rmtree, folder)
        shutil.copy(os.path.join(DATA, "x.pardom"), folder)
        with open(os.path.join(folder, "cad_m.f90"), "w") as file:
            file.write(text)
        compile_in(folder, folder, *sys.argv[2:5], *sys.argv[6:])
        for sizes in ("", "hphy_flag 2\nhgeo_flag 0\n"):  # asked, they do not answer: the size is hphydef
            with open(os.path.join(folder, "blsurf.env"), "w") as env:
                env.write(sizes + "call inimesh\nflag 1\ncall export\ncall exit\n")
            done = subprocess.run([os.path.join(folder, "blsurf")], cwd=folder, capture_output=True, text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(read_mesh(os.path.join(folder, "x.mesh"))["Edges"], 216)  # RT-0232 sec. 6.1


def build_by_hand(gfortran, sources, library, data, *flags):
    folder = tempfile.mkdtemp(prefix="carreau by hand ")
    compile_in(folder, data, gfortran, sources, library, *flags)
    return folder


def compile_in(folder, data, gfortran, sources, library, *flags):
    names = ["carreau_c.f90", "carreau.f90", "blsurf_m.f90", "blsurf.f90"]
    subprocess.run([gfortran, *flags, os.path.join(data, "cad_m.f90"), *[os.path.join(sources, name) for name in names],
                    "-L" + library, "-lcarreau", "-Wl,-rpath," + library, "-o", "blsurf"], cwd=folder, check=True)


if __name__ == "__main__":
    if sys.argv[1] == "--by-hand":
        DATA = sys.argv[5]
        folder = build_by_hand(*sys.argv[2:])
        PROGRAM = os.path.join(folder, "blsurf")
    else:
        folder = None
        PROGRAM, DATA = sys.argv[1:3]
    result = unittest.main(argv=sys.argv[:1], exit=False).result
    if folder:
        shutil.rmtree(folder)
    sys.exit(0 if result.wasSuccessful() else 1)
