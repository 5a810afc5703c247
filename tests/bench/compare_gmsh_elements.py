#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Curved triangles of Gmsh (order 2, with and without its optimisation) and of `carreau mesh --element p2`, in one run.

    apt-get install gmsh python3-gmsh python3-numpy
    python3 tests/bench/compare_gmsh_elements.py CARREAU [FILE.step ...] [--share 60] [--repeat N] [--cases REGEX] [--json FILE]

Cases: the plate with a quarter of a disc cut out (HDR fig. 3.6), sphere, torus, teapot, and the files, whose sizes are the diagonals of
their boxes over a share. Times are those of the processor, one thread: Gmsh's generate(2), setOrder(2) and, where it is asked for,
optimize("HighOrder"); for Carreau all that is between reading and writing. Both meshes are measured by `carreau check`: elements whose
Bernstein coefficients are not all positive, least Jacobian over its mean, shape, scaled Jacobian. Exit status 1 when a figure is missed: ten times
the speed, mean shape and worst scaled Jacobian above, and no invalid element.
"""
import json
import os
import subprocess
import sys
import tempfile
import time

from gmsh_runs import build, element_options, file_of, finish, gmsh, run_process, session

WANTED = 10
WAYS = {"order 2": "", "order 2 optimised": "HighOrder", "order 2 elastic": "HighOrderElastic"}


CASES = [("plate", 0.05), ("plate", 0.2), ("sphere", 0.1), ("torus", 0.1), ("teapot", 0.1)]


def child(name, size, optimiser, out):
    with session(6, size, size):
        build(name)
        start = time.process_time()
        gmsh.model.mesh.generate(2)
        gmsh.model.mesh.setOrder(2)
        if optimiser:
            gmsh.model.mesh.optimize(optimiser)
        print(time.process_time() - start)
        gmsh.option.setNumber("Mesh.SaveAll", 1)
        gmsh.write(out)


def checked(program, path, seconds):
    status, text, problem, _ = run_process([program, "check", path, "--json"])
    if status not in (0, 1):
        sys.exit(f"{path}: {problem}")
    row = json.loads(text)["elements"]
    return {**row, "seconds": seconds, "speed": row["triangles6"] / seconds}


def by_gmsh(program, name, size, way, repeat, folder):
    out, best = os.path.join(folder, "gmsh.msh"), None
    for _ in range(repeat):
        command = [sys.executable, os.path.abspath(__file__), "--child", name, repr(size), WAYS[way], out]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return None
        seconds = float(done.stdout.splitlines()[-1])
        best = seconds if best is None else min(best, seconds)
    return checked(program, out, best)


def by_carreau(program, path, size, repeat, folder):
    out, best = os.path.join(folder, "a.msh"), None
    for _ in range(repeat):
        command = [program, "mesh", path, "-o", out, "--size", repr(size), "--element", "p2", "--threads", "1", "--json", "-q"]
        status, text, problem, _ = run_process(command)
        if status not in (0, 1):
            sys.exit(f"{' '.join(command)}: {problem}")
        seconds = json.loads(text)["seconds"]["processor"]
        best = seconds if best is None else min(best, seconds)
    return checked(program, out, best)


def show(who, row):
    if row is None:
        print(f"  {who:20} ends in a crash or without a mesh", flush=True)
        return
    print(f"  {who:20}{row['triangles6']:8d}{row['speed']:11.0f} /s{row['shape_mean']:8.3f}{row['shape_min']:8.3f}{row['scaled_jacobian_min']:9.3f}"
          f"{row['least_jacobian_min']:9.3f}{row['invalid']:8d}", flush=True)


def worse(ours, theirs):
    return [text for bad, text in ((ours["invalid"] > 0, "invalid elements"),
                                   (ours["speed"] < WANTED * theirs["speed"], f"{ours['speed'] / theirs['speed']:.1f} times the speed"),
                                   (ours["shape_mean"] <= theirs["shape_mean"], "mean shape"),
                                   (ours["scaled_jacobian_min"] <= theirs["scaled_jacobian_min"], "worst scaled Jacobian")) if bad]


def main():
    if len(sys.argv) == 6 and sys.argv[1] == "--child":
        child(sys.argv[2], float(sys.argv[3]), sys.argv[4], sys.argv[5])
        return 0
    options, cases = element_options("Curved triangles of Carreau and Gmsh on the same shapes", CASES)
    print(f"  {'':20}{'elements':>8}{'speed':>14}{'mean':>8}{'worst':>8}{'scaled':>9}{'least J':>9}{'invalid':>8}")
    rows, missed = [], 0
    with tempfile.TemporaryDirectory() as folder:
        for name, size in cases:
            print(f"{os.path.basename(name)} {size:.4g}", flush=True)
            ours = by_carreau(options.carreau, file_of(name, folder), size, options.repeat, folder)
            show("carreau p2", ours)
            for way in WAYS:
                theirs = by_gmsh(options.carreau, name, size, way, options.repeat, folder)
                show(way, theirs)
                if theirs is None:
                    continue
                less = worse(ours, theirs)
                missed += len(less)
                if less:
                    print(f"    misses: {', '.join(less)}", flush=True)
                rows.append({"case": name, "size": size, "way": way, "gmsh": theirs, "carreau": ours})
    return finish(rows, missed, options.json)


sys.exit(main())
