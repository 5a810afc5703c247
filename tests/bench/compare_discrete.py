#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""compare_discrete.py BUILD FILE... [--size SHARE] [--sharp DEGREES]: surfaces given as triangles, by Carreau, Gmsh and CGAL in one run.

Gmsh: merge, classifySurfaces, createGeometry, generate(2); CGAL: detect_sharp_edges, isotropic_remeshing. One thread each; seconds are
for meshing, without reading and writing; "whole" is for the whole command, with measuring and bounds of distances. Distances are shares
of the size: from the mesh to the triangles, back, and from the sharp lines of the file to the sharp lines of the mesh.
CGAL's program is built on request:

    cmake --build BUILD --target carreau_command bench_distance bench_cgal_remeshing
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time

import gmsh_runs


def by_gmsh(path, target, size, sharp):
    with gmsh_runs.session(gmsh_runs.FRONTAL_DELAUNAY, size, size) as gmsh:
        gmsh.merge(path)
        start = time.perf_counter()
        gmsh.model.mesh.removeDuplicateNodes()
        gmsh.model.mesh.classifySurfaces(sharp * math.pi / 180, True, True, math.pi)
        gmsh.model.mesh.createGeometry()
        gmsh.model.mesh.generate(2)
        seconds = time.perf_counter() - start
        gmsh.option.setNumber("Mesh.SaveAll", 1)
        gmsh.write(target)
    return seconds


def row(name, seconds, build, target, path, size, sharp, whole=None):
    command = os.path.join(build, "cad_adapters/command/carreau")
    quality = json.loads(subprocess.run([command, "check", target, "--json"], capture_output=True, text=True).stdout)
    far = subprocess.run([os.path.join(build, "tests/bench/bench_distance"), target, path, str(sharp)], capture_output=True, text=True).stdout.split()
    q = quality["quality"]
    if not far:
        print(f"{os.path.basename(path):14} {name:8} no mesh that can be read")
        return
    print(f"{os.path.basename(path):14} {name:8} {quality['triangles']:8} {seconds:8.3f} {f'{whole:6.3f}' if whole else '     -'} {q['q2_mean']:7.4f} {q['q2_min']:7.4f} " +
          " ".join(f"{float(x) / size:8.4f}" if float(x) < 1e100 else "    none" for x in far[:3]) +
          f" {float(far[6]) / size:8.4f} {float(far[8]) / size:8.4f} {far[3]:>6}/{far[4]}")
    sys.stdout.flush()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("files", nargs="+")
    parser.add_argument("--size", type=float, default=0.01, help="share of the diagonal")
    parser.add_argument("--sharp", type=float, default=45)
    given = parser.parse_args()
    command = os.path.join(given.build, "cad_adapters/command/carreau")
    for program in (command, *(os.path.join(given.build, "tests/bench", name) for name in ("bench_distance", "bench_cgal_remeshing"))):
        if not os.access(program, os.X_OK):
            sys.exit(f"{program} is not there. Type: cmake --build {given.build} --target carreau_command bench_distance bench_cgal_remeshing")
    print("file           by      triangles  seconds  whole Q2 mean   worst  to file    back    lines  bounds of both    sharp edges of mesh/file")
    for path in given.files:
        diagonal = json.loads(subprocess.run([command, "info", path, "--json"], capture_output=True, text=True).stdout)["diagonal"]
        size = given.size * diagonal
        with tempfile.TemporaryDirectory() as folder:
            stl = os.path.join(folder, "in.stl")
            subprocess.run([command, "refine", path, "-o", stl, "-q"], check=True)
            target = os.path.join(folder, "carreau.mesh")
            start = time.perf_counter()
            done = subprocess.run([command, "mesh", path, "-o", target, "--size", repr(size), "--sharp", str(given.sharp), "--threads", "1", "--json", "-q"],
                                  capture_output=True, text=True)
            whole = time.perf_counter() - start
            if done.returncode != 0:
                print(done.stderr)
            row("Carreau", json.loads(done.stdout)["seconds"]["total"], given.build, target, path, size, given.sharp, whole)
            target = os.path.join(folder, "gmsh.stl")
            try:
                start = time.perf_counter()
                child = subprocess.run([sys.executable, __file__, "--one", stl, target, repr(size), str(given.sharp)], capture_output=True, text=True, timeout=600)
                row("Gmsh", float(child.stdout.split()[-1]), given.build, target, path, size, given.sharp)
            except Exception as error:  # it may fail, and end its process
                print(f"{os.path.basename(path):14} Gmsh     failed: {str(child.stderr).strip().splitlines()[-1:] or error}")
            target = os.path.join(folder, "cgal.off")
            done = subprocess.run([os.path.join(given.build, "tests/bench/bench_cgal_remeshing"), path, target, repr(size), str(given.sharp)], capture_output=True, text=True)
            if done.returncode == 0:
                row("CGAL", float(done.stdout), given.build, target, path, size, given.sharp)
            else:
                print(f"{os.path.basename(path):14} CGAL     failed: {done.stderr.strip().splitlines()[:1]}")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        print(by_gmsh(sys.argv[2], sys.argv[3], float(sys.argv[4]), float(sys.argv[5])))
    else:
        main()
