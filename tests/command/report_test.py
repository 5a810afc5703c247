#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""report_test.py CARREAU TEAPOT: pages of `carreau report` and of `carreau mesh -o x.html`, read by a program of their own."""
import base64
import hashlib
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import mesh_files
from report_files import Page, triples

PROGRAM, TEAPOT = sys.argv[1:3]
STYLE = os.path.join(os.path.dirname(__file__), "../../cad_adapters/command/report/viewer/style.css")


def shape(a, b, c):
    """Q2, size."""
    p, q, r = ([y - x for x, y in zip(*pair)] for pair in ((a, b), (a, c), (b, c)))
    normal = math.hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
    squares = sum(x * x for side in (p, q, r) for x in side)
    return 2 * math.sqrt(3) * normal / squares, math.sqrt(2 * normal / math.sqrt(3))


def solids(*names):
    """STL: a unit square a name, side by side."""
    text = ""
    for i, name in enumerate(names):
        corners = [(i, 0, 0), (i + 1, 0, 0), (i + 1, 1, 0), (i, 1, 0)]
        facets = [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]
        text += f"solid {name}\n" + "".join("facet normal 0 0 1\nouter loop\n" + "".join("vertex %d %d %d\n" % p for p in facet) +
                                            "endloop\nendfacet\n" for facet in facets) + f"endsolid {name}\n"
    return text


def area_in_plane(a, b, c):
    return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2


def curved_half_disc():
    """Medit: two triangles of six nodes over a quarter of a circle each."""
    h = math.sqrt(0.5)
    points = [(1, 0), (0, 1), (0, 0), (-1, 0), (h, h), (0, 0.5), (0.5, 0), (-h, h), (-0.5, 0)]
    return ("MeshVersionFormatted 2\nDimension 3\nVertices 9\n" + "".join(f"{x!r} {y!r} 0 0\n" for x, y in points) +
            "TrianglesP2 2\n1 2 3 5 6 7 1\n2 4 3 8 9 6 1\nEnd\n")


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau report ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_carreau(self, *words, code=0):
        done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=300, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
        return name

    def report(self, name, *options):
        self.run_carreau("report", name, "-o", "out.html", *options)
        return Page(self.path("out.html"))


