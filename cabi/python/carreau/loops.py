# SPDX-License-Identifier: BSD-3-Clause
"""Loops and annuli of the plane with smooth parameters, of which atlases are made (docs/explanation/triangles.md)."""
from __future__ import annotations

import weakref
from typing import Any, Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _declarations as c
from ._arrays import doubles
from ._calls import Path, created, file_name, require_by, table
from ._library import lib
from .errors import ArgumentError

Reals = NDArray[np.float64]
BORDERS = {"spline": c.BORDER_SPLINE, "cubic": c.BORDER_CUBIC, "polygon": c.BORDER_POLYGON,
           "outer-spline": c.BORDER_OUTER_SPLINE, "outer-cubic": c.BORDER_OUTER_CUBIC}


class _Handle:
    """A handle of a kind, "loop" or "annulus", with its sentences of errors."""

    def __init__(self, kind: str) -> None:
        self._kind, self._handle = kind, created(getattr(lib(), kind + "_create"))
        weakref.finalize(self, getattr(lib(), kind + "_free"), self._handle)

    def _call(self, name: str, *arguments: Any) -> None:
        status = getattr(lib(), f"{self._kind}_{name}")(self._handle, *arguments)
        require_by(getattr(lib(), self._kind + "_last_error"), self._handle, status)

    def _table(self, name: str, columns: int) -> Reals:
        ask: Callable[[int, Any, Any], None] = lambda capacity, rows, count: self._call(name, capacity, rows, count)  # noqa: E731
        return table(ask, columns)

    @property
    def pivots(self) -> Reals:
        """The pivots (k, 2), inside and outside by turns."""
        return self._table("pivots", 2)


class Loop(_Handle):
    """A simple polygon (n, 2), counterclockwise, with an angle as parameter: phi has a period of 2 pi, and is 0 at vertex 0.

    smooth   the parameter is C1 where pivots change; else the angle about each pivot is linear in phi

    Raises DomainError for a loop that crosses or touches itself, or runs clockwise.
    """

    def __init__(self, polygon: ArrayLike, smooth: bool = False) -> None:
        super().__init__("loop")
        corners = doubles(polygon, "polygon", None, 2)
        self._call("build", len(corners), corners, c.LOOP_SMOOTH if smooth else c.LOOP_EVEN)

    def points(self, phi: ArrayLike) -> tuple[Reals, Reals]:
        """Points (n, 2) at n values of phi, and derivatives by phi (n, 2)."""
        at = doubles(phi, "phi", None)
        points, derivatives = np.empty((len(at), 2)), np.empty((len(at), 2))
        self._call("points", len(at), at, points, derivatives)
        return points, derivatives

    def invert(self, points: ArrayLike, tolerance: float = 1e-9) -> Reals:
        """phi (n), from 0 to 2 pi, of points (n, 2) of the loop. Raises ArgumentError for one that is farther from it."""
        xy = doubles(points, "points", None, 2)
        phi = np.empty(len(xy))
        self._call("invert", len(xy), xy, float(tolerance), phi)
        return phi


class Annulus(_Handle):
    """The annulus between two polygons (n, 2) and (m, 2), both counterclockwise, with parameters tau, from 0 at the inner to 1
    at the outer border, and phi.

    border   the outer one: "spline" (C1, inside the polygons), "cubic" (C1, simpler, covers less), "polygon" (C0)
    star     one pivot does where it sees the whole inner border

    Raises DomainError as Loop, and for an annulus without width.
    """

    def __init__(self, inner: ArrayLike, outer: ArrayLike, border: str = "spline", star: bool = False) -> None:
        super().__init__("annulus")
        if border not in BORDERS:
            raise ArgumentError(f"border is one of {', '.join(BORDERS)}, not '{border}'")
        first, second = doubles(inner, "inner", None, 2), doubles(outer, "outer", None, 2)
        self._call("build", len(first), first, len(second), second, BORDERS[border], int(star))

    def points(self, tau_phi: ArrayLike) -> tuple[Reals, Reals]:
        """Points (n, 2) at places (n, 2) tau, phi; and derivatives (n, 2, 2), by tau and by phi."""
        at = doubles(tau_phi, "tau_phi", None, 2)
        points, derivatives = np.empty((len(at), 2)), np.empty((len(at), 2, 2))
        self._call("points", len(at), at, points, derivatives)
        return points, derivatives

    def invert(self, points: ArrayLike) -> tuple[Reals, NDArray[np.int32]]:
        """tau, phi (n, 2) of points (n, 2), 0 beside the annulus; and zones (n): 0 outside, 1 in the annulus, 2 inside."""
        xy = doubles(points, "points", None, 2)
        places, zones = np.empty((len(xy), 2)), np.empty(len(xy), dtype=np.int32)
        self._call("invert", len(xy), xy, places, zones)
        return places, zones

    @property
    def outer_border(self) -> Reals:
        """The polygon (k, 2) that was described as outer border."""
        return self._table("outer_border", 2)

    @property
    def skeleton(self) -> Reals:
        """The edges (k, 2, 2) of the pseudo-skeleton of the inner border."""
        return self._table("skeleton", 4).reshape(-1, 2, 2)

    def write(self, path: Path, width: int = 512) -> None:
        """Writes tau, phi and zone as an OpenEXR file of `width` pixels a row. Raises FileError."""
        self._call("write_exr", file_name(path), width)
