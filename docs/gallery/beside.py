#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""beside.py NAME MESH FIGURE...: numbers of triangles of meshes beside the numbers that a paper prints."""
import subprocess, sys, json
print(f"{'':34}{'paper':>8}{'ours':>8}")
for name, mesh, figure in zip(*[iter(sys.argv[1:])] * 3):
    result = json.loads(subprocess.run(["carreau", "check", mesh, "--json", "--allow-crossings"], capture_output=True, text=True).stdout)
    ours = result["quality"]["triangles"]
    print(f"{name:34}{figure:>8}{ours:>8}{100 * (ours / int(figure) - 1):+7.1f} %")
