#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""calculix_test.py CARREAU CCX: CalculiX solves problems on shells that `carreau mesh` wrote as .inp, and finds their closed forms."""
import math
import os
import subprocess
import sys
import tempfile

PROGRAM, CCX = sys.argv[1:3]
YOUNG, POISSON, THICKNESS, LENGTH, WIDTH, PULL = 210000.0, 0.0, 0.1, 2.0, 1.0, 3.0
# Two plates side by side: [0, 1] x [0, 1] and [1, 2] x [0, 1].
PLATES = "2\n1 1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n1 1\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n"


def nodes_and_elements(path):
    """{node: (x, y, z)} and [[nodes]] of a file of one line an element."""
    nodes, elements, keyword = {}, [], ""
    with open(path) as file:
        for line in file:
            if line.startswith("*"):
                keyword = line.split(",")[0].strip()
            elif keyword == "*NODE":
                number, *place = line.split(",")
                nodes[int(number)] = tuple(float(x) for x in place)
            elif keyword == "*ELEMENT":
                elements.append([int(n) for n in line.split(",")[1:]])
    return nodes, elements


def forces_at_end(nodes, elements, curved):
    """The pull, constant along x = 2, as forces at nodes: shares 1/2, 1/2 of straight sides and 1/6, 4/6, 1/6 of curved ones."""
    forces = {}
    for element in elements:
        n = len(element) // 2 if curved else len(element)
        for k in range(n):
            side = [element[k], element[(k + 1) % n]] + ([element[n + k]] if curved else [])
            if all(abs(nodes[v][0] - LENGTH) < 1e-9 for v in side):
                size = math.dist(nodes[side[0]], nodes[side[1]]) * PULL
                for v, share in zip(side, (1 / 6, 1 / 6, 4 / 6) if curved else (1 / 2, 1 / 2)):
                    forces[v] = forces.get(v, 0) + share * size
    return forces


def displacements(path):
    """{node: (u, v, w)} from the first table of a .dat file."""
    with open(path) as file:
        rows = [line.split() for line in file]
    return {int(row[0]): tuple(float(x) for x in row[1:]) for row in rows if len(row) == 4 and row[0].isdigit()}


def check(folder, element):
    """Two plates pulled along x: u = PULL x / (YOUNG THICKNESS), which elements of either order hold. CalculiX turns S4 into a brick
    with incompatible modes, which is exact for parallelograms only."""
    mesh = os.path.join(folder, "plates.inp")
    with open(os.path.join(folder, "plates.bpt"), "w") as file:
        file.write(PLATES)
    subprocess.run([PROGRAM, "mesh", "plates.bpt", "-o", mesh, "--size", "0.3", "--element", element, "-q"], cwd=folder, check=True)
    nodes, elements = nodes_and_elements(mesh)
    held = [v for v, p in nodes.items() if abs(p[0]) < 1e-9]
    forces = forces_at_end(nodes, elements, element[0] in "pq" and element[1] == "2")
    assert abs(sum(forces.values()) - PULL * WIDTH) < 1e-9, forces
    lines = ["*INCLUDE, INPUT=plates.inp", "*MATERIAL, NAME=steel", "*ELASTIC", f"{YOUNG}, {POISSON}"]
    # A section a face: the sets are there, and each holds its own elements.
    for face in (1, 2):
        lines += [f"*SHELL SECTION, MATERIAL=steel, ELSET=face_{face}", str(THICKNESS)]
    lines += ["*BOUNDARY"] + [f"{v}, 1, 1" for v in held] + ["all_nodes, 3, 3", f"{held[0]}, 2, 2", "*STEP", "*STATIC", "*CLOAD"]
    lines += [f"{v}, 1, {force!r}" for v, force in forces.items()]
    lines += ["*NODE PRINT, NSET=all_nodes", "U", "*END STEP", ""]
    with open(os.path.join(folder, "pull.inp"), "w") as file:
        file.write("\n".join(lines))
    done = subprocess.run([CCX, "pull"], cwd=folder, capture_output=True, text=True, timeout=300, env=os.environ | {"OMP_NUM_THREADS": "1"})
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout[-3000:]
    found = displacements(os.path.join(folder, "pull.dat"))
    assert set(found) == set(nodes), (len(found), len(nodes))
    stretch = PULL / (YOUNG * THICKNESS)
    worst = max(abs(found[v][0] - stretch * p[0]) for v, p in nodes.items())
    exact = 3e-2 if element.startswith("q1") else 1e-4  # of the displacement; six digits are printed
    assert worst < exact * stretch * LENGTH, (element, worst, stretch * LENGTH)
    print("calculix", element, len(nodes), "nodes", len(elements), "elements, largest error of the displacement", worst)


for each in ("p1", "p2", "q1.1", "q2.1"):
    with tempfile.TemporaryDirectory(prefix="carreau calculix ") as home:
        check(home, each)
