#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""volumes.py CARREAU [FILE]...: a table of solids and engines: tetrahedra, worst shape, seconds of the engine, solids. It makes 28 solids with Gmsh's
OpenCASCADE (python3-gmsh) and adds the CAD files of its arguments. `carreau volume` verifies each surface triangle by triangle."""
import json
import math
import os
import subprocess
import sys
import tempfile

import gmsh

ENGINES = ("tetgen", "gmsh", "netgen")
SOLIDS = []


def solid(make):
    SOLIDS.append(make)
    return make


def balls(occ, *radii):
    return [[(3, occ.addSphere(0, 0, 0, radius))] for radius in radii]


def drill(occ, body, radius, x=0.0, y=0.0):
    return occ.cut(body, [(3, occ.addCylinder(x, y, -5, 0, 0, 10, radius))])[0]


def edges(occ, volume):
    occ.synchronize()
    return [tag for _, tag in gmsh.model.getBoundary(gmsh.model.getBoundary([(3, volume)], oriented=False), combined=False, oriented=False)]


@solid
def box(occ):
    occ.addBox(0, 0, 0, 1, 2, 3)


@solid
def sphere(occ):
    occ.addSphere(0, 0, 0, 1)


@solid
def cylinder(occ):
    occ.addCylinder(0, 0, 0, 0, 0, 3, 1)


@solid
def cone(occ):
    occ.addCone(0, 0, 0, 0, 0, 2, 1, 0)


@solid
def torus(occ):
    occ.addTorus(0, 0, 0, 2, 0.5)


@solid
def wedge(occ):
    occ.addWedge(0, 0, 0, 2, 1, 1, -1, 0.5)


@solid
def half_ball(occ):
    occ.addSphere(0, 0, 0, 1, -1, 0)


@solid
def thick_sphere(occ):
    occ.cut(*balls(occ, 2, 1))


@solid
def coated_ball(occ):
    occ.fragment(*balls(occ, 1.2, 1))


@solid
def pipe(occ):
    drill(occ, [(3, occ.addCylinder(0, 0, 0, 0, 0, 3, 1))], 0.8)


@solid
def drilled_plate(occ):
    body = [(3, occ.addBox(0, 0, 0, 3, 3, 1))]
    for k in range(4):
        body = drill(occ, body, 0.3, 1 + k % 2, 1 + k // 2)


@solid
def thin_plate(occ):
    occ.addBox(0, 0, 0, 10, 10, 0.1)


@solid
def filleted_box(occ):
    volume = occ.addBox(0, 0, 0, 2, 2, 1)
    occ.fillet([volume], sorted(set(edges(occ, volume))), [0.2])


@solid
def chamfered_box(occ):
    volume = occ.addBox(0, 0, 0, 2, 2, 1)
    some = sorted(set(edges(occ, volume)))[:4]
    occ.chamfer([volume], some, [int(gmsh.model.getAdjacencies(1, edge)[0][0]) for edge in some], [0.2])


@solid
def crossing_pipes(occ):
    occ.fuse([(3, occ.addCylinder(-2, 0, 0, 4, 0, 0, 0.6))], [(3, occ.addCylinder(0, -2, 0, 0, 4, 0, 0.5))])


@solid
def ball_in_a_cavity(occ):
    occ.cut([(3, occ.addBox(-2, -2, -2, 4, 4, 4))], balls(occ, 1.5)[0])
    occ.addSphere(0, 0, 0, 0.7)


@solid
def two_boxes(occ):
    for x in (0, 1):
        occ.addBox(x, 0, 0, 1, 1, 1)


@solid
def three_boxes(occ):
    two_boxes(occ)
    occ.addBox(0.5, 1, 0, 1, 1, 1)


@solid
def boxes_that_touch_in_an_edge(occ):
    for x in (0, 1):
        occ.addBox(x, x, 0, 1, 1, 1)


@solid
def plug_in_a_plate(occ):
    drill(occ, [(3, occ.addBox(-2, -2, 0, 4, 4, 1))], 0.7)
    occ.addCylinder(0, 0, 0, 0, 0, 1, 0.7)


@solid
def bolted_plates(occ):
    for z in (0, 1):
        drill(occ, [(3, occ.addBox(-2, -2, z, 4, 4, 1))], 0.4)
    occ.fuse([(3, occ.addCylinder(0, 0, 0, 0, 0, 2, 0.4))], [(3, occ.addCylinder(0, 0, 2, 0, 0, 0.5, 0.8))])


@solid
def revolved_section(occ):
    points = [occ.addPoint(x, 0, z) for x, z in ((0.5, 0), (1.5, 0), (1, 1), (0.6, 1.5))]
    section = occ.addPlaneSurface([occ.addCurveLoop([occ.addLine(points[k], points[(k + 1) % 4]) for k in range(4)])])
    occ.revolve([(2, section)], 0, 0, 0, 0, 0, 1, 1.5 * math.pi)


@solid
def swept_disc(occ):
    spine = occ.addWire([occ.addSpline([occ.addPoint(math.cos(0.4 * k), math.sin(0.4 * k), 0.12 * k) for k in range(16)])])
    disc = occ.addDisk(1, 0, 0, 0.15, 0.15)
    occ.rotate([(2, disc)], 1, 0, 0, 1, 0, 0, math.pi / 2)
    occ.addPipe([(2, disc)], spine)


@solid
def lofted_circles(occ):
    occ.addThruSections([occ.addCurveLoop([occ.addCircle(x, 0, z, r)]) for x, z, r in ((0, 0, 1), (0, 2, 0.5), (0.3, 3, 0.8))])


@solid
def ellipsoid(occ):
    occ.dilate(balls(occ, 1)[0], 0, 0, 0, 3, 2, 1)


@solid
def wing(occ):
    points = []
    for k in range(40):
        x = 0.5 * (1 + math.cos(math.pi * k / 20))
        half = 0.6 * (0.2969 * x ** 0.5 - 0.126 * x - 0.3516 * x * x + 0.2843 * x ** 3 - 0.1036 * x ** 4)
        points.append(occ.addPoint(x, half if k <= 20 else -half, 0))
    outline = occ.addCurveLoop([occ.addSpline(points[:21]), occ.addSpline(points[20:] + points[:1])])
    occ.extrude([(2, occ.addPlaneSurface([outline]))], 0.3, 0, 3)


@solid
def gear(occ):
    teeth = []
    for k in range(12):
        teeth.append((3, occ.addBox(0.9, -0.1, 0, 0.3, 0.2, 0.5)))
        occ.rotate(teeth[-1:], 0, 0, 0, 0, 0, 1, k * math.pi / 6)
    drill(occ, occ.fuse([(3, occ.addCylinder(0, 0, 0, 0, 0, 0.5, 1))], teeth)[0], 0.3)


@solid
def nozzle(occ):
    occ.cut([(3, occ.addCone(0, 0, 0, 0, 0, 3, 1, 0.5))], [(3, occ.addCone(0, 0, 0, 0, 0, 3, 0.8, 0.3))])


def row(program, path, folder):
    cells = [os.path.basename(path)]
    for engine in ENGINES:
        done = subprocess.run([program, "volume", path, "--imprint", "--engine", engine, "-o", os.path.join(folder, "out.msh"), "--json", "-q", "--size", "5%",
                               "--angle", "15", "--engine-seconds", "120"], capture_output=True, text=True)
        if done.returncode != 0:
            cells.append(done.stderr.strip().splitlines()[0][:60])
            continue
        figures = json.loads(done.stdout)["volume"]
        cells.append(f"{figures['tetrahedra']}, {figures['worst_shape']:.3f}, {figures['seconds']:.1f} s, {len(figures['solids'])}")
    return "| " + " | ".join(cells) + " |"


def main():
    program, files = os.path.abspath(sys.argv[1]), [os.path.abspath(path) for path in sys.argv[2:]]
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    with tempfile.TemporaryDirectory() as folder:
        for make in SOLIDS:
            gmsh.clear()
            make(gmsh.model.occ)
            gmsh.model.occ.synchronize()
            files.insert(0, os.path.join(folder, make.__name__ + ".step"))
            gmsh.write(files[0])
        print("| solid | " + " | ".join(ENGINES) + " |\n|---|" + "---|" * len(ENGINES), flush=True)
        for path in sorted(files, key=os.path.basename):
            print(row(program, path, folder), flush=True)


main()
