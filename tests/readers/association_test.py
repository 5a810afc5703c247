#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""association_test.py CARREAU: other programs read the places of nodes on the geometry (carreau mesh --association): each node lies at its
parameters. Gmsh reads .msh and .msh2, VTK .vtu, a reader of its own .mesh and .meshb (libMeshb's records)."""
import importlib.util
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
# Distances of nodes from their parameters. On a shared curve nodes lie on the surface of one face: the other face has parameters by interpolation.
INSIDE, SHARED = 1e-11, 1e-7
# Two patches of degree (2, 2) that share a side.
FIRST = [[(0, 0, 0), (0, 1, 0.3), (0, 2, 0)], [(1, 0, 0.5), (1, 1, 1), (1, 2, 0.2)], [(2, 0, 0), (2, 1, 0.4), (2, 2, 0)]]
SECOND = [FIRST[2], [(3, 0, -0.3), (3, 1.2, 0.1), (3, 2, 0.6)], [(4, 0, 0), (4, 1, 0), (4, 2.5, 0)]]
KEYWORDS = {40: "VerticesOnGeometricVertices", 41: "VerticesOnGeometricEdges", 42: "VerticesOnGeometricTriangles", 44: "EdgesOnGeometricEdges",
            4: "Vertices", 5: "Edges", 6: "Triangles", 7: "Quadrilaterals", 24: "TrianglesP2", 25: "EdgesP2", 27: "QuadrilateralsQ2"}
# integers, reals, integers of a record
LAYOUT = {40: "ii", 41: "iirr", 42: "iirrr", 44: "ii", 4: "rrri", 5: "iii", 6: "iiii", 7: "iiiii", 24: "iiiiiii", 25: "iiii", 27: "iiiiiiiiii"}


def has(module):
    return importlib.util.find_spec(module) is not None


def bernstein(t):
    return ((1 - t) ** 2, 2 * t * (1 - t), t * t)


def on_patch(points, u, v):
    return [sum(bernstein(u)[i] * bernstein(v)[k] * points[i][k][c] for i in range(3) for k in range(3)) for c in range(3)]


def on_side(points, side, t):
    return on_patch(points, *((t, 0), (t, 1), (0, t), (1, t), (1 - t, 0), (1 - t, 1), (0, 1 - t), (1, 1 - t))[side])


def on_sphere(u, v):
    return [math.cos(v) * math.cos(u), math.cos(v) * math.sin(u), math.sin(v)]


def text_sections(path):
    with open(path) as file:
        words = file.read().split()
    found, i = {}, 0
    codes = {name: code for code, name in KEYWORDS.items()}
    while i < len(words):
        code = codes.get(words[i])
        i += 1
        if code is None:
            continue
        n, width = int(words[i]), len(LAYOUT[code])
        rows = [words[i + 1 + width * k:i + 1 + width * (k + 1)] for k in range(n)]
        found[KEYWORDS[code]] = [tuple(int(w) if kind == "i" else float(w) for w, kind in zip(row, LAYOUT[code])) for row in rows]
        i += 1 + width * n
    return found


def binary_sections(path):
    with open(path, "rb") as file:
        data = file.read()
    one, version = struct.unpack_from("=ii", data)
    assert one == 1 and version in (2, 3)
    at, found = 8, {}
    while True:
        code, following = struct.unpack_from("=ii" if version == 2 else "=iq", data, at)
        at += 8 if version == 2 else 12
        if code == 54:
            assert at == len(data)
            return found
        if code in KEYWORDS:
            n, = struct.unpack_from("=i", data, at)
            row = struct.Struct("=" + LAYOUT[code].replace("r", "d"))
            assert at + 4 + n * row.size == following, KEYWORDS[code]
            found[KEYWORDS[code]] = [row.unpack_from(data, at + 4 + k * row.size) for k in range(n)]
        else:
            assert code == 3, code
        at = following


class Association(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="carreau association ")
        with open(os.path.join(cls.folder.name, "patches.bpt"), "w") as file:
            file.write("2\n")
            for patch in (FIRST, SECOND):
                file.write("2 2\n" + "".join("%r %r %r\n" % p for row in patch for p in row))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def mesh(self, geometry, element, *names, options=("--association",)):
        outputs = [word for name in names for word in ("-o", self.path(name))]
        subprocess.run([PROGRAM, "mesh", self.path(geometry), "--size", "0.4", "--element", element, "-q", *outputs, *options], check=True)

    def near(self, x, y, limit=INSIDE):
        self.assertLess(math.dist(x, y), limit)

    def surfaces(self):
        return {1: lambda u, v: on_patch(FIRST, u, v), 2: lambda u, v: on_patch(SECOND, u, v)}

    def sphere(self):
        """A STEP file; None: this program reads none."""
        if not has("gmsh"):
            self.skipTest("python3-gmsh makes the sphere")
        import gmsh
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.addSphere(0, 0, 0, 1)
        gmsh.model.occ.synchronize()
        gmsh.write(self.path("sphere.step"))
        gmsh.finalize()
        done = subprocess.run([PROGRAM, "info", self.path("sphere.step")], capture_output=True, text=True)
        if done.returncode != 0:
            self.skipTest(done.stderr)
        return "sphere.step"

    def test_records_of_gmf(self):
        for element in ("p1", "p2", "q1.0", "q2.0"):
            with self.subTest(element=element):
                self.mesh("patches.bpt", element, "x.mesh", "x.meshb")
                found = text_sections(self.path("x.mesh"))
                self.assertEqual(found, binary_sections(self.path("x.meshb")))
                points = [row[:3] for row in found["Vertices"]]
                of_vertex = {}
                on_curves = {row[0] for row in found["VerticesOnGeometricEdges"]}
                for vertex, face, u, v, distance in found["VerticesOnGeometricTriangles"]:
                    self.near(points[vertex - 1], self.surfaces()[face](u, v), SHARED if vertex in on_curves else INSIDE)
                    self.assertEqual(distance, 0)
                    of_vertex.setdefault(vertex, set()).add(face)
                centres = max(of_vertex)  # vertices behind them are centres of quadrilaterals, which no face has
                for kind in ("Triangles", "Quadrilaterals", "TrianglesP2", "QuadrilateralsQ2"):
                    for *nodes, face in found.get(kind, ()):
                        for node in nodes:
                            self.assertTrue(node > centres or face in of_vertex[node], (kind, node))
                # Each curve is one side of a patch, in one direction.
                corners = dict(found["VerticesOnGeometricVertices"])
                self.assertEqual({v: row[3] for v, row in enumerate(found["Vertices"], 1) if row[3] != 0}, corners)
                self.assertEqual(len(corners), 6)
                curves = {}
                for vertex, curve, t, distance in found["VerticesOnGeometricEdges"]:
                    curves.setdefault(curve, []).append((points[vertex - 1], t))
                    self.assertEqual(distance, 0)
                self.assertEqual(len(curves), 7)
                for places in curves.values():
                    self.assertLess(min(max(math.dist(x, on_side(patch, side, t)) for x, t in places) for patch in (FIRST, SECOND) for side in range(8)), SHARED)
                edges = {}
                for a, b, *mid, ref in found.get("Edges", []) + found.get("EdgesP2", []):
                    edges.setdefault(ref, set()).update((a, b, *mid))
                on_curve = {}
                for vertex, curve, *_ in found["VerticesOnGeometricEdges"]:
                    on_curve.setdefault(curve, set()).add(vertex)
                self.assertEqual(edges, on_curve)
                if "Edges" in found:
                    self.assertEqual(found["EdgesOnGeometricEdges"], [(k, edge[2]) for k, edge in enumerate(found["Edges"], 1)])

    def test_a_seam_has_both_parameters(self):
        self.mesh(self.sphere(), "p2", "s.mesh")
        found = text_sections(self.path("s.mesh"))
        points = [row[:3] for row in found["Vertices"]]
        of_vertex = {}
        for vertex, face, u, v, _ in found["VerticesOnGeometricTriangles"]:
            self.near(points[vertex - 1], on_sphere(u, v))
            of_vertex.setdefault(vertex, []).append(u)
        corners = dict(found["VerticesOnGeometricVertices"])
        seam = {vertex for vertex, *_ in found["VerticesOnGeometricEdges"]} - set(corners)
        self.assertGreater(len(seam), 5)
        for vertex in seam:
            low, high = sorted(of_vertex[vertex])
            self.assertAlmostEqual(high - low, 2 * math.pi, places=12)

    def test_without_the_option_nothing_changes(self):
        self.mesh("patches.bpt", "p2", "x.mesh", "x.msh", "x.msh2", options=())
        self.assertNotIn("VerticesOnGeometricEdges", text_sections(self.path("x.mesh")))
        with open(self.path("x.msh")) as file:
            nodes = re.search(r"\$Nodes\n(.*?)\$EndNodes", file.read(), re.DOTALL).group(1)
        self.assertEqual({line.split()[2] for line in nodes.splitlines()[1:] if len(line.split()) == 4}, {"0"})  # libMesh stops at 1
        with open(self.path("x.msh2")) as file:
            self.assertNotIn("$ParametricNodes", file.read())

    @unittest.skipUnless(has("gmsh"), "python3-gmsh")
    def test_gmsh_reads_parametric_nodes(self):
        import gmsh
        for element in ("p1", "p2", "p3", "p4", "q1.0", "q2.0", "q3", "q4"):
            for suffix in ("msh", "msh2"):
                with self.subTest(element=element, suffix=suffix):
                    self.mesh("patches.bpt", element, f"x.{suffix}")
                    gmsh.initialize()
                    self.addCleanup(gmsh.finalize)
                    gmsh.option.setNumber("General.Terminal", 0)
                    gmsh.open(self.path(f"x.{suffix}"))
                    count = 0
                    for face, surface in self.surfaces().items():
                        _, x, uv = gmsh.model.mesh.getNodes(2, face, False, True)
                        self.assertEqual(3 * len(uv), 2 * len(x))
                        for i in range(len(uv) // 2):
                            self.near(x[3 * i:3 * i + 3], surface(*uv[2 * i:2 * i + 2]))
                        count += len(uv) // 2
                    for _, curve in gmsh.model.getEntities(1):
                        _, x, t = gmsh.model.mesh.getNodes(1, curve, False, True)
                        self.assertEqual(len(x), 3 * len(t))
                        count += len(t)
                        self.assertLess(min(max(math.dist(x[3 * i:3 * i + 3], on_side(patch, side, t[i])) for i in range(len(t)))
                                            for patch in (FIRST, SECOND) for side in range(8)), SHARED)
                    self.assertEqual(count + 6, len(gmsh.model.mesh.getNodes()[0]))
                    if suffix == "msh":  # entities know their borders
                        border = gmsh.model.getBoundary([(2, 1), (2, 2)], combined=True, oriented=False)
                        self.assertEqual(len(border), 6)
                        for face in (1, 2):
                            sides = gmsh.model.getBoundary([(2, face)])
                            self.assertEqual(len(sides), 4)
                            self.assertEqual(gmsh.model.getBoundary(sides, combined=True), [])  # a closed loop
                        for _, curve in gmsh.model.getEntities(1):
                            self.assertEqual(len(gmsh.model.getBoundary([(1, curve)])), 2)
                    self.doCleanups()

    @unittest.skipUnless(has("vtk"), "python3-vtk9")
    def test_vtk_reads_arrays(self):
        import vtk
        from vtk.util.numpy_support import vtk_to_numpy
        geometries = [("patches.bpt", self.surfaces())]
        if has("gmsh"):
            geometries.append((self.sphere(), {1: on_sphere}))
        for geometry, surfaces in geometries:
            for element in ("p1", "p2", "p3", "p4", "q1.0", "q2.0", "q3", "q4"):
                with self.subTest(geometry=geometry, element=element):
                    self.mesh(geometry, element, "x.vtu")
                    reader = vtk.vtkXMLUnstructuredGridReader()
                    reader.SetFileName(self.path("x.vtu"))
                    reader.Update()
                    grid = reader.GetOutput()
                    points = vtk_to_numpy(grid.GetPoints().GetData())
                    data = {name: vtk_to_numpy(grid.GetPointData().GetArray(name)) for name in ("entity_dimension", "entity_reference", "curve_t", "face_uv")}
                    refs = vtk_to_numpy(grid.GetCellData().GetArray("reference"))
                    uv = vtk_to_numpy(grid.GetCellData().GetArray("corner_uv"))
                    seen = set()
                    for c in range(grid.GetNumberOfCells()):
                        cell = grid.GetCell(c)
                        if cell.GetCellDimension() == 1:
                            self.assertTrue(all(math.isnan(x) for x in uv[c]))
                            self.assertTrue(all(data["entity_dimension"][cell.GetPointId(k)] < 2 for k in range(cell.GetNumberOfPoints())))
                            continue
                        for k in range(cell.GetNumberOfPoints()):
                            node = cell.GetPointId(k)
                            inside = data["entity_dimension"][node] == 2
                            self.near(points[node], surfaces[refs[c]](*uv[c][2 * k:2 * k + 2]), INSIDE if inside else SHARED)
                            seen.add(node)
                            if inside:
                                self.assertEqual(data["entity_reference"][node], refs[c])
                                self.near(points[node], surfaces[refs[c]](*data["face_uv"][node]))
                            else:
                                self.assertEqual(math.isnan(data["curve_t"][node]), data["entity_dimension"][node] == 0)
                        for k in range(2 * cell.GetNumberOfPoints(), len(uv[c])):
                            self.assertTrue(math.isnan(uv[c][k]))
                    self.assertEqual(len(seen), len(points))

    def test_other_places_of_nodes_are_rejected(self):
        done = subprocess.run([PROGRAM, "mesh", self.path("patches.bpt"), "--size", "0.5", "--element", "p3", "--nodes", "gauss-lobatto", "--association",
                               "-o", self.path("x.msh"), "-q"], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("requires equidistant nodes", done.stderr)


if __name__ == "__main__":
    unittest.main()
