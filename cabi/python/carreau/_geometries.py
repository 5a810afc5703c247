# SPDX-License-Identifier: BSD-3-Clause
"""The geometries of a session, except for files of CAD."""
from __future__ import annotations

from ctypes import byref, c_int32, c_int64
from typing import Any, Callable, Iterable, NamedTuple, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _declarations as c
from ._arrays import doubles, int32s
from ._calls import Path, address, asked, counted, file_name, struct, text_of
from ._library import lib
from ._records import Geometry, MoleculeMeasures, TrianglesReport
from ._run import Host
from .atlas import Atlas
from .errors import ArgumentError, CarreauError
from .meshes import Mesh
from .planes import PlaneDomain
from .surfaces import Patch, PatchCallbacks, model_of

SURFACES = {"vws": c.VWS, "sas": c.SAS, "ses": c.SES}
MEASURED = {"points": c.MEASURED_POINTS, "heights": c.MEASURED_HEIGHTS, "radii": c.MEASURED_RADII}
GRID_FORMATS = {"": c.GRID_BY_SUFFIX, "plot3d": c.GRID_PLOT3D, "heights": c.GRID_HEIGHTS, "scan": c.GRID_SCAN, "nodes": c.GRID_NODES}


def choice(words: dict[str, int], word: str, what: str) -> int:
    if word not in words:
        raise ArgumentError(f"{what} is one of {', '.join(filter(None, words))}, not '{word}'")
    return words[word]


def molecule_options(surface: str = "vws", probe: float = 1.4, drop_cavities: bool = False, radii: Optional[Path] = None) -> Any:
    return struct(c.carreau_molecule_options, surface=choice(SURFACES, surface, "surface"), probe=probe, drop_cavities=int(drop_cavities),
                  radii=None if radii is None else file_name(radii))


def grid_options(*, measured: str = "points", smooth: Union[int, tuple[int, float, float]] = 0, lengths: bool = False,
                 orient: bool = True, join_angle: float = 0, tolerance: float = 0, step: float = 0, fill: bool = False,
                 continuity: int = 1, by_distance: bool = False) -> Any:
    rounds, *weights = smooth if isinstance(smooth, tuple) else (smooth,)
    inward, outward = weights or (0.0, 0.0)
    return struct(c.carreau_grid_options, measured=choice(MEASURED, measured, "measured"), smoothing_rounds=rounds,
                  smoothing_inward=inward, smoothing_outward=outward, lengths=int(lengths), orient=int(orient),
                  join_angle=join_angle, tolerance=tolerance, step=step, fill=int(fill), continuity=continuity,
                  smoothing_by_distance=int(by_distance))


def triangles_options(*, sharp: float = 0, corner: float = 0, given_edges: bool = False, ignore_references: bool = False,
                      keep_double_vertices: bool = False) -> Any:
    return struct(c.carreau_triangles_options, sharp_angle=sharp, corner_angle=corner, given_edges_only=int(given_edges),
                  ignore_references=int(ignore_references), keep_double_vertices=int(keep_double_vertices))


class Evaluated(NamedTuple):
    """Positions (n, 3) and derivatives up to the order: of a face (n, 2, 3), S_u and S_v, and (n, 3, 3), S_uu, S_uv, S_vv; of a curve
    (n, 1, 3) each."""

    xyz: NDArray[np.float64]
    first: Optional[NDArray[np.float64]]
    second: Optional[NDArray[np.float64]]


class Projected(NamedTuple):
    """Closest points: references of the entities found (n,), parameters (n, dimension), points (n, 3) and distances (n,)."""

    refs: NDArray[np.int32]
    parameters: NDArray[np.float64]
    xyz: NDArray[np.float64]
    distances: NDArray[np.float64]


