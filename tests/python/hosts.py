# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of tests and benchmarks: surfaces in Python and in host.c."""
import ctypes
import math
import os

import numpy as np

import carreau
from carreau import capi

TWO_PI = 2 * math.pi
TORUS_BOX = (0, 0, TWO_PI, TWO_PI)
TORUS_AREA = 4 * math.pi ** 2 * 2


def torus(u, v):
    r = 2 + np.cos(v)
    return r * np.cos(u), r * np.sin(u), np.sin(v)


@carreau.scalar
def torus_of_floats(u, v):
    r = 2 + math.cos(v)
    return r * math.cos(u), r * math.sin(u), math.sin(v)


def sphere(u, v):
    w = 1 + u * u + v * v
    return 2 * u / w, 2 * v / w, (w - 2) / w


class HostInC:
    """A surface of host.c over a box, as a geometry of a session."""

    def __init__(self, name, box, batch=False, size=None):
        self.library = ctypes.CDLL(os.environ["CARREAU_PYTHON_HOST"])
        self.box = (ctypes.c_double * 4)(*box)
        members = {"surface_batch" if batch else "surface": self.function(name + ("_batch" if batch else ""), "surface_batch" if batch else "surface")}
        self.cad = capi.struct(capi.carreau_cad, curve_order=2, user=ctypes.addressof(self.box), **members,
                               curve_interval=self.function("unit_interval", "interval"), curve=self.function("box_side", "curve"))
        self.metric = None if size is None else capi.struct(capi.carreau_metric_callbacks, surface_metric=self.function(size, "surface_metric"))

    def function(self, name, kind):
        pointer = ctypes.cast(getattr(self.library, name), ctypes.c_void_p)
        return getattr(capi, f"carreau_{kind}_fn")(pointer.value)

    def add_to(self, session):
        lib = capi.lib()
        session._kept.append(self)
        session._call(lib.geometry_begin, ctypes.byref(self.cad))
        session._call(lib.model_add_face, 1, 1)
        for _ in range(4):
            session._call(lib.model_add_curve, 1, capi.BOUNDARY, 0, 0, 0)
        session._call(lib.geometry_end)
        if self.metric is not None:
            session._call(lib.set_metric_callbacks, ctypes.byref(self.metric))
        return session


def arrays_of(mesh):
    return [getattr(mesh, name) for name in ("vertices", "triangles", "edges", "face_ids", "curve_ids", "vertex_ids", "corner_uv", "sizes")]


def same(a, b):
    return all(np.array_equal(x, y) for x, y in zip(arrays_of(a), arrays_of(b)))
