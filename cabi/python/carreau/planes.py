# SPDX-License-Identifier: BSD-3-Clause
"""Domains of the plane: curves through points, holes, subdomains."""
from __future__ import annotations

from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _declarations as c
from ._arrays import doubles, int32s
from ._calls import address, struct
from .errors import ArgumentError

KINDS = {"segments": c.SEGMENTS, "spline": c.SPLINE, "arcs": c.ARCS}
RESTS = {"parity": c.REST_PARITY, "inside": c.REST_INSIDE, "outside": c.REST_OUTSIDE}
OptionalArray = Optional[NDArray[Any]]


def _numbers(kinds: Union[None, str, Sequence[str]], count: int) -> OptionalArray:
    if kinds is None:
        return None
    words = [kinds] * count if isinstance(kinds, str) else list(kinds)
    unknown = [word for word in words if word not in KINDS]
    if unknown or len(words) != count:
        raise ArgumentError(f"kinds: one of {', '.join(KINDS)} for each of {count} curves, not {kinds}")
    return np.array([KINDS[word] for word in words], dtype=np.int32)


class PlaneDomain:
    """A domain of the plane. Indices count from 0; references are the caller's, 0 means no reference.

    points      (n, 2)
    curves      for each the indices of the points that it passes; closed if the last one is the first
    kinds       "segments", "spline" or "arcs", for all curves or for each
    sizes       (n): prescribed at points and along curves between them, 0: none; metrics (n, 3) in their place
    point_refs, curve_refs   (n), (number of curves)
    imposed     (n): 1 makes a point a vertex wherever it lies
    seeds       (k, 2): places inside subdomains or holes, with seed_refs (k): their references, -1: a hole
    sides       (k, 3): a curve, +1 for its left or -1 for its right side, the reference of the subdomain there
    rest        the rest of the domain: "parity" (loops inside loops are holes), "inside" (all), "outside" (nothing)
    """

    def __init__(self, points: ArrayLike, curves: Sequence[ArrayLike], *, kinds: Union[None, str, Sequence[str]] = None,
                 sizes: Optional[ArrayLike] = None, metrics: Optional[ArrayLike] = None, point_refs: Optional[ArrayLike] = None,
                 curve_refs: Optional[ArrayLike] = None, imposed: Optional[ArrayLike] = None, seeds: Optional[ArrayLike] = None,
                 seed_refs: Optional[ArrayLike] = None, sides: Optional[ArrayLike] = None, rest: str = "parity") -> None:
        self.points = doubles(points, "points", None, 2)
        n, lines = len(self.points), [int32s(each, "a curve", None) for each in curves]
        if rest not in RESTS:
            raise ArgumentError(f"rest is one of {', '.join(RESTS)}, not '{rest}'")

        def optional(values: Optional[ArrayLike], name: str, whole: bool, *shape: Optional[int]) -> OptionalArray:
            if values is None:
                return None
            return int32s(values, name, *shape) if whole else doubles(values, name, *shape)

        self._arrays: dict[str, OptionalArray] = {
            "points": self.points, "curve_starts": np.cumsum([0] + [len(line) for line in lines], dtype=np.int64),
            "curve_points": np.concatenate(lines) if lines else np.empty(0, dtype=np.int32), "smooth": _numbers(kinds, len(lines)),
            "sizes": optional(sizes, "sizes", False, n), "metrics": optional(metrics, "metrics", False, n, 3),
            "point_refs": optional(point_refs, "point_refs", True, n), "imposed": optional(imposed, "imposed", True, n),
            "curve_refs": optional(curve_refs, "curve_refs", True, len(lines)), "seeds": optional(seeds, "seeds", False, None, 2),
            "sides": optional(sides, "sides", True, None, 3)}
        found = self._arrays["seeds"]
        count = 0 if found is None else len(found)
        self._arrays["seed_refs"] = optional(np.arange(1, count + 1) if seed_refs is None else seed_refs, "seed_refs", True, count)
        side_count = 0 if sides is None else len(np.atleast_2d(np.asarray(sides)))
        self._counts = {"point_count": n, "curve_count": len(lines), "seed_count": count, "side_count": side_count, "rest": RESTS[rest]}

    def _struct(self) -> Any:
        return struct(c.carreau_plane_domain, **self._counts, **{name: address(array) for name, array in self._arrays.items()})


def polygons(*loops: ArrayLike, **named: Any) -> PlaneDomain:
    """The domain that closed polygons (n, 2) bound; polygons inside others bound holes. named: arguments of
    PlaneDomain."""
    corners = [doubles(loop, "a loop", None, 2) for loop in loops]
    starts = np.cumsum([0] + [len(loop) for loop in corners])
    curves = [np.append(np.arange(first, last), first) for first, last in zip(starts, starts[1:])]
    return PlaneDomain(np.concatenate(corners), curves, **named)
