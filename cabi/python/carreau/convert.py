# SPDX-License-Identifier: BSD-3-Clause
"""Meshes for other packages."""
from __future__ import annotations

import importlib
from typing import Any

import numpy as np

from ._content import MeshContent


def package(name: str, debian: str, what: str) -> Any:
    """A package that is not needed otherwise."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(f"{what} needs the package {name}: pip install {name}{debian}") from error


def to_meshio(mesh: MeshContent) -> Any:
    meshio = package("meshio", ", or apt-get install python3-meshio", "to_meshio()")
    blocks = {name: rows for name, rows in mesh.cells.items()}
    if len(mesh.edges):
        blocks["line"] = (mesh.edges, mesh.curve_ids)
    return meshio.Mesh(mesh.vertices, [(name, nodes) for name, (nodes, _) in blocks.items()],
                       point_data={"reference": mesh.vertex_ids}, cell_data={"face": [refs for _, refs in blocks.values()]})


def to_pyvista(mesh: MeshContent) -> Any:
    pyvista = package("pyvista", "", "to_pyvista()")
    faces = np.column_stack([np.full(len(mesh.triangles), 3, dtype=np.int64), mesh.triangles]).ravel()
    made = pyvista.PolyData(mesh.vertices, faces)
    made.cell_data["face"] = mesh.face_ids
    made.point_data["reference"] = mesh.vertex_ids
    if mesh.sizes is not None:
        made.point_data["size"] = mesh.sizes
    return made
