#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""inner_sizes.py CARREAU: edges inside solids against the size field, for each engine: mean and deciles of length over size. The sizes of the
file cad_adapters/command/volume/engines.cpp are chosen by it."""
import json
import math
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../command"))
from medit_volume import Medit, box, inner_edges, off  # noqa: E402

CENTRE = "sqrt((x-0.5)^2+(y-0.5)^2+(z-0.5)^2)"
FIELDS = {
    "uniform": (["--size", "0.08"], lambda p: 0.08),
    "small in the middle": (["--size-map", "0.02+0.3*" + CENTRE], lambda p: 0.02 + 0.3 * math.dist(p, (0.5, 0.5, 0.5))),
    "along x": (["--size-map", "0.02+0.2*x"], lambda p: 0.02 + 0.2 * p[0]),
    "from the surface": (["--size-map", "0.04+0*u", "--gradation", "1.3"], lambda p: 0.05 + 0.3 * min(min(x, 1 - x) for x in p)),
}


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "cube.off"), "w") as file:
            file.write(off(*box((0, 0, 0), (1, 1, 1))))
        print("| field | engine | tetrahedra | worst shape | length over size: mean | 10 % | 90 % | s |\n|---|---|---|---|---|---|---|---|")
        for name, (words, size) in FIELDS.items():
            for engine in ("tetgen", "gmsh", "netgen"):
                done = subprocess.run([program, "volume", "cube.off", *words, "-o", "cube.mesh", "--engine", engine, "-q", "--json"], cwd=folder, capture_output=True, text=True)
                if done.returncode != 0:
                    print(f"| {name} | {engine} | {done.stderr.strip().splitlines()[0]}")
                    continue
                figures = json.loads(done.stdout)["volume"]
                ratios = sorted(math.dist(p, q) / size([(x + y) / 2 for x, y in zip(p, q)]) for p, q in inner_edges(Medit(os.path.join(folder, "cube.mesh"))))
                deciles = [ratios[len(ratios) * k // 10] for k in (1, 9)]
                print(f"| {name} | {engine} | {figures['tetrahedra']} | {figures['worst_shape']:.3f} | {sum(ratios) / len(ratios):.2f} | {deciles[0]:.2f} | "
                      f"{deciles[1]:.2f} | {figures['seconds']:.1f} |", flush=True)


main()
