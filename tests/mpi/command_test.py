#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`mpirun carreau mesh` and `adapt` write the files of one process, byte for byte; VTK reads every triangle of the .pvtu once; a
rank that is killed leaves no file.

    command_test.py <mpirun> <ranks> <carreau> <teapot.bpt> <python with VTK, or NONE>
"""
import glob
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time

import mpirun

MPIRUN, RANKS, CARREAU, TEAPOT, VTK = sys.argv[1], int(sys.argv[2]), *sys.argv[3:6]
HERE = os.path.dirname(os.path.abspath(__file__))
RUNS = [["--size", "0.2"], ["--angle", "8", "--gradation", "1.3"], ["--size", "0.25", "--independent"]]
ADAPTATION = ["--formula", "tanh(8 * (y - x^2 / 2))", "--tolerance", "0.002", "--gradation", "2"]
TRIANGLES_SIZE = "0.04"  # 80 000 triangles, which are remeshed in parts


def content(path):
    with open(path, "rb") as file:
        return file.read()


def alone(*arguments, **more):
    return subprocess.run([CARREAU, *arguments], capture_output=True, text=True, timeout=280, **more)


def same_files(folder):
    for i, options in enumerate(RUNS):
        one, many = f"{folder}/one{i}.meshb", f"{folder}/many{i}.meshb"
        first = alone("mesh", TEAPOT, *options, "-o", one, "-o", f"{folder}/one{i}.vtu")
        done = mpirun.run(MPIRUN, RANKS, CARREAU, "mesh", TEAPOT, *options, "-o", many, "-o", f"{folder}/many{i}.pvtu")
        assert done.returncode == first.returncode == 0, done.stdout + done.stderr
        assert content(one) == content(many), options
        # One rank prints.
        assert (done.stdout + done.stderr).count("32 faces, 128 sides") == 1, done.stdout + done.stderr
    assert not glob.glob(f"{folder}/.carreau-*"), os.listdir(folder)
    if VTK != "NONE":
        subprocess.run([VTK, f"{HERE}/read_pvtu.py", f"{folder}/many0.pvtu", f"{folder}/one0.vtu", str(RANKS)], check=True)


def sheet(corner, height):
    """A bicubic patch that is bent alike at any height."""
    return ["3 3"] + [f"{i / 3} {k / 3} {height + corner * i * (3 - i) * k / 9}" for i in range(4) for k in range(4)]


def same_pairs(folder):
    """Periodic faces: the master's mesh may be made by another process than the faces around. All elements match."""
    cell = f"{folder}/cell.bpt"
    with open(cell, "w", encoding="utf-8") as file:
        file.write("\n".join(["3", *sheet(.3, 0), *sheet(.3, 1), *sheet(-.2, 3)]) + "\n")
    for i, options in enumerate([["--size", "0.1"], ["--angle", "6", "--gradation", "1.3", "--element", "q2.0"]]):
        one, many = f"{folder}/pairs{i}.msh2", f"{folder}/pairs_of_many{i}.msh2"
        words = [*options, "--periodic", "0,0,1", "--periodic", "2=1"]
        first = alone("mesh", cell, *words, "-o", one)
        done = mpirun.run(MPIRUN, RANKS, CARREAU, "mesh", cell, *words, "-o", many)
        assert done.returncode == first.returncode == 0, first.stderr + done.stdout + done.stderr
        assert content(one) == content(many), options
        assert b"$Periodic" in content(one), first.stderr


