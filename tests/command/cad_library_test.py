#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""cad_library_test.py CARREAU SONAME TEAPOT.bpt PART: libcarreau_cad is loaded for CAD files, and for nothing else."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, LIBRARY, TEAPOT, PART = sys.argv[1:5]


class CadLibrary(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau without cad ")
        # Found before the real one, and no library.
        with open(os.path.join(self.folder, LIBRARY), "w") as file:
            file.write("no library\n")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def run_broken(self, *arguments):
        paths = self.folder + ":" + os.environ.get("LD_LIBRARY_PATH", "")
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, env=os.environ | {"LD_LIBRARY_PATH": paths})

    def test_other_inputs_do_without(self):
        made = os.path.join(self.folder, "teapot.mesh")
        run = self.run_broken("mesh", TEAPOT, "--size", "0.5", "-o", made)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(self.run_broken("check", made).returncode, 0)

    def test_a_library_that_cannot_be_loaded_is_told(self):
        made = os.path.join(self.folder, "part.mesh")
        for arguments in (("mesh", PART, "--size", "5%", "-o", made), ("info", PART)):
            run = self.run_broken(*arguments)
            self.assertEqual(run.returncode, 2, run.stdout + run.stderr)
            self.assertIn("CAD files need libcarreau_cad, which cannot be loaded: ", run.stderr)
            self.assertIn(LIBRARY, run.stderr)
        self.assertFalse(os.path.exists(made))

    def test_cad_files_are_read(self):
        run = subprocess.run([PROGRAM, "info", PART], capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
