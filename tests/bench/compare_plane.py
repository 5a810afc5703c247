#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes a plane domain of one size by Gmsh's Frontal-Delaunay, by its BAMG and by `carreau plane`, in one run, and prints speed
and quality.

    apt-get install gmsh python3-gmsh python3-numpy
    cmake --preset release && cmake --build --preset release --target carreau_command
    python3 tests/bench/compare_plane.py build/release/cad_adapters/command/carreau [--size H] [--repeat N]

The domain is the unit square with a round hole, a polygon of 64 sides. Each mesher has one thread. Gmsh's seconds are
processor times of generate(2) after generate(1). Carreau's are for its whole run except reading and writing, once with
the command's defaults, and once without its local search for the worst triangles. Triangle is not in Debian (its
licence is not free).
"""
import argparse
import json
import math
import os
import subprocess
import tempfile
import time

from gmsh_runs import BAMG, FRONTAL_DELAUNAY, gmsh, quality, quality_row, session, triangles

SIDES = 64


def loops():
    hole = [(0.5 + 0.2 * math.cos(2 * math.pi * i / SIDES), 0.5 + 0.2 * math.sin(2 * math.pi * i / SIDES)) for i in range(SIDES)]
    return [[(0, 0), (1, 0), (1, 1), (0, 1)], hole]


def poly():
    points = [p for loop in loops() for p in loop]
    text = f"{len(points)} 2 0 0\n" + "".join(f"{i + 1} {x!r} {y!r}\n" for i, (x, y) in enumerate(points))
    edges, first = [], 1
    for loop in loops():
        edges += [(first + i, first + (i + 1) % len(loop)) for i in range(len(loop))]
        first += len(loop)
    return text + f"{len(edges)} 0\n" + "".join(f"{i + 1} {a} {b}\n" for i, (a, b) in enumerate(edges)) + "1\n1 .5 .5\n"


def by_gmsh(algorithm, size):
    with session(algorithm, size, size):
        tags = []
        for loop in loops():
            points = [gmsh.model.geo.addPoint(x, y, 0, size) for x, y in loop]
            lines = [gmsh.model.geo.addLine(points[i], points[(i + 1) % len(points)]) for i in range(len(points))]
            tags.append(gmsh.model.geo.addCurveLoop(lines))
        gmsh.model.geo.addPlaneSurface(tags)
        gmsh.model.geo.synchronize()
        gmsh.model.mesh.generate(1)
        start = time.process_time()
        gmsh.model.mesh.generate(2)
        seconds = time.process_time() - start
        q2, _ = quality(*triangles())
        return {"seconds": seconds, **quality_row(q2)}


def by_carreau(program, folder, size, *options):
    done = subprocess.run([program, "plane", os.path.join(folder, "x.poly"), "-o", os.path.join(folder, "x.bl2d"), "-q", "--json",
                           "--threads", "1", "--size", repr(size), *options], capture_output=True, text=True, check=True)
    said = json.loads(done.stdout)
    mesh = said["mesh"]
    return {"seconds": said["seconds"]["processor"], **{key: mesh[key] for key in ("triangles", "q2_mean", "q2_p1", "q2_min")}}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--size", type=float, default=0.0045)
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "x.poly"), "w", encoding="utf-8") as file:
            file.write(poly())
        runs = {"Gmsh Frontal-Delaunay": lambda: by_gmsh(FRONTAL_DELAUNAY, options.size),
                "Gmsh BAMG": lambda: by_gmsh(BAMG, options.size),
                "carreau plane": lambda: by_carreau(options.program, folder, options.size),
                "... shape_trials=0": lambda: by_carreau(options.program, folder, options.size, "--set", "shape_trials=0")}
        print(f"{'':22} triangles   seconds   triangles/s  Q2 mean      1 %    worst")
        for name, run in runs.items():
            best = min((run() for _ in range(options.repeat)), key=lambda row: row["seconds"])
            print(f"{name:22} {best['triangles']:9d} {best['seconds']:9.3f} {best['triangles'] / best['seconds']:13.0f}  {best['q2_mean']:.4f}"
                  f"  {best['q2_p1']:.4f}  {best['q2_min']:.4f}")


if __name__ == "__main__":
    main()
