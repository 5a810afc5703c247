#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""report_frames.py CARREAU TEAPOT [SIZE...]: reports of the teapot, one a size of edges (0.035: some 100 000 triangles, 0.011: a million): bytes,
time until it can be used, time and draw calls of a picture in a headless Chromium whose WebGL is SwiftShader's, by the processor alone."""
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../command"))
from report_browser import Browser  # noqa: E402

PROGRAM, TEAPOT = (os.path.abspath(word) for word in sys.argv[1:3])
SIZES = sys.argv[3:] or ["0.035", "0.011"]
FRAMES = 20


def measure(folder, size):
    words = [PROGRAM, "mesh", TEAPOT, "--size", size, "--min", size + "e-3", "-q", "--json", "-o", "t.mesh", "-o", "t.html"]
    told = json.loads(subprocess.run(words, cwd=folder, check=True, capture_output=True, text=True).stdout)
    path = os.path.join(folder, "t.html")
    start = time.time()
    subprocess.run([PROGRAM, "report", "t.mesh", "-o", "again.html"], cwd=folder, check=True)
    written = time.time() - start
    with Browser(folder, 1600, 900) as browser:
        start = time.time()
        assert browser.open(path), browser.run("return document.getElementById('message').textContent")
        browser.frames()
        opened = time.time() - start
        rows = {}
        ways = (("at rest", True, 1, False), ("moving", False, 1, False), ("moving, half as many pixels a side", False, 0.5, False),
                ("moving, half as many pixels a side, the coarse mesh of a large one", False, 0.5, True))
        start = time.time()
        browser.run("if (viewer.renderer.hasCoarse()) viewer.renderer.coarseSet()")
        made = time.time() - start
        for name, fine, density, coarse in ways:
            before = browser.processor_seconds()
            times = browser.run("return carreauReport.timesOfFrames(viewer, ...arguments)", FRAMES, fine, density, coarse)
            rows[name] = statistics.median(times), (browser.processor_seconds() - before) / FRAMES
        pick = browser.run("const start = performance.now(); viewer.pickAt(0.5, 0.5); return performance.now() - start")
        coarse = browser.run("return viewer.renderer.coarse ? viewer.renderer.coarse.triangles : 0")
        canvas, calls, buffers = browser.run("return [[viewer.canvas.width, viewer.canvas.height], viewer.renderer.drawCalls, viewer.renderer.bytes]")
        card = browser.run("const gl = viewer.renderer.gl; return gl.getParameter(gl.getExtension('WEBGL_debug_renderer_info').UNMASKED_RENDERER_WEBGL)")
    triangles = told["mesh"]["triangles"]
    print(f"{triangles} triangles: report {os.path.getsize(path) / 1e6:.2f} MB ({os.path.getsize(path) / triangles:.1f} bytes a triangle), of the mesh alone "
          f"{os.path.getsize(os.path.join(folder, 'again.html')) / 1e6:.2f} MB in {written:.2f} s; .mesh {os.path.getsize(os.path.join(folder, 't.mesh')) / 1e6:.2f} MB\n"
          f"  opened in {opened:.2f} s; canvas {canvas[0]} x {canvas[1]}; {calls} draw calls, {sum(buffers.values()) / 1e6:.1f} MB on the card, pick {pick:.0f} ms"
          + (f"; coarse mesh of {coarse} triangles in {made:.2f} s" if coarse else ""))
    for name, (wall, processor) in rows.items():
        print(f"  {name}: {1000 / wall:.1f} pictures a second, {1000 * processor:.0f} ms of processors each")
    print("  " + card, flush=True)


for each in SIZES:
    with tempfile.TemporaryDirectory(prefix="carreau report ") as home:
        measure(home, each)
