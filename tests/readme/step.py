#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""step.py PROGRAM CARREAU PART WORK: a program of README meshes PART as the command does, and reports the reason when there is no file."""
import os
import shutil
import subprocess
import sys

PROGRAM, CARREAU, PART, WORK = sys.argv[1:5]


def area(mesh):
    text = subprocess.run([CARREAU, "check", mesh, "--json"], check=True, capture_output=True, text=True).stdout
    return float(text.split('"area":')[1].split(",")[0])


shutil.rmtree(WORK, ignore_errors=True)
os.makedirs(WORK)
missing = subprocess.run([PROGRAM], cwd=WORK, capture_output=True, text=True)
assert missing.returncode != 0 and "part.step" in missing.stdout + missing.stderr, missing
shutil.copy(PART, os.path.join(WORK, "part.step"))
subprocess.run([PROGRAM], cwd=WORK, check=True)
of_command = os.path.join(WORK, "command.mesh")
subprocess.run([CARREAU, "mesh", PART, "-o", of_command, "--size", "2", "-q"], check=True)
found, wanted = area(os.path.join(WORK, "part.mesh")), area(of_command)
assert abs(found - wanted) < 1e-6 * wanted, (found, wanted)
print(found)
