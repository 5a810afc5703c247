# SPDX-License-Identifier: BSD-3-Clause
"""Tests of a command that work in a folder of their own."""
import os
import shutil
import subprocess
import tempfile
import unittest


class WorkFolder(unittest.TestCase):
    """program: the command, set by the test."""
    program = ""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau test ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
        return name

    def run_program(self, *words):
        return subprocess.run([self.program, *words], cwd=self.folder, capture_output=True, text=True, timeout=240)

    def done(self, *words):
        """Messages of a run without errors."""
        result = self.run_program(*words)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stderr
