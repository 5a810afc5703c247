#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""run.py BUILD [--long] [--only NAME]...: runs the benchmarks of docs/reference/benchmarks.md and writes that page. docs/benchmarks/run.json keeps the figures
with the machine, its load, the versions and the date of the commit.

BUILD: a build with -DCARREAU_BENCH=ON in which carreau_command and bench_surface are up to date. Needs Debian's gmsh, python3-gmsh, python3-numpy.
--long: meshes of a million triangles, too, and three repetitions of each run."""
import argparse
import json
import os
import platform
import re
import subprocess
import sys
import tempfile
import time

import page

FOLDER = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.path.dirname(os.path.dirname(FOLDER))
BENCH = os.path.join(SOURCE, "tests/bench")
TEAPOT = os.path.join(SOURCE, "fortran_examples/teapot/teapot.bpt")
DATA = os.path.join(SOURCE, "tests/data")
# Whole runs of the command: name, arguments.
RUNS = [("teapot, size .035", [TEAPOT, "--size", "0.035"]), ("teapot, 8 degrees, gradation 1.3", [TEAPOT, "--angle", "8", "--gradation", "1.3"]),
        ("teapot, 8 degrees, by direction", [TEAPOT, "--angle", "8", "--anisotropic"]), ("teapot, quadrilaterals .1", [TEAPOT, "--size", "0.1", "--element", "q1.0"]),
        ("teapot, P2 .1", [TEAPOT, "--size", "0.1", "--element", "p2"]),
        ("caffeine, excluding water, .1", [DATA + "/molecule/caffeine.xyzr", "--surface", "ses", "--size", "0.1"]),
        ("1BNA, excluding water, .4", [DATA + "/molecule/1bna.pdb", "--surface", "ses", "--size", "0.4"]),
        ("head, smoothed, 1 %", [DATA + "/grid/head.cyl", "--smooth", "2000", "--size", "1%"])]


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return next((line.split(":")[1].strip() for line in file if line.startswith("model name")), platform.machine())


def place(build):
    """Machine, versions and date of the figures."""
    with open(os.path.join(build, "CMakeCache.txt"), encoding="utf-8") as file:
        compiler = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", file.read(), re.M).group(1)
    git = ["git", "-C", SOURCE]
    return {"processor": processor(), "cores": os.cpu_count(), "system": output("sh", "-c", ". /etc/os-release; echo $PRETTY_NAME"),
            "compiler": output(compiler, "--version").split("\n")[0], "commit": output(*git, "log", "-1", "--format=%cd", "--date=short"),
            "carreau": output(os.path.join(build, "cad_adapters/command/carreau"), "--version"), "gmsh": output("gmsh", "--version") or output("sh", "-c", "gmsh --version 2>&1")}


def compared(script, *arguments):
    """Rows of a script of tests/bench that writes them as JSON; its status, whether all aims are reached, is ignored."""
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        done = subprocess.run(["/usr/bin/python3", os.path.join(BENCH, script), *arguments, "--json", file.name], capture_output=True, text=True, check=False)
        rows = file.read()
    if not rows:
        sys.exit(f"{script}: {done.stdout}{done.stderr}")
    return json.loads(rows)


def command_runs(build, repeat):
    rows = []
    for name, arguments in RUNS:
        best = None
        for _ in range(repeat):
            with tempfile.TemporaryDirectory() as folder:
                start = time.perf_counter()
                done = subprocess.run([os.path.join(build, "cad_adapters/command/carreau"), "mesh", *arguments, "-o", os.path.join(folder, "x.vtu"), "--json", "-q",
                                       "--threads", "1"], capture_output=True, text=True, check=False)
                seconds = time.perf_counter() - start
            if done.returncode > 1 or not done.stdout:
                sys.exit(f"{name}: {done.stderr}")
            told = json.loads(done.stdout)
            if best is None or seconds < best["seconds"]:
                best = {"case": name, "seconds": seconds, "processor": told["seconds"]["processor"], "triangles": told["mesh"]["triangles"],
                        "q2_mean": told["mesh"]["q2_mean"], "q2_min": told["mesh"]["q2_min"]}
        rows.append(best)
        print(best, flush=True)
    return rows


def main():
    parser = argparse.ArgumentParser(description="the benchmarks of docs/reference/benchmarks.md")
    parser.add_argument("build")
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--only", action="append", choices=("surface", "quads", "elements", "command"))
    options = parser.parse_args()
    build, repeat = os.path.abspath(options.build), "3" if options.long else "1"
    carreau = os.path.join(build, "cad_adapters/command/carreau")
    near = ["--near", "5k", "--near", "13k", "--near", "100k"] + (["--near", "1M"] if options.long else [])
    coarse = [] if options.long else ["--cases", "0.05|0.1"]
    wanted = {"surface": lambda: compared("compare_gmsh.py", os.path.join(build, "tests/bench/bench_surface"), *near, "--repeat", repeat),
              "command": lambda: command_runs(build, int(repeat)),
              "quads": lambda: compared("compare_gmsh_quads.py", carreau, "--repeat", repeat, *coarse),
              "elements": lambda: compared("compare_gmsh_elements.py", carreau, "--repeat", repeat)}
    told = {"place": place(build) | {"date": time.strftime("%Y-%m-%d"), "long": options.long, "load_before": round(os.getloadavg()[1], 1)}}
    for name, run in wanted.items():
        if not options.only or name in options.only:
            print(name, flush=True)
            told[name] = run()
            told["place"]["load_after"] = round(os.getloadavg()[1], 1)
            with open(os.path.join(FOLDER, "run.json"), "w", encoding="utf-8") as file:
                json.dump(told, file, indent=1)
                file.write("\n")
    page.main()


if __name__ == "__main__":
    main()
