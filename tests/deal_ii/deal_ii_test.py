#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""deal_ii_test.py CARREAU DEAL_II_PAIRS: deal.II matches the sides of periodic meshes."""
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "adapters", "periodic"))
from periodic_files import Mesh  # noqa: E402

PROGRAM, PAIRS = sys.argv[1:3]
# A unit square with a square hole, and sides in two parts.
CELL = """10 2 0 0
1 0 0
2 .3 0
3 1 0
4 1 1
5 .3 1
6 0 1
7 .4 .4
8 .6 .4
9 .6 .6
10 .4 .6
10 0
1 1 2
2 2 3
3 3 4
4 4 5
5 5 6
6 6 1
7 7 8
8 8 9
9 9 10
10 10 7
1
1 .5 .5
"""


class DealII(unittest.TestCase):
    def test_sides_are_matched(self):
        """deal.II orders cells and matches sides by coordinates: as many pairs as the file has edges on the curves."""
        with tempfile.TemporaryDirectory(prefix="carreau deal.II ") as folder:
            poly, path = os.path.join(folder, "cell.poly"), os.path.join(folder, "cell.msh2")
            with open(poly, "w", encoding="utf-8") as file:
                file.write(CELL)
            for element in ("q1.1", "q1.0"):
                for version in ("msh2", "msh"):
                    made = os.path.join(folder, "cell." + version)
                    done = subprocess.run([PROGRAM, "plane", poly, "-o", made, "--size", ".08", "--size-map", ".03 + .1*x", "--element", element,
                                           "--periodic", "x", "--periodic", "y"], capture_output=True, text=True, timeout=120)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    if version == "msh2":
                        mesh = Mesh(made)
                if any(len(cell) == 3 for cells in mesh.cells.values() for cell in cells):
                    self.assertNotEqual(element, "q1.1")
                    continue  # deal.II 9 takes quadrilaterals alone
                curves = [pair for pair in mesh.pairs if pair[0] == 1]
                self.assertEqual(len(curves), 3)
                for _, slave, master, affine, nodes in curves:
                    direction = 0 if affine[3] else 1
                    for version in ("msh2", "msh"):
                        with self.subTest(element, version=version, slave=slave):
                            read = subprocess.run([PAIRS, os.path.join(folder, "cell." + version), str(master), str(slave), str(direction)],
                                                  capture_output=True, text=True, timeout=120)
                            self.assertEqual(read.returncode, 0, read.stderr)
                            cells, pairs, sides = map(int, read.stdout.split())
                            self.assertEqual(cells, sum(map(len, mesh.cells.values())))
                            self.assertEqual(pairs, len(nodes) - 1)
                            self.assertEqual(sides, 2 * pairs)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
