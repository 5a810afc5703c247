# SPDX-License-Identifier: BSD-3-Clause
"""Sessions: geometry, parameters and the mesh made of them."""
from __future__ import annotations

from ctypes import byref, c_int64, c_void_p
from typing import Any, Callable, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _declarations as c
from ._geometries import Geometries
from ._calls import counted
from ._library import lib
from ._session import SessionBase, log, parameters
from .convert import raised_to_meshio, raised_to_pyvista
from .errors import PartialError
from .meshes import Ints, Mesh, Reals
from .progress import Progress

__all__ = ["Raised", "Session", "parameters"]


class Raised(NamedTuple):
    """Elements of one order over a mesh: nodes, rows of nodes in Gmsh's order, references of faces and of curves."""
    order: int
    nodes: Reals
    triangles: Ints
    triangle_refs: Ints
    quads: Ints
    quad_refs: Ints
    edges: Ints
    edge_refs: Ints
    invalid: int

    def to_meshio(self, mesh: Optional[Mesh] = None) -> Any:
        """A meshio.Mesh as of Mesh.to_meshio(); mesh names its faces and curves."""
        return raised_to_meshio(self, mesh)

    def to_pyvista(self, mesh: Optional[Mesh] = None) -> Any:
        """A pyvista.UnstructuredGrid of Lagrange cells, with edges of curves, as of Mesh.to_pyvista()."""
        return raised_to_pyvista(self, mesh)


class Session(SessionBase, Geometries):
    """Holds geometry, model, parameters and the mesh made of them.

        session = carreau.Session(hphydef=0.1)
        session.add(carreau.Patch(lambda u, v: (u, v, u * v)))
        mesh = session.generate()

    Keywords are parameters, which `carreau params` and carreau.parameters() list; session["hphydef"] reads and writes
    them, too. Geometries are added by add() and add_...(), load_...() and read_pardom(). A session belongs to one thread
    at a time; only stop() may be called from anywhere. Messages go to the logger "carreau".

    messages   (level, sentence) of the last run; levels as in carreau.h: 0 error, 1 warning, 10 summary, ...
    """

    def generate(self, progress: Progress = None) -> Mesh:
        """Makes the mesh. With the parameter failing_faces at "leave_out" it may lack faces: mesh.failed lists them.

        progress   True: a bar; or a function of (fraction, phase, entity), which returns True to stop. Raises
        CarreauError; CallbackError from the exception of a callback; KeyboardInterrupt."""
        try:
            self._run(lib().mesh_generate, progress=progress)
        except PartialError as partial:
            log.warning("%s", partial)
        self._runs += 1
        del self._sizes[:-1]
        return self.mesh

    def _followed(self, function: Callable[..., int], *arguments: Any) -> Mesh:
        try:
            self._run(function, *arguments)
        except PartialError as partial:
            log.warning("%s", partial)
        self._runs += 1
        del self._sizes[:-1]
        return self.mesh

    def carry(self, old: Mesh, match: str = "any") -> Mesh:
        """The mesh of another session on this session's geometry, of equal topology: match by "reference", "name" or "shape"."""
        by = {"any": c.MATCH_ANY, "reference": c.MATCH_REFERENCE, "name": c.MATCH_NAME, "shape": c.MATCH_SHAPE}
        if match not in by:
            raise ValueError(f"match is {match!r}; it must be one of {', '.join(by)}")
        return self._followed(lib().mesh_carry, old._handle, by[match])

    def halve(self, times: int = 1) -> Mesh:
        """Halves all edges of the mesh on its surfaces: each element becomes four."""
        return self._followed(lib().mesh_halve, times)

    def refine(self, *, edges: Optional[ArrayLike] = None, elements: Optional[ArrayLike] = None, sizes: Optional[ArrayLike] = None) -> Mesh:
        """Halves marked edges (n, 2), all edges of marked elements, or edges longer than sizes at vertices allow, on the surfaces."""
        if (edges is not None) + (elements is not None) + (sizes is not None) != 1:
            raise ValueError("one of edges, elements and sizes is needed")
        if sizes is not None:
            values = np.ascontiguousarray(sizes, dtype=float).ravel()
            return self._followed(lib().mesh_refine_sizes, len(values), values)
        kind = c.MARK_ELEMENTS if edges is None else c.MARK_EDGES
        marks = np.ascontiguousarray(elements if edges is None else edges, dtype=np.int32).reshape(-1, 2 if kind == c.MARK_EDGES else 1)
        return self._followed(lib().mesh_refine, kind, len(marks), marks)

    def raise_order(self, order: int, places: str = "equidistant") -> Raised:
        """Elements of order 2 to 4 over the mesh, best of order 2; places of nodes: "equidistant" or "gauss-lobatto"."""
        by = {"equidistant": c.EQUIDISTANT, "gauss-lobatto": c.GAUSS_LOBATTO}
        if places not in by:
            raise ValueError(f"places is {places!r}; it must be one of {', '.join(by)}")
        invalid = counted(lambda out: self._call(lib().raise_order, order, by[places], out))
        numbers = [c_int64() for _ in range(4)]
        self._call(lib().raised_count, *map(byref, numbers))
        counts = [each.value for each in numbers]
        nodes = np.empty((counts[0], 3))
        self._call(lib().raised_nodes, len(nodes), nodes)
        found: list[Ints] = []
        for corners, n, width in ((3, counts[1], (order + 1) * (order + 2) // 2), (4, counts[2], (order + 1) ** 2), (2, counts[3], order + 1)):
            rows, refs = np.empty((n, width), dtype=np.int32), np.empty(n, dtype=np.int32)
            self._call(lib().raised_elements, corners, len(rows), rows, refs)
            found += [rows, refs]
        triangles, triangle_refs, quads, quad_refs, edges, edge_refs = found
        return Raised(order, nodes, triangles, triangle_refs, quads, quad_refs, edges, edge_refs, invalid)

    def write_raised(self, path: str) -> None:
        """Writes these elements: .msh (Gmsh), .vtu, .mesh (MFEM)."""
        self._call(lib().raised_write, str(path).encode())

    @property
    def mesh(self) -> Mesh:
        """The latest mesh, in arrays that do not change. Raises SequenceError before the first mesh."""
        handle = c_void_p()
        self._call(lib().session_mesh, byref(handle))
        return Mesh._of_session(self, handle, any(each.kind == c.GEOMETRY_PLANE for each in self.geometries))
