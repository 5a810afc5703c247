#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""command_same_mesh_test.py CARREAU MAKE_CELLS TESTS MPIEXEC: periodic meshes of several threads and of several processes are identical."""
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM, MAKE_CELLS, TESTS, MPIEXEC = sys.argv[1:5]
sys.path.append(os.path.join(TESTS, "mpi"))
import mpirun  # noqa: E402

AXES = ("--periodic", "x", "--periodic", "y", "--periodic", "z")
TURN = ("--periodic", "rotate:0,0,0:0,0,1:60")
CASES = (("fcc.step", "0.2", AXES), ("fcc.step", "0.2", (*AXES, "--cross-patch")), ("fcc.step", "0.2", (*AXES, "--cross-patch", "--element", "q1.1")),
         ("fcc.step", "0.15", (*AXES, "--cross-patch", "--element", "p2")), ("annulus.step", "0.2", (*TURN, "--gradation", "1.3", "--size-map", ".05 + .2*z")),
         ("pipe.step", "0.2", (*TURN, "--element", "p3")), ("pipe.step", "0.2", (*TURN, "--cross-patch", "--element", "q2.0")),
         ("lens.step", "0.25", ("--periodic", "rotate:0,0,0:1,0,0:180", "--element", "q1.1")), ("cube.step", "0.2", ("--periodic", "rotate:0,0,.5:1,1,0:180", "--face-size", "1=.07")),
         ("block.step", "0.15", ("--mirror", "x", "--mirror", "y", "--element", "p2")), ("half_wired.step", "0.15", ("--mirror", "x", "--loose-edges")),
         ("wired.step", "0.15", ("--mirror", "x", "--loose-edges", "--cross-patch")))


class SameMesh(unittest.TestCase):
    def test_threads_and_processes(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([MAKE_CELLS, folder], check=True, stdout=subprocess.DEVNULL)
            for number, (body, size, options) in enumerate(CASES):
                made = {}
                for name, threads, ranks in (("one", 1, 0), ("threads", 3, 0), ("ranks", 1, 3)):
                    if ranks > 0 and MPIEXEC == "NONE":
                        continue
                    path = os.path.join(folder, f"{number}{name}.msh2")
                    words = [PROGRAM, "mesh", os.path.join(folder, body), "-o", path, "--size", size, "--threads", threads, *options]
                    with self.subTest(body, options=options, name=name):
                        done = mpirun.run(MPIEXEC, ranks, *words) if ranks > 0 else subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=300)
                        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                        with open(path, "rb") as file:
                            made[name] = file.read()
                        self.assertTrue(made[name] == made["one"])
                        self.assertIn(b"$Periodic", made[name])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[5:])
