# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of meshes: a z-buffer in NumPy, and PNG by zlib."""
from __future__ import annotations

import base64
import html as text
import struct
import zlib
from typing import Any, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from ._content import MeshContent

Reals = NDArray[np.float64]
VIEWS = {"iso": (1, -1, 0.8), "top": (0, 0, 1), "bottom": (0, 0, -1), "front": (0, -1, 0), "back": (0, 1, 0), "right": (1, 0, 0),
         "left": (-1, 0, 0)}
SAMPLES = 2  # a pixel, in both directions
LINE = 0.6  # half the width of edges, samples
AT_ONCE = 1 << 22  # places looked at in one go: bounds the memory


def _axes(view: Union[str, Sequence[float]]) -> Reals:
    """Rows: to the right, upwards, towards the eye."""
    if isinstance(view, str) and view not in VIEWS:
        raise ValueError(f"view is one of {', '.join(VIEWS)}, or a direction, not '{view}'")
    eye = np.array(VIEWS[view] if isinstance(view, str) else view, dtype=np.float64)
    eye /= np.linalg.norm(eye)
    up = np.array((0, 0, 1.0)) if abs(eye[2]) < 0.999 else np.array((0, 1.0, 0))
    right = np.cross(up, eye)
    right /= np.linalg.norm(right)
    return np.array((right, np.cross(eye, right), eye))


def _palette(index: NDArray[Any]) -> Reals:
    """Light colours (n, 3) of faces, neighbours apart: hues by the golden ratio."""
    hue = (index * 0.6180339887498949 + 0.55) % 1 * 2 * np.pi
    return np.stack([0.78 + 0.16 * np.cos(hue - shift) for shift in (0, 2.0944, 4.1888)], axis=-1)


# Viridis (S. van der Walt, N. Smith, E. Firing; matplotlib, CC0), as in pictures and reports of the command: readable for people with
# red-green colour blindness, too.
SCALE = np.array([[int(stop[i:i + 2], 16) / 255 for i in (0, 2, 4)] for stop in (
    "440154 48186a 472d7b 424086 3b528b 33638d 2c728e 26828e 21918c 1fa088 28ae80 3fbc73 5ec962 84d44b addc30 d8e219 fde725").split()])


def _scale(share: Reals) -> Reals:
    """From dark violet at 0 over blue-green to yellow at 1; NaN is grey."""
    at = np.clip(share, 0, 1) * (len(SCALE) - 1)
    color = np.stack([np.interp(at, np.arange(len(SCALE)), SCALE[:, k]) for k in range(3)], axis=-1)
    return np.where(np.isnan(share)[:, None], 0.6, color)


