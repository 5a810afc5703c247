#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A program that leaves MPI to libcarreau_mpi: two ranks write the file of one; a missing file is reported once, by all ranks' end.

    plain_test.py <mpirun> <plain_ranks> <teapot.bpt>
"""
import os
import sys
import tempfile

from mpirun import run

MPIRUN, PROGRAM, TEAPOT = sys.argv[1], os.path.abspath(sys.argv[2]), os.path.abspath(sys.argv[3])

with tempfile.TemporaryDirectory() as folder:
    files = []
    for ranks in (1, 2):
        out = os.path.join(folder, f"{ranks}.meshb")
        done = run(MPIRUN, ranks, PROGRAM, TEAPOT, out)
        assert done.returncode == 0, done.stdout + done.stderr
        with open(out, "rb") as file:
            files.append(file.read())
    assert files[0] == files[1] and len(files[0]) > 10000
    done = run(MPIRUN, 2, PROGRAM, os.path.join(folder, "none.bpt"), os.path.join(folder, "none.meshb"))
    assert done.returncode != 0 and done.stderr.count("none.bpt") == 1, done.stderr
    assert sorted(os.listdir(folder)) == ["1.meshb", "2.meshb"]
