#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""med_test.py CARREAU HAS_MED LIBRARY: files .med come back as they were written; files of other programs are read."""
import ctypes
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv[1])
HAS_MED = sys.argv[2].upper() in ("ON", "TRUE", "1", "YES")
LIBRARY = sys.argv[3] if len(sys.argv) > 3 else ""
OFF = """OFF
8 12 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
""" + "".join("3 %d %d %d\n" % t for a, b, c, d in ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
               for t in ((a, b, c), (a, c, d)))


class Med(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau med ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name, text=None):
        path = os.path.join(self.folder, name)
        if text is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        return path

    def run_program(self, *words, status=0):
        done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout if status == 0 else done.stderr

    def check(self, path):
        report = json.loads(self.run_program("check", path, "--json", "--faces"))
        for key in ("mesh", "input", "file"):
            report.pop(key, None)
        return report

    @unittest.skipIf(HAS_MED, "the program has the MED library")
    def test_a_program_without_the_library_names_the_package(self):
        self.assertIn("libmedc-dev", self.run_program("check", self.path("a.med", "x"), status=2))
        cube = self.path("cube.off", OFF)
        self.assertIn("libmedc-dev", self.run_program("mesh", cube, "--size", "0.5", "-o", self.path("a.med"), status=2))

    @unittest.skipUnless(HAS_MED, "the program has no MED library")
    def test_meshes_of_all_elements_come_back(self):
        cube = self.path("cube.off", OFF)
        for element in ("p1", "p2", "q1.0", "q1.1", "q2.0", "q2.1"):
            with self.subTest(element=element):
                med, msh = self.path(element + ".med"), self.path(element + ".msh")
                self.run_program("mesh", cube, "--size", "0.4", "--element", element, "-o", med, "-o", msh)
                self.assertEqual(self.check(med), self.check(msh))
        # The vertices, references and edges are the same to the last bit.
        self.run_program("refine", self.path("p1.med"), "-o", self.path("again.msh"))
        self.run_program("refine", self.path("p1.msh"), "-o", self.path("direct.msh"))
        with open(self.path("again.msh"), "rb") as again, open(self.path("direct.msh"), "rb") as direct:
            self.assertEqual(again.read(), direct.read())

    @unittest.skipUnless(HAS_MED, "the program has no MED library")
    def test_wrong_files_get_a_sentence(self):
        self.assertIn("is not an HDF5 file", self.run_program("check", self.path("text.med", "text"), status=2))
        self.assertIn("No such file", self.run_program("check", self.path("none.med"), status=2))

    @unittest.skipUnless(HAS_MED, "the program has no MED library")
    def test_files_of_the_library_itself_are_read(self):
        med = ctypes.CDLL(LIBRARY)
        med.MEDfileOpen.restype = ctypes.c_int64
        points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
        tria3, quad4, hexa8 = 203, 204, 308

        def write(name, elements, families):
            path = self.path(name)
            file = ctypes.c_int64(med.MEDfileOpen(path.encode(), 3))
            mesh, step = b"part", (-1, -1, ctypes.c_double(0))
            names = b"x".ljust(16) + b"y".ljust(16) + b"z".ljust(16)
            self.assertEqual(med.MEDmeshCr(file, mesh, 3, 3, 0, b"", b"", 0, 0, names, names), 0)
            flat = (ctypes.c_double * 24)(*[c for p in points for c in p])
            self.assertEqual(med.MEDmeshNodeCoordinateWr(file, mesh, *step, 0, 8, flat), 0)
            for number, groups in families.items():
                text = b"".join(group.encode().ljust(80, b"\0") for group in groups)
                self.assertEqual(med.MEDfamilyCr(file, mesh, b"F%d" % -number, number, len(groups), text), 0)
            for kind, nodes, numbers in elements:
                data = (ctypes.c_int * sum(map(len, nodes)))(*[v for each in nodes for v in each])
                self.assertEqual(med.MEDmeshElementConnectivityWr(file, mesh, *step, 0, kind, 0, 0, len(nodes), data), 0)
                data = (ctypes.c_int * len(numbers))(*numbers)
                self.assertEqual(med.MEDmeshEntityFamilyNumberWr(file, mesh, -1, -1, 0, kind, len(numbers), data), 0)
            self.assertEqual(med.MEDfileClose(file), 0)
            return path

        # A volume of one hexahedron, whose corners MED lists inside out: its outer faces are a closed cube.
        cube = self.check(write("hexa.med", [(hexa8, [(1, 4, 3, 2, 5, 8, 7, 6)], [0])], {0: []}))
        self.assertEqual((cube["triangles"], cube["vertices"], cube["report"]["borders"]), (12, 8, []))
        # Groups are names, and their families have references from 1; a group "face_7" is the reference 7.
        part = self.check(write("faces.med", [(tria3, [(1, 3, 2), (1, 4, 3)], [-1, -1]), (quad4, [(5, 6, 7, 8)], [-2])],
                                {0: [], -1: ["face_7", "floor"], -2: ["roof", "hot"]}))
        names = {face["reference"]: face["name"] for face in part["report"]["faces"]}
        self.assertEqual(names, {7: "floor", 8: "roof+hot"})
        wrong = write("wrong.med", [(tria3, [(1, 3, 9)], [0])], {0: []})
        self.assertIn("TRIA3 names node 9 of 8", self.run_program("check", wrong, status=2))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
