#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes a plane anisotropic field by Gmsh's BAMG, by FreeFem++'s adaptmesh and by Carreau, in one run, and prints speed and
quality in the metric.

    apt-get install gmsh python3-gmsh python3-numpy freefem++
    cmake --preset bench && cmake --build --preset bench --target bench_metric
    python3 tests/bench/compare_bamg.py build/bench/tests/bench/bench_metric [--sizes H,H..] [--ratio R] [--json FILE]

The field is a layer along y = sin x on [0, 2 pi] x [-2, 2]: size h across, ratio h along, growing by 0.2 a unit of distance.
Times are processor times, one thread: Gmsh's generate(2) after generate(1), the last of FreeFem++'s passes of
adaptmesh, and Carreau's control space and plane mesh together. Each pass of adaptmesh starts from the previous mesh,
with the field's own values at its vertices. Gmsh reads the field from Carreau's mesh at 0.7 h, linear in each triangle.
All three meshes are measured by the same code (tests/cpp/plane/metric_cases.cpp): lengths by Gauss quadrature in the
field itself, Q2 (HDR eq. 1.6) with lengths and area in the metric.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time

from gmsh_runs import BAMG, ROOT, gmsh, np, session
from gmsh_runs import triangles as triangles_of_gmsh

GMSH_TIMES, FREEFEM_TIMES = 20, 4  # as fast, at least

FREEFEM = """\
int passes = {passes};
mesh Th = square(63, 41, [2 * pi * x, -2 + 4 * y]);
real h = {h}, seconds = 0;
for (int pass = 0; pass < passes; ++pass) {{
  fespace Vh(Th, P1);
  Vh k = 1 / sqrt(1 + cos(x)^2), d = k * (y - sin(x));
  Vh along = 1 / ({ratio} * h)^2, across = 1 / min({ratio} * h, sqrt(h^2 + 0.04 * d^2))^2;
  Vh nx = -k * cos(x), ny = k;
  Vh m11 = across * nx^2 + along * ny^2, m12 = (across - along) * nx * ny, m22 = across * ny^2 + along * nx^2;
  real start = clock();
  Th = adaptmesh(Th, m11, m12, m22);
  seconds = clock() - start;
}}
cout << "SECONDS " << seconds << endl;
savemesh(Th, "{path}");
"""


def write(path, points, triangles):
    """As bench_metric reads it."""
    p = points[triangles]
    turned = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]) < 0
    triangles = np.where(turned[:, None], triangles[:, ::-1], triangles)
    with open(path, "w") as file:
        file.write(f"{len(points)} {len(triangles)}\n")
        np.savetxt(file, points, "%.17g")
        np.savetxt(file, triangles, "%d")


def metric(points, h, ratio):
    """m11, m12, m22 of the field."""
    slope = np.cos(points[:, 0])
    k = 1 / np.sqrt(1 + slope * slope)
    d = k * (points[:, 1] - np.sin(points[:, 0]))
    p = 1 / np.minimum(ratio * h, np.sqrt(h * h + 0.04 * d * d)) ** 2
    q = 1 / (ratio * h) ** 2
    nx, ny = -k * slope, k
    return p * nx * nx + q * ny * ny, (p - q) * nx * ny, p * ny * ny + q * nx * nx


