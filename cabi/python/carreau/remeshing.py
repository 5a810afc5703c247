# SPDX-License-Identifier: BSD-3-Clause
"""Pieces of the plane that deform, break and touch tools, meshed anew increment by increment (docs/how-to/deforming_piece.md)."""
from __future__ import annotations

from dataclasses import dataclass
from ctypes import byref
from typing import Any, NamedTuple, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _declarations as c
from ._arrays import doubles, int32s
from ._calls import address, record, require_mesh, struct
from ._library import lib
from ._records import RemeshSummary
from .errors import ArgumentError
from .meshes import Mesh

Reals = NDArray[np.float64]
CURVES = {"tangent": c.SPLINE_TANGENT, "natural": c.SPLINE_NATURAL, "polygon": c.POLYGON}
ERRORS = {"": c.ERROR_NONE, "hessian": c.ERROR_HESSIAN, "curvature": c.ERROR_CURVATURE, "deformation": c.ERROR_DEFORMATION}


@dataclass
class Tool:
    """A rigid tool: points (n, 2) of a polyline with the solid on its left; radii (n) round its corners."""

    points: ArrayLike
    radii: Optional[ArrayLike] = None
    closed: bool = False


class Remeshed(NamedTuple):
    """The next mesh, and the fields carried to it. Fields that were not given are None."""

    mesh: Mesh
    summary: RemeshSummary
    nodal: Optional[Reals]
    elements: Optional[Reals]
    damage: Optional[Reals]


def _tools(tools: Sequence[Tool]) -> dict[str, Any]:
    points = [doubles(tool.points, "a tool", None, 2) for tool in tools]
    radii = [np.zeros(len(p)) if tool.radii is None else doubles(tool.radii, "radii", len(p)) for tool, p in zip(tools, points)]
    return {"tool_starts": np.cumsum([0] + [len(p) for p in points], dtype=np.int64),
            "tool_points": np.concatenate(points or [np.empty((0, 2))]),
            "tool_radii": np.concatenate(radii or [np.empty(0)]), "tool_closed": np.array([int(tool.closed) for tool in tools], dtype=np.int32)}


def _columns(values: Optional[ArrayLike], rows: int, name: str) -> Optional[Reals]:
    return None if values is None else doubles(np.reshape(np.asarray(values, dtype=np.float64), (rows, -1)), name, rows, None)


def remesh(vertices: ArrayLike, triangles: ArrayLike, *, h_min: float, h_max: float, step: float, tools: Sequence[Tool] = (),
           displacements: Optional[ArrayLike] = None, damage: Optional[ArrayLike] = None, nodal: Optional[ArrayLike] = None,
           elements: Optional[ArrayLike] = None, vertex_kinds: Optional[ArrayLike] = None, conserved: Sequence[bool] = (), curves: str = "tangent", error: str = "",
           **options: Any) -> Remeshed:
    """Meshes a piece anew after an increment.

    vertices       (n, 2), the displacement of the increment added; triangles (m, 3), counterclockwise
    h_min, h_max   bounds of sizes; step: vertices as near to a tool are bound, at most h_min
    displacements  (n, 2), to be checked
    damage         (m), in [0, 1]: totally damaged triangles are removed
    vertex_kinds   (n): mesh.vertex_refs of the last increment; faces that were laid bare stay imposed
    nodal          (n) or (n, k), elements (m) or (m, k): fields to be carried on; conserved: for each column of
                   elements, whether its integral stays, in place of means
    curves         between corners: "tangent", "natural" (splines), "polygon"
    error          estimator of the sizes from a field of nodal: "hessian", "curvature", "deformation", with
                   error_component and error_tolerance
    options        damage_limit, gradation, corner_angle, curvature_angle, imposed_smoothing, keep_all_parts,
                   no_damage_sizes, max_triangles, remove_overlaps, reach: members of carreau_remesh_input

    Raises ArgumentError, DomainError where the piece overlaps itself, LimitError.
    """
    xy, corners = doubles(vertices, "vertices", None, 2), int32s(triangles, "triangles", None, 3)
    if curves not in CURVES or error not in ERRORS:
        raise ArgumentError(f"curves is one of {', '.join(CURVES)}, error one of {', '.join(filter(None, ERRORS))}")
    at_nodes, in_elements = _columns(nodal, len(xy), "nodal"), _columns(elements, len(corners), "elements")
    kinds = np.array([c.ELEMENT_CONSERVED if each else c.ELEMENT_MEAN for each in conserved], dtype=np.int32)
    if len(kinds) and (in_elements is None or len(kinds) != in_elements.shape[1]):
        raise ArgumentError("conserved has a word for each column of elements")
    arrays: dict[str, Any] = {
        "vertices": xy, "triangles": corners, "displacements": None if displacements is None else doubles(displacements, "displacements", len(xy), 2),
        "damage": None if damage is None else doubles(damage, "damage", len(corners)), "nodal_values": at_nodes,
        "vertex_kinds": None if vertex_kinds is None else int32s(vertex_kinds, "vertex_kinds", len(xy)),
        "element_values": in_elements, "element_kinds": kinds if len(kinds) else None, **_tools(tools)}
    options["has_reach"] = int("reach" in options)
    given = struct(c.carreau_remesh_input, vertex_count=len(xy), triangle_count=len(corners), tool_count=len(tools), h_min=h_min,
                   h_max=h_max, step=step, nodal_components=0 if at_nodes is None else at_nodes.shape[1],
                   element_components=0 if in_elements is None else in_elements.shape[1], curves=CURVES[curves],
                   error_source=ERRORS[error], **{name: address(array) for name, array in arrays.items()}, **options)
    summary = struct(c.carreau_remesh_summary)
    mesh = Mesh._filled_by(lambda handle: int(lib().remesh(handle, byref(given), byref(summary))))
    return Remeshed(mesh, record(summary), _carried(mesh, lib().remesh_nodal_values, len(mesh.vertices), nodal, at_nodes),
                    _carried(mesh, lib().remesh_element_values, len(mesh.triangles), elements, in_elements),
                    _carried(mesh, lib().remesh_damage, len(mesh.triangles), damage, arrays["damage"]))


def _carried(mesh: Mesh, ask: Any, rows: int, given: Optional[ArrayLike], columns: Optional[Reals]) -> Optional[Reals]:
    """A field on the next mesh, of as many dimensions as it had."""
    if columns is None:
        return None
    out = np.empty((rows, columns.shape[1]) if columns.ndim == 2 else rows)
    require_mesh(mesh._handle, ask(mesh._handle, rows, out))
    return out.reshape(-1) if np.ndim(given) == 1 else out  # type: ignore[arg-type]
