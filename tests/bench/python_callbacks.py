#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""python_callbacks.py [SIZE...]: the cost of a geometry by callbacks in C, in NumPy (batched) and in Python (scalar): a torus, the median
of fifteen runs by turns in a new session each. Then with a size at every place. Processor seconds, by one thread; the additional cost of a
point is the difference to C, divided by the number of evaluations. In a clone with a build:

    PYTHONPATH=cabi/python CARREAU_LIBRARY_PATH=build/release/cabi CARREAU_PYTHON_HOST=build/release/tests/python/python_host.so \\
      /usr/bin/python3 tests/bench/python_callbacks.py
"""
import math
import os
import statistics
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "python"))
import numpy as np  # noqa: E402

import carreau  # noqa: E402
from hosts import HostInC, TORUS_BOX, torus, torus_of_floats  # noqa: E402

RUNS = 15


def in_c(batch, sized):
    return lambda session: HostInC("torus_surface", TORUS_BOX, batch=batch, size="torus_size" if sized else None).add_to(session)


def in_python(surface, size):
    def add(session):
        session.add(carreau.Patch(surface, TORUS_BOX))
        if size is not None:
            session.set_sizes(size)
    return add


def run(add, h):
    """(seconds, mesh)."""
    session = carreau.Session(hphydef=h, hphymin=h / 10, threads=1)
    add(session)
    start = time.process_time()
    mesh = session.generate()
    return time.process_time() - start, mesh


def table(h, sized):
    scalar_size = carreau.scalar(lambda v: 0.05 + abs(math.sin(v)) / 10) if sized else None
    numpy_size = (lambda v: 0.05 + np.abs(np.sin(v)) / 10) if sized else None
    hosts = {"C, one by one": in_c(False, sized), "C, batches": in_c(True, sized), "NumPy, batches": in_python(torus, numpy_size),
             "Python, scalar": in_python(torus_of_floats, scalar_size)}
    times = {name: [] for name in hosts}
    for _ in range(RUNS):
        for name, add in hosts.items():
            seconds, mesh = run(add, h)
            times[name].append(seconds)
    points = mesh.session.report.surf0_calls
    base = statistics.median(times["C, one by one"])
    print(f"{len(mesh.triangles)} triangles, {points} evaluations")
    for name, all_runs in times.items():
        total = statistics.median(all_runs)
        print(f"  {name:16} {total:7.3f} s {total / base:5.2f} x {(total - base) / points * 1e9:7.0f} ns a point more", flush=True)


for word in sys.argv[1:] or ["0.1", "0.03"]:
    print(f"torus, size {word}")
    table(float(word), False)
print("torus, sizes by a callback from 0.05 to 0.15")
table(0.15, True)
