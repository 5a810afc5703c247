#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Quadrilaterals of Gmsh and of `carreau mesh` on the same shapes, in one run: speed, quality, scaled Jacobian.

    apt-get install gmsh python3-gmsh python3-numpy
    python3 tests/bench/compare_gmsh_quads.py CARREAU [FILE.step ...] [--share 60] [--repeat N] [--cases REGEX] [--json FILE]

Cases: the plate with a quarter of a disc cut out (HDR fig. 3.6), sphere, torus, teapot, and the files, whose sizes are the
diagonals of their boxes over a share. Gmsh's ways: Frontal-Delaunay for quads (8) and packing of parallelograms (9), each with
Blossom and with Blossom full-quad, and Frontal-Delaunay (6) with Blossom; each runs in a separate process, since some
crash. Full-quad cuts each quadrilateral into four, whatever the bounds of sizes: it gets twice the size, so that all
deliver equal sizes. Times are processor times, one thread: Gmsh's generate(1) and generate(2); for Carreau all
that is between reading and writing. Quality is (2 + 2 sqrt 2) rho / h (HDR sec. 1.1.1), in space. Exit status 1 when a
figure is missed: ten times the speed in quadrilaterals a second, mean quality and worst scaled Jacobian above every way
that ends.
"""
import json
import math
import os
import subprocess
import sys
import tempfile
import time

from gmsh_runs import build, element_options, file_of, finish, gmsh, np, run_process, session

WAYS = {"front-quads blossom": (8, 1), "front-quads full": (8, 3), "packing blossom": (9, 1), "packing full": (9, 3), "front blossom": (6, 1)}
FULL = ("front-quads full", "packing full")
WANTED = 10


CASES = [("plate", 0.05), ("plate", 0.01), ("sphere", 0.1), ("sphere", 0.03), ("torus", 0.1), ("teapot", 0.1)]


def shapes(points, quads):
    """Quality and scaled Jacobian of quadrilaterals, about the normals of their diagonals."""
    p = points[quads]
    edges = [p[:, (k + 1) % 4] - p[:, k] for k in range(4)]
    sides = [np.linalg.norm(e, axis=1) for e in edges]
    diagonals = [np.linalg.norm(p[:, k + 2] - p[:, k], axis=1) for k in range(2)]
    normal = np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    rho, jacobian = [], []
    for k in range(4):
        area2 = (np.cross(edges[k - 1], edges[k]) * normal).sum(axis=1)
        rho.append(area2 / (sides[k - 1] + sides[k] + diagonals[(k + 1) % 2]))
        jacobian.append(area2 / np.maximum(sides[k - 1] * sides[k], 1e-300))
    diameter = np.max(sides + diagonals, axis=0)
    return np.maximum((2 + 2 * math.sqrt(2)) * np.min(rho, axis=0) / diameter, 0), np.min(jacobian, axis=0)


def row_of(points, quads, triangles, seconds):
    quality, jacobian = shapes(points, quads)
    p = points[triangles] if len(triangles) else np.zeros((0, 3, 3))
    t_area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum() / 2
    q = points[quads]
    q_area = np.linalg.norm(np.cross(q[:, 2] - q[:, 0], q[:, 3] - q[:, 1]), axis=1).sum() / 2
    return {"quads": len(quads), "triangle_share": t_area / (t_area + q_area), "seconds": seconds, "mean": quality.mean(),
            "worst": quality.min(), "jacobian": jacobian.min(), "speed": len(quads) / seconds}


def child(name, size, algorithm, recombination):
    asked = 2 * size if recombination == 3 else size
    with session(algorithm, asked, asked):
        gmsh.option.setNumber("Mesh.RecombineAll", 1)
        gmsh.option.setNumber("Mesh.RecombinationAlgorithm", recombination)
        build(name)
        start = time.process_time()
        gmsh.model.mesh.generate(1)
        gmsh.model.mesh.generate(2)
        seconds = time.process_time() - start
        tags, xyz, _ = gmsh.model.mesh.getNodes()
        rank = np.zeros(int(max(tags)) + 1, dtype=np.int64)
        rank[np.asarray(tags, dtype=np.int64)] = np.arange(len(tags))
        cells = {kind: np.zeros((0, kind + 1), dtype=np.int64) for kind in (2, 3)}
        for kind, _, nodes in zip(*gmsh.model.mesh.getElements(2)):
            cells[kind] = rank[np.asarray(nodes, dtype=np.int64)].reshape(-1, kind + 1)
        print(json.dumps(row_of(np.asarray(xyz).reshape(-1, 3), cells[3], cells[2], seconds)))


def by_gmsh(name, size, way, repeat):
    rows = []
    for _ in range(repeat):
        command = [sys.executable, os.path.abspath(__file__), "--child", name, repr(size), *map(str, WAYS[way])]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return None
        rows.append(json.loads(done.stdout.splitlines()[-1]))
    return {**rows[0], "seconds": min(row["seconds"] for row in rows), "speed": max(row["speed"] for row in rows)}


def read_medit(path):
    """Vertices, quadrilaterals, triangles of an ASCII .mesh file."""
    found = {}
    with open(path) as file:
        words = iter(file.read().split())
    width = {"Vertices": 4, "Triangles": 4, "Quadrilaterals": 5}
    for word in words:
        if word in width:
            count = int(next(words))
            found[word] = np.array([float(next(words)) for _ in range(count * width[word])]).reshape(count, width[word])[:, :-1]
    empty = {"Quadrilaterals": np.zeros((0, 4)), "Triangles": np.zeros((0, 3))}
    corners = [(found.get(key, empty[key]) - 1).astype(np.int64) for key in ("Quadrilaterals", "Triangles")]
    return found["Vertices"], *corners


def by_carreau(program, path, size, element, repeat, folder):
    best = None
    for _ in range(repeat):
        out = os.path.join(folder, "a.mesh")
        command = [program, "mesh", path, "-o", out, "--size", repr(size), "--element", element, "--threads", "1", "--json", "-q"]
        status, text, problem, _ = run_process(command)
        if status not in (0, 1):
            sys.exit(f"{' '.join(command)}: {problem}")
        row = row_of(*read_medit(out), json.loads(text)["seconds"]["processor"])
        best = row if best is None or row["seconds"] < best["seconds"] else best
    return best


def show(who, row):
    if row is None:
        print(f"  {who:22} ends in a crash or without a mesh", flush=True)
        return
    print(f"  {who:22}{row['quads']:8d}{100 * row['triangle_share']:8.2f} %{row['speed']:11.0f} /s{row['mean']:8.3f}{row['worst']:8.3f}"
          f"{row['jacobian']:8.3f}", flush=True)


def worse(ours, theirs):
    return [text for bad, text in ((ours["speed"] < WANTED * theirs["speed"], f"{ours['speed'] / theirs['speed']:.1f} times the speed"),
                                   (ours["mean"] <= theirs["mean"], "mean quality"),
                                   (ours["jacobian"] <= theirs["jacobian"], "worst Jacobian")) if bad]


def main():
    if len(sys.argv) == 6 and sys.argv[1] == "--child":
        child(sys.argv[2], float(sys.argv[3]), int(sys.argv[4]), int(sys.argv[5]))
        return 0
    options, cases = element_options("Quadrilaterals of Carreau and Gmsh on the same shapes", CASES)
    print(f"  {'':22}{'quads':>8}{'triangles':>10}{'speed':>14}{'mean':>8}{'worst':>8}{'Jacobian':>9}")
    rows, missed = [], 0
    with tempfile.TemporaryDirectory() as folder:
        for name, size in cases:
            print(f"{os.path.basename(name)} {size:.4g}", flush=True)
            path = file_of(name, folder)
            ours = {e: by_carreau(options.carreau, path, size, e, options.repeat, folder) for e in ("q1.0", "q1.1")}
            for element, row in ours.items():
                show("carreau " + element, row)
            for way in WAYS:
                theirs = by_gmsh(name, size, way, options.repeat)
                show(way, theirs)
                if theirs is None:
                    continue
                element = "q1.1" if way in FULL else "q1.0"
                less = worse(ours[element], theirs)
                missed += len(less)
                if less:
                    print(f"    {element} misses: {', '.join(less)}", flush=True)
                rows.append({"case": name, "size": size, "way": way, "element": element, "gmsh": theirs, "carreau": ours[element]})
    return finish(rows, missed, options.json)


sys.exit(main())
