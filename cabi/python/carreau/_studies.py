# SPDX-License-Identifier: BSD-3-Clause
"""Studies of a session's mesh: sizes from fields, adaptation, images, measures of the delivered mesh."""
from __future__ import annotations

from ctypes import addressof, byref, c_void_p
from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _declarations as c
from ._arrays import doubles, int32s, view
from ._callbacks import Named, each_place
from ._calls import Path, address, asked, counted, file_name, record, require_mesh, struct
from ._library import lib
from ._records import AdaptationReport, BackgroundReport, Delivered, LayersReport, Measure
from ._run import Host
from .errors import ArgumentError, PartialError
from .progress import Progress

Reals = NDArray[np.float64]
SOURCES = {"hessian": c.HESSIAN, "curvature": c.CURVATURE, "deformation": c.DEFORMATION}
FORMS = {"isotropic": c.ISOTROPIC, "graph": c.GRAPH, "anisotropic": c.ANISOTROPIC}
RECOVERIES = {"fit": c.FIT, "projection": c.PROJECTION, "quadric": c.QUADRIC}
MEASURES = {"length": c.MEASURE_LENGTH, "edge_angle": c.MEASURE_EDGE_ANGLE, "gradation": c.MEASURE_GRADATION,
            "length_ratio": c.MEASURE_LENGTH_RATIO, "q1": c.MEASURE_Q1, "q2": c.MEASURE_Q2,
            "metric_quality": c.MEASURE_METRIC_QUALITY, "a0": c.MEASURE_A0, "a1": c.MEASURE_A1, "curve_a0": c.MEASURE_CURVE_A0,
            "curve_a1": c.MEASURE_CURVE_A1, "vertex_angle": c.MEASURE_VERTEX_ANGLE,
            "a0_bound": c.MEASURE_A0_BOUND, "a1_bound": c.MEASURE_A1_BOUND, "bound_share": c.MEASURE_BOUND_SHARE,
            "input_bound": c.MEASURE_INPUT_BOUND}
CHANNELS = {"size": c.EXR_SIZE, "induced": c.EXR_INDUCED, "target": c.EXR_TARGET, "curvature": c.EXR_CURVATURE,
            "position": c.EXR_POSITION, "normal": c.EXR_NORMAL, "deviation": c.EXR_DEVIATION, "triangle": c.EXR_TRIANGLE,
            "mask": c.EXR_MASK, "preview": c.EXR_PREVIEW}


def _one_of(words: dict[str, int], word: str, what: str) -> int:
    if word not in words:
        raise ArgumentError(f"{what} is one of {', '.join(words)}, not '{word}'")
    return words[word]


def estimator_of(tolerance: float = 0.01, *, source: str = "hessian", shape: str = "isotropic", relative: bool = False,
                 recovery: str = "fit", hmin: float = 0, hmax: float = 0, ratio: float = 1000, floor: float = 0.1) -> Any:
    """The struct of an estimator. tolerance: error in units of the field, a share where relative, degrees for "curvature"."""
    return struct(c.carreau_estimator, source=_one_of(SOURCES, source, "source"), shape=_one_of(FORMS, shape, "shape"),
                  relative=int(relative), recovery=_one_of(RECOVERIES, recovery, "recovery"), tolerance=tolerance,
                  relative_floor=floor, hmin=hmin, hmax=hmax, ratio=ratio)


