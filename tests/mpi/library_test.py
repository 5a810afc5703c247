#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The cases of ranks_program.cpp hold on all ranks; files of all ranks equal the files of one process.

    library_test.py <mpirun> <ranks> <ranks_program>
"""
import os
import sys
import tempfile

from mpirun import run

MPIRUN, RANKS, PROGRAM = sys.argv[1], int(sys.argv[2]), os.path.abspath(sys.argv[3])


def holds(case, *arguments, **more):
    done = run(MPIRUN, RANKS, PROGRAM, case, *arguments, **more)
    assert done.returncode == 0, f"{case}: {done.stdout}{done.stderr}"


def content(path):
    with open(path, "rb") as file:
        return file.read()


for case in ["same", "parts", "status", "stop", "no_memory", "large_same", "large_status_inside", "large_stop", "large_no_memory",
             "bulging_large_same", "bulging_large_status_inside", "bulging_large_stop", "bulging_large_no_memory",
             "adapt_same", "adapt_status", "adapt_stop", "adapt_no_memory", "kept_same", "kept_refusals", "kept_status", "kept_stop",
             "kept_no_memory"]:
    holds(case)
for case in ["other_curves", "other_inside", "large_other_inside", "bulging_large_other_inside", "adapt_other_field",
             "adapt_other_values", "kept_other_inside"] if RANKS > 1 else []:
    holds(case)

with tempfile.TemporaryDirectory() as folder:
    holds("files", folder)
    expected = sorted(["one.mesh", "one.meshb", "ranks.mesh", "ranks.meshb", "ranks.pvtu"] +
                      [f"ranks_{r}.vtu" for r in range(RANKS)])
    assert sorted(os.listdir(folder)) == expected, os.listdir(folder)
    for suffix in (".mesh", ".meshb"):
        assert content(f"{folder}/one{suffix}") == content(f"{folder}/ranks{suffix}"), suffix

with tempfile.TemporaryDirectory() as folder:
    holds("kept_files", folder)
    expected = sorted(["one.meshb", "ranks.meshb", "ranks.pvtu"] + [f"ranks_{r}.vtu" for r in range(RANKS)])
    assert sorted(os.listdir(folder)) == expected, os.listdir(folder)
    assert content(f"{folder}/one.meshb") == content(f"{folder}/ranks.meshb")

# No rest remains of files that a full disk did not take.
with tempfile.TemporaryDirectory() as folder:
    holds("full_disk", folder)
    holds("large_files", folder)
    assert not os.listdir(folder), os.listdir(folder)

# A rank that dies ends all of them.
for case in ["dies", "adapt_dies", "large_dies", "bulging_large_dies", "kept_dies"]:
    with tempfile.TemporaryDirectory() as folder:
        done = run(MPIRUN, RANKS, PROGRAM, case, cwd=folder)
        assert done.returncode != 0 and not os.listdir(folder), (case, done.returncode, os.listdir(folder))
        assert "signal 9" in done.stderr, (case, done.stderr)
print("all cases hold on", RANKS, "ranks")
