#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bad_hosts_test.py CARREAU DOMAIN FIRST HOST...: geometries in shared libraries that end their program: HOSTs by a null pointer, abort(),
exit(0), recursion, DOMAIN and FIRST outside of their faces' domains."""
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, DOMAIN, FIRST, HOSTS = sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:]

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

    def test_no_place_lies_outside_of_the_domain(self):
        def mesh(host, face, curves, *options):
            with open(os.path.join(self.folder, "x.pardom"), "w") as file:
                file.write(f"1\n{face} 1 {curves}" + "  1 0 0 0" * curves + "  0\n")
            done = subprocess.run([PROGRAM, "mesh", "x.pardom", "--host", host, "-o", "x.mesh", *options],
                                  cwd=self.folder, capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 0, f"{face} {options}: {done.stderr}")
            with open(os.path.join(self.folder, "x.mesh")) as file:
                words = file.read().split()
            at = words.index("Vertices")
            vertices = [tuple(map(float, words[at + 2 + 4 * i:at + 5 + 4 * i])) for i in range(int(words[at + 1]))]
            return vertices, int(words[words.index("Triangles") + 1]) if "Triangles" in words else 0

        height = {1: lambda u, v: math.sqrt(max(0, 1 - u * u - v * v)), 2: lambda u, v: 1 / math.hypot(u, v),
                  3: lambda u, v: (u * u + v * v) / 2, 4: lambda u, v: math.sqrt(max(0, 1 - u * u)),
                  5: lambda u, v: math.sqrt(max(0, u * u + v * v - 0.25))}
        cases = (["--size", ".1"], ["--angle", "8"], ["--angle", "8", "--anisotropic"], ["--chord", ".01"],
                 ["--angle", "8", "--gradation", "1.3"], ["--size", ".1", "--element", "q1.1"], ["--size", ".2", "--element", "p2"])
        for face, curves, host in ((1, 1, DOMAIN), (2, 2, DOMAIN), (3, 2, DOMAIN), (3, 2, FIRST), (4, 4, DOMAIN), (5, 2, DOMAIN)):
            for options in cases[:5] if face == 5 else cases:
                with self.subTest(face=face, host=host, options=options):
                    vertices, triangles = mesh(host, face, curves, *options)
                    if face == 1 and options == ["--angle", "8"]:  # equilateral triangles with edges of 2 sin(8 degrees)
                        edge = 2 * math.sin(math.radians(8))
                        self.assertAlmostEqual(triangles / (2 * math.pi / (math.sqrt(3) / 4 * edge ** 2)), 1, delta=0.15)
                    for u, v, z in vertices:
                        # Places between chords and a concave circle are extrapolated. Rounding beside an infinite slope: sqrt(1e-16).
                        inside = not (face in (2, 5) and math.hypot(u, v) < 0.5) and not (face == 3 and math.hypot(u - 0.6, v) < 1)
                        self.assertAlmostEqual(z, height[face](u, v), delta=2e-8 if inside else 0.1 if face == 5 else 2e-3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
