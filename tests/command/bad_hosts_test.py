#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bad_hosts_test.py CARREAU HOST...: geometries in shared libraries that end their program: by a null pointer, abort(), exit(0), recursion."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, HOSTS = sys.argv[1], sys.argv[2:]

SQUARE = "1\n1 1 4  1 0 0 0  1 0 0 0  1 0 0 0  1 0 0 0  0\n"
# Start and end of the last line. The function that calls itself has no name outside of its library, nor has the part of
# surf0 that compilers keep apart because it never returns.
SENTENCES = [("crashed in surf0", "(SIGSEGV): it used memory that is not there, or called itself without end."),
             ("crashed", "(SIGABRT): it, or a routine that it calls, gave up."),
             ("ended the program", "(exit or STOP)."),
             ("crashed", "(SIGSEGV): it used memory that is not there, or called itself without end.")]


class BadHosts(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau bad hosts ")
        with open(os.path.join(self.folder, "x.pardom"), "w") as file:
            file.write(SQUARE)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def test_the_library_and_its_routine_are_named(self):
        for host, (start, end) in zip(HOSTS, SENTENCES, strict=True):
            for command, output in (("mesh", "x.mesh"), ("fields", "x.exr")):
                with self.subTest(host=host, command=command):
                    done = subprocess.run([PROGRAM, command, "x.pardom", "--host", host, "-o", output, "--set", "hphydef=0.1"],
                                          cwd=self.folder, capture_output=True, text=True, timeout=60)
                    self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                    last = done.stderr.splitlines()[-1]
                    self.assertTrue(last.startswith(f"carreau: The shared library '{host}' {start}"), last)
                    self.assertTrue(last.endswith(end), last)
                    self.assertLessEqual(set(os.listdir(self.folder)), {"x.pardom", "x.pardom.new"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
