#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""zero_edges_test.py CARREAU MAKE_SHAPES: edges of no length in a STEP file are no reason to lose a face."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, MAKE_SHAPES = sys.argv[1:3]

CURVES = {
    "a line": "LINE('',#9000,#9004)", "a vector of no length": "LINE('',#9000,#9005)", "a spline": "B_SPLINE_CURVE_WITH_KNOTS('',1,(#9000,#9000),"
    ".UNSPECIFIED.,.F.,.F.,(2,2),(0.,1.),.UNSPECIFIED.)", "a polyline": "POLYLINE('',(#9000,#9000))", "a circle of no radius": "CIRCLE('',#9007,0.)"}


class ZeroEdges(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.TemporaryDirectory(prefix="carreau zero edges ")
        subprocess.run([MAKE_SHAPES, cls.home.name], check=True)
        with open(os.path.join(cls.home.name, "inch.step")) as file:  # a cube
            cls.text = file.read()
        cls.entities = {int(k): v.replace("\n", "") for k, v in re.findall(r"#(\d+) = (.*?);\n", cls.text, re.S)}

    @classmethod
    def tearDownClass(cls):
        cls.home.cleanup()

    def with_edge(self, curve, one_vertex):
        """The cube with one more edge, at the beginning of an edge, in both loops of that edge."""
        entities = dict(self.entities)
        long = min(k for k, v in entities.items() if v.startswith("EDGE_CURVE"))
        start = int(re.search(r"#(\d+)", entities[long])[1])
        place = entities[int(re.search(r"#(\d+)", entities[start])[1])]
        ends = f"#{start},#{start}"
        if not one_vertex:
            ends = f"#{start},#9001"
            entities[long] = entities[long].replace(f"#{start},", "#9001,", 1)
        loops = 0
        for oriented, text in list(entities.items()):
            if text.startswith("ORIENTED_EDGE") and f"#{long}," in text:
                pair = f"#9010,#{oriented}" if ".T." in text else f"#{oriented},#9011"
                for loop, members in list(entities.items()):
                    if members.startswith("EDGE_LOOP") and re.search(rf"#{oriented}(?=[,)])", members):
                        entities[loop] = re.sub(rf"#{oriented}(?=[,)])", pair, members)
                        loops += 1
        self.assertEqual(loops, 2)
        entities |= {9000: place, 9001: "VERTEX_POINT('',#9000)", 9002: f"EDGE_CURVE('',{ends},#9003,.T.)", 9003: CURVES[curve],
                     9004: "VECTOR('',#9006,1.)", 9005: "VECTOR('',#9006,0.)", 9006: "DIRECTION('',(0.,0.,1.))",
                     9007: "AXIS2_PLACEMENT_3D('',#9000,#9006,$)", 9010: "ORIENTED_EDGE('',*,*,#9002,.T.)",
                     9011: "ORIENTED_EDGE('',*,*,#9002,.F.)"}
        head = self.text[:self.text.index("DATA;") + 6]
        return head + "".join(f"#{k} = {v};\n" for k, v in sorted(entities.items())) + "ENDSEC;\nEND-ISO-10303-21;\n"

    def mesh(self, text):
        path = os.path.join(self.home.name, "part.step")
        with open(path, "w") as file:
            file.write(text)
        done = subprocess.run([PROGRAM, "mesh", path, "-o", os.path.join(self.home.name, "part.mesh"), "--size", "6", "--json"],
                              capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        self.assertTrue(told["closed"])
        self.assertEqual((told["not_read"], [face["status"] for face in told["faces"]]), ([], 6 * ["meshed"]))
        self.assertAlmostEqual(told["mesh"]["area"], 6 * 25.4 ** 2, places=6)
        return told["mesh"]["triangles"]

    def test_faces_with_edges_of_no_length_are_meshed_as_without(self):
        triangles = self.mesh(self.text)
        for curve in CURVES:
            for one_vertex in (True, False):
                with self.subTest(curve=curve, one_vertex=one_vertex):
                    self.assertEqual(self.mesh(self.with_edge(curve, one_vertex)), triangles)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
