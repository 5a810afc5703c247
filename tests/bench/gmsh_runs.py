# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of the comparisons with Gmsh: its sessions, its triangles, the quality of triangles, time of processes."""
import argparse
import contextlib
import json
import math
import os
import re
import subprocess
import sys

sys.path.append("/usr/lib/python3/dist-packages")  # where Debian's python3-gmsh is, whatever python3 runs this
try:
    import gmsh
    import numpy as np
except ImportError as error:
    sys.exit(f"{error}. Type: apt-get install gmsh python3-gmsh python3-numpy")

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
FRONTAL_DELAUNAY, BAMG = 6, 7
# Options of the command `gmsh` and of the sessions here: sizes are as given, nothing else changes them.
PLAIN_SIZES = {"Mesh.MeshSizeExtendFromBoundary": 0, "Mesh.MeshSizeFromPoints": 0, "Mesh.MeshSizeFromCurvature": 0}


@contextlib.contextmanager
def session(algorithm, least, largest):
    """Gmsh in one thread, with sizes between two bounds."""
    gmsh.initialize()
    try:
        options = {"General.Terminal": 0, "General.NumThreads": 1, "Mesh.Algorithm": algorithm, "Mesh.MeshSizeMin": least,
                   "Mesh.MeshSizeMax": largest, **PLAIN_SIZES}
        for name, value in options.items():
            gmsh.option.setNumber(name, value)
        gmsh.option.setString("Geometry.OCCTargetUnit", "MM")
        yield gmsh
    finally:
        gmsh.finalize()


def triangles():
    """Points (n x 3) and triangles (m x 3, from 0) of the session's mesh."""
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    corners = np.concatenate([nodes for kind, _, nodes in zip(*gmsh.model.mesh.getElements(2)) if kind == 2])
    rank = np.zeros(int(max(tags)) + 1, dtype=np.int64)
    rank[np.asarray(tags, dtype=np.int64)] = np.arange(len(tags))
    return np.asarray(xyz).reshape(-1, 3), rank[np.asarray(corners, dtype=np.int64)].reshape(-1, 3)


def quality(points, corners):
    """4 sqrt(3) area / sum of squared edges of each triangle (HDR eq. 1.6), and the areas."""
    p = points[corners]
    edges = [p[:, (k + 1) % 3] - p[:, k] for k in range(3)]
    squares = sum((e * e).sum(axis=1) for e in edges)
    areas = np.linalg.norm(np.cross(edges[0], edges[1]), axis=1) / 2
    return 4 * math.sqrt(3) * areas / squares, areas


def quality_row(q2):
    return {"triangles": len(q2), "q2_mean": q2.mean(), "q2_p1": np.percentile(q2, 1), "q2_min": q2.min()}


def run_process(command):
    """Exit status, standard output, standard error, and seconds of the processor of a whole process."""
    before = os.times()
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    after = os.times()
    seconds = after.children_user + after.children_system - before.children_user - before.children_system
    return done.returncode, done.stdout, done.stderr, seconds


def plate(occ):
    """A square with a quarter of a disc cut out (HDR fig. 3.6)."""
    occ.cut([(2, occ.addRectangle(0, 0, 0, 1, 1))], [(2, occ.addDisk(1, 1, 0, 0.5, 0.5))])


TEAPOT = os.path.join(ROOT, "fortran_examples", "teapot", "teapot.bpt")


def teapot(occ):
    """32 bicubic Bezier patches, sides that are equal made one."""
    with open(TEAPOT) as file:
        words = file.read().split()
    at = 1
    for _ in range(int(words[0])):
        at += 2  # 3 3
        occ.addBezierSurface([occ.addPoint(*map(float, words[at + 3 * k:at + 3 * k + 3])) for k in range(16)], 4)
        at += 48
    occ.removeAllDuplicates()


SHAPES = {"plate": plate, "sphere": lambda occ: occ.addSphere(0, 0, 0, 1), "torus": lambda occ: occ.addTorus(0, 0, 0, 2, 0.7), "teapot": teapot}


def build(name):
    """One of SHAPES, or the file of that name, in the session."""
    if name in SHAPES:
        SHAPES[name](gmsh.model.occ)
    else:
        gmsh.option.setString("Geometry.OCCTargetUnit", "")
        gmsh.model.occ.importShapes(name)
    gmsh.model.occ.synchronize()


def file_of(name, folder):
    """The input of `carreau mesh`."""
    if name == "teapot":
        return TEAPOT
    if name not in SHAPES:
        return name
    path = os.path.join(folder, name + ".step")
    with session(FRONTAL_DELAUNAY, 0, 1):
        build(name)
        gmsh.write(path)
    return path


def diagonal(path):
    with session(FRONTAL_DELAUNAY, 0, 1):
        build(path)
        box = gmsh.model.getBoundingBox(-1, -1)
    return math.dist(box[:3], box[3:])


def element_options(description, cases):
    """The command line of a comparison of elements, and its cases: names or files, and sizes."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("carreau", help="the program carreau")
    parser.add_argument("files", nargs="*", help="CAD files")
    parser.add_argument("--share", type=float, default=60, help="sizes of files: diagonal / share")
    parser.add_argument("--repeat", type=int, default=1, help="runs, of which the fastest counts")
    parser.add_argument("--cases", default="", help="those whose `name size` matches this regular expression")
    parser.add_argument("--json", help="file for all figures")
    options = parser.parse_args()
    every = cases + [(path, diagonal(path) / options.share) for path in options.files]
    return options, [case for case in every if re.search(options.cases, f"{case[0]} {case[1]}")]


def finish(rows, missed, path):
    """Prints how many figures were missed, and writes all; the exit status."""
    print(f"{len(rows)} comparisons, {missed} figures below those wanted")
    if path:
        with open(path, "w") as file:
            json.dump(rows, file, indent=1)
    return 1 if missed else 0
