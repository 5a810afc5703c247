#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes periodic cells by Gmsh and by `carreau mesh`, free and periodic, by patches, across them, and from triangles, in one run, and prints a table.

    apt-get install gmsh python3-gmsh python3-numpy
    python3 tests/bench/compare_periodic.py CARREAU MAKE_CELLS [--repeat N] [--json FILE]

The cells are unit cubes of MAKE_CELLS (tests/adapters/periodic). Times are processor times of surface meshing in one thread, the least of
N runs (5 by default). Quality is 4 sqrt(3) area / sum of squared edges. The mismatch is the largest distance of a vertex from the image of its
partner. Exit status 1: an overhead of pairs above 10 %, or a mismatch above 2e-12.
"""
import argparse
import itertools
import json
import os
import subprocess
import sys
import tempfile
import time

from gmsh_runs import FRONTAL_DELAUNAY, ROOT, gmsh, np, quality, quality_row, run_process, session, triangles

sys.path.append(os.path.join(ROOT, "tests", "adapters", "periodic"))
from periodic_files import Mesh  # noqa: E402

CELLS = (("cube", 0.03), ("fcc", 0.03), ("inclusions", 0.05), ("inclusions", 0.03))
PROGRAMS = ("Gmsh", "Carreau", "cross-patch", "triangles")  # the last two are kinds of Carreau's meshes
MAX_OVERHEAD, MAX_MISMATCH = 1.1, 2e-12
ROW = "{:12}{:>6}  {:21}{:>10}{:>9}{:>8}{:>8}{:>11}"


def make_periodic():
    """Pairs of faces on opposite sides of the unit cube, with their maps."""
    box = {tag: np.array(gmsh.model.getBoundingBox(2, tag)) for _, tag in gmsh.model.getEntities(2)}
    slaves = []
    for axis, master, slave in itertools.product(range(3), box, box):
        shift = np.zeros(6)
        shift[[axis, axis + 3]] = 1
        if np.abs(box[master] + shift - box[slave]).max() > 1e-4:
            continue
        affine = np.eye(4)
        affine[axis, 3] = 1
        gmsh.model.mesh.setPeriodic(2, [slave], [master], affine.ravel().tolist())
        slaves.append(slave)
    return slaves


def mismatch_of(slaves):
    worst = 0.
    for slave in slaves:
        _, nodes, masters, affine = gmsh.model.mesh.getPeriodicNodes(2, slave, True)
        affine = np.reshape(affine, (4, 4))
        for node, partner in zip(nodes, masters):
            y, x = (np.array(gmsh.model.mesh.getNode(n)[0]) for n in (node, partner))
            worst = max(worst, float(np.linalg.norm(affine[:3, :3] @ x + affine[:3, 3] - y)))
    return worst


def by_gmsh(path, size, periodic):
    with session(FRONTAL_DELAUNAY, size, size):
        gmsh.option.setString("Geometry.OCCTargetUnit", "")
        gmsh.model.occ.importShapes(path)
        gmsh.model.occ.synchronize()
        slaves = make_periodic() if periodic else []
        start = time.process_time()
        gmsh.model.mesh.generate(1)
        gmsh.model.mesh.generate(2)
        seconds = time.process_time() - start
        return {**quality_row(quality(*triangles())[0]), "seconds": seconds, "mismatch": mismatch_of(slaves) if slaves else None}


AXES = [word for axis in "xyz" for word in ("--periodic", axis)]


def triangles_of(program, path, size):
    """A file of triangles of the cell, half as large: its opposite sides match."""
    made = path.replace(".step", f"{size}.stl")
    if not os.path.exists(made):
        subprocess.run([program, "mesh", path, "-o", made, "--size", repr(size / 2), "-q", *AXES], check=True)
    return made


def by_carreau(program, path, size, periodic, folder, kind):
    out = os.path.join(folder, "cell.msh2")
    words = (AXES if periodic else []) + (["--cross-patch"] if kind == "cross-patch" else [])
    source = triangles_of(program, path, size) if kind == "triangles" else path
    status, text, problem, _ = run_process([program, "mesh", source, "-o", out, "--size", repr(size), "--threads", "1", "--json", "-q", *words])
    if status != 0:
        sys.exit(problem)
    summary = json.loads(text)
    figures = {key: summary["mesh"][key] for key in ("triangles", "q2_mean", "q2_p1", "q2_min")}
    return {**figures, "seconds": summary["seconds"]["processor"], "mismatch": Mesh(out).mismatch() if periodic else None}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("carreau")
    parser.add_argument("make_cells")
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--json")
    options = parser.parse_args()
    rows, missed = [], 0
    print(ROW.format("cell", "size", "mesh", "triangles", "seconds", "mean", "worst", "mismatch"))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([options.make_cells, folder], check=True, stdout=subprocess.DEVNULL)
        for cell, size in CELLS:
            path = os.path.join(folder, cell + ".step")
            made = {}
            for _ in range(options.repeat):  # kinds take turns, since the machine's speed varies
                for program, periodic in itertools.product(PROGRAMS, (False, True)):
                    row = by_gmsh(path, size, periodic) if program == "Gmsh" else by_carreau(options.carreau, path, size, periodic, folder, program)
                    known = made.setdefault((program, periodic), row)
                    known["seconds"] = min(known["seconds"], row["seconds"])
            for (program, periodic), row in made.items():
                mesh = f"{program} {'periodic' if periodic else 'free'}"
                rows.append({"cell": cell, "size": size, "mesh": mesh, **row})
                apart = "" if row["mismatch"] is None else f"{row['mismatch']:.1e}"
                print(ROW.format(cell, size, mesh, row["triangles"], f"{row['seconds']:.3f}", f"{row['q2_mean']:.4f}", f"{row['q2_min']:.3f}", apart), flush=True)
            for program in PROGRAMS[1:]:
                free, bound = made[program, False], made[program, True]
                missed += (bound["seconds"] > MAX_OVERHEAD * free["seconds"]) + (bound["mismatch"] > MAX_MISMATCH)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
