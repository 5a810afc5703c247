#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""report_browser_test.py CARREAU TEAPOT [PICTURES]: reports in a browser. PICTURES: a folder for pictures of its window.
--has: exit status 0 when there is a browser."""
import sys

from report_browser import Browser, missing

if sys.argv[1] == "--has":
    sys.exit(1 if missing() else 0)

import math
import os
import shutil
import subprocess
import tempfile
import unittest

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

import mesh_files
from report_files import Page

PROGRAM, TEAPOT = sys.argv[1:3]
PICTURES = sys.argv[3] if len(sys.argv) > 3 else None
# Two bilinear patches side by side, [0, 1] x [0, 1] and [1, 2] x [0, 1], without names.
PLATES = "2\n1 1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n1 1\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n"


def inside(p, a, b, c):
    turns = [(v[0] - u[0]) * (p[1] - u[1]) - (v[1] - u[1]) * (p[0] - u[0]) for u, v in ((a, b), (b, c), (c, a))]
    return all(t > 0 for t in turns) or all(t < 0 for t in turns)


def shape(a, b, c):
    p, q, r = ([y - x for x, y in zip(*pair)] for pair in ((a, b), (a, c), (b, c)))
    normal = math.hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
    return 2 * math.sqrt(3) * normal / sum(x * x for side in (p, q, r) for x in side)


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.mkdtemp(prefix="carreau report ")
        with open(os.path.join(cls.home, "plates.bpt"), "w") as file:
            file.write(PLATES)
        for name, words in (("plates", ["plates.bpt", "--size", "0.21"]), ("teapot", [TEAPOT, "--size", "0.1"])):
            subprocess.run([PROGRAM, "mesh", *words, "-q", "-o", name + ".mesh", "-o", name + ".html"], cwd=cls.home, check=True, timeout=300)
        cls.browser = Browser(cls.home)

    @classmethod
    def tearDownClass(cls):
        cls.browser.driver.quit()
        shutil.rmtree(cls.home, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.home, name)

    def open(self, name):
        self.assertTrue(self.browser.open(self.path(name)), self.browser.run("return document.getElementById('message').textContent"))
        self.browser.frames()

    def picture(self, name, browser=None):
        if PICTURES:
            (browser or self.browser).shot(os.path.join(PICTURES, name + ".png"))

    def picked(self):
        rows = self.browser.run("return [...document.querySelectorAll('#picked div')].map((d) => [d.children[0].textContent, d.children[1].textContent])")
        return dict(rows)

    def look_from(self, name):
        self.browser.run("const s = document.getElementById('view-from'); s.value = arguments[0]; s.dispatchEvent(new Event('change'));", name)
        self.browser.frames()

    def click(self, x, y):
        """At pixels of the canvas from its upper left corner."""
        canvas = self.browser.driver.find_element(By.ID, "canvas")
        box = canvas.rect
        ActionChains(self.browser.driver).move_to_element_with_offset(canvas, round(x - box["width"] / 2), round(y - box["height"] / 2)).click().perform()
        self.browser.frames()

    def test_a_click_picks_the_triangle_that_is_there(self):
        self.open("plates.html")
        self.look_from("top")
        mesh = mesh_files.read_mesh(self.path("plates.mesh"))
        box = self.browser.driver.find_element(By.ID, "canvas").rect
        # The box [0, 2] x [0, 1] fills the view but for 6 %: half its height is the larger of both half sides that fit.
        half = 1.06 * max(0.5, 1 / (box["width"] / box["height"]))
        tried = 0
        for i in range(7):
            for k in range(3):
                x, y = 0.143 + 0.281 * i, 0.17 + 0.311 * k
                column = round(box["width"] / 2 + (x - 1) / half * box["height"] / 2)
                row = round(box["height"] / 2 - (y - 0.5) / half * box["height"] / 2)
                # The middle of the pixel, on the plate.
                place = (1 + (column + 0.5 - box["width"] / 2) * half / (box["height"] / 2),
                         0.5 - (row + 0.5 - box["height"] / 2) * half / (box["height"] / 2))
                near = [(place[0] + d * 0.008, place[1] + e * 0.008) for d in (-1, 0, 1) for e in (-1, 0, 1)]
                there = [t for t, corners in enumerate(mesh.triangles) if all(inside(p, *(mesh.vertices[v] for v in corners)) for p in near)]
                if not there:
                    continue  # too near to a side
                tried += 1
                self.click(column, row)
                told = self.picked()
                self.assertEqual(int(told["Triangle"]) - 1, there[0], place)
                self.assertEqual(told["Face"], str(mesh.refs[there[0]]))
                self.assertAlmostEqual(float(told["Shape quality"]), shape(*(mesh.vertices[v] for v in mesh.triangles[there[0]])), delta=1e-4)
                self.assertEqual(told["Vertices"], ", ".join(str(v + 1) for v in mesh.triangles[there[0]]))
        self.assertGreater(tried, 10)
        self.picture("plates_picked")
        self.click(5, 5)
        self.assertEqual(self.picked(), {})

    def test_the_browser_unpacks_what_python_unpacks(self):
        self.open("teapot.html")
        page = Page(self.path("teapot.html"))
        for name in ("positions", "corners", "faces", "sides"):
            self.assertEqual(self.browser.wait("return [...viewer.mesh[given[0]]];", name), page.array(name), name)
        for scale in page.head["values"]:
            self.assertEqual(self.browser.wait("return [...viewer.mesh.codes[given[0]]];", scale["key"]), page.array(scale["key"]))

    def test_keys_turn_move_zoom_and_pick(self):
        self.open("teapot.html")
        canvas = self.browser.driver.find_element(By.ID, "canvas")
        self.browser.run("arguments[0].focus()", canvas)
        state = lambda: self.browser.run("return structuredClone(viewer.camera.copy())")
        before = state()
        canvas.send_keys(Keys.ARROW_RIGHT)
        turned = state()
        cosine = sum(a * b for a, b in zip(before["frame"]["right"], turned["frame"]["right"]))
        self.assertAlmostEqual(math.degrees(math.acos(cosine)), 10, places=6)
        canvas.send_keys("+")
        self.assertAlmostEqual(state()["half"], before["half"] / 1.25, places=9)
        canvas.send_keys(Keys.SHIFT, Keys.ARROW_UP)
        self.assertNotEqual(state()["target"], before["target"])
        canvas.send_keys(Keys.HOME)
        self.browser.frames()
        canvas.send_keys(Keys.ENTER)
        self.assertIn("Triangle", self.picked())
        canvas.send_keys(Keys.ESCAPE)
        self.assertEqual(self.picked(), {})
        canvas.send_keys("n")
        worst = Page(self.path("teapot.html")).rows("worst-quality")[0]
        self.assertEqual(self.picked()["Triangle"], worst[0].replace("\u202f", ""))

    def test_a_button_flies_to_its_triangle(self):
        self.open("teapot.html")
        button = self.browser.driver.find_elements(By.CSS_SELECTOR, "#worst-a0 button.show")[3]
        triangle = int(button.get_attribute("data-triangle"))
        button.click()
        self.browser.frames()
        self.assertEqual(int(self.picked()["Triangle"]), triangle + 1)
        x, y = self.browser.run("return viewer.onPage(arguments[0])", triangle)
        box = self.browser.driver.find_element(By.ID, "canvas").rect
        self.assertAlmostEqual(x, box["width"] / 2, delta=2)
        self.assertAlmostEqual(y, box["height"] / 2, delta=2)
        # From above: only things nearer to the eye lie before it.
        self.picture("worst")

    def test_colours_change_the_picture(self):
        self.open("teapot.html")
        read = ("const { gl, canvas } = { gl: viewer.renderer.gl, canvas: viewer.canvas }; viewer.renderer.draw(viewer.camera, false);"
                "const pixels = new Uint8Array(4 * canvas.width * canvas.height);"
                "gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);"
                "let seen = 0; const colours = new Set();"
                "for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 3] > 0) { ++seen; colours.add(pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]); }"
                "return [seen / (canvas.width * canvas.height), colours.size, [...pixels].reduce((a, b, i) => (a * 31 + b) | 0, 0)];")
        seen = {}
        for key in ("face", "quality", "size", "a0", "a1"):
            self.browser.run("const s = document.getElementById('colour-by'); s.value = arguments[0]; s.dispatchEvent(new Event('change'));", key)
            self.browser.frames()
            covered, colours, seen[key] = self.browser.run(read)
            self.assertGreater(covered, 0.2, key)
            self.assertGreater(colours, 50, key)
            self.assertEqual(self.browser.run("return document.getElementById('legend').hidden"), key == "face")
            self.picture("teapot_" + key)
        self.assertEqual(len(set(seen.values())), 5)

    def test_the_coarse_mesh_of_a_large_one_lies_where_it_lies(self):
        torus = "x = cos(u) * (2 + cos(v)); y = sin(u) * (2 + cos(v)); z = sin(v)"
        subprocess.run([PROGRAM, "mesh", torus, "--domain", "box:0,0,6.283185307,6.283185307", "--size", "0.029", "-q", "-o", "torus.mesh"], cwd=self.home, check=True, timeout=300)
        subprocess.run([PROGRAM, "report", "torus.mesh", "-o", "torus.html"], cwd=self.home, check=True, timeout=300)
        self.open("torus.html")
        self.assertTrue(self.browser.run("return viewer.renderer.hasCoarse()"))
        # Its area, and the share of the sides that two of its triangles have.
        area, even, triangles, given = self.browser.run("""
          const { mesh } = viewer, { corners, from } = carreauReport.coarseMesh(mesh, 20000), sides = new Map();
          const place = (v) => [0, 1, 2].map((x) => mesh.positions[3 * v + x] * mesh.head.box.quantum[x]);
          let area = 0;
          for (let i = 0; i < corners.length; i += 3) {
            const [a, b, c] = [0, 1, 2].map((k) => place(corners[i + k])), p = a.map((x, k) => b[k] - x), q = a.map((x, k) => c[k] - x);
            area += Math.hypot(p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]) / 2;
            for (let k = 0; k < 3; ++k) {
              const key = [corners[i + k], corners[i + (k + 1) % 3]].sort((x, y) => x - y).join();
              sides.set(key, (sides.get(key) || 0) + 1);
            }
          }
          return [area, [...sides.values()].filter((n) => n === 2).length / sides.size, from.length, mesh.head.triangles];""")
        self.assertGreater(given, 180000)
        self.assertTrue(10000 < triangles < 30000, triangles)
        self.assertAlmostEqual(area / (8 * math.pi ** 2), 1, delta=0.02)
        self.assertGreater(even, 0.99)
        covered = [self.browser.run("""
          const { gl } = viewer.renderer, { width, height } = viewer.canvas, pixels = new Uint8Array(4 * width * height);
          viewer.renderer.draw(viewer.camera, false, arguments[0]);
          gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
          return pixels.filter((x, i) => i % 4 === 3 && x > 0).length / (width * height);""", coarse) for coarse in (False, True)]
        self.assertAlmostEqual(covered[1] / covered[0], 1, delta=0.01)
        self.click(0.5 * self.browser.driver.find_element(By.ID, "canvas").rect["width"], 10)
        self.assertEqual(self.browser.run("return viewer.renderer.drawCalls"), 1)

    def test_a_curved_element_is_picked_whole(self):
        h = math.sqrt(0.5)
        points = [(1, 0), (0, 1), (0, 0), (-1, 0), (h, h), (0, 0.5), (0.5, 0), (-h, h), (-0.5, 0)]
        with open(self.path("disc.mesh"), "w") as file:
            file.write("MeshVersionFormatted 2\nDimension 3\nVertices 9\n" + "".join(f"{x!r} {y!r} 0 0\n" for x, y in points) +
                       "TrianglesP2 2\n1 2 3 5 6 7 1\n2 4 3 8 9 6 1\nEnd\n")
        subprocess.run([PROGRAM, "report", "disc.mesh", "-o", "disc.html"], cwd=self.home, check=True, timeout=300)
        self.open("disc.html")
        self.look_from("top")
        # Between the chord and the arc, where no straight triangle is.
        place = ("const [right, up] = viewer.camera.project([arguments[0], 0.6, 0]), half = viewer.canvas.clientHeight / 2;"
                 "return [viewer.canvas.clientWidth / 2 + right * half, half - up * half];")
        for x, triangle in ((0.6, "1"), (-0.6, "2")):
            self.click(*self.browser.run(place, x))
            self.browser.frames()
            self.assertEqual(self.picked()["Triangle"], triangle)
        self.picture("curved")

    def test_slow_pictures_lead_to_less_and_fast_ones_back(self):
        self.open("plates.html")
        levels = self.browser.run("""
          const pace = new carreauReport.Pace(true), seen = [];
          for (const took of [100, 20, 100, 100, 100, 100, 100, 5]) { pace.note(took, true); seen.push([pace.density(), pace.isCoarse(), pace.isFineAtRest()]); }
          for (const took of [100, 20]) { pace.note(took, false); seen.push([pace.density(), pace.isCoarse(), pace.isFineAtRest()]); }
          return seen;""")
        whole, fewer, coarse = [1, False, True], [0.5, False, True], [0.5, True, False]
        self.assertEqual(levels, [whole] * 3 + [fewer] * 2 + [coarse] * 4 + [whole])

    def test_faces_and_tables_answer(self):
        self.open("teapot.html")
        driver = self.browser.driver
        driver.find_elements(By.CSS_SELECTOR, "#faces-table button.show")[4].click()
        self.browser.frames()
        self.assertEqual(self.browser.run("return viewer.face"), 4)
        self.picture("face")
        heads = driver.find_elements(By.CSS_SELECTOR, "#faces-table button.sort")
        heads[3].click()
        counts = self.browser.run("return [...document.querySelectorAll('#faces-table tbody tr')].map((r) => Number(r.cells[3].dataset.sort))")
        self.assertEqual(counts, sorted(counts))
        heads[3].click()
        self.assertEqual(self.browser.run("return [...document.querySelectorAll('#faces-table tbody tr')].map((r) => Number(r.cells[3].dataset.sort))"),
                         sorted(counts, reverse=True))
        self.assertEqual(heads[3].find_element(By.XPATH, "..").get_attribute("aria-sort"), "descending")

    def test_every_control_has_a_name_and_is_reached_by_keys(self):
        self.open("teapot.html")
        tree = self.browser.driver.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
        focusable = [node for node in tree if any(p["name"] == "focusable" and p["value"].get("value") for p in node.get("properties", []))]
        self.assertGreater(len(focusable), 20)
        for node in focusable:
            self.assertTrue(node.get("name", {}).get("value", "").strip(), node)
        body = self.browser.driver.find_element(By.TAG_NAME, "body")
        reached = []
        for _ in range(12):
            self.browser.driver.switch_to.active_element.send_keys(Keys.TAB)
            identity, ring = self.browser.run("const e = document.activeElement, s = getComputedStyle(e); return [e.id || e.className, s.outlineStyle + ' ' + s.outlineWidth]")
            reached.append(identity)
            self.assertEqual(ring, "solid 3px", identity)
        self.assertEqual(reached[:8], ["skip", "colour-by", "view-from", "show-edges", "show-all", "next-worst", "scheme", "canvas"])
        self.assertIsNotNone(body)

    def test_texts_have_contrast_in_both_schemes(self):
        self.open("teapot.html")
        measure = """
          const luminance = (c) => { const f = c.slice(0, 3).map((x) => { x /= 255; return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4; });
                                     return 0.2126 * f[0] + 0.7152 * f[1] + 0.0722 * f[2]; };
          const parse = (text) => (text.match(/[\\d.]+/g) || []).map(Number);
          const ground = (e) => { for (; e; e = e.parentElement) { const c = parse(getComputedStyle(e).backgroundColor); if (c.length === 3 || c[3] === 1) return c; } return [255, 255, 255]; };
          const low = [];
          for (const e of document.querySelectorAll('body *')) {
            if (!e.checkVisibility() || ![...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim()) || e.closest('script, style, svg, option')) continue;
            const a = luminance(parse(getComputedStyle(e).color)), b = luminance(ground(e));
            const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
            if (ratio < 4.5) low.push([e.tagName, e.id, e.className, ratio]);
          }
          return low;"""
        for scheme in ("light", "dark"):
            self.browser.run("document.documentElement.dataset.scheme = arguments[0]", scheme)
            self.assertEqual(self.browser.run(measure), [], scheme)
            self.browser.frames()
            self.picture("scheme_" + scheme)

    def test_no_request_goes_to_a_network_and_no_error_is_logged(self):
        self.browser.messages()
        self.open("teapot.html")
        self.assertEqual(self.browser.run("return performance.getEntriesByType('resource').map((e) => e.name)"), [])
        self.assertEqual(self.browser.messages(), [])

    def test_a_narrow_page_has_the_view_above_the_tables(self):
        with tempfile.TemporaryDirectory() as folder, Browser(folder, 420, 900) as browser:
            self.assertTrue(browser.open(self.path("teapot.html")))
            browser.frames()
            self.assertLessEqual(browser.run("return document.documentElement.scrollWidth"), 420)
            self.picture("narrow", browser)

    def test_without_webgl_the_rest_is_there(self):
        with tempfile.TemporaryDirectory() as folder, Browser(folder, options=("--disable-3d-apis",)) as browser:
            self.assertFalse(browser.open(self.path("teapot.html")))
            self.assertIn("WebGL", browser.run("return document.getElementById('message').textContent"))
            self.assertEqual(browser.run("return document.querySelectorAll('figure svg').length"), 4)
            self.assertGreater(browser.run("return document.querySelectorAll('#faces-table tbody tr').length"), 30)
            self.picture("no_webgl", browser)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
