# SPDX-License-Identifier: BSD-3-Clause
"""Meshes: arrays, quality, defects, files, pictures."""
from __future__ import annotations

import weakref
from ctypes import byref, c_char_p, c_int32, c_int64, c_void_p
from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _declarations as c
from ._arrays import doubles, int32s
from ._calls import Path, address, asked, counted, created, file_name, require_mesh, struct, text_of
from ._library import lib
from ._records import CellQuality, Face, Quality
from ._session import SessionBase
from .convert import to_meshio, to_pyvista
from .errors import SequenceError
from .gmsh_model import to_gmsh
from .render import html, picture

Reals = NDArray[np.float64]
Ints = NDArray[np.int32]
#: Kinds of elements by the names that meshio has for them, and numbers of nodes.
CELLS = {"triangle": (c.CELL_TRIANGLE3, 3), "triangle6": (c.CELL_TRIANGLE6, 6), "quad": (c.CELL_QUAD4, 4), "quad8": (c.CELL_QUAD8, 8)}
STATUS = {c.FACE_NOT_MESHED: "not meshed", c.FACE_MESHED: "meshed", c.FACE_MENDED: "mended", c.FACE_FAILED: "failed",
          c.FACE_COLLAPSED: "collapsed"}


class Mesh:
    """A mesh of triangles in arrays, which the library has filled and which do not change; indices count from 0.

    vertices       (n, 3)     x y z, model length; elements of second order have nodes behind the corners
    triangles      (m, 3)     vertices, counterclockwise in (u, v); of curved elements and quadrilaterals: between corners
    edges          (k, 2)     vertices, along each curve
    face_ids       (m)        reference of the face of each triangle
    curve_ids      (k)        reference of the curve of each edge
    edge_mids      (k)        node of each edge; -1: the edge is straight
    vertex_ids     (n)        reference of the corner or imposed point, 0: made by the mesher
    corner_uv      (m, 3, 2)  u v of each corner in its face; None: of a mesh that no session has made
    corner_faces   (m, 3)     the face of corner_uv; None as above
    sizes          (n)        prescribed sizes, model length; None as above
    fields         of add_field, by name
    dimension      3, or 2: of the plane z = 0
    session        that has made it; None: of a file or of arrays

    A mesh whose session has made a later mesh is measured and written as straight triangles.
    """

    def __init__(self, vertices: ArrayLike, triangles: ArrayLike, *, edges: Optional[ArrayLike] = None,
                 face_ids: Optional[ArrayLike] = None, curve_ids: Optional[ArrayLike] = None,
                 vertex_ids: Optional[ArrayLike] = None, corner_uv: Optional[ArrayLike] = None) -> None:
        """A mesh of arrays, to be measured, checked, written: vertices (n, 2) or (n, 3), the rest as above. Raises
        ArgumentError."""
        points = np.asarray(vertices, dtype=np.float64)
        self.dimension = 2 if points.ndim == 2 and points.shape[1] == 2 else 3
        points = doubles(points, "vertices", None, self.dimension)
        corners = int32s(triangles, "triangles", None, 3)
        lines = int32s(np.empty((0, 2)) if edges is None else edges, "edges", None, 2)
        given = [("vertex_refs", vertex_ids, len(points)), ("triangle_refs", face_ids, len(corners)), ("edge_refs", curve_ids, len(lines))]
        refs = {name: None if ids is None else int32s(ids, name, count) for name, ids, count in given}
        uv = None if corner_uv is None else doubles(corner_uv, "corner_uv", len(corners), 3, 2)
        self._own(created(lib().mesh_create))
        arrays = struct(c.carreau_mesh_arrays, dimension=self.dimension, vertex_count=len(points), triangle_count=len(corners),
                        edge_count=len(lines), vertices=address(points), triangles=address(corners),
                        edges=address(lines) if len(lines) else None, corner_uv=address(uv),
                        **{name: address(array) for name, array in refs.items()})
        require_mesh(self._handle, lib().mesh_from_arrays(self._handle, byref(arrays)))
        self._fill()

    def _own(self, handle: c_void_p) -> None:
        self._handle, self._run = handle, 0
        self.session: Optional[SessionBase] = None
        weakref.finalize(self, lib().mesh_free, handle)

    @classmethod
    def _filled_by(cls, fill: Callable[[c_void_p], int]) -> "Mesh":
        """The mesh that fill(handle) makes of a new mesh."""
        made = cls.__new__(cls)
        made._own(created(lib().mesh_create))
        made._require(fill(made._handle))
        made._fill()
        return made

    @classmethod
    def _of_session(cls, session: SessionBase, handle: c_void_p, is_plane: bool) -> "Mesh":
        made = cls.__new__(cls)
        made._handle, made.session, made._run = handle, session, session._runs
        made._fill()
        if is_plane:
            made.dimension = 2
        return made

    @classmethod
    def read(cls, path: Path) -> "Mesh":
        """The mesh of a file .mesh, .meshb, .vtu, .stl, .msh, .off, .obj or .ply. Raises FileError."""
        return cls._filled_by(lambda handle: lib().mesh_read(handle, file_name(path)))  # type: ignore[no-any-return]

    def _fill(self) -> None:
        count = [c_int64(), c_int64(), c_int64()]
        self._require(lib().mesh_count(self._handle, *map(byref, count), None))
        n, m, k = (each.value for each in count)
        self.vertices: Reals = self._array(lib().mesh_vertices, n, 3)
        self.vertex_ids: Ints = self._array(lib().mesh_vertex_refs, n, dtype=np.int32)
        self.triangles: Ints = self._array(lib().mesh_triangles, m, 3, dtype=np.int32)
        self.face_ids: Ints = self._array(lib().mesh_triangle_refs, m, dtype=np.int32)
        self.edges: Ints = self._array(lib().mesh_edges, k, 2, dtype=np.int32)
        self.curve_ids: Ints = self._array(lib().mesh_edge_refs, k, dtype=np.int32)
        self.edge_mids: Ints = self._array(lib().mesh_edge_mids, k, dtype=np.int32)
        self.corner_uv: Optional[Reals] = self._array_if_any(lib().mesh_corner_uv, m, 3, 2)
        self.corner_faces: Optional[Ints] = self._array_if_any(lib().mesh_corner_faces, m, 3, dtype=np.int32)
        self.sizes: Optional[Reals] = self._array_if_any(lib().mesh_vertex_sizes, n)
        dimension = c_int32()
        self._require(lib().mesh_dimension(self._handle, byref(dimension)))
        self.dimension = dimension.value
        order = c_int32()
        self._require(lib().mesh_order(self._handle, byref(order)))
        self.order = order.value
        self.faces: list[Face] = self._faces()
        self.fields: dict[str, Reals] = {}
        self.cells: dict[str, tuple[Ints, Ints]] = self._cells()

    def _array(self, ask: Callable[..., int], rows: int, *columns: int, dtype: Any = np.float64) -> NDArray[Any]:
        array: NDArray[Any] = np.empty((rows, *columns), dtype=dtype)
        self._require(ask(self._handle, rows, array))
        array.flags.writeable = False
        return array

    def _array_if_any(self, ask: Callable[..., int], rows: int, *columns: int, dtype: Any = np.float64) -> Optional[NDArray[Any]]:
        try:
            return self._array(ask, rows, *columns, dtype=dtype)
        except SequenceError:
            return None

    def _faces(self) -> list[Face]:
        count = counted(lambda out: self._require(lib().mesh_count(self._handle, None, None, None, out)))
        return [asked(c.carreau_face, lambda out, k=k: self._require(lib().mesh_face(self._handle, k, out)))  # type: ignore[misc]
                for k in range(count)]

    def periodic(self) -> list[tuple[int, int, int, NDArray[np.float64], Ints]]:
        """Pairs of entities that periodicities carry onto each other: dimension (0, 1, 2), slave, master, map (3, 4), nodes (n, 2).

        Nodes are rows of points: slave, master.
        """
        pairs, nodes = c_int64(), c_int64()
        self._require(lib().mesh_periodic_count(self._handle, byref(pairs), byref(nodes)))
        n = pairs.value
        dimensions, refs, maps = np.empty(n, np.int32), np.empty((n, 2), np.int32), np.empty((n, 3, 4))
        counts, rows = np.empty(n, np.int64), np.empty((nodes.value, 2), np.int32)
        self._require(lib().mesh_periodic(self._handle, n, nodes.value, dimensions, refs, maps, counts, rows))
        ends = np.cumsum(counts)
        return [(int(dimensions[i]), int(refs[i, 0]), int(refs[i, 1]), maps[i], rows[ends[i] - counts[i]:ends[i]]) for i in range(n)]

    def face_sides(self, face: int) -> tuple[int, int]:
        """The solids on both sides of a face by its reference: the solid that its triangles look out of, and the other solid; 0:
        none."""
        solids = np.empty(2, np.int32)
        self._require(lib().mesh_face_sides(self._handle, face, solids))
        return int(solids[0]), int(solids[1])

    def entity_name(self, dimension: int, ref: int) -> str:
        """The name of points (dimension 0), curves (1), a face (2) or a solid (3); "": none."""
        return text_of(lib().mesh_entity_name(self._handle, dimension, ref))  # type: ignore[no-any-return]

    def _cells(self) -> dict[str, tuple[Ints, Ints]]:
        found = {}
        for name, (kind, nodes) in CELLS.items():
            count = counted(lambda out: self._require(lib().mesh_cell_count(self._handle, kind, out)))
            if count == 0:
                continue
            rows, refs = np.empty((count, nodes), dtype=np.int32), np.empty(count, dtype=np.int32)
            self._require(lib().mesh_cells(self._handle, kind, count, rows, refs))
            found[name] = (rows, refs)
        return found

    def _require(self, status: int) -> None:
        require_mesh(self._handle, status)

    def _live(self) -> c_void_p:
        """A handle with this content. The handle of a session shows its latest mesh: an earlier mesh lives on as a
        copy."""
        session = self.session
        if session is not None and not (session._close.alive and session._runs == self._run):
            copy = Mesh(self.vertices[:, :self.dimension], self.triangles, edges=self.edges, face_ids=self.face_ids,
                        curve_ids=self.curve_ids, vertex_ids=self.vertex_ids, corner_uv=self.corner_uv)
            self._handle, self.session, self._copy = copy._handle, None, copy
        return self._handle

    # ---- the model ----

    def vertex_entities(self) -> tuple[Ints, Ints]:
        """The dimension of the entity that each vertex lies on (0 points, 1 curves, 2 faces), and its reference; mesh of a session only."""
        n = len(self.vertices)
        dimensions, refs = np.empty(n, dtype=np.int32), np.empty(n, dtype=np.int32)
        self._require(lib().mesh_vertex_entities(self._handle, n, dimensions, refs))
        return dimensions, refs

    def edge_parameters(self) -> tuple[Reals, Ints, Ints]:
        """t (k, 2) at the ends of edges on curve number ic (k) of a face (k); mesh of a session only. NaN: not known."""
        k = len(self.edges)
        t, faces, ics = np.empty((k, 2)), np.empty(k, dtype=np.int32), np.empty(k, dtype=np.int32)
        self._require(lib().mesh_edge_parameters(self._handle, k, t, faces, ics))
        return t, faces, ics

    # ---- quality ----

    @property
    def failed(self) -> list[Face]:
        """Faces that have no triangles, with the reason (why)."""
        return [face for face in self.faces if face.status == c.FACE_FAILED]

    @property
    def quality(self) -> Quality:
        """Shapes, angles (degrees), area and lengths of all triangles."""
        handle = self._live()
        return asked(c.carreau_quality, lambda out: self._require(lib().mesh_quality(handle, out)))  # type: ignore[no-any-return]

    @property
    def cell_quality(self) -> CellQuality:
        """The quality of elements, curved ones and quadrilaterals too."""
        handle = self._live()
        return asked(c.carreau_cell_quality, lambda out: self._require(lib().mesh_cell_quality(handle, out)))  # type: ignore[no-any-return]

    def check(self, closed: bool = False, limit: int = 100) -> list[str]:
        """Defects that make the mesh unusable: at most `limit` sentences, an empty list without defects. closed: open edges count."""
        handle, count, text = self._live(), c_int64(), c_char_p()
        self._require(lib().mesh_defects(handle, int(closed), limit, byref(count), byref(text)))
        return [line for line in (text_of(text.value) or "").splitlines() if line]

    def regions(self) -> tuple[Ints, Reals]:
        """Regions of space that the mesh bounds: numbers (r,) of solids, 0 for a hole, and a point (r, 3) inside each."""
        handle = self._live()
        count = counted(lambda out: self._require(lib().mesh_regions(handle, 0, out, None, None)))
        solids, places = np.empty(count, dtype=np.int32), np.empty((count, 3))
        if count:
            self._require(lib().mesh_regions(handle, count, byref(c_int64()), solids, places))
        return solids, places

    @property
    def triangle_sides(self) -> Ints:
        """Solids (m, 2) beside each triangle: the one that it looks out of, and the other one; 0: none."""
        solids = np.empty((len(self.triangles), 2), dtype=np.int32)
        self._require(lib().mesh_triangle_sides(self._live(), len(solids), solids))
        return solids

    def crossings(self, threads: int = 0) -> tuple[Ints, Reals]:
        """Pairs of triangles that cross (k, 2), and a place of each (k, 3)."""
        handle = self._live()
        count = counted(lambda out: self._require(lib().mesh_intersections(handle, threads, 0, out, None, None)))
        pairs, places = np.empty((count, 2), dtype=np.int32), np.empty((count, 3))
        if count:
            self._require(lib().mesh_intersections(handle, threads, count, byref(c_int64()), pairs, places))
        return pairs, places

    @property
    def normals(self) -> Reals:
        """Normals (m, 3) of the triangles, as long as twice their areas."""
        a, b, d = (self.vertices[self.triangles[:, i]] for i in range(3))
        normals: Reals = np.cross(b - a, d - a)
        return normals

    @property
    def areas(self) -> Reals:
        """Areas (m) of the triangles, model length^2."""
        areas: Reals = np.linalg.norm(self.normals, axis=1) / 2
        return areas

    # ---- files and others ----

    def write(self, path: Path) -> None:
        """Writes a file .mesh, .meshb, .vtu, .stl, .msh, .msh2, .bl2d or, of a session, .exr. Raises FileError."""
        self._require(lib().mesh_write(self._live(), file_name(path)))

    def add_field(self, name: str, values: ArrayLike) -> None:
        """Adds a field for .vtu files: a row for each vertex, or for each triangle. The mesh parts from its session."""
        rows = np.ascontiguousarray(values, dtype=np.float64)
        if len(rows) not in (len(self.vertices), len(self.triangles)):
            raise ValueError(f"the field has {len(rows)} rows; there are {len(self.vertices)} vertices and {len(self.triangles)} triangles")
        self._run = -1  # fields belong to meshes of nobody
        components = rows.size // max(len(rows), 1)
        self._require(lib().mesh_add_field(self._live(), name.encode(), int(len(rows) == len(self.vertices)), components, rows))
        self.fields[name] = rows.copy()

    def to_meshio(self) -> Any:
        """A meshio.Mesh, which shares the arrays: its cells are the elements, and edges of curves; cell_data["face"] has the references.
        Groups are in field_data and cell_data["gmsh:physical"], which meshio writes to .msh; sizes and fields of add_field in point_data or
        cell_data. Raises ImportError without the package meshio."""
        return to_meshio(self)

    def to_gmsh(self, tolerance: float = 1e-3) -> None:
        """Puts the mesh into the running Gmsh, whose model has the same CAD file; see carreau.to_gmsh."""
        to_gmsh(self, tolerance)

    def to_pyvista(self, edges: bool = False) -> Any:
        """A pyvista.PolyData of the triangles, or a pyvista.UnstructuredGrid of other elements; cell_data["face"] has the references. With
        edges, edges of curves are cells behind the elements, whose references are in cell_data["curve"];
        field_data["face_names"] the names of faces 1, 2, ...; faces of one name are a group, whose number is in cell_data["group"] and
        whose name stands beside it in field_data["group_numbers"] and ["group_names"]. Raises ImportError without the package pyvista."""
        return to_pyvista(self, edges)

    def picture(self, path: Optional[Path] = None, **options: Any) -> bytes:
        """A picture as PNG, written to a file where a path is given. options: width and height (pixels), view ("iso",
        "top", "front", "right", or a direction from which to look), edges, colors ("face", "quality", or n or m values); see
        carreau.render."""
        data = picture(self, **options)
        if path is not None:
            with open(path, "wb") as file:
                file.write(data)
        return data

    def _repr_png_(self) -> bytes:
        return self.picture()

    def _repr_html_(self) -> str:
        return html(self)

    def __repr__(self) -> str:
        counts = f"{len(self.vertices)} vertices, {len(self.triangles)} triangles, {len(self.edges)} edges on curves"
        return f"<carreau.Mesh: {counts}, {len(self.faces)} faces>"
