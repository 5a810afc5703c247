# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces by functions of (u, v): patches, and their callbacks."""
from __future__ import annotations

import ctypes
from typing import Any, Callable, Iterable, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _declarations as c
from ._arrays import view
from ._callbacks import Named, each_place, rows_of
from ._calls import struct
from ._run import Host
from .domains import Curve, domain_of
from .errors import ArgumentError

Array = NDArray[np.float64]
OFFER = ("u", "v", "uv", "face")


class Surface:
    """A surface S(u, v) by functions, whose parameters name the values they take: u, v (n each), uv (n, 2), face (its
    reference).

    point    S: (n, 3), or a tuple of the columns x, y, z
    first    Su and Sv: a tuple of two such results; None: by finite differences, as is second
    second   Suu, Suv and Svv: a tuple of three

    A function that is marked by scalar() takes floats, and gives rows of 3. Arrays that a function gets are read-only memory
    of the library, and end with the call.
    """

    def __init__(self, point: Callable[..., Any], first: Optional[Callable[..., Any]] = None,
                 second: Optional[Callable[..., Any]] = None) -> None:
        if second is not None and first is None:
            raise ArgumentError("a surface with second derivatives needs the first ones")
        self._jets = [Named(each, OFFER, 2, "uv") for each in (point, first, second) if each is not None]

    @property
    def order(self) -> int:
        """The highest derivative that it has itself."""
        return len(self._jets) - 1

    def fill(self, face: int, uv: Array, order: int, out: Sequence[Optional[Array]]) -> None:
        """Puts S, Su, Sv, Suu, Suv and Svv at n places, up to an order, into six arrays (n, 3)."""
        values = {"u": uv[:, 0], "v": uv[:, 1], "uv": uv, "face": face}
        first = 0
        for k, function in enumerate(self._jets[:order + 1]):
            wanted = out[first:first + k + 1]
            first += k + 1
            if function.scalar:
                _fill_scalar(each_place(function, values, len(uv), uv), wanted)
            else:
                results = function(values)
                for array, result in zip(wanted, (results,) if k == 0 else results):
                    rows_of(result, array, "a surface")  # type: ignore[arg-type]

    def __call__(self, uv: Any, face: int = 1) -> Array:
        """S at n places (n, 2): (n, 3)."""
        places = np.ascontiguousarray(uv, dtype=np.float64).reshape(-1, 2)
        out = np.empty((len(places), 3))
        self.fill(face, places, 0, [out])
        return out


def _fill_scalar(rows: list[Any], wanted: Sequence[Optional[Array]]) -> None:
    if len(wanted) == 1:
        wanted[0][...] = rows  # type: ignore[index]
        return
    for k, array in enumerate(wanted):
        array[...] = [row[k] for row in rows]  # type: ignore[index]


def _surface_of(given: Any) -> Surface:
    """A Surface, an object with point(u, v) and perhaps first and second, or a function."""
    if isinstance(given, Surface):
        return given
    if hasattr(given, "point"):
        return Surface(given.point, getattr(given, "first", None), getattr(given, "second", None))
    return Surface(given)


class Patch:
    """A surface over a domain of its parameter plane: a face of a model.

    surface   a function of u and v (see Surface), a Surface, or an object with methods point, first and second
    domain    curves that bound it, or u0, v0, u1, v1 of a box; see carreau.domains
    points    (k, 2): imposed vertices inside; point_refs (k): their references, from 1 where none are given
    name      for people, and for files that hold names; color: 0xRRGGBB in sRGB, for .vtu
    """

    def __init__(self, surface: Any, domain: Any = (0, 0, 1, 1), *, points: Any = (), point_refs: Optional[Sequence[int]] = None,
                 name: str = "", color: int = -1) -> None:
        self.surface, self.curves, self.name, self.color = _surface_of(surface), domain_of(domain), name, color
        self.points = np.asarray(points, dtype=np.float64).reshape(-1, 2)
        self.point_refs = list(point_refs) if point_refs is not None else list(range(1, len(self.points) + 1))
        if len(self.point_refs) != len(self.points):
            raise ArgumentError(f"there are {len(self.points)} points and {len(self.point_refs)} references")


def patch(domain: Any = (0, 0, 1, 1), **named: Any) -> Callable[[Callable[..., Any]], Patch]:
    """A decorator that makes a function of u and v the patch over a domain; named: arguments of Patch."""
    return lambda function: Patch(function, domain, **named)


Patches = Union[Patch, Iterable[Patch]]


class PatchCallbacks:
    """The functions of patches, which are faces 1, 2, ... of their geometry. It has no callback, which would be a
    cycle."""

    def __init__(self, patches: Sequence[Patch], host: Host) -> None:
        self.patches, self.host = patches, host
        self.before = 0  # faces of the session that come before, for sentences

    def _place(self, face: int, n: int, uv: int, *_: Any) -> dict[str, Any]:
        return {"face": face + self.before, "uv": tuple(view(uv, (2,), True).tolist())}

    def _curve_place(self, face: int, ic: int, t: Any, *_: Any) -> dict[str, Any]:
        return {"face": face + self.before, "ic": ic, "t": t if isinstance(t, float) else None}

    def struct(self) -> Any:
        """The callbacks, which live as long as this struct."""
        guarded = self.host.guarded
        orders = [each.surface.order for each in self.patches]
        curve_orders = [curve.order for each in self.patches for curve in each.curves]
        return struct(c.carreau_cad, surface_order=min(orders), curve_order=min(curve_orders),
                      surface_batch=c.carreau_surface_batch_fn(guarded(self._place, self._surface)),
                      curve_interval=c.carreau_interval_fn(guarded(self._curve_place, self._interval)),
                      curve=c.carreau_curve_fn(guarded(self._curve_place, self._curve)))

    def _surface(self, face: int, n: int, uv: int, order: int, *results: Optional[int]) -> None:
        out = [None if each is None else view(each, (n, 3)) for each in results[:6]]
        self.patches[face - 1].surface.fill(face, view(uv, (n, 2), True), order, out)

    def _interval(self, face: int, ic: int, a: int, b: int, _: Any) -> None:
        curve = self.patches[face - 1].curves[ic - 1]
        ctypes.c_double.from_address(a).value = curve.a
        ctypes.c_double.from_address(b).value = curve.b

    def _curve(self, face: int, ic: int, t: float, order: int, *results: Any) -> None:
        curve = self.patches[face - 1].curves[ic - 1]
        for k in range(order + 1):
            u, v = curve.at(t, k, face, ic)
            pair = (ctypes.c_double * 2).from_address(results[k])
            pair[0], pair[1] = u, v


def model_of(patches: Sequence[Patch]) -> list[tuple[str, tuple[Any, ...]]]:
    """The calls that describe the faces of patches: the names of functions, without carreau_model_, and arguments."""
    calls: list[tuple[str, tuple[Any, ...]]] = []
    for ref, each in enumerate(patches, 1):
        bounding = next((k for k, curve in enumerate(each.curves, 1) if not curve.internal), 1)
        calls.append(("add_face", (ref, bounding)))
        for curve in each.curves:
            calls.append(("add_curve", (ref, _kind(curve), curve.ref, *curve.ends)))
        for point_ref, (u, v) in zip(each.point_refs, each.points):
            calls.append(("add_point", (ref, point_ref, u, v)))
        if each.name:
            calls.append(("name_face", (ref, each.name.encode())))
        if each.color >= 0:
            calls.append(("color_face", (ref, each.color)))
    return calls


def _kind(curve: Curve) -> int:
    return c.INTERNAL if curve.internal else c.BOUNDARY
