"""What the comparisons with Gmsh share: its sessions, its triangles, the quality of triangles, time of processes."""
import contextlib
import math
import os
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
# What the command `gmsh` and the sessions here are told: sizes are as given, nothing else changes them.
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