class Geometries:
    """The part of Session that adds geometries. Each comes behind the previous geometries; the first face of the first
    geometry is face 1. Options have the names of the command."""

    _handle: Any
    _host: Host
    _kept: list[Any]

    def _call(self, function: Callable[..., int], *arguments: Any) -> None:
        raise NotImplementedError

    def _long(self, function: Callable[..., int], *arguments: Any) -> None:
        raise NotImplementedError

    def add(self, patches: Union[Patch, Iterable[Patch]]) -> None:
        """Adds patches, as one geometry: faces 1, 2, ... of it. Curves that meet are found when a mesh is made, unless
        they have references."""
        faces = [patches] if isinstance(patches, Patch) else list(patches)
        if not faces or not all(isinstance(each, Patch) for each in faces):
            raise ArgumentError("there is no patch to add, or something else among them")
        callbacks = PatchCallbacks(faces, self._host)
        given = callbacks.struct()
        self._call(lib().geometry_begin, byref(given))
        try:
            for name, arguments in model_of(faces):
                self._call(getattr(lib(), "model_" + name), *arguments)
            self._call(lib().geometry_end)
        except CarreauError:
            lib().geometry_cancel(self._handle)
            raise
        self._kept.append(given)
        callbacks.before = self.geometries[-1].first_face - 1

    def add_bezier(self, patches: Sequence[ArrayLike], side_refs: Optional[ArrayLike] = None) -> None:
        """Adds Bezier patches: control points (m + 1, n + 1, 3) of each, u along the first axis. side_refs: (k, 4),
        references of the sides v = 0, u = 1, v = 1, u = 0."""
        nets = [doubles(each, "a net of control points", None, None, 3) for each in patches]
        degrees = np.array([(net.shape[0] - 1, net.shape[1] - 1) for net in nets], dtype=np.int32)
        controls = np.concatenate([net.ravel() for net in nets]) if nets else np.empty(0)
        sides = None if side_refs is None else int32s(side_refs, "side_refs", len(nets), 4)
        self._long(lib().add_bezier, byref(struct(c.carreau_bezier, patch_count=len(nets), degrees=address(degrees),
                                                  controls=address(controls), side_refs=address(sides))))

    def load_bezier(self, path: Path) -> None:
        """Adds the patches of a file .bpt."""
        self._long(lib().load_bezier, file_name(path))

    def add_molecule(self, centers: ArrayLike, radii: ArrayLike, **options: Any) -> None:
        """Adds the surface of n balls: centers (n, 3), radii (n). options: surface ("vws", "sas", "ses"), probe (its
        radius), drop_cavities."""
        xyz = doubles(centers, "centers", None, 3)
        self._long(lib().add_molecule, byref(molecule_options(**options)), len(xyz), xyz, doubles(radii, "radii", len(xyz)))

    def load_molecule(self, path: Path, **options: Any) -> None:
        """Adds the surface of the atoms of a file .xyzr, .xyz, .pdb or .cif; option radii: a file of lines "symbol
        radius"."""
        self._long(lib().load_molecule, byref(molecule_options(**options)), file_name(path))

    @property
    def molecule(self) -> MoleculeMeasures:
        """Areas and volumes of the molecule that was added last, in closed form. Raises SequenceError."""
        return asked(c.carreau_molecule_measures, lambda out: self._call(lib().molecule_measure, out))  # type: ignore[no-any-return]

    def atom_areas(self) -> NDArray[np.float64]:
        """For each atom of that molecule: areas (n, 3) of convex, torus and concave parts."""
        n = self.molecule.atoms
        areas = np.empty((3, n))
        self._call(lib().molecule_atom_areas, n, *areas)
        return areas.T

    def atom_names(self) -> list[str]:
        """Residues of the atoms of that molecule, "" for atoms without a residue."""
        return [text_of(lib().molecule_atom_name(self._handle, k)) for k in range(self.molecule.atoms)]

    def add_grid(self, *blocks: ArrayLike, **options: Any) -> None:
        """Adds a surface through the nodes of structured grids: (rows, columns, 3) each, NaN: a node is missing. options:
        measured ("points", "heights", "radii"), smooth (rounds, or rounds and two weights), lengths, orient, join_angle
        (degrees), tolerance, step, fill, continuity (1 or 2), by_distance (weights of smoothing, HDR sec. 4.7.1)."""
        grids = [doubles(each, "a grid", None, None, 3) for each in blocks]
        counts = np.array([(grid.shape[1], grid.shape[0]) for grid in grids], dtype=np.int32)
        nodes = np.concatenate([grid.ravel() for grid in grids]) if grids else np.empty(0)
        self._long(lib().add_grid, byref(grid_options(**options)), len(grids), counts, nodes)

    def load_grid(self, path: Path, format: str = "", **options: Any) -> None:
        """Adds a surface through the grids of a file; format: "plot3d", "heights", "scan", "nodes", or "": by the
        suffix."""
        self._long(lib().load_grid, byref(grid_options(**options)), file_name(path), choice(GRID_FORMATS, format, "format"))

    def add_triangles(self, vertices: ArrayLike, triangles: ArrayLike, *, references: Optional[ArrayLike] = None,
                      edges: Optional[ArrayLike] = None, **options: Any) -> None:
        """Adds triangles, whose surface is to be meshed anew; borders that they share with others are one line. vertices (n, 3), triangles
        (m, 3) from 0, references (m) of faces, edges (k, 2) that are sharp. options: sharp and corner (degrees), given_edges,
        ignore_references, keep_double_vertices."""
        xyz, corners = doubles(vertices, "vertices", None, 3), int32s(triangles, "triangles", None, 3)
        refs = None if references is None else int32s(references, "references", len(corners))
        lines = None if edges is None else int32s(edges, "edges", None, 2)
        given = struct(c.carreau_triangles, vertex_count=len(xyz), triangle_count=len(corners), vertices=address(xyz),
                       triangles=address(corners), triangle_refs=address(refs), edge_count=0 if lines is None else len(lines),
                       edges=address(lines))
        self._long(lib().add_triangles, byref(triangles_options(**options)), byref(given))

    def load_triangles(self, path: Path, **options: Any) -> None:
        """Adds the triangles of a file .stl, .off, .obj, .ply, .mesh, .vtu or .msh."""
        self._long(lib().load_triangles, byref(triangles_options(**options)), file_name(path))

    @property
    def triangles(self) -> TrianglesReport:
        """The findings in the triangles. Raises SequenceError if no triangles were given."""
        return asked(c.carreau_triangles_report, lambda out: self._call(lib().triangles_measure, out))  # type: ignore[no-any-return]

    def triangles_distances(self) -> tuple[float, float]:
        """Largest distances from the mesh to the triangles, and back; model length."""
        pair = np.empty(2)
        self._call(lib().triangles_distances, pair)
        return float(pair[0]), float(pair[1])

    def triangles_bounds(self, share: float = 0) -> tuple[float, float, float, float]:
        """Bounds of two distances. The first two bound the largest distance from the mesh to the triangles, the others
        the distance back. They differ by a share of it (0: .01) and a millionth of the diagonal at most."""
        bounds = np.empty(4)
        self._call(lib().triangles_bounds, float(share), bounds)
        return float(bounds[0]), float(bounds[1]), float(bounds[2]), float(bounds[3])

    def refine_triangles(self, angle: float, depth: int = 6) -> Mesh:
        """The repaired triangles, cut into four on the smooth surface while normals differ from it by more than an
        angle (degrees), at most `depth` times; 0: not cut."""
        def fill(handle: Any) -> int:
            self._call(lib().triangles_refine, float(angle), depth, handle)
            return c.OK
        return Mesh._filled_by(fill)

    def add_plane(self, domain: PlaneDomain) -> None:
        """Makes a domain of the plane the only geometry."""
        self._long(lib().add_plane_domain, byref(domain._struct()))

    def load_plane(self, path: Path, sizes: Optional[Path] = None, corner_angle: float = 0) -> None:
        """Adds the plane domain of a file .poly, .mesh, .bl2d, .data or .g; sizes: a .sol, .hg or .h for its vertices. With a
        corner_angle (degrees) above 0, polygons become splines between corners."""
        self._long(lib().load_plane_domain, file_name(path), None if sizes is None else file_name(sizes), float(corner_angle))

    def plane_has_sizes(self) -> bool:
        """True if that domain has sizes at its points."""
        answer = c_int32()
        self._call(lib().plane_has_sizes, byref(answer))
        return bool(answer.value)

    def add_atlas(self, atlas: Atlas) -> None:
        """Adds the C1 surface near closed triangles; the atlas may go."""
        self._long(lib().add_atlas, atlas._handle)

    def read_pardom(self, path: Path) -> None:
        """Replaces the model by the model of a file x.pardom."""
        self._call(lib().model_read_pardom, file_name(path))

    def write_pardom(self, path: Path) -> None:
        """Writes the model in the layout of x.pardom."""
        self._call(lib().model_write_pardom, file_name(path))

    def leave_out_face(self, face: int, why: str) -> None:
        """Leaves a face out of the mesh, for a reason; "" takes it in again."""
        self._call(lib().model_leave_out_face, face, why.encode())

    # ---- content ----

    @property
    def geometries(self) -> list[Geometry]:
        """The added geometries, with their references of the session."""
        count = counted(lambda out: self._call(lib().geometry_count, out))
        return [asked(c.carreau_geometry, lambda out, k=k: self._call(lib().geometry_info, k, out))  # type: ignore[misc]
                for k in range(count)]

    @property
    def faces(self) -> NDArray[np.int32]:
        """References of the faces of the model."""
        count = counted(lambda out: self._call(lib().model_count, out, None, None))
        refs = np.empty(count, dtype=np.int32)
        self._call(lib().model_faces, count, refs, None)
        return refs

    @property
    def curves(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """References of the faces of all curves, face by face, and of the curves: 0 before gluing has found them."""
        count = counted(lambda out: self._call(lib().model_count, None, out, None))
        faces, refs = np.empty(count, dtype=np.int32), np.empty(count, dtype=np.int32)
        self._call(lib().model_curves, count, faces, None, refs, None)
        return faces, refs

    def points(self, face: int, uv: ArrayLike) -> NDArray[np.float64]:
        """S at places (n, 2) of a face: (n, 3)."""
        places = doubles(uv, "uv", None, 2)
        xyz = np.empty((len(places), 3))
        self._call(lib().geometry_points, face, len(places), places, xyz)
        return xyz

    def curve_points(self, face: int, ic: int, shares: ArrayLike) -> NDArray[np.float64]:
        """(u, v), (n, 2), of curve ic (from 1) of a face at n shares of its interval, 0 to 1."""
        uv = np.empty((len(np.atleast_1d(shares)), 2))
        for row, share in zip(uv, np.atleast_1d(shares)):
            self._call(lib().geometry_curve, face, ic, float(share), row)
        return uv

    def evaluate(self, parameters: ArrayLike, ref: int, order: int = 0, dimension: int = 2) -> Evaluated:
        """Evaluates a face (dimension 2) at (u, v), (n, 2), or a curve (1) at t, (n,), by its reference."""
        width = dimension if dimension in (1, 2) else 1  # the library rejects other dimensions
        places = doubles(np.reshape(np.asarray(parameters, dtype=float), (-1, width)), "parameters", None, width)
        n = len(places)
        xyz = np.empty((n, 3))
        first = np.empty((n, width, 3)) if order > 0 else None
        second = np.empty((n, 3 if dimension == 2 else 1, 3)) if order > 1 else None
        self._call(lib().evaluate, dimension, ref, n, places, order, xyz, first, second)
        return Evaluated(xyz, first, second)

    def project(self, xyz: ArrayLike, dimension: int = 2, ref: int = 0) -> Projected:
        """The closest point of all faces (dimension 2), curves (1) or points (0) to each of n points (n, 3); of one entity with its
        reference."""
        points = doubles(xyz, "xyz", None, 3)
        n = len(points)
        found = Projected(np.empty(n, dtype=np.int32), np.empty((n, max(dimension, 0))), np.empty((n, 3)), np.empty(n))
        self._call(lib().project, dimension, ref, n, points, *found)
        return found

    def embed_point(self, xyz: ArrayLike, name: str = "") -> int:
        """Embeds a point of space in the nearest face: the mesh has a vertex there. Returns its reference."""
        ref = c_int32()
        self._call(lib().model_embed_point, doubles(xyz, "xyz", 3), name.encode(), byref(ref))
        return ref.value

    def embed_polyline(self, xyz: ArrayLike, name: str = "") -> int:
        """Embeds a polyline (n, 3) in the faces that it lies on, within the parameter embed_tolerance; closed when its last point is its
        first. The mesh has its edges, whose reference is returned."""
        points = doubles(xyz, "xyz", None, 3)
        ref = c_int32()
        self._call(lib().model_embed_polyline, len(points), points, name.encode(), byref(ref))
        return ref.value

    def embed_wires(self) -> int:
        """Embeds the wires that lie on faces; returns their number."""
        count = c_int64()
        self._call(lib().model_embed_wires, byref(count))
        return count.value

    def embed_ridges(self, radius: float) -> int:
        """Embeds the ridges of structured grids whose radius of curvature is below `radius`; returns their number."""
        count = c_int64()
        self._call(lib().model_embed_ridges, radius, byref(count))
        return count.value

    def clear(self) -> None:
        """Drops all faces and geometries; an earlier mesh stays, and so do the callbacks that it is measured with."""
        self._call(lib().model_clear)
