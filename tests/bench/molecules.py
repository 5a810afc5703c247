#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""molecules.py CARREAU [--sizes 10000,100000] [--surfaces vws,sas,ses] [--shapes random,packed,lattice] [--no-meshes] [--limit SECONDS]:
seconds and memory of `carreau areas` and of `carreau mesh` for molecules from 24 atoms to 100 000.

Caffeine and 1BNA come from tests/data; the others are made here, with radii of 1.7, 1.55, 1.52 and 1.2 in the shares that
proteins have:

    random   independent places in a cube, 60 cubic angstrom each: most balls are bare
    packed   a globule of a protein's density (18 cubic angstrom an atom) whose atoms are 1.5 apart at least, by random addition
    lattice  the same globule from a face-centred lattice, each atom moved by .3 in each direction (standard deviation)

`carreau areas` measures all three surfaces; behind each stand area, volume and Euler's number. Seconds are clock and
processor times of the whole command, memory is the largest of the process. Edges have the length of --edges (VWS and
SES .6, SAS .8; 1.2 from 100 000 atoms on). The command searches its mesh for triangles that cross and writes a binary
mesh. A run that takes longer than --limit (3600 s) is ended.
"""
import argparse
import json
import math
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DATA = os.path.join(SOURCE, "tests/data/molecule")
RADII = ((1.7, 0.33), (1.55, 0.09), (1.52, 0.10), (1.2, 0.48))
SPACE_PACKED, SPACE_RANDOM, APART = 18.0, 60.0, 1.5


def radius(draw):
    share = draw.random()
    for value, part in RADII:
        share -= part
        if share < 0:
            return value
    return RADII[-1][0]


def places_random(n, draw):
    side = (n * SPACE_RANDOM) ** (1 / 3)
    return [tuple(draw.uniform(0, side) for _ in range(3)) for _ in range(n)]


def places_packed(n, draw):
    """In a ball; each new place is drawn again when it is too near to an earlier one."""
    ball = (3 * n * SPACE_PACKED / (4 * math.pi)) ** (1 / 3)
    cells, found = {}, []
    while len(found) < n:
        p = tuple(draw.uniform(-ball, ball) for _ in range(3))
        if sum(x * x for x in p) > ball * ball:
            continue
        at = tuple(math.floor(x / APART) for x in p)
        near = (q for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1) for q in cells.get((at[0] + dx, at[1] + dy, at[2] + dz), ()))
        if any(math.dist(p, q) < APART for q in near):
            continue
        cells.setdefault(at, []).append(p)
        found.append(p)
    return found


def places_lattice(n, draw):
    """The n nodes of a face-centred lattice that are nearest to its middle, moved."""
    step = (4 * SPACE_PACKED) ** (1 / 3)
    most = math.ceil((3 * n * SPACE_PACKED / (4 * math.pi)) ** (1 / 3) / step) + 2
    nodes = [(i + a, j + b, k + c) for i in range(-most, most) for j in range(-most, most) for k in range(-most, most)
             for a, b, c in ((0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5))]
    nodes.sort(key=lambda p: (p[0] ** 2 + p[1] ** 2 + p[2] ** 2, p))
    return [tuple(step * x + draw.gauss(0, 0.3) for x in p) for p in nodes[:n]]


PLACES = {"random": places_random, "packed": places_packed, "lattice": places_lattice}


def write_atoms(path, shape, n):
    draw = random.Random(n)
    with open(path, "w") as file:
        for p in PLACES[shape](n, draw):
            file.write(f"{p[0]:.4f} {p[1]:.4f} {p[2]:.4f} {radius(draw)}\n")


def run(command, limit):
    """Output, seconds, seconds of the processor, bytes; the output is None when the run was ended or has failed."""
    start, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    signal.signal(signal.SIGALRM, lambda *_: child.kill())
    signal.alarm(int(limit))
    out, err = child.communicate()
    signal.alarm(0)
    seconds, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if child.returncode not in (0, 1) or not out:
        print(err.strip().splitlines()[-1:] or f"ended after {seconds:.0f} s", file=sys.stderr)
        return None, seconds, processor
    return json.loads(out), seconds, processor


def peak(command, limit):
    """Measures in a separate process, whose children are this command alone: the system reports the largest memory of all of
    them."""
    done = subprocess.run([sys.executable, os.path.abspath(__file__), "--one", str(limit), *command], capture_output=True, text=True)
    if not done.stdout:
        return None
    return json.loads(done.stdout)


def one(limit, command):
    out, seconds, processor = run(command, limit)
    keep = None
    if out is not None and "mesh" in out:
        keep = {"triangles": out["mesh"]["triangles"], "q2": out["mesh"]["q2_mean"], "closed": out["closed"], "pairs": out["intersections"]["pairs"],
                "faces": len(out["faces"]), "failed": sum(f["status"] == "failed" for f in out["faces"]), "meshing": out["seconds"]["total"]}
    elif out is not None:
        keep = [[s["surface"], s["area"], s["volume"], s["euler_number"]] for s in out["surfaces"]]
    json.dump({"result": keep, "seconds": seconds, "processor": processor,
               "megabytes": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024}, sys.stdout)


def edge_of(surface, n, edges):
    return edges.get(surface) or (1.2 if n >= 100000 else 0.8 if surface == "sas" else 0.6)


def rows_of(name, path, n, given, edges):
    areas = peak([given.carreau, "areas", path, "--json"], given.limit)
    if areas and areas["result"]:
        print(f"{name:14}{n:8}  all  areas {areas['seconds']:9.2f} {areas['processor']:9.2f} {areas['megabytes']:8.0f}   " +
              "; ".join(f"{surface} {area:.4f}, {volume:.4f}, {euler}" for surface, area, volume, euler in areas["result"]), flush=True)
    for surface in [] if given.no_meshes else given.surfaces.split(","):
        h = edge_of(surface, n, edges)
        with tempfile.TemporaryDirectory() as folder:
            mesh = peak([given.carreau, "mesh", path, "--surface", surface, "--size", repr(h), "-q", "--json", "-o", os.path.join(folder, "x.meshb")], given.limit)
        if not mesh or not mesh["result"]:
            print(f"{name:14}{n:8}  {surface}  {h:5}  no mesh", flush=True)
            continue
        r = mesh["result"]
        print(f"{name:14}{n:8}  {surface}  {h:5} {mesh['seconds']:9.2f} {mesh['processor']:9.2f} {mesh['megabytes']:8.0f}   "
              f"{r['triangles']} triangles, Q2 {r['q2']:.4f}, {r['faces']} faces, {r['failed']} failed, {'closed' if r['closed'] else 'OPEN'}, "
              f"{r['pairs']} pairs cross, meshing {r['meshing']:.2f} s", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("carreau")
    parser.add_argument("--sizes", default="10000,100000")
    parser.add_argument("--surfaces", default="vws,sas,ses")
    parser.add_argument("--shapes", default="random,packed,lattice")
    parser.add_argument("--edges", default="", help="vws:0.5,ses:0.4: other lengths of edges")
    parser.add_argument("--no-meshes", action="store_true")
    parser.add_argument("--limit", type=float, default=3600)
    given = parser.parse_args()
    edges = {word.split(":")[0]: float(word.split(":")[1]) for word in given.edges.split(",") if word}
    print(f"{'atoms':>22}  of   edges   seconds processor       MB")
    rows_of("caffeine", os.path.join(DATA, "caffeine.xyzr"), 24, given, edges)
    rows_of("1BNA", os.path.join(DATA, "1bna.xyzr"), 486, given, edges)
    with tempfile.TemporaryDirectory() as folder:
        for n in (int(word) for word in given.sizes.split(",") if word):
            for shape in given.shapes.split(","):
                path = os.path.join(folder, f"{shape}.xyzr")
                write_atoms(path, shape, n)
                rows_of(shape, path, n, given, edges)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        one(float(sys.argv[2]), sys.argv[3:])
    else:
        main()
