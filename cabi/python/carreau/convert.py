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


def _groups(mesh: MeshContent) -> tuple[dict[str, Any], dict[int, int], dict[int, int]]:
    """Groups of faces and curves as Gmsh has them: field_data, and numbers of groups by references. Entities of one name are one group."""
    found: dict[str, Any] = {}
    numbers: tuple[dict[int, int], dict[int, int]] = ({}, {})
    for dimension, refs, prefix in ((2, mesh.face_ids, "face_"), (1, mesh.curve_ids, "curve_")):
        for ref in (int(each) for each in np.unique(refs)):
            name = mesh.entity_name(dimension, ref) or f"{prefix}{ref}"
            numbers[2 - dimension][ref] = int(found.setdefault(name, np.array([ref, dimension]))[0])
    return found, numbers[0], numbers[1]


def to_meshio(mesh: MeshContent) -> Any:
    meshio = package("meshio", ", or apt-get install python3-meshio", "to_meshio()")
    blocks = {name: rows for name, rows in mesh.cells.items()}
    if len(mesh.edges):
        curved = bool((mesh.edge_mids >= 0).all())
        rows = np.column_stack([mesh.edges, mesh.edge_mids]) if curved else mesh.edges
        blocks["line3" if curved else "line"] = (rows, mesh.curve_ids)
    groups, of_faces, of_curves = _groups(mesh)
    physical = [np.array([(of_curves if name.startswith("line") else of_faces)[int(ref)] for ref in refs], dtype=np.int32)
                for name, (_, refs) in blocks.items()]
    references = [refs for _, refs in blocks.values()]
    points: dict[str, Any] = {"reference": mesh.vertex_ids}
    cells: dict[str, Any] = {"face": references, "gmsh:physical": physical, "gmsh:geometrical": references}
    if mesh.sizes is not None:
        points["size"] = mesh.sizes
    for name, values in mesh.fields.items():
        if len(values) == len(mesh.vertices):
            points[name] = values
        elif list(blocks)[:1] == ["triangle"] and len(blocks) <= 1 + len(mesh.edges[:1]):  # triangles are the elements
            cells[name] = [values] + [np.full((len(refs), *values.shape[1:]), np.nan) for refs in references[1:]]
    return meshio.Mesh(mesh.vertices, [(name, nodes) for name, (nodes, _) in blocks.items()],
                       point_data=points, cell_data=cells, field_data=groups)


#: Cells of VTK, whose nodes have the order of Mesh.cells.
VTK = {"triangle": 5, "triangle6": 22, "quad": 9, "quad8": 23}


def to_pyvista(mesh: MeshContent) -> Any:
    pyvista = package("pyvista", "", "to_pyvista()")
    if set(mesh.cells) <= {"triangle"}:
        faces = np.column_stack([np.full(len(mesh.triangles), 3, dtype=np.int64), mesh.triangles]).ravel()
        made = pyvista.PolyData(mesh.vertices, faces)
        made.cell_data["face"] = mesh.face_ids
    else:
        rows = [np.column_stack([np.full(len(nodes), nodes.shape[1], dtype=np.int64), nodes]).ravel() for nodes, _ in mesh.cells.values()]
        kinds = [np.full(len(nodes), VTK[name], dtype=np.uint8) for name, (nodes, _) in mesh.cells.items()]
        made = pyvista.UnstructuredGrid(np.concatenate(rows), np.concatenate(kinds), mesh.vertices)
        made.cell_data["face"] = np.concatenate([refs for _, refs in mesh.cells.values()])
    made.point_data["reference"] = mesh.vertex_ids
    if mesh.sizes is not None:
        made.point_data["size"] = mesh.sizes
    for name, values in mesh.fields.items():
        if len(values) == len(mesh.vertices):
            made.point_data[name] = values
        elif len(values) == made.n_cells:
            made.cell_data[name] = values
    groups, of_faces, _ = _groups(mesh)
    made.cell_data["group"] = np.array([of_faces[int(ref)] for ref in made.cell_data["face"]], dtype=np.int32)
    made.field_data["group_names"] = [name for name, (_, dimension) in groups.items() if dimension == 2]
    made.field_data["group_numbers"] = [int(number) for number, dimension in groups.values() if dimension == 2]
    made.field_data["face_names"] = [mesh.entity_name(2, ref) for ref in range(1, int(max(mesh.face_ids, default=0)) + 1)]
    return made
