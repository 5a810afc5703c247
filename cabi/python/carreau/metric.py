# SPDX-License-Identifier: BSD-3-Clause
"""Algebra of metrics, of many at a time: rows of 3 numbers (xx xy yy) in the plane, of 6 (xx xy xz yy yz zz) in space.

A metric M is positive definite, in 1 / model length^2. A vector d has the length sqrt(d^T M d) in it; a size h along an
axis is 1 / sqrt(eigenvalue).
"""
from __future__ import annotations

from ctypes import byref, c_double, c_int64
from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _declarations as c
from ._arrays import doubles
from ._calls import address, struct
from ._library import lib
from ._session import SessionBase
from .errors import ArgumentError

Array = NDArray[np.float64]
LAWS = {"linear": 0, "geometric": 1, "sinusoidal": 2}
ENTRIES = {2: 3, 3: 6}
DIMENSIONS = {3: 2, 6: 3}


def _call() -> Callable[..., None]:
    """Uses a session that keeps the sentence of an error; each call has its own, so that threads may call."""
    return SessionBase()._call


def _rows(metrics: ArrayLike, name: str = "metrics") -> tuple[Array, int]:
    rows = np.atleast_2d(np.asarray(metrics, dtype=np.float64))
    if rows.shape[-1] not in DIMENSIONS:
        raise ArgumentError(f"{name} has rows of {rows.shape[-1]} numbers; metrics have 3 or 6")
    return doubles(rows, name, *rows.shape), DIMENSIONS[rows.shape[-1]]


def _law(law: str) -> int:
    if law not in LAWS:
        raise ArgumentError(f"law is one of {', '.join(LAWS)}, not '{law}'")
    return LAWS[law]


def sizes(metrics: ArrayLike) -> tuple[Array, Array]:
    """Sizes (n, d) along the axes of each metric, the smallest first, and the unit axes (n, d, d), one a row."""
    rows, d = _rows(metrics)
    out, axes = np.empty((len(rows), d)), np.empty((len(rows), d, d))
    _call()(lib().metric_sizes, d, len(rows), rows, out, axes)
    return out, axes


def of_sizes(sizes: ArrayLike, axes: ArrayLike) -> Array:
    """The reverse: metrics of sizes (n, d) along axes (n, d, d), which are made orthogonal from the first."""
    h = np.atleast_2d(np.asarray(sizes, dtype=np.float64))
    n, d = h.shape
    if d not in ENTRIES:
        raise ArgumentError(f"sizes have 2 or 3 columns, not {d}")
    out = np.empty((n, ENTRIES[d]))
    _call()(lib().metric_of_sizes, d, n, doubles(h, "sizes", n, d), doubles(np.reshape(axes, (n, d, d)), "axes", n, d, d), out)
    return out


def isotropic(sizes: ArrayLike, dimension: int = 3) -> Array:
    """Metrics of sizes (n) that are the same in all directions."""
    h = np.atleast_1d(np.asarray(sizes, dtype=np.float64))
    entries = {2: (1, 0, 1), 3: (1, 0, 0, 1, 0, 1)}[dimension]
    return h[:, None] ** -2 * np.array(entries, dtype=np.float64)


def interpolate(p: ArrayLike, q: ArrayLike, share: ArrayLike, law: str = "linear") -> Array:
    """The metrics at a share in [0, 1] of the way from p to q, by their simultaneous reduction (RR-2818 sec. 4.3.2)."""
    first, d = _rows(p, "p")
    second = doubles(np.broadcast_to(np.atleast_2d(np.asarray(q, dtype=np.float64)), first.shape), "q", *first.shape)
    shares = doubles(np.broadcast_to(np.asarray(share, dtype=np.float64), len(first)), "share", len(first))
    out = np.empty_like(first)
    _call()(lib().metric_interpolate, d, _law(law), len(first), first, second, shares, out)
    return out


