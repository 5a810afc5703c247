#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""molecule.py [FILE.pdb]: a molecule's three surfaces in closed form, and a mesh of the surface that excludes water;
without a file the molecule is methane, from arrays."""
import sys

import numpy as np

import carreau

BOND, CARBON, HYDROGEN = 1.087, 1.70, 1.20  # angstrom; radii of Bondi
corners = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]) / np.sqrt(3)
methane = np.vstack([np.zeros(3), BOND * corners]), np.array([CARBON] + 4 * [HYDROGEN])

molecule = sys.argv[1] if len(sys.argv) > 1 else methane
areas = carreau.areas(molecule, probe=1.4)
for name, measures in zip(areas._fields, areas):
    print(f"{name}: area {measures.area:.2f}, volume {measures.volume:.2f}")
session = carreau.Session()
add = session.load_molecule if isinstance(molecule, str) else session.add_molecule
add(*((molecule,) if isinstance(molecule, str) else molecule), surface="ses", probe=1.4)
mesh = carreau.mesh(session, size=0.4, eps_ends=1e-6)
print(f"{mesh}: area {mesh.quality.area:.2f}, defects {mesh.check(closed=True)}")
mesh.write("molecule.vtu")
mesh.picture("molecule.png")
