#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes CAD files by Gmsh with compound surfaces: faces that meet at less than a degree are parametrised again as one.

    apt-get install gmsh python3-gmsh python3-numpy
    python3 tests/bench/gmsh_compounds.py FILE... [--share 2%]... [--limit SECONDS]

Each run has a separate process, which ends after the limit. One line a file and a size, to be read beside the lines of
trans_patch.py: triangles, over ideal ones of the size, the area of the mesh over the area of the faces (failed faces
have no triangles), share of edges with lengths in [1/sqrt 2, sqrt 2] of the size, Q2 (mean, first percentile, worst),
seconds; or that it failed.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import time

from gmsh_runs import FRONTAL_DELAUNAY, np, quality, session, triangles

SMOOTH = math.cos(math.radians(1))
ROW = "{:30.30}{:>5}{:>9}{:>8}{:>8}{:>8}{:>8}{:>7}{:>7}{:>9}"


def is_smooth(model, curve, faces):
    """True if both faces have one tangent plane at three places of the curve."""
    low, high = model.getParametrizationBounds(1, curve)
    for share in (0.25, 0.5, 0.75):
        xyz = model.getValue(1, curve, [low[0] + share * (high[0] - low[0])])
        p, q = (model.getNormal(face, model.getParametrization(2, face, xyz)) for face in faces)
        if not abs(float(np.dot(p, q))) >= SMOOTH:
            return False
    return True


def compounds(model):
    """Faces that are smooth together, and the number of such sets."""
    root = {face: face for _, face in model.getEntities(2)}

    def find(face):
        while root[face] != face:
            face = root[face]
        return face

    for _, curve in model.getEntities(1):
        faces = list(model.getAdjacencies(1, curve)[0])
        if len(faces) == 2 and faces[0] != faces[1] and is_smooth(model, curve, faces):
            root[find(faces[0])] = find(faces[1])
    sets = {}
    for face in root:
        sets.setdefault(find(face), []).append(face)
    return [faces for faces in sets.values() if len(faces) > 1]


def one(path, share):
    with session(FRONTAL_DELAUNAY, 0, 1e22) as gmsh:
        gmsh.option.setNumber("Geometry.OCCBoundsUseStl", 1)  # else boxes are those of control points
        gmsh.merge(path)
        gmsh.model.occ.synchronize()
        low, high = np.array(gmsh.model.getBoundingBox(-1, -1)).reshape(2, 3)
        size = float(share.rstrip("%")) / 100 * float(np.linalg.norm(high - low))
        gmsh.option.setNumber("Mesh.MeshSizeMin", size)
        gmsh.option.setNumber("Mesh.MeshSizeMax", size)
        whole = sum(gmsh.model.occ.getMass(2, face) for _, face in gmsh.model.getEntities(2))
        sets = compounds(gmsh.model)
        for faces in sets:
            gmsh.model.mesh.setCompound(2, faces)
        start = time.process_time()
        gmsh.model.mesh.generate(2)
        seconds = time.process_time() - start
        points, corners = triangles()
        q2, areas = quality(points, corners)
        edges = np.unique(np.sort(corners[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
        lengths = np.linalg.norm(points[edges[:, 1]] - points[edges[:, 0]], axis=1) / size
        inside = float(((lengths > math.sqrt(0.5)) & (lengths < math.sqrt(2))).mean())
        area = float(areas.sum())
        return {"triangles": len(q2), "ideal": len(q2) * math.sqrt(3) / 4 * size * size / area, "area": 100 * area / whole,
                "range": 100 * inside, "mean": float(q2.mean()), "p1": float(np.percentile(q2, 1)), "worst": float(q2.min()),
                "seconds": seconds}


def attempt(path, share, limit):
    """Figures of one mesh, made by a process that ends after `limit` seconds; or a sentence with the reason for their
    absence."""
    try:
        done = subprocess.run([sys.executable, __file__, "--one", path, "--share", share], capture_output=True, text=True,
                              check=True, timeout=limit)
        return json.loads(done.stdout.strip().splitlines()[-1])
    except subprocess.TimeoutExpired:
        return f"not done after {limit:g} s"
    except (subprocess.CalledProcessError, ValueError, IndexError):
        return "failed"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--share", action="append")
    parser.add_argument("--limit", type=float, default=60)
    parser.add_argument("--one", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.one:
        print(json.dumps(one(options.files[0], options.share[0])))
        return
    print(ROW.format("file", "size", "tri", "ideal", "area", "range", "mean", "p1", "worst", "seconds"))
    for path in options.files:
        for share in options.share or ["5%", "2%", "1%"]:
            name = os.path.basename(path)
            f = attempt(path, share, options.limit)
            if isinstance(f, str):
                print(f"{name:30.30}{share:>5}  {f}", flush=True)
                continue
            print(ROW.format(name, share, f["triangles"], f"{f['ideal']:.3f}", f"{f['area']:.1f}", f"{f['range']:.2f}",
                             f"{f['mean']:.4f}", f"{f['p1']:.3f}", f"{f['worst']:.3f}", f"{f['seconds']:.2f}"), flush=True)


if __name__ == "__main__":
    main()
