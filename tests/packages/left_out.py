#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""left_out.py CMAKE SOURCE WORK: `cmake --preset release` on a machine without GoogleTest, gfortran and whatever else is optional
configures, and lists the missing parts with reasons. A part that is requested must be there."""
import os
import shutil
import subprocess
import sys

CMAKE, SOURCE, WORK = sys.argv[1:4]
BARE = ["-DCMAKE_Fortran_COMPILER=NOTFOUND", "-DCARREAU_MUPARSER=OFF", "-DCARREAU_MED=OFF"] + [
    f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in ("GTest", "OpenEXR", "TBB", "OpenCASCADE", "MPI")]


def configure(name, *options, preset=True):
    build = os.path.join(WORK, name)
    shutil.rmtree(build, ignore_errors=True)
    how = ["--preset", "release"] if preset else ["-S", SOURCE]
    done = subprocess.run([CMAKE, *how, "-B", build, *options], cwd=SOURCE, capture_output=True, text=True)
    return done.returncode, [line.removeprefix("-- ") for line in done.stdout.splitlines()], done.stderr, build


def left_out(lines):
    at = lines.index("Carreau: left out")
    rows = []
    for line in lines[at + 1:]:
        if not line.startswith("  "):
            break
        what, why = line.strip().split(": ", 1)
        rows.append((what, why))
    return dict(rows)


status, lines, errors, _ = configure("plain", *BARE, preset=False)
assert status == 0 and "libgtest-dev" in left_out(lines)["tests"], errors

status, lines, errors, build = configure("bare", *BARE)
assert status == 0, errors
rows = left_out(lines)
print(rows)
for what, word in ((".exr files", "libopenexr-dev"), ("oneTBB", "libtbb-dev"), ("libcarreau_mpi (mpirun carreau mesh)", "libopenmpi-dev"), ("Fortran modules and examples", "gfortran"),
                   ("libcarreau_cad (STEP, IGES and BREP files)", "OpenCASCADE"), ("formulas in --size-map", "CARREAU_MUPARSER is OFF"), (".med files", "CARREAU_MED is OFF"), ("tests", "CARREAU_TESTS is OFF")):
    assert word in rows[what], (what, rows)
assert os.path.exists(os.path.join(build, "build.ninja"))
targets = subprocess.run([CMAKE, "--build", build, "--target", "help"], check=True, capture_output=True, text=True).stdout
assert "uninstall" in targets and "carreau_command" in targets and "carreau_fortran" not in targets and "abi_test" not in targets

status, lines, errors, _ = configure("off", *BARE, "-DCARREAU_COMMAND=OFF", "-DCARREAU_OPENEXR=OFF")
assert status == 0 and left_out(lines)["the command carreau"] == "CARREAU_COMMAND is OFF", errors
status, lines, errors, _ = configure("asked", *BARE, "-DCARREAU_OPENEXR=ON")
assert status != 0 and "OpenEXR" in errors, errors
