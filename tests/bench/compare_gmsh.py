#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes the same surfaces by Gmsh's Frontal-Delaunay and by Carreau, in one run, and prints speed and quality.

    apt-get install gmsh python3-gmsh python3-numpy
    cmake --preset bench && cmake --build --preset bench --target bench_surface
    python3 tests/bench/compare_gmsh.py build/bench/tests/bench/bench_surface [--near 5k|100k|1M]... [--cases REGEX]
                                        [--repeat N] [--json FILE]

Near a million triangles Gmsh takes a minute or so for each surface.

Both are timed on surface meshing alone, in one thread: Gmsh's generate(2) after generate(1), and Carreau's sampling, plane
meshing and lift after its curves. Times are processor times, so that a busy machine does not count. Sizes are
uniform. Quality is 4 sqrt(3) area / sum of squared edges of the triangles in space (HDR eq. 1.6), computed here for
Gmsh and by bench_surface for Carreau.
"""
import argparse
import json
import math
import os
import re
import subprocess
import sys
import time

from gmsh_runs import FRONTAL_DELAUNAY, ROOT, gmsh, np, quality, quality_row, session, teapot, triangles

# Case of bench_surface, size, number of triangles it is near, and the ratio of speeds to reach.
CASES = [
    ("paraboloid", 0.15462, "5k", None),
    ("paraboloid", 0.03558, "100k", 30),
    ("paraboloid", 0.011252, "1M", 30),
    ("hemisphere", 0.0121, "100k", 30),
    ("hemisphere", 0.00381, "1M", 30),
    ("torus", 0.0145, "100k", 30),
    ("torus", 0.0046, "1M", 30),
    ("teapot", 0.1, "13k", 15),
    ("teapot", 0.035, "100k", 15),
]
GROWTH = 1.3  # of our time per triangle, from 100k to 1M, at most


def paraboloid(occ):
    """z = (u^2 + v^2) / 2 on [-2.5, 2.5]^2, exactly: a biquadratic Bezier patch."""
    a = 2.5
    x, square = (-a, 0, a), (a * a, -a * a, a * a)  # Bezier coefficients of u and u^2
    occ.addBezierSurface([occ.addPoint(x[i], x[j], (square[i] + square[j]) / 2) for j in range(3) for i in range(3)], 3)


def hemisphere(occ):
    """Half of the unit sphere over the unit disc by stereographic projection, exactly: a rational biquadratic B-spline
    surface on [-1, 1]^2 (with a knot at 0, so that weights are positive), trimmed by the unit circle."""
    x, square = (-1, -0.5, 0.5, 1), (1, 0, 0, 1)  # B-spline coefficients of u and u^2
    points, weights = [], []
    for j in range(4):
        for i in range(4):
            s = square[i] + square[j]
            points.append(occ.addPoint(2 * x[i] / (1 + s), 2 * x[j] / (1 + s), (1 - s) / (1 + s)))
            weights.append(1 + s)
    knots, counts = [-1, 0, 1], [3, 1, 3]
    surface = occ.addBSplineSurface(points, 4, degreeU=2, degreeV=2, weights=weights, knotsU=knots, knotsV=knots,
                                    multiplicitiesU=counts, multiplicitiesV=counts)
    circle = occ.addWire([occ.addCircle(0, 0, 0, 1)])
    occ.addTrimmedSurface(surface, [circle])
    occ.remove([(2, surface)], recursive=True)


def torus(occ):
    """A quarter of the big circle (radius 2), half of the small one (radius 0.7), by angles."""
    arc = occ.addCircle(2, 0, 0, 0.7, angle1=0, angle2=math.pi)
    occ.rotate([(1, arc)], 2, 0, 0, 1, 0, 0, math.pi / 2)
    occ.revolve([(1, arc)], 0, 0, 0, 0, 0, 1, math.pi / 2)


GEOMETRY = {"paraboloid": paraboloid, "hemisphere": hemisphere, "torus": torus, "teapot": teapot}


def figures(points, corners):
    """Quality and counts, as bench_surface has them."""
    q2, areas = quality(points, corners)
    sides = np.sort(np.concatenate([corners[:, (k, (k + 1) % 3)] for k in range(3)]), axis=1)
    sides, count = np.unique(sides, axis=0, return_counts=True)
    degree = np.bincount(sides.ravel(), minlength=len(points))
    inside = degree > 0
    inside[sides[count == 1].ravel()] = False
    return {**quality_row(q2), "degree6": (degree[inside] == 6).mean(), "area": areas.sum()}


def by_gmsh(name, size):
    with session(FRONTAL_DELAUNAY, size, size):
        gmsh.model.add(name)
        GEOMETRY[name](gmsh.model.occ)
        gmsh.model.occ.synchronize()
        gmsh.model.mesh.generate(1)
        start = time.process_time()
        gmsh.model.mesh.generate(2)
        seconds = time.process_time() - start
        made = triangles()
    return {"case": name, "size": size, "seconds": seconds, **figures(*made)}


def by_carreau(program, name, size, repeat):
    done = subprocess.run([program, name, repr(size), str(repeat)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{program} {name} {size}: {done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])


def show(who, row):
    speed = row["triangles"] / row["seconds"]
    print(f"{row['case']:11}{row['size']:<10g}{who:9}{row['triangles']:9d}{row['seconds']:10.3f} s{speed:12.0f} /s"
          f"{row['q2_mean']:8.3f}{row['q2_p1']:7.3f}{row['q2_min']:7.3f}{100 * row['degree6']:7.1f} %"
          f"{row['area']:10.4f}", flush=True)
    return speed


def growth(rows):
    """Prints how much longer a triangle takes among a million than among 100 k; number of those above GROWTH."""
    cost = {(row["carreau"]["case"], row["near"]): row["carreau"]["seconds"] / row["carreau"]["triangles"] for row in rows}
    above = 0
    for (name, near), seconds in cost.items():
        if near == "1M" and (name, "100k") in cost:
            ratio = seconds / cost[name, "100k"]
            above += ratio > GROWTH
            print(f"{name}: {ratio:.2f} times the time per triangle of 100k, wanted {GROWTH} at most")
    return above


def main():
    parser = argparse.ArgumentParser(description="Carreau and Gmsh on the same surfaces")
    parser.add_argument("bench", nargs="?", default=os.path.join(ROOT, "build/bench/tests/bench/bench_surface"),
                        help="the program bench_surface")
    parser.add_argument("--near", action="append", choices=sorted({near for _, _, near, _ in CASES}),
                        help="only meshes near that many triangles; may be repeated")
    parser.add_argument("--cases", default="", help="those whose `name size` matches this regular expression")
    parser.add_argument("--repeat", type=int, default=3, help="runs, of which the best is taken (one of Gmsh when it is above 2 s)")
    parser.add_argument("--json", help="file for all figures")
    options = parser.parse_args()
    if not os.access(options.bench, os.X_OK):
        sys.exit(f"{options.bench} is not there. Type: cmake --preset bench && cmake --build --preset bench")

    print(f"{'case':11}{'size':10}{'by':9}{'triangles':>9}{'time':>12}{'speed':>15}{'mean':>8}{'p1':>7}{'worst':>7}"
          f"{'degree 6':>9}{'area':>10}")
    gmsh.initialize()
    version = gmsh.option.getString("General.Version")
    gmsh.finalize()
    rows, missed = [], 0
    for name, size, near, wanted in CASES:
        if not re.search(options.cases, f"{name} {size}") or (options.near and near not in options.near):
            continue
        theirs = by_gmsh(name, size)
        for _ in range(options.repeat - 1 if theirs["seconds"] < 2 else 0):
            theirs["seconds"] = min(theirs["seconds"], by_gmsh(name, size)["seconds"])
        ours = by_carreau(options.bench, name, size, options.repeat)
        slow, fast = show("gmsh", theirs), show("carreau", ours)
        text = f"  wanted {wanted}" if wanted else ""
        if wanted and fast / slow < wanted:
            missed += 1
            text += ": not reached"
        print(f"{'':30}{fast / slow:.1f} times the speed{text}\n", flush=True)
        rows.append({"near": near, "gmsh": theirs, "carreau": ours, "ratio": fast / slow, "wanted": wanted})
    missed += growth(rows)
    print(f"Gmsh {version}; {len(rows)} cases, {missed} figures below those wanted")
    if options.json:
        with open(options.json, "w") as file:
            json.dump(rows, file, indent=1)


main()
