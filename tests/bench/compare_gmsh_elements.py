#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Curved triangles of Gmsh (order 2, with and without its optimisation) and of `carreau mesh --element p2`, in one run.

    apt-get install gmsh python3-gmsh python3-numpy
    python3 tests/bench/compare_gmsh_elements.py CARREAU [FILE.step ...] [--share 60] [--repeat N] [--cases REGEX] [--json FILE]

Cases: the plate with a quarter of a disc cut out (HDR fig. 3.6), sphere, torus, teapot, and the files, whose sizes are the diagonals of
their boxes over a share. Times are processor times, one thread, with equal scope on both sides: from a model in memory
to a mesh in memory. For Gmsh these are generate(2), setOrder(2) and, where it is requested, optimize("HighOrder"); for
Carreau carreau_mesh_generate, which glues curves and finds their supports, too. `speed` is for the fastest of several
meshes of one process, as in a program that meshes; `first` is for the first mesh (of the command), whose code and
memory are new. `whole` is the program `carreau mesh` in milliseconds, from its start to its end, reading and writing
included. Both meshes are measured by `carreau check`: elements whose Bernstein coefficients are not all positive, least
Jacobian over its mean, shape, scaled Jacobian. Exit status 1 when a figure is missed: ten times the speed, mean shape
and worst scaled Jacobian above, and no invalid element.
"""
import json
import os
import subprocess
import sys
import tempfile
import time

from gmsh_runs import ROOT, build, element_options, file_of, finish, gmsh, run_process, session

WANTED = 10
WAYS = {"order 2": "", "order 2 optimised": "HighOrder", "order 2 elastic": "HighOrderElastic"}


CASES = [("plate", 0.05), ("plate", 0.2), ("sphere", 0.1), ("torus", 0.1), ("teapot", 0.1)]


MESHES = 5  # of one process


def gmsh_child(name, size, optimiser, out):
    with session(6, size, size):
        build(name)
        for _ in range(MESHES):
            gmsh.model.mesh.clear()
            start = time.process_time()
            gmsh.model.mesh.generate(2)
            gmsh.model.mesh.setOrder(2)
            if optimiser:
                gmsh.model.mesh.optimize(optimiser)
            print(time.process_time() - start)
        gmsh.option.setNumber("Mesh.SaveAll", 1)
        gmsh.write(out)


def carreau_child(path, size, out):
    sys.path.insert(0, os.path.join(ROOT, "cabi", "python"))
    import carreau
    from carreau import capi
    made = carreau.mesh(path, size=size, element="p2", threads=1)
    generate, handle = capi.lib().mesh_generate, made.session._handle
    for _ in range(MESHES):
        start = time.process_time()
        status = generate(handle)
        print(time.process_time() - start)
        if status != capi.OK:
            sys.exit(f"{path}: status {status}")
    made.session.mesh.write(out)


def child(arguments, environment=None):
    """Seconds of the first mesh and of the fastest one; None: it ends in a crash."""
    done = subprocess.run([sys.executable, os.path.abspath(__file__), *arguments], capture_output=True, text=True, check=False, env=environment)
    if done.returncode != 0:
        return None
    seconds = [float(line) for line in done.stdout.splitlines()[-MESHES:]]
    return seconds[0], min(seconds)


def checked(program, path, seconds, first):
    status, text, problem, _ = run_process([program, "check", path, "--json"])
    if status not in (0, 1):
        sys.exit(f"{path}: {problem}")
    row = json.loads(text)["elements"]
    return {**row, "seconds": seconds, "speed": row["triangles6"] / seconds, "first": row["triangles6"] / first, "whole": None}


def by_gmsh(program, name, size, way, repeat, folder):
    out = os.path.join(folder, "gmsh.msh")
    runs = [child(["--gmsh", name, repr(size), WAYS[way], out]) for _ in range(repeat)]
    if None in runs:
        return None
    return checked(program, out, min(fastest for _, fastest in runs), min(first for first, _ in runs))


def by_carreau(program, path, size, repeat, folder):
    out, first, whole = os.path.join(folder, "a.msh"), [], []
    for _ in range(repeat):
        command = [program, "mesh", path, "-o", out, "--size", repr(size), "--element", "p2", "--threads", "1", "--json", "-q"]
        status, text, problem, seconds = run_process(command)
        if status not in (0, 1):
            sys.exit(f"{' '.join(command)}: {problem}")
        first.append(json.loads(text)["seconds"]["processor"])
        whole.append(1e3 * seconds)
    build_folder = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(program))))
    folders = [os.path.join(build_folder, part) for part in ("cabi", "cad_adapters/cad", "lib")] + [os.environ.get("CARREAU_LIBRARY_PATH", "")]
    again = os.path.join(folder, "again.msh")
    runs = [child(["--carreau", path, repr(size), "", again], {**os.environ, "CARREAU_LIBRARY_PATH": os.pathsep.join(folders)}) for _ in range(repeat)]
    if None in runs:
        sys.exit(f"{path}: the package carreau has made no mesh; CARREAU_LIBRARY_PATH names the folders of its libraries")
    row = checked(program, out, min(fastest for _, fastest in runs), min(first))
    if checked(program, again, 1, 1)["triangles6"] != row["triangles6"]:
        sys.exit(f"{path}: the command and the package carreau have made meshes that differ")
    return {**row, "whole": min(whole)}


def show(who, row):
    if row is None:
        print(f"  {who:18} ends in a crash or without a mesh", flush=True)
        return
    whole = f"{row['whole']:8.1f}" if row["whole"] else " " * 8
    print(f"  {who:18}{row['triangles6']:8d}{row['speed']:10.0f}{row['first']:10.0f}{whole}{row['shape_mean']:8.3f}{row['shape_min']:8.3f}"
          f"{row['scaled_jacobian_min']:8.3f}{row['least_jacobian_min']:8.3f}{row['invalid']:8d}", flush=True)


def worse(ours, theirs):
    return [text for bad, text in ((ours["invalid"] > 0, "invalid elements"),
                                   (ours["speed"] < WANTED * theirs["speed"], "speed"),
                                   (ours["shape_mean"] <= theirs["shape_mean"], "mean shape"),
                                   (ours["scaled_jacobian_min"] <= theirs["scaled_jacobian_min"], "worst scaled Jacobian")) if bad]


def main():
    if len(sys.argv) == 6 and sys.argv[1] == "--gmsh":
        gmsh_child(sys.argv[2], float(sys.argv[3]), sys.argv[4], sys.argv[5])
        return 0
    if len(sys.argv) == 6 and sys.argv[1] == "--carreau":
        carreau_child(sys.argv[2], float(sys.argv[3]), sys.argv[5])
        return 0
    options, cases = element_options("Curved triangles of Carreau and Gmsh on the same shapes", CASES)
    print(f"  {'':18}{'elements':>8}{'speed /s':>10}{'first /s':>10}{'whole':>8}{'mean':>8}{'worst':>8}{'scaled':>8}{'least J':>8}{'invalid':>8}")
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
                print(f"    {ours['speed'] / theirs['speed']:.1f} times the speed, {ours['first'] / theirs['first']:.1f} of the first mesh"
                      f"{'; misses: ' if less else ''}{', '.join(less)}", flush=True)
                rows.append({"case": name, "size": size, "way": way, "gmsh": theirs, "carreau": ours})
    return finish(rows, missed, options.json)


sys.exit(main())
