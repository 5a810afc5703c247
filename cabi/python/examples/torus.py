#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A torus by NumPy, with sizes by a function of the place: torus.vtu, torus.png."""
import numpy as np

import carreau

MAJOR, MINOR = 2.0, 1.0


@carreau.patch(domain=(0, 0, 2 * np.pi, 2 * np.pi), name="torus")
def torus(u, v):
    """S(u, v) at n places: u and v are arrays (n)."""
    r = MAJOR + MINOR * np.cos(v)
    return r * np.cos(u), r * np.sin(u), MINOR * np.sin(v)


mesh = carreau.mesh(torus, size=lambda x, y: np.where(x * y > 0, 0.06, 0.18), gradation=1.3)
exact = 4 * np.pi ** 2 * MAJOR * MINOR
print(f"{mesh}: area {mesh.quality.area:.4f} of {exact:.4f}, shape Q2 {mesh.quality.q2_mean:.3f}, defects {mesh.check(closed=True)}")
mesh.write("torus.vtu")
mesh.picture("torus.png")
