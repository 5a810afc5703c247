#!/usr/bin/python3
"""Meshes CAD files by Gmsh's Frontal-Delaunay and by `carreau mesh`, in one run, and prints speed and quality.

    apt-get install gmsh python3-gmsh python3-numpy
    python3 tests/bench/compare_gmsh_cad.py CARREAU FILE... [--share 50]... [--json FILE]

Each size is the diagonal of the file's box divided by a share (100 by default). Times are those of the processor, one
thread, on meshing of curves and surfaces: Gmsh's generate(1) and generate(2); for Carreau everything between reading and
writing. Quality is 4 sqrt(3) area / sum of squared edges (HDR eq. 1.6). Exit status 1 when a file is worse than Gmsh's
in anything that is asked: a failure that Gmsh does not have, speed below, mean or worst quality below, or a geometric
mean of the ratios of speed below 5.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time

sys.path.append("/usr/lib/python3/dist-packages")
try:
    import gmsh
    import numpy as np
except ImportError as error:
    sys.exit(f"{error}. Type: apt-get install gmsh python3-gmsh python3-numpy")

WANTED = 5


def by_gmsh(path, size):
    gmsh.initialize()
    try:
        for option, value in (("General.Terminal", 0), ("General.NumThreads", 1), ("Mesh.Algorithm", 6),
                              ("Mesh.MeshSizeMin", size), ("Mesh.MeshSizeMax", size),
                              ("Mesh.MeshSizeExtendFromBoundary", 0), ("Mesh.MeshSizeFromPoints", 0),
                              ("Mesh.MeshSizeFromCurvature", 0)):
            gmsh.option.setNumber(option, value)
        gmsh.option.setString("Geometry.OCCTargetUnit", "MM")
        gmsh.model.occ.importShapes(path)
        gmsh.model.occ.synchronize()
        start = time.process_time()
        failed = ""
        try:
            gmsh.model.mesh.generate(1)
            gmsh.model.mesh.generate(2)
        except Exception as error:  # the binding raises no other class
            failed = str(error)
        seconds = time.process_time() - start
        tags, xyz, _ = gmsh.model.mesh.getNodes()
        empty = 0
        for _, face in gmsh.model.getEntities(2):
            kinds, _, _ = gmsh.model.mesh.getElements(2, face)
            empty += len(kinds) == 0
        corners = np.concatenate([nodes for kind, _, nodes in zip(*gmsh.model.mesh.getElements(2)) if kind == 2])
    finally:
        gmsh.finalize()
    rank = np.zeros(int(max(tags)) + 1, dtype=np.int64)
    rank[np.asarray(tags, dtype=np.int64)] = np.arange(len(tags))
    p = np.asarray(xyz).reshape(-1, 3)[rank[np.asarray(corners, dtype=np.int64)].reshape(-1, 3)]
    edges = [p[:, (k + 1) % 3] - p[:, k] for k in range(3)]
    squares = sum((e * e).sum(axis=1) for e in edges)
    q2 = 4 * math.sqrt(3) * np.linalg.norm(np.cross(edges[0], edges[1]), axis=1) / 2 / squares
    return {"triangles": len(p), "seconds": seconds, "q2_mean": q2.mean(), "q2_p1": np.percentile(q2, 1),
            "q2_min": q2.min(), "failed": empty, "error": failed}


def by_carreau(program, path, size):
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([program, "mesh", path, "-o", os.path.join(folder, "a.meshb"), "--size", repr(size), "--threads",
                               "1", "--json", "-q"], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        return {"error": done.stderr.strip()}
    summary = json.loads(done.stdout)
    return {**{key: summary["mesh"][key] for key in ("triangles", "q2_mean", "q2_p1", "q2_min")},
            "seconds": summary["seconds"]["processor"], "failed": sum(f["status"] == "failed" for f in summary["faces"]),
            "error": ""}


def diagonal(path):
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setString("Geometry.OCCTargetUnit", "MM")
        gmsh.model.occ.importShapes(path)
        gmsh.model.occ.synchronize()
        box = gmsh.model.getBoundingBox(-1, -1)
    finally:
        gmsh.finalize()
    return math.dist(box[:3], box[3:])


def show(who, row):
    print(f"    {who:9}{row['triangles']:9d} triangles{row['seconds']:9.3f} s{row['triangles'] / row['seconds']:11.0f} /s  Q2 mean "
          f"{row['q2_mean']:.4f} p1 {row['q2_p1']:.4f} worst {row['q2_min']:.4f}  faces without mesh {row['failed']}"
          f"  {row['error']}", flush=True)


def main():
    parser = argparse.ArgumentParser(description="Carreau and Gmsh on the same CAD files")
    parser.add_argument("carreau", help="the program carreau")
    parser.add_argument("files", nargs="+")
    parser.add_argument("--share", action="append", type=float, help="size = diagonal / share; 100 by default")
    parser.add_argument("--json", help="file for all figures")
    options = parser.parse_args()
    rows, ratios, worse = [], [], 0
    for path in options.files:
        whole = diagonal(path)
        for share in options.share or [100]:
            size = whole / share
            print(f"{os.path.basename(path)}, diag/{share:g}", flush=True)
            theirs, ours = by_gmsh(path, size), by_carreau(options.carreau, path, size)
            show("gmsh", theirs)
            if ours["error"]:
                print(f"    carreau: {ours['error']}")
                worse += 1
                continue
            show("carreau", ours)
            ratio = ours["triangles"] / ours["seconds"] / (theirs["triangles"] / theirs["seconds"])
            ratios.append(ratio)
            complaints = [text for bad, text in ((ours["failed"] > theirs["failed"], "fails more faces"), (ratio < 1, "slower"),
                                                 (ours["q2_mean"] < theirs["q2_mean"], "mean quality below"),
                                                 (ours["q2_min"] < theirs["q2_min"], "worst quality below")) if bad]
            worse += len(complaints) > 0
            print(f"    {ratio:.1f} times the speed; {', '.join(complaints) or 'at least as good in all'}", flush=True)
            rows.append({"file": path, "share": share, "gmsh": theirs, "carreau": ours, "ratio": ratio})
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios)) if ratios else 0
    print(f"geometric mean of the ratios of speed: {mean:.2f}, wanted {WANTED}; {worse} of {len(rows)} with a complaint")
    if options.json:
        with open(options.json, "w") as file:
            json.dump(rows, file, indent=1, default=float)
    return 1 if worse or mean < WANTED else 0


if __name__ == "__main__":
    sys.exit(main())
