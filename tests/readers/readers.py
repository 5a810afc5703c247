#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""readers.py READER CARREAU TEAPOT.BPT: other programs read the files of `carreau mesh`: the same vertices, triangles, references and
names.

READER is vtk (whose readers ParaView uses), gmsh or meshio. --has READER: exit status 0 when this Python has it."""
import importlib
import json
import math
import os
import subprocess
import sys
import tempfile

READER = sys.argv[-1] if sys.argv[1] == "--has" else sys.argv[1]
if sys.argv[1] == "--has":
    importlib.import_module(READER)
    sys.exit(0)
PROGRAM, TEAPOT = sys.argv[2:4]

# A corner of a cube: three squares without names, with curves and corners.
CORNER = "3\n" + "".join("1 1\n" + "".join("%d %d %d\n" % p for p in face) for face in (
    ((0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0)), ((0, 0, 0), (0, 0, 1), (0, 1, 0), (0, 1, 1)), ((0, 0, 0), (1, 0, 0), (0, 0, 1), (1, 0, 1))))


def area(points, triangles):
    total = 0
    for t in triangles:
        (a, b, c), (d, e, f), (g, h, i) = (tuple(map(float, points[v])) for v in t)
        u, v = (d - a, e - b, f - c), (g - a, h - b, i - c)
        total += math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2
    return total


def by_vtk(path):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    errors = []
    reader = {".vtu": vtk.vtkXMLUnstructuredGridReader, ".stl": vtk.vtkSTLReader, ".ply": vtk.vtkPLYReader,
              ".obj": vtk.vtkOBJReader}[os.path.splitext(path)[1]]()
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(path))
    reader.SetFileName(path)
    reader.Update()
    assert not errors and reader.GetErrorCode() == 0, (path, reader.GetErrorCode())
    grid = reader.GetOutput()
    points = vtk_to_numpy(grid.GetPoints().GetData())
    chosen = [i for i in range(grid.GetNumberOfCells()) if grid.GetCellType(i) == vtk.VTK_TRIANGLE]
    triangles = [[grid.GetCell(i).GetPointId(k) for k in range(3)] for i in chosen]
    refs = []
    if path.endswith(".vtu"):
        array = vtk_to_numpy(grid.GetCellData().GetArray("reference"))
        refs = [int(array[i]) for i in chosen]
        assert grid.GetFieldData().GetArray("face_name") is not None
    return points, triangles, refs


def by_meshio(path):
    import meshio
    import numpy
    mesh = meshio.read(path, file_format="gmsh") if path.endswith(".msh2") else meshio.read(path)
    triangles, refs = [], []
    key = next((k for k in ("reference", "gmsh:geometrical", "medit:ref", "nastran:ref", "su2:tag") if k in mesh.cell_data), None)
    if path.endswith(".inp"):
        assert all(name in mesh.cell_sets for name in (f"face_{face}" for face in WANTED)), list(mesh.cell_sets)
        refs_of = [[0] * len(block.data) for block in mesh.cells]
        for face in WANTED:
            for refs_of_block, members in zip(refs_of, mesh.cell_sets[f"face_{face}"]):
                for i in members:
                    refs_of_block[i] = face
        key, mesh.cell_data["reference"] = "reference", [numpy.array(block) for block in refs_of]
    for i, block in enumerate(mesh.cells):
        if block.type == "triangle":
            triangles += block.data.tolist()
            refs += mesh.cell_data[key][i].astype(int).flatten().tolist() if key else []
    return mesh.points, triangles, refs


def by_gmsh(path):
    import gmsh
    if path.endswith(".msh2"):
        copy = path[:-5] + ".2.msh"
        os.link(path, copy)
        path = copy
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.logger.start()
        gmsh.open(path)
        wrong = [line for line in gmsh.logger.get() if line.startswith(("Error", "Warning"))]
        gmsh.logger.stop()
        assert not wrong, wrong
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        place = {int(tag): k for k, tag in enumerate(tags)}
        points = [coordinates[3 * k:3 * k + 3] for k in range(len(tags))]
        triangles, refs = [], []
        for _, entity in gmsh.model.getEntities(2):
            types, _, nodes = gmsh.model.mesh.getElements(2, entity)
            for kind, corners in zip(types, nodes):
                assert kind == 2, kind
                triangles += [[place[int(v)] for v in corners[k:k + 3]] for k in range(0, len(corners), 3)]
                refs += [entity] * (len(corners) // 3)
        return points, triangles, refs
    finally:
        gmsh.finalize()


READERS = {"vtk": (by_vtk, ("vtu", "stl", "ply", "obj")), "gmsh": (by_gmsh, ("msh", "msh2", "mesh", "stl", "unv", "bdf")),
           "meshio": (by_meshio, ("vtu", "msh", "msh2", "mesh", "meshb", "stl", "inp", "bdf", "ply", "off", "obj"))}
WANTED = {}  # references of faces and their numbers of triangles


KINDS = {"triangles3": 3, "triangles6": 6, "quads4": 4, "quads8": 8}  # elements, as `carreau check` calls them: nodes


def elements_by_vtk(path):
    import vtk
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    kinds = {vtk.VTK_TRIANGLE: "triangles3", vtk.VTK_QUADRATIC_TRIANGLE: "triangles6", vtk.VTK_QUAD: "quads4",
             vtk.VTK_QUADRATIC_QUAD: "quads8"}
    counts = {}
    for i in range(grid.GetNumberOfCells()):
        kind = kinds.get(grid.GetCellType(i))
        if kind is None:
            continue
        counts[kind] = counts.get(kind, 0) + 1
        # Each node is where VTK's own functions put it: the order is VTK's.
        cell, places, weights, where, part = grid.GetCell(i), grid.GetCell(i).GetParametricCoords(), [0] * 8, [0] * 3, vtk.mutable(0)
        for k in range(KINDS[kind]):
            cell.EvaluateLocation(part, places[3 * k:3 * k + 3], where, weights)
            assert math.dist(where, cell.GetPoints().GetPoint(k)) < 1e-12, (path, i, k)
    return counts


def elements_by_meshio(path):
    import meshio
    if path.endswith(".inp"):  # meshio knows Abaqus' names of elements
        with open(path) as file:
            text = file.read()
        path = path[:-4] + "_abaqus.inp"
        with open(path, "w") as file:
            file.write(text.replace("TYPE=S6,", "TYPE=STRI65,"))
    mesh = meshio.read(path, file_format="gmsh") if path.endswith(".msh2") else meshio.read(path)
    names = {"triangle": "triangles3", "triangle6": "triangles6", "quad": "quads4", "quad8": "quads8"}
    counts = {}
    for block in mesh.cells:
        if block.type in names:
            counts[names[block.type]] = counts.get(names[block.type], 0) + len(block.data)
    return counts


def elements_by_gmsh(path):
    import gmsh
    if path.endswith(".msh2"):
        copy = path[:-5] + ".2.msh"
        os.link(path, copy)
        path = copy
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(path)
        names = {2: "triangles3", 9: "triangles6", 3: "quads4", 16: "quads8", 10: "quads8"}  # 10: nine nodes, of Medit
        counts = {}
        types, tags, _ = gmsh.model.mesh.getElements(2)
        for kind, elements in zip(types, tags):
            counts[names[int(kind)]] = counts.get(names[int(kind)], 0) + len(elements)
            # Nodes in another order would make other areas.
            points, weights = gmsh.model.mesh.getIntegrationPoints(int(kind), "Gauss6")
            _, determinants, _ = gmsh.model.mesh.getJacobians(int(kind), points)
            counts["area"] = counts.get("area", 0) + sum(d * weights[i % len(weights)] for i, d in enumerate(determinants))
        return counts
    finally:
        gmsh.finalize()


# Our command makes triangles of the polygons of these: the mesh equals the mesh of the other files.
PLAIN = (".off", ".obj", ".ply")
# Formats of which they know quadrilaterals, curved triangles and curved quadrilaterals.
ELEMENT_READERS = {"vtk": (elements_by_vtk, {"q1": ("vtu",), "p2": ("vtu",), "q2": ("vtu",)}),
                   "gmsh": (elements_by_gmsh, {"q1": ("msh", "msh2", "mesh", "unv", "bdf"), "p2": ("msh", "msh2", "mesh", "unv"), "q2": ("msh", "msh2", "unv")}),
                   "meshio": (elements_by_meshio, {"q1": ("vtu", "msh", "msh2", "mesh", "inp", "bdf", "ply", "obj"), "p2": ("vtu", "msh", "msh2", "inp", "bdf"),
                                                   "q2": ("vtu", "msh", "msh2", "inp", "bdf")})}


def check_elements(folder, geometry, element, options):
    """Kinds and numbers of elements agree with the counts of `carreau check`, in formats that READER knows of that
    order."""
    read, formats = ELEMENT_READERS[READER]
    names = [os.path.join(folder, "e." + form) for form in formats[element[:2]]]
    outputs = [word for name in names for word in ("-o", name)]
    subprocess.run([PROGRAM, "mesh", geometry, *outputs, "--element", element, "-q", *options], check=True)
    told = None
    for name in sorted(names, key=lambda path: path.endswith(PLAIN)):
        told = told if name.endswith(PLAIN) else json.loads(subprocess.run([PROGRAM, "check", name, "--json", "--allow-crossings"], check=True, capture_output=True, text=True).stdout)
        wanted = {kind: told["elements"][kind] for kind in KINDS if told["elements"][kind] > 0}
        assert told["elements"]["invalid"] == 0, (name, told["elements"])
        found = read(name)
        assert abs(found.pop("area", told["elements"]["area"]) / told["elements"]["area"] - 1) < 1e-5, name
        assert found == wanted, (name, found, wanted)
        print(READER, element, os.path.splitext(name)[1], found)


def check(folder, geometry, options):
    read, formats = READERS[READER]
    names = {form: os.path.join(folder, "m." + form) for form in formats}
    outputs = [word for name in names.values() for word in ("-o", name)]
    done = subprocess.run([PROGRAM, "mesh", geometry, *outputs, "--json", *options], check=True, capture_output=True, text=True)
    told = json.loads(done.stdout)
    wanted = {face["reference"]: face["triangles"] for face in told["faces"]}
    WANTED.clear()
    WANTED.update(wanted)
    for form, name in names.items():
        points, triangles, refs = read(name)
        assert len(triangles) == sum(wanted.values()), (name, len(triangles), wanted)
        assert form == "stl" or len(points) == told["mesh"]["vertices"], (name, len(points))
        single = form == "stl" or (READER == "vtk" and form in ("ply", "obj"))  # precision of the format or of the reader
        precision = 1e-6 if single else 1e-12
        assert abs(area(points, triangles) / told["mesh"]["area"] - 1) < precision, name
        if refs and form != "stl":
            assert {ref: refs.count(ref) for ref in set(refs)} == wanted, name
        print(READER, form, len(points), "points", len(triangles), "triangles")


def check_su2_of_space(folder):
    """A surface in space has faces as markers, and nothing else."""
    import meshio
    corner, name = os.path.join(folder, "space.bpt"), os.path.join(folder, "space.su2")
    with open(corner, "w") as file:
        file.write(CORNER)
    for element, kinds in (("p1", ("triangle",)), ("q1.1", ("quad",)), ("q1.0", ("quad", "triangle"))):
        done = subprocess.run([PROGRAM, "mesh", corner, "-o", name, "--size", "0.3", "--element", element, "--json"], check=True, capture_output=True, text=True)
        told = json.loads(done.stdout)
        mesh = meshio.read(name)
        areas = {}
        for block, tags in zip(mesh.cells, mesh.cell_data["su2:tag"]):
            assert block.type in kinds, (element, block.type)
            for nodes, tag in zip(block.data.tolist(), tags.tolist()):
                halves = [nodes[:3]] if len(nodes) == 3 else [nodes[:3], [nodes[0], *nodes[2:]]]
                areas[tag] = areas.get(tag, 0) + area(mesh.points.tolist(), halves)
        assert len(mesh.points) == told["mesh"]["vertices"], (element, len(mesh.points))
        assert len(areas) == 3 and all(abs(each - 1) < 1e-12 for each in areas.values()), (element, areas)
        print("meshio su2 of space", element, {block.type: len(block.data) for block in mesh.cells})


def check_su2(folder):
    """A mesh of the plane: elements, and markers of curves."""
    import meshio
    plates, name = os.path.join(folder, "plates.bpt"), os.path.join(folder, "plates.su2")
    with open(plates, "w") as file:
        file.write("2\n1 1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n1 1\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n")
    done = subprocess.run([PROGRAM, "mesh", plates, "-o", name, "--size", "0.2", "--json"], check=True, capture_output=True, text=True)
    told = json.loads(done.stdout)
    mesh = meshio.read(name)
    triangles = [t for block in mesh.cells if block.type == "triangle" for t in block.data.tolist()]
    lines = [e for block in mesh.cells if block.type == "line" for e in block.data.tolist()]
    points = [(*p, 0.0)[:3] for p in mesh.points.tolist()]
    assert len(triangles) == told["mesh"]["triangles"] and abs(area(points, triangles) - 2) < 1e-12
    # The border of [0, 2] x [0, 1], and the side that both squares share.
    length = sum(math.dist(points[a], points[b]) for a, b in lines)
    assert abs(length - 7) < 1e-12, length
    print("meshio su2", len(triangles), "triangles", len(lines), "edges")


with tempfile.TemporaryDirectory(prefix="carreau readers ") as home:
    if READER == "meshio":
        check_su2(home)
        check_su2_of_space(home)
    corner = os.path.join(home, "corner.bpt")
    with open(corner, "w") as file:
        file.write(CORNER)
    for number, (geometry, options) in enumerate(((corner, ("--size", "0.3")), (corner, ("--size", "0.3", "--set", "curve_groups=0")),
                                                  (TEAPOT, ("--size", "0.2")))):
        folder = os.path.join(home, str(number))
        os.mkdir(folder)
        check(folder, geometry, options)
    for element in ("p2", "q1.0", "q1.1", "q2.0", "q2.1"):
        folder = os.path.join(home, element)
        os.mkdir(folder)
        # Coarser curved quadrilaterals of the teapot are not all valid.
        check_elements(folder, TEAPOT, element, ("--size", "0.1" if element.startswith("q2") else "0.4"))