def _range(values: Reals) -> Reals:
    """Shares of the range of values, 0 to 1."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
    share: Reals = (values - low) / (high - low if high > low else 1)
    return share


def _base(mesh: MeshContent, size: Reals, colors: Any) -> Reals:
    """A colour (m, 3) for each triangle of twice the area `size`."""
    if not isinstance(colors, str):
        values = np.asarray(colors, dtype=np.float64)
        if values.shape == (len(mesh.vertices),):
            values = values[mesh.triangles].mean(axis=1)
        if values.shape != (len(mesh.triangles),):
            raise ValueError(f"colors has the shape {values.shape}: a number for each vertex, or for each triangle")
        return _scale(_range(values))
    if colors == "quality":
        p = mesh.vertices[mesh.triangles]
        squares = sum(((p[:, i] - p[:, i - 1]) ** 2).sum(axis=1) for i in range(3))
        return _scale(2 * np.sqrt(3) * size / np.where(squares > 0, squares, 1))
    if colors == "face":
        return _palette(np.unique(mesh.face_ids, return_inverse=True)[1])
    raise ValueError(f"colors is face, quality or an array, not '{colors}'")


def _shades(mesh: MeshContent, axes: Reals, colors: Any) -> Reals:
    """Colours lit from the eye."""
    normals = mesh.normals
    size = np.linalg.norm(normals, axis=1)
    lit = np.abs(normals @ axes[2]) / np.where(size > 0, size, 1)
    base = _base(mesh, size, colors)
    shaded: Reals = base * (0.45 + 0.55 * lit)[:, None]
    return shaded


def _places(low: NDArray[np.int64], extent: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """All samples of boxes (n, 2): the rank of the box, and x and y."""
    counts = extent.prod(axis=1)
    box = np.repeat(np.arange(len(low)), counts)
    k = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return box, low[box, 0] + k % extent[box, 0], low[box, 1] + k // extent[box, 0]


class _Canvas:
    def __init__(self, width: int, height: int) -> None:
        self.width, self.height = width, height
        self.depth = np.full(width * height, -np.inf)
        self.color = np.ones((width * height, 3))

    def fill(self, corners: Reals, colors: Reals, edges: bool) -> None:
        """Triangles (m, 3, 3) of x, y in samples and the depth, the largest nearest to the eye."""
        low = np.clip(np.floor(corners[..., :2].min(axis=1)), 0, (self.width - 1, self.height - 1)).astype(np.int64)
        high = np.clip(np.ceil(corners[..., :2].max(axis=1)), 0, (self.width - 1, self.height - 1)).astype(np.int64)
        extent = high - low + 1
        done = np.concatenate([[0], np.cumsum(extent.prod(axis=1))])
        first = 0
        while first < len(corners):
            last = max(int(np.searchsorted(done, done[first] + AT_ONCE)), first + 1)
            part = slice(first, last)
            self._fill(corners[part], colors[part], low[part], extent[part], edges)
            first = last

    def _fill(self, corners: Reals, colors: Reals, low: NDArray[np.int64], extent: NDArray[np.int64], edges: bool) -> None:
        p, q = corners[..., :2], np.roll(corners[..., :2], -1, axis=1)
        side = q - p
        area = side[:, 0, 0] * side[:, 1, 1] - side[:, 0, 1] * side[:, 1, 0]
        sound = np.abs(area) > 1e-9
        t, x, y = _places(low[sound], extent[sound])
        p, side, area, corners, colors = p[sound], side[sound], area[sound], corners[sound], colors[sound]
        # Twice the areas opposite to the corners, over the area of the triangle; side i is opposite to corner i + 2.
        weights = ((side[t, :, 0] * (y[:, None] - p[t, :, 1]) - side[t, :, 1] * (x[:, None] - p[t, :, 0])) / area[t, None])
        inside = (weights >= -1e-12).all(axis=1)
        t, x, y, weights = t[inside], x[inside], y[inside], weights[inside]
        depth = (np.roll(weights, -1, axis=1) * corners[t, :, 2]).sum(axis=1)
        color = colors[t]
        if edges:
            away = weights * np.abs(area)[t, None] / np.maximum(np.linalg.norm(side, axis=2)[t], 1e-12)
            color = np.where((away.min(axis=1) < LINE)[:, None], color * 0.45, color)
        order = np.argsort(depth, kind="stable")
        place = (y * self.width + x)[order]
        nearest = np.full(self.width * self.height, -1)
        nearest[place] = order  # the last one counts: the nearest
        hit = np.flatnonzero(nearest >= 0)
        hit = hit[depth[nearest[hit]] > self.depth[hit]]
        self.depth[hit], self.color[hit] = depth[nearest[hit]], color[nearest[hit]]

    def pixels(self) -> NDArray[np.uint8]:
        """Means of the samples, the first row on top."""
        rows = self.color.reshape(self.height // SAMPLES, SAMPLES, self.width // SAMPLES, SAMPLES, 3).mean(axis=(1, 3))
        values: NDArray[np.uint8] = (np.clip(rows[::-1], 0, 1) * 255 + 0.5).astype(np.uint8)
        return values


def png(pixels: NDArray[np.uint8]) -> bytes:
    """A file of (height, width, 3) values of sRGB."""
    height, width, _ = pixels.shape

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def picture(mesh: MeshContent, width: int = 640, height: int = 480, view: Union[None, str, Sequence[float]] = None, edges: bool = True,
            colors: Any = "face") -> bytes:
    """A PNG file of a mesh.

    view     "iso", "top", "bottom", "front", "back", "right", "left", or the direction towards the eye; None: "iso", of a
             plane mesh "top"
    edges    draws the sides of triangles
    colors   "face"; "quality": from violet (Q2 = 0) to yellow (1); or a number for each vertex (n) or triangle (m), from
             violet, the smallest, to yellow
    """
    canvas = _Canvas(width * SAMPLES, height * SAMPLES)
    if len(mesh.triangles):
        axes = _axes(view if view is not None else "top" if mesh.dimension == 2 else "iso")
        seen = mesh.vertices @ axes.T
        low, high = seen.min(axis=0), seen.max(axis=0)
        spread = np.maximum(high - low, 1e-300)
        scale = 0.94 * min(canvas.width / spread[0], canvas.height / spread[1])
        middle = (low + high) / 2
        seen = (seen - middle) * scale + (canvas.width / 2, canvas.height / 2, 0)
        canvas.fill(seen[mesh.triangles], _shades(mesh, axes, colors), edges)
    return png(canvas.pixels())


def html(mesh: MeshContent) -> str:
    """A picture and a few figures, for notebooks."""
    q = mesh.quality
    rows = [("vertices", f"{q.vertices}"), ("triangles", f"{q.triangles}"), ("faces", f"{len(mesh.faces)}"),
            ("shape Q2", f"mean {q.q2_mean:.4f}, worst {q.q2_min:.4f}"), ("angles", f"{q.angle_min:.2f} to {q.angle_max:.2f} degrees"),
            ("edges", f"{q.edge_min:.4g} to {q.edge_max:.4g}, {q.open_edges} open"), ("area", f"{q.area:.6g}")]
    if mesh.failed:
        rows.append(("failed", ", ".join(str(face.ref) for face in mesh.failed)))
    body = "".join(f"<tr><th style='text-align:left'>{name}</th><td style='text-align:left'>{text.escape(value)}</td></tr>" for name, value in rows)
    data = base64.b64encode(mesh.picture()).decode()
    return f"<div><img alt='{text.escape(repr(mesh))}' src='data:image/png;base64,{data}'/><table>{body}</table></div>"
