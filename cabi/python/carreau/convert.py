# SPDX-License-Identifier: BSD-3-Clause
"""Meshes for other packages."""
from __future__ import annotations

import importlib
from typing import Any, Optional

import numpy as np

from ._content import MeshContent, RaisedContent


def package(name: str, debian: str, what: str) -> Any:
    """A package that is not needed otherwise."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(f"{what} needs the package {name}: pip install {name}{debian}") from error


def _groups(mesh: Optional[MeshContent], face_ids: Any, curve_ids: Any) -> tuple[dict[str, Any], dict[int, int], dict[int, int]]:
    """Groups of faces and curves as Gmsh has them: field_data, and numbers of groups by references. Entities of one name are one group."""
    found: dict[str, Any] = {}
    numbers: tuple[dict[int, int], dict[int, int]] = ({}, {})
    for dimension, refs, prefix in ((2, face_ids, "face_"), (1, curve_ids, "curve_")):
        for ref in (int(each) for each in np.unique(refs)):
            name = (mesh.entity_name(dimension, ref) if mesh is not None else "") or f"{prefix}{ref}"
            numbers[2 - dimension][ref] = int(found.setdefault(name, np.array([ref, dimension]))[0])
    return found, numbers[0], numbers[1]


def _edges(mesh: MeshContent) -> dict[str, tuple[Any, Any]]:
    """Edges on curves as a block of cells; empty: none."""
    if not len(mesh.edges):
        return {}
    curved = bool((mesh.edge_mids >= 0).all())
    return {"line3" if curved else "line": (np.column_stack([mesh.edges, mesh.edge_mids]) if curved else mesh.edges, mesh.curve_ids)}


def _physical(mesh: Optional[MeshContent], blocks: dict[str, tuple[Any, Any]]) -> tuple[dict[str, Any], dict[str, Any]]:
    """field_data and cell_data of blocks of elements and edges."""
    refs_of = {lines: np.concatenate([np.empty(0, dtype=np.int32)] + [refs for name, (_, refs) in blocks.items() if name.startswith("line") == lines])
               for lines in (False, True)}
    groups, of_faces, of_curves = _groups(mesh, refs_of[False], refs_of[True])
    physical = [np.array([(of_curves if name.startswith("line") else of_faces)[int(ref)] for ref in refs], dtype=np.int32)
                for name, (_, refs) in blocks.items()]
    references = [refs for _, refs in blocks.values()]
    return groups, {"face": references, "gmsh:physical": physical, "gmsh:geometrical": references}


def to_meshio(mesh: MeshContent) -> Any:
    meshio = package("meshio", ", or apt-get install python3-meshio", "to_meshio()")
    blocks = {**mesh.cells, **_edges(mesh)}
    groups, cells = _physical(mesh, blocks)
    references = cells["face"]
    points: dict[str, Any] = {"reference": mesh.vertex_ids}
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
VTK = {"line": 3, "line3": 21, "triangle": 5, "triangle6": 22, "quad": 9, "quad8": 23}
#: Lagrange cells of VTK by their corners.
LAGRANGE = {2: 68, 3: 69, 4: 70}


def _raised_blocks(raised: RaisedContent) -> dict[str, tuple[Any, Any]]:
    blocks = {"triangle": (raised.triangles, raised.triangle_refs), "quad": (raised.quads, raised.quad_refs), "line": (raised.edges, raised.edge_refs)}
    return {f"{name}{rows.shape[1]}": (rows, refs) for name, (rows, refs) in blocks.items() if len(rows)}


def raised_to_meshio(raised: RaisedContent, mesh: Optional[MeshContent] = None) -> Any:
    meshio = package("meshio", ", or apt-get install python3-meshio", "to_meshio()")
    blocks = _raised_blocks(raised)
    groups, cells = _physical(mesh, blocks)
    return meshio.Mesh(raised.nodes, [(name, nodes) for name, (nodes, _) in blocks.items()], cell_data=cells, field_data=groups)


def _square(n: int, low: int = 0) -> list[tuple[int, int]]:
    """Places of the nodes of a square of n + 1 nodes a side in Gmsh's order: corners, sides around, and the square inside."""
    if n <= 0:
        return [(low, low)] * (n == 0)
    high, along = low + n, range(low + 1, low + n)
    sides = [(k, low) for k in along] + [(high, k) for k in along] + [(k, high) for k in reversed(along)] + [(low, k) for k in reversed(along)]
    return [(low, low), (high, low), (high, high), (low, high)] + sides + _square(n - 2, low + 1)


