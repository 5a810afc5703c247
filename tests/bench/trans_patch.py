#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes files with `carreau mesh`, with and without --independent, and prints both side by side.

    python3 tests/bench/trans_patch.py CARREAU FILE... [--share 2%]... [--repeat N] [--json FILE] [--gmsh SECONDS]

One line a file, a size and a mesh; with --gmsh a third line, of Gmsh with compound surfaces, or the reason for its
absence after so many seconds. (gmsh_compounds.py; x is its time over the time of `carreau mesh --independent`, area the
share of the faces' area that its mesh covers, since failed faces stay empty.)
  ideal    triangles over the number of equilateral triangles of the size with the area of the mesh
  range    share of edges with lengths in [1/sqrt 2, sqrt 2] in the prescribed metric, per cent
  away     range of edges whose ends are neither on a sharp line nor joined to one by an edge; their share of all edges,
           per cent
  idealA   triangles over ideal ones of the same area, away from sharp lines: no corner is on one or joined to one
  idealF   triangles over ideal ones, where triangles near sharp lines count as they are: the excess that sharp lines
           force
  Q2       mean, first percentile, worst (HDR eq. 1.6)
  A0, A1   largest distance over the size, largest angle in degrees, both measured on the surface
  bound    largest upper bound of A0 and A1 over their tolerances, of meshes with --independent
  x        time of meshing over the time without --independent, one thread, best of N runs
  tri/s    triangles of the mesh a second of the time that --independent adds
  evals    evaluations of surfaces a vertex
Exit status 1 where a mesh with --independent has a defect, is open and was closed, or has more triangles that cross.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

ROW = "{:30.30}{:>5} {:5}{:>8}{:>7}{:>7}{:>7}{:>6}{:>7}{:>7}{:>7}{:>7}{:>7}{:>7}{:>7}{:>7}{:>6}{:>9}{:>7}"
HEAD = ("file", "size", "mesh", "tri", "ideal", "range", "away", "of", "idealA", "idealF", "mean", "p1", "worst", "A0/h", "A1", "bound", "x", "tri/s", "evals")


def run(program, path, share, options, out):
    done = subprocess.run([program, "mesh", path, "--size", share, "--json", "--set", "threads=1", "-o", out, *options],
                          capture_output=True, text=True, check=False)
    return json.loads(done.stdout) if done.stdout else None


def defects(program, out):
    done = subprocess.run([program, "check", out], capture_output=True, text=True, check=False)
    return done.returncode != 0


def in_range(lengths):
    bounds, counts = lengths["histogram"]["bounds"], lengths["histogram"]["counts"]
    inside = sum(n for low, high, n in zip([-math.inf, *bounds], [*bounds, math.inf], counts)
                 if low > 0.7071 and high < 1.4143)
    return 100 * inside / lengths["count"]


def read_mesh(path):
    """Vertices, triangles, and edges with the reference of their curve."""
    with open(path, encoding="ascii") as file:
        words = file.read().split()
    lists, k = {"Vertices": [], "Triangles": [], "Edges": []}, 0
    width = {"Vertices": 4, "Triangles": 4, "Edges": 3}
    while k < len(words):
        name = words[k]
        k += 1
        if name in width:
            w, count = width[name], int(words[k])
            kind = float if name == "Vertices" else int
            lists[name] = [tuple(map(kind, words[k + 1 + w * i:k + 1 + w * (i + 1)])) for i in range(count)]
            k += 1 + w * count
    vertices = [v[:3] for v in lists["Vertices"]]
    triangles = [tuple(v - 1 for v in t[:3]) for t in lists["Triangles"]]
    return vertices, triangles, [(a - 1, b - 1, ref) for a, b, ref in lists["Edges"]]


def away_from_lines(path, size, sharp):
    """Shares of edges away from sharp lines, for a uniform size. `sharp`: references of curves; None: all that are left."""
    vertices, triangles, on_curves = read_mesh(path)
    lines = {v for a, b, ref in on_curves if sharp is None or ref in sharp for v in (a, b)}
    near = lines | {v for t in triangles if any(w in lines for w in t) for v in t}
    edges = {(min(a, b), max(a, b)) for t in triangles for a, b in zip(t, t[1:] + t[:1])}
    apart = [math.dist(vertices[a], vertices[b]) / size for a, b in edges if a not in near and b not in near]
    inside = sum(0.70711 <= x <= 1.41421 for x in apart)
    area, count = 0.0, 0
    for a, b, c in triangles:
        if a in near or b in near or c in near:
            continue
        p, q = ([x - y for x, y in zip(vertices[k], vertices[a])] for k in (b, c))
        n = (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
        area, count = area + math.hypot(*n) / 2, count + 1
    ideal = area / (math.sqrt(3) / 4 * size * size)
    return {"away": 100 * inside / len(apart) if apart else None, "away_of": 100 * len(apart) / len(edges),
            "ideal_away": count / ideal if count else None, "ideal_forced": len(triangles) / (len(triangles) - count + ideal),
            "lines": {ref for _, _, ref in on_curves}}


def figures(program, path, share, options, repeat, folder, sharp=None):
    out = os.path.join(folder, "x.mesh")
    seconds = math.inf
    for _ in range(repeat):
        plain = run(program, path, share, options, out)
        if plain is None or "mesh" not in plain:
            return None
        seconds = min(seconds, plain["seconds"]["total"])
    measured = run(program, path, share, [*options, "--set", "measure=1"], out)
    size = float(share.rstrip("%")) / 100 * plain["diagonal"] if share.endswith("%") else float(share)
    mesh, kinds = plain["mesh"], measured["delivered"]["measures"]
    away = away_from_lines(out, size, sharp)
    return away | {"triangles": mesh["triangles"], "ideal": mesh["triangles"] * math.sqrt(3) / 4 * size * size / mesh["area"],
            "range": in_range(kinds["metric_length"]), "mean": mesh["q2_mean"], "p1": mesh["q2_p1"], "worst": mesh["q2_min"],
            "a0": kinds["A0"]["max"] / size, "a1": kinds["A1"]["max"], "bound": kinds["bound_share"]["max"], "seconds": seconds,
            "evaluations": sum(plain["calls"][k] for k in ("surf0", "surf1", "surf2")) / mesh["vertices"],
            "closed": plain["closed"], "crossings": plain["intersections"]["pairs"], "defects": defects(program, out)}


def print_row(name, share, mesh, f, before):
    added = f["seconds"] - before["seconds"]
    speed = f"{f['triangles'] / added:.0f}" if f is not before and added > 0 else ""
    shown = ["" if f[k] is None else f"{f[k]:.{n}f}" for k, n in (("away", 2), ("away_of", 0), ("ideal_away", 3), ("ideal_forced", 3))]
    print(ROW.format(name, share, mesh, f["triangles"], f"{f['ideal']:.3f}", f"{f['range']:.2f}", *shown, f"{f['mean']:.4f}",
                     f"{f['p1']:.3f}", f"{f['worst']:.3f}", f"{f['a0']:.3f}", f"{f['a1']:.1f}",
                     "" if f["bound"] is None else f"{f['bound']:.2f}",
                     f"{f['seconds'] / before['seconds']:.2f}", speed, f"{f['evaluations']:.1f}"), flush=True)


def print_gmsh(name, share, f, free):
    if isinstance(f, str):
        print(f"{name:30.30}{share:>5} gmsh   {f}", flush=True)
        return
    print(ROW.format(name, share, "gmsh", f["triangles"], f"{f['ideal']:.3f}", f"{f['range']:.2f}", "", "", "", "",
                     f"{f['mean']:.4f}", f"{f['p1']:.3f}", f"{f['worst']:.3f}", "", "", "", f"{f['seconds'] / free['seconds']:.1f}",
                     "", ""),
          f" area {f['area']:.1f} %", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("files", nargs="+")
    parser.add_argument("--share", action="append")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--json")
    parser.add_argument("--gmsh", type=float, metavar="SECONDS")
    options = parser.parse_args()
    if options.gmsh:
        from gmsh_compounds import attempt  # asks for python3-gmsh, which the rest does without
    print(ROW.format(*HEAD))
    worse, results = False, {}
    with tempfile.TemporaryDirectory() as folder:
        for path in options.files:
            for share in options.share or ["5%", "2%", "1%"]:
                name = os.path.basename(path)
                after = figures(options.program, path, share, ["--independent"], options.repeat, folder)
                before = figures(options.program, path, share, [], options.repeat, folder, after and after["lines"])
                if before is None or after is None:
                    print(name, share, "not meshed")
                    worse = worse or before is not None
                    continue
                print_row(name, share, "cut", before, before)
                print_row(name, share, "free", after, before)
                before.pop("lines"), after.pop("lines")
                results[f"{name} {share}"] = {"cut": before, "free": after}
                if options.gmsh:
                    gmsh = attempt(path, share, options.gmsh)
                    print_gmsh(name, share, gmsh, after)
                    results[f"{name} {share}"]["gmsh"] = gmsh
                worse = worse or (after["defects"] and not before["defects"]) or (before["closed"] and not after["closed"]) \
                    or after["crossings"] > before["crossings"]
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(results, file, indent=1)
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
