#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes CAD files by Gmsh's Frontal-Delaunay and by `carreau mesh`, in one run, and prints a table of speed and quality.

    apt-get install gmsh python3-gmsh python3-numpy
    python3 tests/bench/compare_gmsh_cad.py CARREAU FILE... [--share 50]... [--repeat N] [--same-count] [--json FILE]

Each size is the diagonal of the file's box divided by a share (100 by default). Times are processor times, one thread,
the best of N runs (3 by default). They are for surface meshing alone (Gmsh's generate(1) and generate(2); for Carreau
all that is between reading and writing), and for the whole processes `gmsh` and `carreau mesh`, which read the file and
write a binary mesh. With --same-count the size of `carreau mesh` is moved until it has as many triangles as Gmsh (Gmsh
gives small circles seven edges, whatever the size). Quality is 4 sqrt(3) area / sum of squared edges (HDR eq. 1.6).
Exit status 1 if a file is worse than Gmsh's in a requirement: a failure that Gmsh does not have, speed below, mean or
worst quality below. A geometric mean of the ratios of speed in surface meshing below 5 gives status 1, too.
"""
import argparse
import itertools
import json
import math
import os
import sys
import tempfile
import time

from gmsh_runs import FRONTAL_DELAUNAY, PLAIN_SIZES, gmsh, quality, quality_row, run_process, session, triangles

WANTED = 5
ROW = "{:34}{:>7}{:>9}{:>9}{:>9}{:>7}{:>8}{:>8}{:>8}{:>7}"


class NotRead(Exception):
    """Gmsh cannot read a file."""


def open_file(path):
    # OpenCASCADE's own unit is the millimetre, and Gmsh 4.8 fails to set it before a STEP file has been read.
    gmsh.option.setString("Geometry.OCCTargetUnit", "")
    try:
        gmsh.model.occ.importShapes(path)
        gmsh.model.occ.synchronize()
    except Exception as problem:  # the binding raises no other class
        raise NotRead(str(problem) or "no reason is given") from problem


def diagonal(path):
    with session(FRONTAL_DELAUNAY, 0, 1):
        open_file(path)
        box = gmsh.model.getBoundingBox(-1, -1)
    return math.dist(box[:3], box[3:])


def by_gmsh(path, size):
    with session(FRONTAL_DELAUNAY, size, size):
        open_file(path)
        start = time.process_time()
        error = ""
        try:
            gmsh.model.mesh.generate(1)
            gmsh.model.mesh.generate(2)
        except Exception as problem:  # the binding raises no other class
            error = str(problem)
        seconds = time.process_time() - start
        failed = sum(not len(gmsh.model.mesh.getElements(2, face)[0]) for _, face in gmsh.model.getEntities(2))
        q2, _ = quality(*triangles())
    return {**quality_row(q2), "surface": seconds, "failed": failed, "error": error}


def whole_gmsh(path, size, folder):
    settings = [word for name, value in PLAIN_SIZES.items() for word in ("-setnumber", name, str(value))]
    command = ["gmsh", path, "-2", "-algo", "front2d", "-clmin", repr(size), "-clmax", repr(size), "-nt", "1", "-v", "0", *settings,
               "-setstring", "Geometry.OCCTargetUnit", "MM", "-bin", "-format", "msh41", "-o", os.path.join(folder, "a.msh")]
    return run_process(command)[3]


def by_carreau(program, path, size, folder):
    command = [program, "mesh", path, "-o", os.path.join(folder, "a.meshb"), "--size", repr(size), "--threads", "1", "--json", "-q"]
    status, out, problem, whole = run_process(command)
    if status not in (0, 1):
        return {"error": problem.strip()}
    summary = json.loads(out)
    return {**{key: summary["mesh"][key] for key in ("triangles", "q2_mean", "q2_p1", "q2_min")},
            "surface": summary["seconds"]["processor"], "whole": whole,
            "failed": sum(face["status"] == "failed" for face in summary["faces"]), "error": ""}


def size_of_count(program, path, size, wanted, folder):
    """A size with which Carreau makes as many triangles as requested, to 1 % where counts allow it."""
    low, high = 0.0, math.inf  # sizes with too many and too few triangles
    best = (math.inf, size)
    for _ in range(12):
        row = by_carreau(program, path, size, folder)
        if row["error"]:
            return size
        ratio = row["triangles"] / wanted
        best = min(best, (abs(math.log(ratio)), size))
        if best[0] < 0.01:
            break
        low, high = (max(low, size), high) if ratio > 1 else (low, min(high, size))
        guess = size * math.sqrt(ratio)
        size = guess if low < guess < high else math.sqrt(low * high) if low > 0 and high < math.inf else guess
    return best[1]


def compare(options, path, size):
    """Rows of both, and the figures that are worse in ours."""
    with tempfile.TemporaryDirectory() as folder:
        theirs = [{**by_gmsh(path, size), "whole": whole_gmsh(path, size, folder)} for _ in range(options.repeat)]
        if options.same_count:
            size = size_of_count(options.carreau, path, size, theirs[0]["triangles"], folder)
        ours = [by_carreau(options.carreau, path, size, folder) for _ in range(options.repeat)]
    if ours[0]["error"]:
        return theirs[0], ours[0], [ours[0]["error"]]

    def best(rows):
        return {**rows[0], **{key: min(row[key] for row in rows) for key in ("surface", "whole")}}
    g, c = best(theirs), best(ours)
    per_triangle = {key: g[key] / g["triangles"] / (c[key] / c["triangles"]) for key in ("surface", "whole")}
    c["times"] = per_triangle
    worse = [text for bad, text in ((c["failed"] > g["failed"], "fails more faces"), (per_triangle["surface"] < 1, "slower"),
                                    (g["whole"] < c["whole"], "slower as a process"),
                                    (c["q2_mean"] < g["q2_mean"], "mean quality below"),
                                    (c["q2_min"] < g["q2_min"], "worst quality below")) if bad]
    return g, c, worse


def show(name, row):
    print(ROW.format(name, "%.3g" % row.get("share", 0) if "share" in row else "", row["triangles"], "%.3f" % row["surface"],
                     "%.3f" % row["whole"], "%d" % row["failed"], *("%.4f" % row[key] for key in ("q2_mean", "q2_p1", "q2_min")), ""),
          row["error"], flush=True)


def main():
    parser = argparse.ArgumentParser(description="Carreau and Gmsh on the same CAD files")
    parser.add_argument("carreau", help="the program carreau")
    parser.add_argument("files", nargs="+")
    parser.add_argument("--share", action="append", type=float, help="size = diagonal / share; 100 by default")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--same-count", action="store_true", help="as many triangles as Gmsh, not the same size")
    parser.add_argument("--json", help="file for all figures")
    options = parser.parse_args()
    print(ROW.format("file, program", "diag/", "triangl.", "surface s", "whole s", "failed", "Q2 mean", "p1", "worst", ""))
    rows, worse, not_read = [], 0, 0
    for path, share in itertools.product(options.files, options.share or [100]):
        try:
            g, c, complaints = compare(options, path, diagonal(path) / share)
        except NotRead as problem:
            not_read += 1
            print(f"{os.path.basename(path)}: Gmsh cannot read it: {problem}", flush=True)
            continue
        worse += len(complaints) > 0
        show(os.path.basename(path), {**g, "share": share})
        if not c["error"]:
            show("    carreau", c)
            print("    %.1f times as fast a triangle in surface meshing, %.1f as a whole process; %s"
                  % (c["times"]["surface"], c["times"]["whole"], ", ".join(complaints) or "at least as good in all"), flush=True)
        else:
            print("    carreau:", c["error"])
        rows.append({"file": path, "share": share, "gmsh": g, "carreau": c, "worse": complaints})
    ratios = {key: [row["carreau"]["times"][key] for row in rows if "times" in row["carreau"]] for key in ("surface", "whole")}
    mean = {key: math.exp(sum(map(math.log, r)) / len(r)) if r else 0 for key, r in ratios.items()}
    print(f"geometric mean of the ratios of speed: surface meshing {mean['surface']:.2f} (wanted {WANTED}), whole process "
          f"{mean['whole']:.2f}; {worse} of {len(rows)} with a complaint, {not_read} that Gmsh cannot read")
    if options.json:
        with open(options.json, "w") as file:
            json.dump(rows, file, indent=1, default=float)
    return 1 if worse or mean["surface"] < WANTED else 0


if __name__ == "__main__":
    sys.exit(main())