def vtk_order(corners: int, order: int) -> list[int]:
    """The nodes of VTK's Lagrange cells by Gmsh's numbers: in quadrilaterals, opposite sides run the same way, and rows of nodes follow each
    other inside. Cells of one or two sides have one order."""
    if corners < 4:
        return list(range(order + 1 if corners == 2 else (order + 1) * (order + 2) // 2))
    number = {place: k for k, place in enumerate(_square(order))}
    along = range(1, order)
    places = ([(0, 0), (order, 0), (order, order), (0, order)] + [(k, 0) for k in along] + [(order, k) for k in along] +
              [(k, order) for k in along] + [(0, k) for k in along] + [(i, k) for k in along for i in along])
    return [number[place] for place in places]


def raised_to_pyvista(raised: RaisedContent, mesh: Optional[MeshContent] = None) -> Any:
    pyvista = package("pyvista", "", "to_pyvista()")
    blocks = [(corners, rows[:, vtk_order(corners, raised.order)], refs) for corners, rows, refs in
              ((3, raised.triangles, raised.triangle_refs), (4, raised.quads, raised.quad_refs), (2, raised.edges, raised.edge_refs)) if len(rows)]
    made = _grid(pyvista, raised.nodes, [(LAGRANGE[corners], rows, refs, corners == 2) for corners, rows, refs in blocks])
    _name_groups(made, mesh, np.concatenate([raised.triangle_refs, raised.quad_refs]))
    return made


def _grid(pyvista: Any, points: Any, blocks: list[tuple[int, Any, Any, bool]]) -> Any:
    """A grid of (VTK's type, nodes, references, whether these are curves); "face" and "curve" are 0 where there is none."""
    rows = [np.column_stack([np.full(len(nodes), nodes.shape[1], dtype=np.int64), nodes]).ravel() for _, nodes, _, _ in blocks]
    kinds = [np.full(len(nodes), kind, dtype=np.uint8) for kind, nodes, _, _ in blocks]
    made = pyvista.UnstructuredGrid(np.concatenate(rows), np.concatenate(kinds), points)
    made.cell_data["face"] = np.concatenate([0 * refs if is_curve else refs for _, _, refs, is_curve in blocks])
    if any(is_curve for _, _, _, is_curve in blocks):
        made.cell_data["curve"] = np.concatenate([refs if is_curve else 0 * refs for _, _, refs, is_curve in blocks])
    return made


def _name_groups(made: Any, mesh: Optional[MeshContent], faces: Any) -> None:
    """faces: references of elements; cells behind them have group 0."""
    groups, of_faces, _ = _groups(mesh, faces, np.empty(0, dtype=np.int32))
    made.cell_data["group"] = np.array([of_faces[int(ref)] for ref in faces] + [0] * (len(made.cell_data["face"]) - len(faces)), dtype=np.int32)
    made.field_data["group_names"] = list(groups)
    made.field_data["group_numbers"] = [int(number) for number, _ in groups.values()]
    names = mesh.entity_name if mesh is not None else lambda _, __: ""
    made.field_data["face_names"] = [names(2, ref) for ref in range(1, int(max(faces, default=0)) + 1)]


def to_pyvista(mesh: MeshContent, edges: bool = False) -> Any:
    pyvista = package("pyvista", "", "to_pyvista()")
    if set(mesh.cells) <= {"triangle"} and not edges:
        faces = np.column_stack([np.full(len(mesh.triangles), 3, dtype=np.int64), mesh.triangles]).ravel()
        made = pyvista.PolyData(mesh.vertices, faces)
        made.cell_data["face"] = mesh.face_ids
    else:
        blocks = {**mesh.cells, **(_edges(mesh) if edges else {})}
        made = _grid(pyvista, mesh.vertices, [(VTK[name], nodes, refs, name.startswith("line")) for name, (nodes, refs) in blocks.items()])
    made.point_data["reference"] = mesh.vertex_ids
    if mesh.sizes is not None:
        made.point_data["size"] = mesh.sizes
    for name, values in mesh.fields.items():
        if len(values) == len(mesh.vertices):
            made.point_data[name] = values
        elif len(values) == sum(len(nodes) for nodes, _ in mesh.cells.values()):
            made.cell_data[name] = np.concatenate([values, np.full((made.n_cells - len(values), *values.shape[1:]), np.nan)])
    _name_groups(made, mesh, mesh.face_ids)
    return made
