# SPDX-License-Identifier: BSD-3-Clause
"""Carreau: conforming meshes of surfaces made of parametric patches.

    import carreau

    mesh = carreau.mesh("part.step", size="1%", angle=8)
    mesh.vertices, mesh.triangles, mesh.face_ids          # NumPy arrays
    mesh.write("part.vtu")

Geometry is a file, a formula, arrays of triangles, or functions of (u, v) in NumPy:

    torus = lambda u, v: ((2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v))
    mesh = carreau.mesh(torus, domain=(0, 0, 2 * np.pi, 2 * np.pi), size=lambda x, y, z: 0.05 + 0.1 * abs(z))

Lengths are in the units of the model, angles in degrees, times in seconds; indices count from 0. docs/tutorials/python.md is the
tutorial, and carreau.h the manual of the library.
"""
from . import capi, domains, errors, metric
from ._callbacks import scalar
from ._library import version
from .atlas import Atlas
from .cad import CadFile
from .domains import Curve, arc, box, disc, polygon, ring, segment
from .errors import (ArgumentError, BusyError, CallbackError, Cancelled, CarreauError, DomainError, FileError, InternalError,
                     LimitError, ModelError, OutOfMemory, PartialError, SequenceError)
from .gmsh_model import to_gmsh
from .loops import Annulus, Loop
from .meshes import Mesh
from .meshing import adapt, fields, mesh, plane
from .molecules import Areas, areas
from .planes import PlaneDomain, polygons
from .remeshing import Remeshed, Tool, remesh
from .session import Session, parameters
from .surfaces import Patch, Surface, patch

__version__ = "0.1.0"
__all__ = [
    "Annulus", "Areas", "ArgumentError", "Atlas", "BusyError", "CadFile", "CallbackError", "Cancelled", "CarreauError", "Curve", "DomainError",
    "FileError", "InternalError", "LimitError", "Loop", "Mesh", "ModelError", "OutOfMemory", "PartialError", "Patch", "PlaneDomain",
    "Remeshed", "SequenceError", "Session", "Surface", "Tool", "adapt", "arc", "areas", "box", "capi", "disc", "domains",
    "errors", "fields", "mesh", "metric", "parameters", "patch", "plane", "polygon", "polygons", "read", "remesh", "ring", "scalar", "segment",
    "to_gmsh", "version"]

read = Mesh.read