def same_parts(folder):
    """Each rank keeps its part. The teapot's spout crosses its body: crossing triangles are found, and meshed again in vain, in parts,
    too."""
    for i, options in enumerate([["--size", "0.15"], ["--angle", "12", "--set", "crossing_rounds=3"]]):
        one, many = f"{folder}/one{i}.meshb", f"{folder}/many{i}.meshb"
        first = alone("mesh", TEAPOT, *options, "-o", one, "-o", f"{folder}/one{i}.vtu")
        done = mpirun.run(MPIRUN, RANKS, CARREAU, "mesh", TEAPOT, *options, "--parts", "-o", many, "-o", f"{folder}/many{i}.pvtu")
        assert done.returncode == first.returncode == 0, first.stderr + done.stdout + done.stderr
        assert content(one) == content(many), options
        said = done.stdout + done.stderr
        assert f"parts      {RANKS} {'process' if RANKS == 1 else 'processes'};" in said and "triangles cross" in said, said
        # The summary of the whole mesh is the summary of one process. Triangles that cross have no numbers in parts.
        for line in (first.stdout + first.stderr).splitlines():
            if line.startswith(("edges ", "faces ")) or "shape quality" in line or " vertices, " in line:
                assert line in said, (line, said)
    if VTK != "NONE":
        subprocess.run([VTK, f"{HERE}/read_pvtu.py", f"{folder}/many0.pvtu", f"{folder}/one0.vtu", str(RANKS), "kept"], check=True)
    before = sorted(os.listdir(folder))
    # These need the whole mesh: each process makes it, and keeps its part.
    for options in [["--element", "q1.0"], ["--angle", "12", "--gradation", "1.3"]]:
        one, many = f"{folder}/whole_one.meshb", f"{folder}/whole_many.meshb"
        first = alone("mesh", TEAPOT, "--size", "0.3", *options, "--json", "-o", one)
        done = mpirun.run(MPIRUN, RANKS, CARREAU, "mesh", TEAPOT, "--size", "0.3", *options, "--json", "--parts", "-o", many, "-o", f"{folder}/whole.pvtu")
        assert done.returncode == first.returncode == 0, (options, first.stderr + done.stderr)
        assert content(one) == content(many), options
        told, expected = json.loads(done.stdout), json.loads(first.stdout)
        assert told["processes"] == RANKS and told["closed"] == expected["closed"], options
        assert all(told["mesh"][key] == expected["mesh"][key] for key in ("vertices", "triangles")), (told["mesh"], expected["mesh"])
        for name in sorted(set(os.listdir(folder)) - set(before)):
            os.remove(f"{folder}/{name}")
    done = mpirun.run(MPIRUN, RANKS, CARREAU, "mesh", TEAPOT, "--size", "0.3", "--parts", "-o", f"{folder}/x.stl")
    assert done.returncode == 2 and ".stl" in done.stderr, (done.returncode, done.stderr)
    assert sorted(os.listdir(folder)) == before


def write_torus(path, around=48, across=24):
    nodes, triangles = [], []
    for i in range(around):
        for j in range(across):
            u, v = 2 * math.pi * i / around, 2 * math.pi * j / across
            radius = 2 + 0.7 * math.cos(v)
            nodes.append((radius * math.cos(u), radius * math.sin(u), 0.7 * math.sin(v)))
            a, d = i * across + j, i * across + (j + 1) % across
            b, c = (i + 1) % around * across + j, (i + 1) % around * across + (j + 1) % across
            triangles += [(a, b, c), (a, c, d)]
    with open(path, "w", encoding="ascii") as file:
        print("OFF", len(nodes), len(triangles), 0, sep="\n", file=file)
        for node in nodes:
            print(*map(repr, node), file=file)
        for triangle in triangles:
            print(3, *triangle, file=file)


def same_triangles(folder):
    torus, one, many = (f"{folder}/{name}" for name in ("torus.off", "one.meshb", "many.meshb"))
    write_torus(torus)
    first = alone("mesh", torus, "--size", TRIANGLES_SIZE, "-o", one)
    done = mpirun.run(MPIRUN, RANKS, CARREAU, "mesh", torus, "--size", TRIANGLES_SIZE, "-o", many)
    assert done.returncode == first.returncode == 0, first.stderr + done.stdout + done.stderr
    assert content(one) == content(many)
    # One rank reports a file that takes no byte, and the file does not change. Full disks: full_disk of ranks_program.
    full = f"{folder}/full.meshb"
    os.symlink("/dev/full", full)
    done = mpirun.run(MPIRUN, RANKS, CARREAU, "mesh", torus, "--size", "0.3", "-o", full, "-q")
    assert done.returncode == 2 and done.stderr.count("carreau: ") == 1, (done.returncode, done.stderr)
    assert os.path.islink(full) and sorted(os.listdir(folder)) == ["full.meshb", "many.meshb", "one.meshb", "torus.off"]


def write_square(path):
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    with open(path, "w", encoding="ascii") as file:
        print(4, 2, 0, 0, file=file)
        for i, (x, y) in enumerate(corners):
            print(i + 1, x, y, file=file)
        print("4 1", *(f"{i + 1} {i + 1} {(i + 1) % 4 + 1} {i + 1}" for i in range(4)), "0", sep="\n", file=file)


def write_fields(mesh, sol):
    with open(mesh, encoding="ascii") as file:
        words = file.read().split()
    start = words.index("Vertices")
    points = [(float(words[start + 2 + 3 * k]), float(words[start + 3 + 3 * k])) for k in range(int(words[start + 1]))]
    with open(sol, "w", encoding="ascii") as file:
        print("MeshVersionFormatted 2\nDimension 2\nSolAtVertices", len(points), "2 1 2", sep="\n", file=file)
        for x, y in points:
            print(repr(math.tanh(8 * (y - x * x / 2))), repr(x * y), repr(y), file=file)
        print("End", file=file)


