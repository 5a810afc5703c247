#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""cad_library_test.py CARREAU SONAME STEP IGES CHANGES TEAPOT.bpt PART.brep SHAPES: libcarreau_cad is loaded for CAD files, and for nothing else;
likewise its libraries that read STEP and IGES files or change shapes. SHAPES holds files of both."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, LIBRARY, STEP, IGES, CHANGES, TEAPOT, PART, SHAPES = sys.argv[1:9]


class CadLibrary(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau without cad ")

    def break_library(self, name):
        """Found before the real one, and no library."""
        with open(os.path.join(self.folder, name), "w") as file:
            file.write("no library\n")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def run_broken(self, *arguments):
        paths = self.folder + ":" + os.environ.get("LD_LIBRARY_PATH", "")
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, env=os.environ | {"LD_LIBRARY_PATH": paths})

    def test_other_inputs_do_without(self):
        self.break_library(LIBRARY)
        made = os.path.join(self.folder, "teapot.mesh")
        run = self.run_broken("mesh", TEAPOT, "--size", "0.5", "-o", made)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.run_broken("check", made, "--allow-crossings").returncode, 0)

    def test_a_library_that_cannot_be_loaded_is_reported(self):
        self.break_library(LIBRARY)
        made = os.path.join(self.folder, "part.mesh")
        for arguments in (("mesh", PART, "--size", "5%", "-o", made), ("info", PART)):
            run = self.run_broken(*arguments)
            self.assertEqual(run.returncode, 2, run.stdout + run.stderr)
            self.assertIn("CAD files need libcarreau_cad, which cannot be loaded: ", run.stderr)
            self.assertIn(LIBRARY, run.stderr)
        self.assertFalse(os.path.exists(made))

    def test_cad_files_are_read(self):
        for part in (PART, os.path.join(SHAPES, "plate.step"), os.path.join(SHAPES, "plate.igs")):
            run = subprocess.run([PROGRAM, "info", part], capture_output=True, text=True, timeout=120)
            self.assertEqual(run.returncode, 0, run.stderr)

    def test_readers_are_loaded_for_their_files_alone(self):
        for library, kind, broken, other in ((STEP, "STEP", "plate.step", "plate.igs"), (IGES, "IGES", "plate.igs", "plate.step")):
            self.break_library(library)
            run = self.run_broken("info", os.path.join(SHAPES, broken))
            self.assertEqual(run.returncode, 2, run.stdout + run.stderr)
            self.assertIn(f"{kind} files need {library}, which cannot be loaded: ", run.stderr)
            for part in (PART, os.path.join(SHAPES, other)):
                run = self.run_broken("info", part)
                self.assertEqual(run.returncode, 0, run.stderr)
            os.remove(os.path.join(self.folder, library))

    def test_changes_are_loaded_for_requests_alone(self):
        self.break_library(CHANGES)
        made = os.path.join(self.folder, "part.mesh")
        run = self.run_broken("mesh", PART, "--size", "20%", "-o", made)
        self.assertEqual(run.returncode, 0, run.stderr)
        for request in (("--imprint",), ("--min-feature", "1e-3")):
            run = self.run_broken("mesh", PART, "--size", "20%", "-o", made, *request)
            self.assertEqual(run.returncode, 2, run.stdout + run.stderr)
            self.assertIn(f"Imprints, mirrors and small features need {CHANGES}, which cannot be loaded: ", run.stderr)

    def test_nothing_brings_a_viewer(self):
        """OpenCASCADE's own documents do, and a window system with it."""
        for part in (PART, os.path.join(SHAPES, "plate.step"), os.path.join(SHAPES, "plate.igs")):
            run = subprocess.run([PROGRAM, "info", part], capture_output=True, text=True, timeout=120, env=os.environ | {"LD_DEBUG": "files"})
            self.assertIn("libTKBRep", run.stderr)
            for unwanted in ("libTKV3d", "libTKService", "libTKXCAF", "libX11", "libfreeimage", "libGL"):
                self.assertNotIn(unwanted, run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