class Studies:
    """The part of Session that studies its mesh, and takes sizes from meshes."""

    _handle: Any
    _host: Host
    _runs: int
    adaptation: Optional[AdaptationReport] = None

    def _call(self, function: Callable[..., int], *arguments: Any) -> None:
        raise NotImplementedError

    def _run(self, function: Callable[..., int], *arguments: Any, progress: Progress = None) -> None:
        raise NotImplementedError

    # ---- background meshes ----

    def set_background(self, vertices: ArrayLike, triangles: ArrayLike, *, sizes: Optional[ArrayLike] = None,
                       metrics: Optional[ArrayLike] = None, faces: Optional[ArrayLike] = None) -> None:
        """Takes sizes (n), or metrics (n, 6), from the vertices (n, 3) of a mesh; of vertices (n, 2) in parameter planes
        metrics are (n, 3), and faces (m) are the references of the faces of its triangles."""
        points = np.asarray(vertices, dtype=np.float64)
        points = doubles(points, "vertices", None, 2 if points.ndim == 2 and points.shape[1] == 2 else 3)
        corners, d = int32s(triangles, "triangles", None, 3), points.shape[1]
        h = None if sizes is None else doubles(sizes, "sizes", len(points))
        m = None if metrics is None else doubles(metrics, "metrics", len(points), 3 * (d - 1))
        refs = None if faces is None else int32s(faces, "faces", len(corners))
        self._call(lib().set_background, byref(struct(
            c.carreau_background, dimension=d, vertex_count=len(points), triangle_count=len(corners), vertices=address(points),
            triangles=address(corners), faces=address(refs), sizes=address(h), metrics=address(m))))

    def load_background(self, mesh: Path, sol: Path) -> None:
        """Takes sizes or metrics from files: .mesh or .meshb, and .sol or .solb."""
        self._call(lib().set_background_mesh, file_name(mesh), file_name(sol))

    def load_background_fields(self, mesh: Path, sol: Path) -> None:
        """Takes sizes from the error of fields of a .sol, as the parameters adapt_... say."""
        self._call(lib().set_background_fields, file_name(mesh), file_name(sol))

    def set_vertex_sizes(self, values: ArrayLike) -> None:
        """Sizes (n), or metrics (n, 6), at the vertices of the session's mesh, for the next one."""
        rows = np.asarray(values, dtype=np.float64)
        if rows.ndim == 2:
            self._call(lib().set_vertex_metrics, len(rows), doubles(rows, "metrics", None, 6))
        else:
            self._call(lib().set_vertex_sizes, len(rows), doubles(rows, "sizes", None))

    def add_attractor(self, vertices: ArrayLike, elements: ArrayLike, size: float, surrounding: float, reach: float) -> None:
        """Adds sizes near points, edges and triangles: `size` on them, growing linearly to `surrounding` at the distance
        `reach`. vertices (n, 3); elements (m, 3) of indices from 0: an edge is (a, b, b), a point (a, a, a)."""
        points, corners = doubles(vertices, "vertices", None, 3), int32s(elements, "elements", None, 3)
        self._call(lib().add_attractor, len(points), points, len(corners), corners, size, surrounding, reach)

    def clear_attractors(self) -> None:
        """Removes all attractors."""
        self._call(lib().clear_attractors)

    def add_layers(self, curves: ArrayLike, first: float, ratio: float = 1.2, count: int = 10) -> None:
        """Lets rows of cells grow from curves (references): the first row is `first` high, each other row `ratio` times as
        high as the row below it."""
        refs = int32s(np.atleast_1d(np.asarray(curves)), "curves", None)
        self._call(lib().add_layers, len(refs), refs, first, ratio, count)

    def clear_layers(self) -> None:
        """Removes all layers."""
        self._call(lib().clear_layers)

    def layers(self, index: int = 0) -> LayersReport:
        """Measures of a set of layers of the last mesh, in the order of add_layers(). The first heights times a friction velocity over
        viscosity are y+."""
        return asked(c.carreau_layers_report, lambda out: self._call(lib().session_layers, index, out))  # type: ignore[no-any-return]

    def clear_background(self) -> None:
        """Removes the sizes of the functions above."""
        self._call(lib().clear_background)

    @property
    def background(self) -> BackgroundReport:
        """How the last mesh has used its background mesh."""
        return asked(c.carreau_background_report, lambda out: self._call(lib().session_background, out))  # type: ignore[no-any-return]

    # ---- adaptation ----

    def estimate(self, values: ArrayLike, tolerance: float = 0.01, **estimator: Any) -> Reals:
        """Sizes (n), or metrics (n, 6) if shape is not "isotropic", from values (n) of a field at the vertices of the
        mesh. estimator: source ("hessian", "curvature", "deformation"), shape ("isotropic", "graph", "anisotropic"),
        relative, recovery ("fit", "projection", "quadric"), hmin, hmax, ratio, floor."""
        field = doubles(values, "values", None)
        given = estimator_of(tolerance, **estimator)
        isotropic = given.shape == c.ISOTROPIC
        out = np.empty(len(field)) if isotropic else np.empty((len(field), 6))
        self._call(lib().estimate, byref(given), len(field), field, *((out, None) if isotropic else (None, out)))
        return out

    def transfer(self, values: ArrayLike) -> Reals:
        """Carries values (n) or (n, k) from the vertices of the previous mesh to the vertices of the current mesh. Elements
        of second order have them at all nodes, corners first; values at corners alone are carried to corners, and rows of
        other nodes are NaN."""
        rows = np.ascontiguousarray(values, dtype=np.float64)
        components = 1 if rows.ndim == 1 else rows.shape[1]
        n = counted(self._count_vertices)
        out = np.full((n, *rows.shape[1:]), np.nan)
        self._call(lib().transfer, components, len(rows), rows, n, out, None)
        return out

    def _count_vertices(self, out: Any) -> None:
        mesh = c_void_p()
        self._call(lib().session_mesh, byref(mesh))
        require_mesh(mesh, lib().mesh_count(mesh, out, None, None, None))

    def adapt(self, field: Callable[..., Any], tolerance: float = 0.01, *, iterations: int = 5, convergence: float = 0,
              differences: bool = False, progress: Progress = None, **estimator: Any) -> Any:
        """Adapts the mesh to a field in a loop; returns the mesh with the smallest estimated error, and self.adaptation has the report.

        field         of the place; its parameters name the values it takes: x, y, z (n each) or xyz (n, 3). Gives n
                      values
        tolerance     largest error of interpolation, and estimator: as for estimate()
        iterations    at most: the first mesh within the tolerance ends the loop; convergence: ends when the number of
                      triangles changes by a smaller share
        differences   derivatives of the field itself, by differences (plane z = 0 only)"""
        asks = Named(field, ("x", "y", "z", "xyz"), 3, "xyz")

        def at(n: int, xyz: int, values: int, _: Any) -> None:
            points = view(xyz, (n, 3), True)
            offer = {"x": points[:, 0], "y": points[:, 1], "z": points[:, 2], "xyz": points}
            told = np.asarray(each_place(asks, offer, n) if asks.scalar else asks(offer), dtype=np.float64)
            if told.ndim > 0 and told.shape != (n,):
                raise ValueError(f"the field has returned the shape {told.shape} at {n} points; it must be ({n},)")
            view(values, (n,))[...] = told

        given = estimator_of(tolerance, **estimator)
        callback = c.carreau_field_fn(self._host.guarded(lambda *_: {}, at))
        loop = struct(c.carreau_adaptation, field=callback, iterations=iterations, convergence=convergence,
                      differences=int(differences))
        loop.estimator = addressof(given)
        report = struct(c.carreau_adaptation_report)
        try:
            self._run(lib().adapt, byref(loop), byref(report), progress=progress)
        except PartialError:
            pass
        finally:
            self._runs += 1
        self.adaptation = record(report)
        return self.mesh  # type: ignore[attr-defined]

    # ---- the delivered mesh, fields ----

    @property
    def delivered(self) -> Delivered:
        """The latest mesh, measured on the surface of the callbacks against the prescribed sizes."""
        filled = struct(c.carreau_delivered)
        self._run(lib().session_delivered, byref(filled))
        return record(filled)  # type: ignore[no-any-return]

    def measure(self, kind: str) -> tuple[Measure, Reals]:
        """Spread and values of a measure: "length", "edge_angle", "gradation" of edges, "length_ratio" of vertices, "q1",
        "q2", "metric_quality", "a0", "a1", "vertex_angle", "a0_bound", "a1_bound", "bound_share", "input_bound" of triangles, "curve_a0", "curve_a1" of edges of curves."""
        number, filled = _one_of(MEASURES, kind, "kind"), struct(c.carreau_measure)
        self._run(lib().delivered_measure, number, byref(filled))
        spread = record(filled)
        values = np.empty(spread.values)
        self._call(lib().delivered_values, number, len(values), values)
        return spread, values

    def histogram(self, kind: str) -> tuple[Reals, NDArray[np.int64]]:
        """The histogram of a measure: lower bounds of the classes, the first -infinity, and how many values each
        has."""
        classes = self.measure(kind)[0].classes
        bounds, counts = np.empty(classes), np.empty(classes, dtype=np.int64)
        self._call(lib().delivered_histogram, MEASURES[kind], classes, bounds, counts)
        return bounds, counts

    def measured_edges(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """The edges (k, 2) that measures of edges have a value for, the smaller vertex first, and the references (k) of
        their curves, 0 inside faces."""
        count = self.delivered.edges
        ends, curves = np.empty((count, 2), dtype=np.int32), np.empty(count, dtype=np.int32)
        self._call(lib().delivered_edges, count, ends, curves)
        return ends, curves

    def write_delivered(self, path: Path) -> None:
        """Writes spreads, histograms, counts and sentences as JSON."""
        self._run(lib().delivered_write, file_name(path))

    def transfer_files(self, mesh: Path, sol: Path, out: Path) -> int:
        """Carries the fields of a .sol on another mesh to the vertices of this mesh, and writes a .sol. Returns how many vertices
        lie beside the other mesh; they have the nearest values."""
        return counted(lambda outside: self._call(lib().transfer_files, file_name(mesh), file_name(sol), file_name(out), outside))

    def write_fields(self, path: Path, *, longest: int = 0, width: int = 0, height: int = 0, channels: Any = (), face: int = 0,
                     multi_part: bool = False, raw: bool = False, piz: bool = False, threads: int = 0) -> None:
        """Writes the fields that governed the mesh of each face as images .exr, or its preview as .png;
        docs/how-to/see_sizes.md has the channels, whose groups are "size", "induced", "target", "curvature", "position",
        "normal", "deviation", "triangle", "mask" and "preview" (none given: all)."""
        chosen = sum(_one_of(CHANNELS, each, "a channel") for each in channels)
        self._run(lib().write_exr, file_name(path), byref(struct(
            c.carreau_exr_options, longest=longest, width=width, height=height, channels=chosen, face=face,
            multi_part=int(multi_part), raw=int(raw), compression=c.EXR_PIZ if piz else c.EXR_ZIP, threads=threads)))

