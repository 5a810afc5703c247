# SPDX-License-Identifier: BSD-3-Clause
"""Prescribed sizes and metrics by functions of the place."""
from __future__ import annotations

from typing import Any, Callable, Mapping, Optional

import numpy as np
from numpy.typing import NDArray

from . import _declarations as c
from ._arrays import view, view_int32
from ._callbacks import Named, each_place
from ._calls import struct
from ._run import Host
from .errors import ArgumentError

Array = NDArray[np.float64]
OFFER = ("x", "y", "z", "xyz", "u", "v", "uv", "face")
KINDS = {1: c.METRIC_SIZE, 6: c.METRIC_SPACE, 5: c.METRIC_TANGENT}


class SizeCallbacks:
    """The sizes of a session at places of its surface, and perhaps on curves and at points. It has no callback, which
    would be a cycle.

    function     of the place; its parameters name the values it takes: x, y, z (n each), xyz (n, 3), u, v, uv, face.
                 Gives n sizes, or rows: 6 numbers (xx xy xz yy yz zz) of metrics, 5 numbers (h1, h2, x, y, z) of sizes
                 along a direction and across it. NaN: no answer there. None: never called
    face_sizes   sizes by the reference of a face; the smaller size of both holds
    on_curve     a scalar function of t, face and ic: a size, a row as above, or None: no answer
    at_point     likewise a function of point, its reference
    """

    def __init__(self, host: Host, function: Optional[Callable[..., Any]] = None, face_sizes: Optional[Mapping[int, float]] = None,
                 on_curve: Optional[Callable[..., Any]] = None, at_point: Optional[Callable[..., Any]] = None) -> None:
        self.function = None if function is None else Named(function, OFFER, 3, "xyz")
        self.face_sizes = dict(face_sizes or {})
        self.on_curve = None if on_curve is None else Named(on_curve, ("t", "face", "ic"), 1, "t")
        self.at_point = None if at_point is None else Named(at_point, ("point",), 1, "point")
        self.host = host

    def struct(self) -> Any:
        """The callbacks, which live as long as this struct."""
        members = {}
        if self.function is not None or self.face_sizes:
            where = lambda face, n, uv, *_: {"face": face, "uv": tuple(view(uv, (2,), True).tolist())}  # noqa: E731
            members["surface_metric_batch"] = c.carreau_surface_metric_batch_fn(self.host.guarded(where, self._surface))
        if self.on_curve is not None:
            where_on = lambda face, ic, t, *_: {"face": face, "ic": ic, "t": t}  # noqa: E731
            members["curve_metric"] = c.carreau_curve_metric_fn(self.host.guarded(where_on, self._curve))
        if self.at_point is not None:
            where_at = lambda point, *_: {"point": point}  # noqa: E731
            members["point_metric"] = c.carreau_point_metric_fn(self.host.guarded(where_at, self._point))
        return struct(c.carreau_metric_callbacks, **members)

    def _surface(self, face: int, n: int, uv: int, xyz: int, kind: int, value: int, _: Any) -> None:
        kinds, values = view_int32(kind, (n,)), view(value, (n, 6))
        if self.function is not None:
            self._ask(face, view(uv, (n, 2), True), view(xyz, (n, 3), True), kinds, values)
        of_face = self.face_sizes.get(face)
        if of_face is None:
            return
        if np.any(kinds > c.METRIC_SIZE):
            raise ArgumentError("sizes of faces do not go with metrics by functions: give the sizes by the function, too")
        values[:, 0] = np.where(kinds == c.METRIC_NONE, of_face, np.minimum(values[:, 0], of_face))
        kinds[...] = c.METRIC_SIZE

    def _ask(self, face: int, uv: Array, xyz: Array, kinds: NDArray[np.int32], values: Array) -> None:
        assert self.function is not None
        offer = {"x": xyz[:, 0], "y": xyz[:, 1], "z": xyz[:, 2], "xyz": xyz, "u": uv[:, 0], "v": uv[:, 1], "uv": uv, "face": face}
        if self.function.scalar:
            rows = np.asarray(each_place(self.function, offer, len(uv), uv), dtype=np.float64)
        else:
            rows = np.asarray(self.function(offer), dtype=np.float64)
        answer(rows, kinds, values)

    def _curve(self, face: int, ic: int, t: float, kind: int, value: int, _: Any) -> None:
        assert self.on_curve is not None
        answer_one(self.on_curve({"t": t, "face": face, "ic": ic}), kind, value)

    def _point(self, point: int, kind: int, value: int, _: Any) -> None:
        assert self.at_point is not None
        answer_one(self.at_point({"point": point}), kind, value)


def answer(rows: Array, kinds: NDArray[np.int32], values: Array) -> None:
    """Puts n sizes, or n rows of 5 or 6 numbers, into the arrays of the library; rows with a NaN do not answer."""
    n = len(values)
    if rows.ndim <= 1 and rows.size in (1, n):
        rows = np.broadcast_to(rows.reshape(-1, 1), (n, 1))
    if rows.ndim != 2 or len(rows) != n or rows.shape[1] not in KINDS:
        raise ValueError(f"a function of sizes has returned the shape {rows.shape} at {n} places: ({n},), ({n}, 6) of metrics or ({n}, 5)")
    values[:, :rows.shape[1]] = rows
    kinds[...] = np.where(np.isnan(rows).any(axis=1), c.METRIC_NONE, KINDS[rows.shape[1]])


def answer_one(row: Any, kind: int, value: int) -> None:
    if row is not None:
        answer(np.asarray(row, dtype=np.float64).reshape(1, -1), view_int32(kind, (1,)), view(value, (1, 6)))
