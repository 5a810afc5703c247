#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""dolfinx_test.py CARREAU: dolfinx computes area and the first eigenvalue of the Laplace-Beltrami operator, 2, on curved meshes of the unit
sphere. Both errors are of the order p + 1 of the surface (p + 2 for even p), which elements of order p without their nodes would not reach.
--has: exit status 0 when this Python has dolfinx, gmsh and slepc4py."""
import math
import os
import subprocess
import sys
import tempfile
import unittest

if sys.argv[1] == "--has":
    import dolfinx.fem, gmsh, slepc4py  # noqa: E401, F401
    sys.exit(0)
import gmsh
import numpy as np
import ufl
from dolfinx import fem
from dolfinx.cpp.io import perm_gmsh, perm_vtk
from dolfinx.io import gmshio
from dolfinx.mesh import CellType, create_mesh
from mpi4py import MPI
from petsc4py import PETSc
from slepc4py import SLEPc

PROGRAM = sys.argv.pop(1)


def quad_nodes(p, of_vtk, first=0):
    """(i, k) of the nodes of a quadrilateral, as Gmsh (types 10, 36, 37) or VTK (Lagrange) orders them."""
    a, b = first, first + p
    if p == 0:
        return [(a, a)]
    inside = range(1, p)
    nodes = [(a, a), (b, a), (b, b), (a, b)] + [(a + i, a) for i in inside] + [(b, a + i) for i in inside]
    if of_vtk:
        return nodes + [(i, b) for i in inside] + [(a, i) for i in inside] + [(i, k) for k in inside for i in inside]
    return nodes + [(b - i, b) for i in inside] + [(a, b - i) for i in inside] + (quad_nodes(p - 2, False, first + 1) if p > 1 else [])


def permutation(cell, p, n):
    """dolfinx of Debian 12 has no permutation of Gmsh's order 4: triangles have VTK's order, and quadrilaterals come to it."""
    if p < 4:
        return perm_gmsh(cell, n)
    if cell == CellType.triangle:
        return perm_vtk(cell, n)
    ours = quad_nodes(p, False)
    return np.array([ours.index(quad_nodes(p, True)[i]) for i in perm_vtk(cell, n)])


class Sphere(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="carreau dolfinx ")
        cls.step = os.path.join(cls.folder.name, "sphere.step")
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.addSphere(0, 0, 0, 1)
        gmsh.model.occ.synchronize()
        gmsh.write(cls.step)
        if subprocess.run([PROGRAM, "info", cls.step], capture_output=True).returncode != 0:
            raise unittest.SkipTest("this program reads no STEP files")

    @classmethod
    def tearDownClass(cls):
        gmsh.finalize()
        cls.folder.cleanup()

    def errors(self, size, p, *options):
        path = os.path.join(self.folder.name, "x.msh2")  # version 2.2 has no groups of solids without elements
        subprocess.run([PROGRAM, "mesh", self.step, "--size", str(size), "-o", path, "-q", *options], check=True)
        gmsh.clear()
        gmsh.open(path)
        (kind,), _, (nodes,) = gmsh.model.mesh.getElements(2)
        name, _, order, n, *_ = gmsh.model.mesh.getElementProperties(kind)
        self.assertEqual(order, p)
        shape = "triangle" if name.startswith("Triangle") else "quadrilateral"
        cell = CellType.triangle if shape == "triangle" else CellType.quadrilateral
        if p < 4:  # the way of users
            mesh, tags, _ = gmshio.model_to_mesh(gmsh.model, MPI.COMM_WORLD, 0, gdim=3)
            self.assertEqual(set(tags.values), {1})
        else:
            scalar = ufl.FiniteElement("Lagrange", ufl.Cell(shape, geometric_dimension=3), p, variant="equispaced")
            cells = (nodes.reshape(-1, n).astype(np.int64) - 1)[:, permutation(cell, p, n)]
            mesh = create_mesh(MPI.COMM_WORLD, cells, gmshio.extract_geometry(gmsh.model), ufl.Mesh(ufl.VectorElement(scalar)))
        self.assertEqual(mesh.topology.index_map(2).size_local, len(nodes) // n)
        dx = ufl.Measure("dx", domain=mesh, metadata={"quadrature_degree": 12})
        area = fem.assemble_scalar(fem.form(fem.Constant(mesh, PETSc.ScalarType(1)) * dx))
        space = fem.FunctionSpace(mesh, ("Lagrange", p))
        u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
        stiffness = fem.petsc.assemble_matrix(fem.form(ufl.inner(ufl.grad(u), ufl.grad(v)) * dx))
        mass = fem.petsc.assemble_matrix(fem.form(u * v * dx))
        stiffness.assemble(), mass.assemble()
        solver = SLEPc.EPS().create()
        solver.setOperators(stiffness, mass)
        solver.setProblemType(SLEPc.EPS.ProblemType.GHEP)
        solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
        solver.setTarget(2.1)
        solver.getST().setType("sinvert")
        solver.setDimensions(3)
        solver.setTolerances(1e-12)
        solver.solve()
        near = [solver.getEigenvalue(i).real for i in range(3)]
        self.assertLess(max(abs(x - 2) for x in near), 0.1)  # three times: the coordinates
        return abs(area / (4 * math.pi) - 1), max(abs(x - 2) for x in near)

    def test_orders_of_convergence(self):
        for p, options in ((2, ("--element", "p2")), (3, ("--element", "p3")), (4, ("--element", "p4")), (2, ("--element", "q2.1", "--centre-nodes")),
                           (3, ("--element", "q3.1")), (4, ("--element", "q4.1"))):
            with self.subTest(options=options):
                coarse, fine = (self.errors(size, p, *options) for size in (0.5, 0.25))
                orders = [math.log2(a / b) for a, b in zip(coarse, fine)]
                print(" ".join(options), "area %.2e %.2e order %.2f" % (coarse[0], fine[0], orders[0]), "eigenvalue %.2e %.2e order %.2f" % (coarse[1], fine[1], orders[1]))
                self.assertGreater(min(orders), p + 1 - 0.35)


if __name__ == "__main__":
    unittest.main()
