# SPDX-License-Identifier: BSD-3-Clause
"""The content of a mesh, for modules that show and convert it."""
from __future__ import annotations

from typing import Any, Optional, Protocol

import numpy as np
from numpy.typing import NDArray

from ._records import Face, Quality


class RaisedContent(Protocol):
    """Members of carreau.session.Raised."""

    @property
    def order(self) -> int: ...
    @property
    def nodes(self) -> NDArray[np.float64]: ...
    @property
    def triangles(self) -> NDArray[np.int32]: ...
    @property
    def triangle_refs(self) -> NDArray[np.int32]: ...
    @property
    def quads(self) -> NDArray[np.int32]: ...
    @property
    def quad_refs(self) -> NDArray[np.int32]: ...
    @property
    def edges(self) -> NDArray[np.int32]: ...
    @property
    def edge_refs(self) -> NDArray[np.int32]: ...


class MeshContent(Protocol):
    """Members of carreau.Mesh."""

    vertices: NDArray[np.float64]
    vertex_ids: NDArray[np.int32]
    triangles: NDArray[np.int32]
    face_ids: NDArray[np.int32]
    edges: NDArray[np.int32]
    curve_ids: NDArray[np.int32]
    edge_mids: NDArray[np.int32]
    sizes: Optional[NDArray[np.float64]]
    dimension: int
    faces: list[Face]
    cells: dict[str, tuple[NDArray[np.int32], NDArray[np.int32]]]

    fields: dict[str, NDArray[np.float64]]

    def entity_name(self, dimension: int, ref: int) -> str: ...
    @property
    def normals(self) -> NDArray[np.float64]: ...
    @property
    def quality(self) -> Quality: ...
    @property
    def failed(self) -> list[Face]: ...
    def picture(self, **options: Any) -> bytes: ...
