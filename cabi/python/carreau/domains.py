# SPDX-License-Identifier: BSD-3-Clause
"""Curves of the parameter plane, and the domains that they bound."""
from __future__ import annotations

import math
from typing import Any, Callable, Optional, Sequence

import numpy as np

from ._callbacks import Named, scalar
from .errors import ArgumentError

Jet = tuple[float, float]


class Curve:
    """A curve C(t) of the parameter plane, a <= t <= b, the domain on its left.

    point      C: t of shape (n,) in, (n, 2) or two columns out; a scalar() one takes a float. It may name face and ic
    a, b       the interval, a < b
    first      C'(t), in the same way; None: by finite differences, as is second, C''(t)
    ref        reference; curves that are one in space share it. 0 for all: the library finds curves that meet
    ends       references of the points at a and b; 0: as above
    internal   a line inside the domain that edges follow, in place of a part of its boundary
    """

    def __init__(self, point: Callable[..., Any], a: float = 0, b: float = 1, *, first: Optional[Callable[..., Any]] = None,
                 second: Optional[Callable[..., Any]] = None, ref: int = 0, ends: tuple[int, int] = (0, 0),
                 internal: bool = False) -> None:
        if not (math.isfinite(a) and math.isfinite(b) and a < b):
            raise ArgumentError(f"the interval [{a}, {b}] of a curve must be finite with a < b")
        if second is not None and first is None:
            raise ArgumentError("a curve with second derivatives needs the first ones")
        self.a, self.b, self.ref, self.ends, self.internal = float(a), float(b), int(ref), ends, internal
        given = [each for each in (point, first, second) if each is not None]
        self._jets = [Named(each, ("t", "face", "ic"), 1, "t") for each in given]

    @property
    def order(self) -> int:
        """The highest derivative that it has itself."""
        return len(self._jets) - 1

    def at(self, t: float, order: int = 0, face: int = 0, ic: int = 0) -> Jet:
        """C(t) (u, v), or its derivative of this order."""
        function = self._jets[order]
        if function.scalar:
            u, v = function({"t": t, "face": face, "ic": ic})
            return u, v
        pair = function({"t": np.array([t]), "face": face, "ic": ic})
        if isinstance(pair, (tuple, list)) and len(pair) == 2:
            return tuple(float(np.broadcast_to(each, 1)[0]) for each in pair)  # type: ignore[return-value]
        row = np.asarray(pair, dtype=np.float64)
        if row.size != 2:
            raise ValueError(f"a curve has returned the shape {row.shape} for t of shape (1,); it must be (1, 2)")
        return float(row.flat[0]), float(row.flat[1])


def segment(start: Sequence[float], end: Sequence[float], **named: Any) -> Curve:
    """The straight line from (u, v) to (u, v), for t from 0 to 1. named: ref, ends and internal of Curve."""
    (u, v), (last_u, last_v) = map(float, start), map(float, end)
    return _straight(u, v, last_u - u, last_v - v, **named)


def _straight(u: float, v: float, du: float, dv: float, **named: Any) -> Curve:
    return Curve(scalar(lambda t: (u + t * du, v + t * dv)), first=scalar(lambda t: (du, dv)), second=scalar(lambda t: (0.0, 0.0)),
                 **named)


def arc(center: Sequence[float], radius: float, start: float, end: float, **named: Any) -> Curve:
    """The arc of a circle about (u, v) from one angle to another, radians; counterclockwise where end > start."""
    if not radius > 0 or start == end:
        raise ArgumentError(f"an arc has a radius above 0 and two angles, not {radius}, {start} and {end}")
    u, v, w = float(center[0]), float(center[1]), end - start

    def at(t: float) -> Jet:
        angle = start + t * w
        return radius * math.cos(angle), radius * math.sin(angle)

    def point(t: float) -> Jet:
        cosine, sine = at(t)
        return u + cosine, v + sine

    def first(t: float) -> Jet:
        cosine, sine = at(t)
        return -w * sine, w * cosine

    def second(t: float) -> Jet:
        cosine, sine = at(t)
        return -w * w * cosine, -w * w * sine

    return Curve(scalar(point), first=scalar(first), second=scalar(second), **named)


def polygon(points: Sequence[Sequence[float]]) -> list[Curve]:
    """The sides of a polygon, (n, 2), counterclockwise; a hole runs clockwise."""
    corners = [tuple(map(float, p)) for p in points]
    return [segment(p, q) for p, q in zip(corners, corners[1:] + corners[:1])]


def box(u0: float, v0: float, u1: float, v1: float) -> list[Curve]:
    """The sides v = v0, u = u1, v = v1 and u = u0 of a rectangle, in this order."""
    if not (u0 < u1 and v0 < v1):
        raise ArgumentError(f"box({u0}, {v0}, {u1}, {v1}) has no inside: u0 < u1 and v0 < v1")
    w, h = u1 - u0, v1 - v0
    return [_straight(u0, v0, w, 0.0), _straight(u1, v0, 0.0, h), _straight(u1, v1, -w, 0.0), _straight(u0, v1, 0.0, -h)]


def disc(u: float, v: float, radius: float) -> list[Curve]:
    """Two halves of a circle."""
    return [arc((u, v), radius, 0, math.pi), arc((u, v), radius, math.pi, 2 * math.pi)]


def ring(u: float, v: float, inner: float, outer: float) -> list[Curve]:
    """The ring between two circles about (u, v)."""
    if not 0 < inner < outer:
        raise ArgumentError(f"ring: 0 < inner < outer, not {inner} and {outer}")
    return disc(u, v, outer) + [arc((u, v), inner, 0, -math.pi), arc((u, v), inner, -math.pi, -2 * math.pi)]


SHAPES: dict[str, tuple[Callable[..., list[Curve]], int]] = {"box": (box, 4), "disc": (disc, 3), "ring": (ring, 4)}


def domain_of(given: Any) -> list[Curve]:
    """A domain: curves, four numbers of a box, or a word of the command: "box:0,0,1,1", "disc:u,v,r", "ring:u,v,r0,r1"."""
    if isinstance(given, Curve):
        return [given]
    if isinstance(given, str):
        word, _, numbers = given.partition(":")
        make, count = SHAPES.get(word, (box, -1))
        values = [float(each) for each in numbers.split(",") if each]
        if len(values) != count:
            raise ArgumentError(f"'{given}' is not a domain: box:u0,v0,u1,v1, disc:u,v,radius or ring:u,v,inner,outer")
        return make(*values)
    items = list(given)
    if len(items) == 4 and all(isinstance(each, (int, float, np.number)) for each in items):
        return box(*map(float, items))
    if not items or not all(isinstance(each, Curve) for each in items):
        raise ArgumentError("a domain is curves, or four numbers u0, v0, u1, v1 of a box")
    return items