def intersect(metrics: ArrayLike, how: str = "in_turn") -> Array:
    """The intersection of k metrics (n, k, 3 or 6) at each of n places. how: "in_turn", two by two, or "largest", the
    largest ellipsoid inside all unit balls, a tenth of a millisecond each."""
    rows = np.asarray(metrics, dtype=np.float64)
    if rows.ndim != 3 or rows.shape[2] not in DIMENSIONS:
        raise ArgumentError(f"metrics has the shape {rows.shape}; it must be (n, k, 3) or (n, k, 6)")
    words = {"in_turn": c.INTERSECT_IN_TURN, "largest": c.INTERSECT_LARGEST}
    if how not in words:
        raise ArgumentError(f"how is in_turn or largest, not '{how}'")
    n, k, entries = rows.shape
    out = np.empty((n, entries))
    _call()(lib().metric_intersect, DIMENSIONS[entries], words[how], n, k, doubles(rows, "metrics", n, k, entries), out)
    return out


def reduce(p: ArrayLike, q: ArrayLike) -> tuple[Array, Array, Array]:
    """The simultaneous reduction: sizes of p and of q (n, d each) along unit vectors (n, d, d) orthogonal in both."""
    first, d = _rows(p, "p")
    second = doubles(np.broadcast_to(np.atleast_2d(np.asarray(q, dtype=np.float64)), first.shape), "q", *first.shape)
    n = len(first)
    of_p, of_q, directions = np.empty((n, d)), np.empty((n, d)), np.empty((n, d, d))
    _call()(lib().metric_reduce, d, n, first, second, of_p, of_q, directions)
    return of_p, of_q, directions


def split(points: ArrayLike, metrics: ArrayLike, abscissae: Optional[ArrayLike] = None, law: str = "linear") -> tuple[Array, float]:
    """Cuts a polyline (n, d) into edges of equal length in metrics (k, 3 or 6), as near to 1 as a whole number of edges
    allows: usual lengths from the first point (edges + 1), and the length of the curve in the metric (RR-2818 sec. 4).
    abscissae (k): where the metrics hold, usual lengths from the first point; None: at the points."""
    corners = np.asarray(points, dtype=np.float64)
    if corners.ndim != 2 or corners.shape[1] not in ENTRIES:
        raise ArgumentError(f"points has the shape {corners.shape}; it must be (n, 2) or (n, 3)")
    corners, d = doubles(corners, "points", None, None), corners.shape[1]
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(corners, axis=0), axis=1))]) if abscissae is None else abscissae
    places = doubles(along, "abscissae", None)
    rows = doubles(metrics, "metrics", len(places), ENTRIES[d])
    curve = struct(c.carreau_curve, dimension=d, law=_law(law), point_count=len(corners), metric_count=len(rows), points=address(corners),
                   abscissae=address(places), metrics=address(rows))
    edges, length, call = c_int64(), c_double(), _call()
    call(lib().curve_split, byref(curve), 0, None, byref(edges), byref(length))
    out = np.empty(edges.value + 1)
    call(lib().curve_split, byref(curve), len(out), out, None, None)
    return out, length.value


def lengths(edges: ArrayLike, metrics: ArrayLike, law: str = "linear") -> Array:
    """Lengths (n) of straight edges (n, 2, d) with metrics (n, 2, 3 or 6) at their ends."""
    ends: Any = np.asarray(edges, dtype=np.float64)
    if ends.ndim != 3 or ends.shape[1] != 2 or ends.shape[2] not in ENTRIES:
        raise ArgumentError(f"edges has the shape {ends.shape}; it must be (n, 2, 2) or (n, 2, 3)")
    n, _, d = ends.shape
    out = np.empty(n)
    _call()(lib().metric_lengths, d, _law(law), n, doubles(ends, "edges", n, 2, d), doubles(metrics, "metrics", n, 2, ENTRIES[d]), out)
    return out
