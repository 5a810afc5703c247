#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a part like the steering wheel of HDR fig. 4.27, a rim with a hub and three spokes whose surfaces are cut into many patches for
no reason, by Gmsh's binding to OpenCASCADE.

    python3 tests/bench/make_wheel.py wheel.brep
"""
import math
import sys

sys.path.append("/usr/lib/python3/dist-packages")  # where Debian's python3-gmsh is, whatever python3 runs this
try:
    import gmsh
except ImportError as error:
    sys.exit(f"{error}. Type: apt-get install gmsh python3-gmsh")

COLUMNS = 7
RIM, TUBE, HUB, SPOKE = 1.0, 0.09, 0.25, 0.06


def wheel(occ):
    rim = (3, occ.addTorus(0, 0, 0, RIM, TUBE))
    others = [(3, occ.addCylinder(0, 0, -0.08, 0, 0, 0.16, HUB))]
    for k in range(3):
        angle = math.pi / 2 + 2 * math.pi * k / 3
        others.append((3, occ.addCylinder(0, 0, 0, RIM * math.cos(angle), RIM * math.sin(angle), 0, SPOKE)))
    return occ.fuse([rim], others)[0]


def cuts(occ):
    """Planes through the axis, at uneven angles, and two across it."""
    tools = []
    for k in range(COLUMNS):
        angle = 0.13 + 2 * math.pi * k / COLUMNS + 0.05 * math.sin(5 * k)
        plane = (2, occ.addRectangle(0, -0.5, 0, 1.5, 1))
        occ.rotate([plane], 0, 0, 0, 1, 0, 0, math.pi / 2)
        occ.rotate([plane], 0, 0, 0, 0, 0, 1, angle)
        tools.append(plane)
    for z in (-0.031, 0.044):
        tools.append((2, occ.addRectangle(-1.5, -1.5, z, 3, 3)))
    return tools


def main():
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    occ = gmsh.model.occ
    solid = wheel(occ)
    occ.synchronize()
    shell = gmsh.model.getBoundary(solid, oriented=False)
    faces = occ.copy(shell)
    occ.remove(solid, recursive=True)
    # Faces cut by the planes; the rest of the planes goes.
    pieces, images = occ.fragment(faces, cuts(occ))
    kept = {tag for image in images[:len(faces)] for tag in image}
    occ.remove([p for p in pieces if p not in kept], recursive=True)
    occ.removeAllDuplicates()
    occ.synchronize()
    print(len(gmsh.model.getEntities(2)), "patches")
    gmsh.write(sys.argv[1])
    gmsh.finalize()


if __name__ == "__main__":
    main()