class Run(Folder):
    """One run for all tests of its page: the teapot, with files that hold the same mesh."""

    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.mkdtemp(prefix="carreau report ")
        words = [PROGRAM, "mesh", TEAPOT, "-o", "t.mesh", "-o", "t.vtu", "-o", "t.html", "--size", "0.2", "--json"]
        done = subprocess.run(words, capture_output=True, text=True, cwd=cls.home, check=True, timeout=300)
        cls.told = json.loads(done.stdout)
        cls.page = Page(os.path.join(cls.home, "t.html"))
        cls.mesh = mesh_files.read_mesh(os.path.join(cls.home, "t.mesh"))
        cls.words = words

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.home)

    def test_positions_match_the_mesh_within_the_quantum(self):
        quantum = self.page.head["box"]["quantum"]
        vertices = self.page.positions()
        self.assertEqual(len(vertices), len(self.mesh.vertices))
        for p, q in zip(vertices, self.mesh.vertices):
            for a, b, step in zip(p, q, quantum):
                self.assertLessEqual(abs(a - b), 0.5001 * step)
        extent = max(max(x) - min(x) for x in zip(*self.mesh.vertices))
        self.assertLess(max(quantum), extent / 60000)

    def test_triangles_and_faces_match_the_mesh_exactly(self):
        self.assertEqual(self.page.triangles(), self.mesh.triangles)
        self.assertEqual(self.page.refs(), self.mesh.refs)

    def test_values_match_the_mesh(self):
        arrays = mesh_files.read_vtu(os.path.join(self.home, "t.vtu")).arrays
        n = len(self.mesh.triangles)
        shapes = [shape(*(self.mesh.vertices[v] for v in t)) for t in self.mesh.triangles]
        exact = {"quality": [q for q, _ in shapes], "size": [s for _, s in shapes],
                 "a0": arrays["CellData", "A0"][:n], "a1": arrays["CellData", "A1"][:n]}
        for key, values in exact.items():
            scale = self.page.scale(key)
            width = math.log(scale["high"] / scale["low"]) if scale["logarithmic"] else scale["high"] - scale["low"]
            for found, wanted in zip(self.page.values(key), values, strict=True):
                if math.isnan(wanted):
                    self.assertTrue(math.isnan(found))
                elif scale["logarithmic"]:
                    self.assertLess(abs(math.log(found / max(wanted, scale["low"]))), 0.51 * width / 65534 + 1e-12)
                else:
                    self.assertLess(abs(found - wanted), 0.51 * width / 65534 + 1e-12)

    def test_sides_on_curves_are_the_edges_of_the_mesh(self):
        curves = {tuple(sorted(edge[:2])) for edge in self.mesh.edges}
        for t, bits in zip(self.mesh.triangles, self.page.array("sides"), strict=True):
            for k in range(3):
                self.assertEqual(bits >> k & 1, tuple(sorted((t[k], t[(k + 1) % 3]))) in curves)
            self.assertEqual(bits >> 3, 0)

    def test_histograms_count_each_triangle_once(self):
        for scale in self.page.head["values"]:
            self.assertEqual(sum(self.page.histogram(scale["key"])), len(self.mesh.triangles), scale["key"])
        qualities = [shape(*(self.mesh.vertices[v] for v in t))[0] for t in self.mesh.triangles]
        wanted = [0] * 20
        for q in qualities:
            wanted[min(19, int(q * 20))] += 1
        self.assertEqual(self.page.histogram("quality"), wanted)

    def test_the_worst_are_the_worst(self):
        qualities = sorted((shape(*(self.mesh.vertices[v] for v in t))[0], i + 1) for i, t in enumerate(self.mesh.triangles))
        rows = self.page.rows("worst-quality")
        self.assertEqual(len(rows), 20)
        self.assertEqual([int(row[0].replace("\u202f", "")) for row in rows], [i for _, i in qualities[:20]])
        self.assertAlmostEqual(float(rows[0][1]), qualities[0][0], places=4)

    def test_faces_match_the_faces_that_the_run_reports(self):
        rows = self.page.rows("faces-table")
        self.assertEqual([(int(r[0]), r[1], r[2], int(r[3].replace("\u202f", ""))) for r in rows],
                         [(f["reference"], f["name"], f["status"], f["triangles"]) for f in self.told["faces"]])

    def test_it_shows_requests_results_and_times(self):
        asked = {row[0]: row[1] for row in self.page.rows("parameters")}
        self.assertEqual(asked["hphydef"], "0.2")
        measures = {row[0]: row for row in self.page.rows("measures")}
        self.assertEqual(len(measures), 12)
        self.assertTrue({"A0", "A1", "curve_A0", "edge_angle"} <= set(measures))
        seconds = {row[0]: float(row[1]) for row in self.page.rows("seconds")}
        self.assertAlmostEqual(seconds["total"], self.told["seconds"]["total"], delta=1e-3 + 1e-3 * seconds["total"])

    def test_the_command_makes_the_page_again(self):
        command = "".join(self.page.find("command").itertext())
        again = tempfile.mkdtemp(prefix="carreau report ")
        try:
            line = command.replace("carreau", f"'{PROGRAM}'", 1)
            subprocess.run(["sh", "-c", line], cwd=again, check=True, capture_output=True, timeout=300)
            other = Page(os.path.join(again, "t.html"))
        finally:
            shutil.rmtree(again)
        # Only times differ.
        self.assertEqual(other.scripts, self.page.scripts)

    def test_the_page_needs_nothing_else(self):
        text = self.page.text
        policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', text)[1]
        self.assertIn("default-src 'none'", policy)
        self.assertNotIn("unsafe", policy)
        for tag in ("style", "script"):
            content = re.findall(rf"<{tag}>(.*?)</{tag}>", text, re.S)
            self.assertEqual(len(content), 1)
            digest = base64.b64encode(hashlib.sha256(content[0].encode()).digest()).decode()
            self.assertIn(f"{tag}-src 'sha256-{digest}'", policy)
        self.assertEqual(re.findall(r"(?:https?:)?//[a-z]", re.sub(r"<script.*?</script>", "", text, flags=re.S)), [])
        links = [e.get(name) for e in self.page.root.iter() for name in ("href", "src") if e.get(name) is not None]
        self.assertEqual([link for link in links if not link.startswith("#")], [])
        self.assertNotRegex(self.page.text, r"\beval\(|new Function")

    def test_controls_have_names_and_tables_have_heads(self):
        labelled = {e.get("for") for e in self.page.root.iter("label")} | {c.get("id") for e in self.page.root.iter("label") for c in e}
        for e in self.page.root.iter():
            if e.tag in ("select", "input"):
                self.assertIn(e.get("id"), labelled)
            elif e.tag == "button":
                self.assertTrue("".join(e.itertext()).strip())
            elif e.tag == "table":
                self.assertTrue("".join(e.find("caption").itertext()))
                self.assertTrue(all(th.get("scope") == "col" for th in e.find("thead").iter("th")))
            elif e.tag == "svg":
                self.assertEqual((e.get("role"), bool(e.get("aria-label"))), ("img", True))
        identities = [e.get("id") for e in self.page.root.iter() if e.get("id")]
        self.assertEqual(len(identities), len(set(identities)))


