#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""step_field.py PART.step: meshes a part, then adapts the mesh to a field that falls off from one of its corners."""
import sys

import numpy as np

import carreau

path = sys.argv[1] if len(sys.argv) > 1 else "part.step"
coarse = carreau.mesh(path, size="4%")
corner = coarse.vertices.min(axis=0)
reach = 0.1 * np.linalg.norm(np.ptp(coarse.vertices, axis=0))


def temperature(xyz):
    """At n points (n, 3): a layer around the corner."""
    return np.tanh((np.linalg.norm(xyz - corner, axis=1) - 3 * reach) / reach)


mesh = carreau.adapt(path, temperature, tolerance=0.002, size="4%", angle=12, gradation=1.5)
report = mesh.session.adaptation
print(f"{report.triangles_before} triangles with an error of {report.error_max_before:.3g} become {report.triangles} with {report.error_max:.3g}")
values = temperature(mesh.vertices)
mesh.add_field("temperature", values)
mesh.write("adapted.vtu")
mesh.picture("adapted.png", colors=values)