def run(command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def measured(options, h, path):
    return json.loads(run([options.bench, "sine", repr(h), repr(options.ratio), "0", path]))


def by_carreau(options, h, path):
    row = json.loads(run([options.bench, "sine", repr(h), repr(options.ratio), "5", path]))
    return {**row, "seconds": row["meshing"] + row["sampling"]}


def by_gmsh(options, h, path, folder):
    fine = os.path.join(folder, "background")
    run([options.bench, "sine", repr(0.7 * h), repr(options.ratio), "1", fine])
    with open(fine) as file:
        n, m = map(int, file.readline().split())
        points = np.loadtxt(file, max_rows=n)
        triangles = np.loadtxt(file, max_rows=m, dtype=np.int64)
    m11, m12, m22 = metric(points, h, options.ratio)
    zero, one = np.zeros(n), np.full(n, 1 / (options.ratio * h) ** 2)
    tensor = np.stack([m11, m12, zero, m12, m22, zero, zero, zero, one], axis=1)
    p = points[triangles]
    table = np.concatenate([p[:, :, 0], p[:, :, 1], np.zeros((m, 3)), tensor[triangles].reshape(m, 27)], axis=1)
    with session(BAMG, h / 4, 4 * options.ratio * h):
        view = gmsh.view.add("metric")
        gmsh.view.addListData(view, "TT", m, table.ravel())
        field = gmsh.model.mesh.field.add("PostView")
        gmsh.model.mesh.field.setNumber(field, "ViewTag", view)
        gmsh.model.mesh.field.setAsBackgroundMesh(field)
        gmsh.model.occ.addRectangle(0, -2, 0, 2 * math.pi, 4)
        gmsh.model.occ.synchronize()
        gmsh.model.mesh.generate(1)
        start = time.process_time()
        gmsh.model.mesh.generate(2)
        seconds = time.process_time() - start
        made, corners = triangles_of_gmsh()
    write(path, made[:, :2], corners)
    return {**measured(options, h, path), "seconds": seconds}


def by_freefem(options, h, path, folder):
    script, made = os.path.join(folder, "adapt.edp"), os.path.join(folder, "adapted.msh")
    with open(script, "w") as file:
        file.write(FREEFEM.format(passes=options.passes, h=h, ratio=options.ratio, path=made)
                   .replace("m12, m22)", f"m12, m22, IsMetric=1, hmin={h / 4!r}, hmax={4 * options.ratio * h!r}, nbvx=2000000, "
                            f"anisomax={10 * options.ratio!r}, ratio=0)"))
    out = run(["FreeFem++", "-nw", "-v", "0", script])
    seconds = float(out.split("SECONDS")[1].split()[0])
    with open(made) as file:
        n, m, _ = map(int, file.readline().split())
        points = np.loadtxt(file, max_rows=n)[:, :2]
        triangles = np.loadtxt(file, max_rows=m, dtype=np.int64)[:, :3] - 1
    write(path, points, triangles)
    return {**measured(options, h, path), "seconds": seconds}


def show(h, who, row):
    speed = row["triangles"] / row["seconds"]
    print(f"{h:<9g}{who:11}{row['triangles']:9d}{row['seconds']:10.3f} s{speed:12.0f} /s{row['mean']:8.3f}{row['p1']:7.3f}"
          f"{row['worst']:7.3f}{row['length']:8.3f}{100 * row['fitting']:9.2f} %", flush=True)
    return speed


def main():
    parser = argparse.ArgumentParser(description="Carreau, Gmsh's BAMG and FreeFem++'s adaptmesh in the same field")
    parser.add_argument("bench", nargs="?", default=os.path.join(ROOT, "build/bench/tests/bench/bench_metric"),
                        help="the program bench_metric")
    parser.add_argument("--sizes", default="0.006,0.004,0.0027", help="sizes across the layer")
    parser.add_argument("--ratio", type=float, default=10)
    parser.add_argument("--passes", type=int, default=5, help="of adaptmesh")
    parser.add_argument("--json", help="file for all figures")
    options = parser.parse_args()
    if not os.access(options.bench, os.X_OK):
        sys.exit(f"{options.bench} is not there. Type: cmake --preset bench && cmake --build --preset bench")
    print(f"{'h':9}{'by':11}{'triangles':>9}{'time':>12}{'speed':>15}{'mean':>8}{'p1':>7}{'worst':>7}{'length':>8}"
          f"{'in range':>11}")
    rows, missed = [], 0
    for h in map(float, options.sizes.split(",")):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mesh")
            ours = by_carreau(options, h, path)
            theirs = {"gmsh": by_gmsh(options, h, path, folder), "freefem": by_freefem(options, h, path, folder)}
        fast = show(h, "carreau", ours)
        for who, wanted in (("gmsh", GMSH_TIMES), ("freefem", FREEFEM_TIMES)):
            ratio = fast / show(h, who, theirs[who])
            better = ours["mean"] > theirs[who]["mean"] and ours["fitting"] > theirs[who]["fitting"]
            missed += ratio < wanted or not better
            print(f"{'':9}{ratio:.1f} times the speed, wanted {wanted}; lengths and quality "
                  f"{'above' if better else 'NOT above'} theirs", flush=True)
        rows.append({"h": h, "carreau": ours, **theirs})
    print(f"{missed} comparisons below those wanted")
    if options.json:
        with open(options.json, "w") as file:
            json.dump(rows, file, indent=1)


main()