class Reports(Folder):
    def test_names_are_text_whatever_is_in_them(self):
        names = ("</script><script>alert(1)</script>", '"><img src=x onerror=alert(1)>', "a & b <i>'c'</i>", "{{script}}", "bêta \u65b0")
        page = self.report(self.write("x.stl", solids(*names)))
        self.assertEqual([row[1] for row in page.rows("faces-table")], list(names))
        self.assertEqual([face["name"] for face in page.head["faces"]], list(names))
        self.assertEqual(list(page.root.iter("img")) + list(page.root.iter("i")), [])
        self.assertEqual(len(re.findall("<script>", page.text)), 1)
        self.assertNotIn("alert", re.sub(r"&lt;.*?&gt;", "", page.text.replace(page.scripts["viewer-data"], "")).replace("alert(1)", ""))

    def test_the_name_of_a_file_is_text(self):
        page = self.report(self.write("<b>&.stl", solids("a")))
        self.assertEqual("".join(page.root.find(".//h1").itertext()), "Mesh of <b>&.stl")
        self.assertIn("'<b>&.stl'", "".join(page.find("command").itertext()))

    def test_every_format_that_check_reads(self):
        self.run_carreau("mesh", TEAPOT, *(w for s in ("mesh", "meshb", "vtu", "stl", "msh", "msh2") for w in ("-o", "t." + s)), "--size", "0.5")
        self.write("t.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")
        for name in sorted(os.listdir(self.folder)):
            told = json.loads(self.run_carreau("report", name, "--json").stdout)
            page = Page(self.path("t.html"))
            self.assertEqual((told["format"], told["output"], told["bytes"]), ("carreau report 1", "t.html", os.path.getsize(self.path("t.html"))))
            self.assertEqual(len(page.triangles()), told["triangles"], name)

    def test_quadrilaterals_count_once_and_hide_their_diagonal(self):
        self.run_carreau("mesh", TEAPOT, "-o", "q.mesh", "-o", "q.html", "--size", "0.4", "--element", "q1.0")
        page = Page(self.path("q.html"))
        told = json.loads(self.run_carreau("check", "q.mesh", "--allow-crossings", "--json").stdout)["elements"]
        self.assertGreater(told["quads4"], 0)
        for key in ("quality", "size"):
            self.assertEqual(sum(page.histogram(key)), told["quads4"] + told["triangles3"])
        hidden = [bits >> 3 for bits in page.array("sides")]
        self.assertEqual((hidden.count(4), hidden.count(1)), (told["quads4"], told["quads4"]))
        triangles, qualities = page.triangles(), page.array("quality")
        for i in range(len(hidden)):
            if hidden[i] == 4:
                self.assertEqual((triangles[i][0], triangles[i][2]), triangles[i + 1][:2])
                self.assertEqual((hidden[i + 1], qualities[i]), (1, qualities[i + 1]))
        self.assertIn("drawn as two triangles", page.text)

    def test_curved_elements_are_drawn_curved(self):
        self.write("disc.mesh", curved_half_disc())
        page = self.report("disc.mesh")
        self.assertIn("Elements of order 2 are drawn curved", page.text)
        self.assertEqual(len(page.triangles()), 2)
        points, owners = page.positions(), page.array("piece-triangle")
        pieces = triples(page.array("piece-corners"))
        self.assertEqual((owners, len(pieces)), ([0] * 16 + [1] * 16, 32))
        self.assertTrue(all(area_in_plane(*(points[v] for v in piece)) > 0 for piece in pieces))
        straight = sum(area_in_plane(*(points[v] for v in t)) for t in page.triangles())
        curved = sum(area_in_plane(*(points[v] for v in piece)) for piece in pieces)
        exact = 1 + 2 * 2 / 3 * (math.sqrt(2) * (1 - math.sqrt(0.5)))  # two parabolas over chords of length sqrt 2
        self.assertAlmostEqual(straight, 1, delta=1e-3)
        self.assertAlmostEqual(exact - curved, (exact - 1) / 16, delta=1e-3)  # of a parabola exactly
        sides = page.array("piece-sides")
        self.assertEqual(sum((bits >> 3).bit_count() for bits in sides), 3 * 32 - 6 * 4)  # all but those of six sides of elements

    def test_curved_quadrilaterals_have_pieces_of_both_halves(self):
        self.run_carreau("mesh", TEAPOT, "-o", "q.html", "--size", "0.5", "--element", "q2.1")
        page = Page(self.path("q.html"))
        owners, hidden = page.array("piece-triangle"), [bits >> 3 for bits in page.array("sides")]
        self.assertEqual(owners, sorted(owners))
        self.assertEqual([owners.count(t) for t in range(0, len(hidden), 97)], [16] * len(range(0, len(hidden), 97)))
        self.assertEqual((hidden.count(4), hidden.count(1)), (len(hidden) / 2, len(hidden) / 2))
        pieces, triangles = triples(page.array("piece-corners")), page.triangles()
        for t in range(0, len(hidden), 97):  # of their own half
            mine = {v for piece, owner in zip(pieces, owners) if owner == t for v in piece}
            self.assertEqual(len(mine), 15)
            self.assertLessEqual(set(triangles[t]), mine)

    def test_a_square_is_worth_one(self):
        self.write("q.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\nQuadrilaterals 1\n1 2 3 4 7\nEnd\n")
        page = self.report("q.mesh")
        self.assertEqual([round(q, 4) for q in page.values("quality")], [1, 1])
        self.assertEqual(page.refs(), [7, 7])

    def test_short_sides_get_more_bits(self):
        self.write("x.off", "OFF\n6 2 0\n0 0 0\n1e5 0 0\n1e5 1e5 0\n0 1 0\n1 1 0\n0 2 0\n3 0 1 2\n3 3 4 5\n")
        page = self.report("x.off")
        self.assertEqual(page.head["blocks"]["positions"]["bytes"], 3)
        self.assertLess(max(page.head["box"]["quantum"]), 0.01)
        self.assertEqual(page.positions()[4], tuple(page.positions()[4]))
        self.assertAlmostEqual(page.positions()[4][0], 1, delta=0.004)

    def test_meshes_that_cannot_be_measured_are_reported(self):
        self.write("bad.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 3\n0 0 0 0\n1 0 0 0\n2 0 0 0\nTriangles 2\n1 2 3 1\n1 2 3 1\nEnd\n")
        page = self.report("bad.mesh")
        self.assertIn("defects", page.text)
        self.assertEqual(page.values("quality")[0], 0)
        self.write("empty.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 2\n0 0 0 0\n1 0 0 0\nEdges 1\n1 2 1\nEnd\n")
        self.assertIsNone(self.report("empty.mesh").head)

    def test_nothing_stays_of_what_fails(self):
        self.write("x.stl", solids("a"))
        self.write("old.html", "old")
        for words, sentence in ((("x.stl", "-o", "x.png"), "its suffix is not .html"), (("none.stl", "-o", "old.html"), "none.stl"),
                                (("x.stl", "-o", "no folder/x.html"), "no folder")):
            done = self.run_carreau("report", *words, code=2)
            self.assertIn(sentence, done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), ["old.html", "x.stl"])
        with open(self.path("old.html")) as file:
            self.assertEqual(file.read(), "old")


def luminance(colour):
    parts = [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(a, b):
    low, high = sorted((luminance(a), luminance(b)))
    return (high + 0.05) / (low + 0.05)


class Style(unittest.TestCase):
    def test_contrast_meets_wcag_in_both_schemes(self):
        with open(STYLE) as file:
            colours = {name: (light, dark) for name, light, dark in re.findall(r"--([\w-]+): light-dark\((#\w{6}), (#\w{6})\)", file.read())}
        for scheme in (0, 1):
            for ground in ("ground", "panel"):
                for ink in ("ink", "soft", "link", "good", "bad"):
                    self.assertGreaterEqual(contrast(colours[ink][scheme], colours[ground][scheme]), 4.5, (ink, ground, scheme))
                self.assertGreaterEqual(contrast(colours["control"][scheme], colours[ground][scheme]), 3, (ground, scheme))
            for stage in ("stage-top", "stage-bottom"):
                self.assertGreaterEqual(contrast(colours["ink"][scheme], colours[stage][scheme]), 4.5, (stage, scheme))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
