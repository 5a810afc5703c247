# SPDX-License-Identifier: BSD-3-Clause
"""C1 surfaces near closed triangulated ones: atlases of charts."""
from __future__ import annotations

import weakref
from ctypes import byref
from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _declarations as c
from ._arrays import doubles, int32s
from ._calls import asked, created, require_by, struct
from ._library import lib
from ._records import AtlasChart, AtlasCounts

Array = NDArray[np.float64]


class Atlas:
    """Charts that cover a closed surface of n vertices (n, 3) and m triangles (m, 3), counterclockwise from outside.

    clusters   (n): the cluster of each vertex, from 0, each a disc; None: the library makes them
    cubic      borders of charts by one cubic a pivot, in place of a spline: simpler, covers less
    reach      of clusters that the library makes, in edges: 1, 2 or 3
    """

    def __init__(self, vertices: ArrayLike, triangles: ArrayLike, clusters: Optional[ArrayLike] = None, *, cubic: bool = False,
                 reach: int = 1) -> None:
        self._handle = created(lib().atlas_create)
        self._close = weakref.finalize(self, lib().atlas_free, self._handle)
        xyz, corners = doubles(vertices, "vertices", None, 3), int32s(triangles, "triangles", None, 3)
        given = None if clusters is None else int32s(clusters, "clusters", len(xyz))
        options = struct(c.carreau_atlas_options, border=c.BORDER_CUBIC if cubic else c.BORDER_SPLINE, reach=reach)
        self._call(lib().atlas_build, byref(options), len(xyz), xyz, len(corners), corners, given)

    def _call(self, function: Callable[..., int], *arguments: Any) -> None:
        require_by(lib().atlas_last_error, self._handle, function(self._handle, *arguments))

    @property
    def counts(self) -> AtlasCounts:
        """Counts of the triangulation that is covered, and of the charts."""
        return asked(c.carreau_atlas_counts, lambda out: self._call(lib().atlas_count, out))  # type: ignore[no-any-return]

    def chart(self, index: int) -> AtlasChart:
        """The plane of a chart, from 0."""
        return asked(c.carreau_atlas_chart, lambda out: self._call(lib().atlas_chart_info, index, out))  # type: ignore[no-any-return]

    def points(self, chart: int, xy: ArrayLike) -> tuple[Array, Array]:
        """Points (n, 3) of the surface at places (n, 2) of a chart, and derivatives (n, 2, 3), by x and by y."""
        places = doubles(xy, "xy", None, 2)
        xyz, derivatives = np.empty((len(places), 3)), np.empty((len(places), 2, 3))
        self._call(lib().atlas_points, chart, len(places), places, xyz, derivatives)
        return xyz, derivatives

    def zones(self, chart: int, xy: ArrayLike) -> tuple[NDArray[np.int32], Array]:
        """Zones of places (n, 2): 0 outside, 1 shared with other charts, 2 the chart's alone; and weights (n)."""
        places = doubles(xy, "xy", None, 2)
        zones, weights = np.empty(len(places), dtype=np.int32), np.empty(len(places))
        self._call(lib().atlas_zones, chart, len(places), places, zones, weights)
        return zones, weights

    def transition(self, i: int, j: int, xy: ArrayLike) -> tuple[Array, NDArray[np.bool_]]:
        """Places (n, 2) of chart i as places of chart j, NaN where it lacks them; and whether it has them (n)."""
        places = doubles(xy, "xy", None, 2)
        out, found = np.full((len(places), 2), np.nan), np.zeros(len(places), dtype=np.int32)
        self._call(lib().atlas_transition, i, j, len(places), places, out, found)
        return out, found != 0
