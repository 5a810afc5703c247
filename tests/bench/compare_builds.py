#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times of two builds for equal work: every program of tests/bench and runs of the command, by turns.

    python3 tests/bench/compare_builds.py BUILD_BEFORE BUILD_AFTER [CAD_FILE]... [--repeat N] [--only TEXT] [--json FILE]

Both are builds with -DCARREAU_BENCH=ON in which carreau_command and the benches are up to date. Seconds are processor
times (user and system), the least of N runs (3 by default) of each build, taken by turns; MB is the largest resident
size; "mesh" states if both write the same bytes. CAD files are meshed at 5, 2 and 1 % of their diagonals. A run that
one build fails at, or lacks, is reported and does not count."""
import argparse
import filecmp
import json
import math
import os
import subprocess
import sys
import tempfile

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
TEAPOT = os.path.join(ROOT, "fortran_examples/teapot/teapot.bpt")
DATA = os.path.join(ROOT, "tests/data")
SHARES = (5, 2, 1)
ROW = "{:52}{:>9}{:>9}{:>8}{:>7}{:>7}  {}"
SQUARE = "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n"

BENCHES = [
    "bench_algebra", "bench_control_space", "bench_fields 2", "bench_geometry 1", "bench_graded all all .26 20000", "bench_graded all all .11 100000",
    "bench_remesh 3", *(f"bench_metric {case} .02 10 3" for case in ("line", "circle", "spiral", "sine", "constant", "turning")),
    *(f"bench_plane {case} {h} 3" for case, h in (("square", .0048), ("square", .00152), ("sphere", .0054), ("torus", .0065), ("paraboloid", .01), ("hemisphere", .01),
                                                 ("swirl", .01), ("stretched", .01), ("sizes", .3), ("holes", .01), ("star", .01), ("disc", .01))),
    "bench_quads square .01 3", "bench_quads holes .01 3",
    *(f"bench_surface {case}" for case in ("paraboloid", "hemisphere", "torus", "teapot", "square", "sphere", "whole_torus"))]

# {file}: where the mesh goes.
COMMANDS = [
    *(f"plane {{square}} --size {h}" for h in (.0048, .00152, .00048)), *(f"mesh {TEAPOT} --size {h}" for h in (.1, .035, .011)),
    f"mesh {TEAPOT} --angle 8 --gradation 1.3", f"mesh {TEAPOT} --angle 8 --anisotropic", f"mesh {TEAPOT} --size .1 --element q1.0", f"mesh {TEAPOT} --size .1 --element p2",
    f"mesh {TEAPOT} --size .1 --independent", f"mesh {DATA}/molecule/caffeine.xyzr --surface ses --size .1", f"mesh {DATA}/molecule/1bna.pdb --surface ses --size .4",
    f"mesh {DATA}/grid/head.cyl --smooth 2000 --size 1%"]


def taken(command, folder):
    """Exit status, seconds of the processor and MB of a process."""
    with open(os.path.join(folder, "out.txt"), "wb") as out:
        child = subprocess.Popen(command, stdout=out, stderr=out, cwd=folder)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    return child.returncode, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def programs(build, words):
    """The command line in a build, or None where it has no such program."""
    name = words[0]
    path = os.path.join(build, "tests/bench", name) if name.startswith("bench_") else os.path.join(build, "cad_adapters/command/carreau")
    return [path, *words[1:]] if name.startswith("bench_") else [path, *words]


def compared(builds, words, repeat, folder):
    """A row: seconds and MB of both, whether meshes are the same."""
    best = [None, None]
    makes_mesh = not words[0].startswith("bench_")
    for _ in range(repeat):
        for k, build in enumerate(builds):
            command = programs(build, words)
            if not os.path.exists(command[0]):
                return {"problem": f"{'after' if k else 'before'}: not built"}
            if makes_mesh:
                command += ["-o", os.path.join(folder, f"{k}.meshb"), "--threads", "1", "-q"]
            status, seconds, size = taken(command, folder)
            if status not in (0, 1):
                return {"problem": f"{'after' if k else 'before'}: exit status {status}"}
            if best[k] is None or seconds < best[k][0]:
                best[k] = (seconds, size)
    row = {"before": best[0][0], "after": best[1][0], "before_mb": best[0][1], "after_mb": best[1][1]}
    if makes_mesh:
        row["same"] = filecmp.cmp(os.path.join(folder, "0.meshb"), os.path.join(folder, "1.meshb"), shallow=False)
    return row


def main():
    parser = argparse.ArgumentParser(description="What two builds take for the same work")
    parser.add_argument("before")
    parser.add_argument("after")
    parser.add_argument("files", nargs="*", help="CAD files")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--only", default="", help="runs whose name has this text")
    parser.add_argument("--json", help="file for all figures")
    options = parser.parse_args()
    builds = [os.path.abspath(options.before), os.path.abspath(options.after)]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        square = os.path.join(folder, "square.poly")
        with open(square, "w", encoding="utf-8") as file:
            file.write(SQUARE)
        lines = BENCHES + COMMANDS + [f"mesh {os.path.abspath(path)} --size {share}%" for path in options.files for share in SHARES]
        print(ROW.format("run", "before s", "after s", "ratio", "MB", "MB", "mesh"))
        for line in lines:
            name = " ".join(os.path.basename(word) for word in line.format(square="square.poly").split())
            if options.only not in name:
                continue
            row = {"run": name, **compared(builds, line.format(square=square).split(), options.repeat, folder)}
            rows.append(row)
            if "problem" in row:
                print(f"{name:52}{row['problem']}", flush=True)
                continue
            row["ratio"] = row["before"] / row["after"]
            same = {True: "same", False: "another"}.get(row.get("same"), "")
            print(ROW.format(name, "%.3f" % row["before"], "%.3f" % row["after"], "%.2f" % row["ratio"], "%d" % row["before_mb"], "%d" % row["after_mb"], same), flush=True)
    ratios = [row["ratio"] for row in rows if "ratio" in row]
    if ratios:
        print("geometric mean of the ratios: %.2f of %d runs" % (math.exp(sum(map(math.log, ratios)) / len(ratios)), len(ratios)))
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)
    return 0


if __name__ == "__main__":
    sys.exit(main())