def same_adaptations(folder):
    square = f"{folder}/square.poly"
    write_square(square)
    for i, options in enumerate([["--min", "0.01"], ["--min", "0.01", "--differences", "--shape", "anisotropic"]]):
        one, many = f"{folder}/one{i}.meshb", f"{folder}/many{i}.meshb"
        first = alone("adapt", square, *ADAPTATION, *options, "-o", one)
        done = mpirun.run(MPIRUN, RANKS, CARREAU, "adapt", square, *ADAPTATION, *options, "-o", many)
        assert done.returncode == first.returncode == 0, first.stderr + done.stdout + done.stderr
        assert content(one) == content(many), options
    # Adaptation by files: the estimate, and the fields on the next mesh.
    alone("plane", square, "--size", "0.05", "-o", f"{folder}/last.mesh")
    write_fields(f"{folder}/last.mesh", f"{folder}/last.sol")
    by_files = ["adapt", square, "--mesh", f"{folder}/last.mesh", "--sol", f"{folder}/last.sol", "--min", "0.01"]
    first = alone(*by_files, "-o", f"{folder}/next1.mesh")
    done = mpirun.run(MPIRUN, RANKS, CARREAU, *by_files, "-o", f"{folder}/next2.mesh")
    assert done.returncode == first.returncode == 0, first.stderr + done.stdout + done.stderr
    for suffix in (".mesh", ".sol"):
        assert content(f"{folder}/next1{suffix}") == content(f"{folder}/next2{suffix}"), suffix
    # A formula that has no value ends all ranks with one sentence.
    before = sorted(os.listdir(folder))
    done = mpirun.run(MPIRUN, RANKS, CARREAU, "adapt", square, "--formula", "log(x)", "-o", f"{folder}/none.mesh")
    assert done.returncode == 2 and done.stderr.count("carreau: ") == 1 and "log(x)" in done.stderr, (done.returncode, done.stderr)
    assert sorted(os.listdir(folder)) == before


def bad_input(folder):
    before = sorted(os.listdir(folder))
    done = mpirun.run(MPIRUN, RANKS, CARREAU, "mesh", f"{folder}/none.bpt", "--size", "1", "-o", f"{folder}/x.pvtu")
    assert done.returncode == 2 and done.stderr.count("carreau: cannot read") == 1, (done.returncode, done.stderr)
    done = mpirun.run(MPIRUN, RANKS, CARREAU, "mesh", TEAPOT, "--size", "1", "-o", f"{folder}/none/x.pvtu")
    assert done.returncode == 2 and done.stderr.count("carreau: '") == 1, (done.returncode, done.stderr)
    assert sorted(os.listdir(folder)) == before


def ranks_of(launcher):
    """Processes below mpirun that are the command."""
    found = []
    for stat in glob.glob("/proc/[0-9]*/stat"):
        try:
            fields = content(stat).decode().rsplit(")", 1)[1].split()
            name = os.readlink(os.path.dirname(stat) + "/exe")
        except OSError:
            continue  # it has ended
        if int(fields[1]) == launcher and os.path.basename(name) == "carreau":
            found.append(int(stat.split("/")[2]))
    return sorted(found)


def killed(folder, which, arguments, after):
    """`after`: seconds from when all ranks are there."""
    started = subprocess.Popen(mpirun.command(MPIRUN, RANKS, [CARREAU, *arguments, "-o", f"{folder}/x.meshb"]),
                               env=mpirun.environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        deadline = time.monotonic() + 60
        while len(ranks := ranks_of(started.pid)) < RANKS and time.monotonic() < deadline:
            time.sleep(0.02)
        assert len(ranks) == RANKS, ranks
        time.sleep(after)
        os.kill(ranks[which], signal.SIGKILL)
        _, errors = started.communicate(timeout=60)
    finally:
        started.kill()
    assert started.returncode != 0 and "signal 9" in errors, (started.returncode, errors)
    assert not os.listdir(folder), os.listdir(folder)


with tempfile.TemporaryDirectory() as temporary:
    same_files(temporary)
    same_pairs(temporary)
    bad_input(temporary)
with tempfile.TemporaryDirectory() as temporary:
    same_parts(temporary)
with tempfile.TemporaryDirectory() as temporary:
    same_triangles(temporary)
with tempfile.TemporaryDirectory() as temporary:
    same_adaptations(temporary)
with tempfile.TemporaryDirectory() as temporary, tempfile.TemporaryDirectory() as out:
    torus_file, square_file = f"{temporary}/torus.off", f"{temporary}/square.poly"
    write_torus(torus_file), write_square(square_file)
    for rank in {0, RANKS - 1}:
        killed(out, rank, ["mesh", TEAPOT, "--size", "0.012", "-o", f"{out}/x.pvtu"], 0.5)
    killed(out, RANKS - 1, ["mesh", TEAPOT, "--parts", "--size", "0.012", "-o", f"{out}/x.pvtu"], 0.5)
    # While parts are remeshed by edits, and while fields are estimated.
    killed(out, RANKS - 1, ["mesh", torus_file, "--size", "0.03", "--element", "p2"], 2)
    killed(out, RANKS - 1, ["adapt", square_file, *ADAPTATION, "--iterations", "50", "--min", "0.002"], 1.5)
print("the command holds on", RANKS, "ranks")
