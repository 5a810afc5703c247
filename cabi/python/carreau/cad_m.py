# SPDX-License-Identifier: BSD-3-Clause
"""Models x.pardom with the routines of a module cad_m (RT-0232) in a shared library."""
from __future__ import annotations

import ctypes
import os
from ctypes import byref, c_double, c_int32, c_void_p
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _declarations as c
from ._calls import Path, struct
from ._library import lib
from .errors import ArgumentError
from .session import Session

NEEDED = ("surf0", "curv_int", "curv0")


class CadM:
    """The routines of a library: C functions, external subroutines of Fortran, or procedures of a Fortran module cad_m.
    Raises ArgumentError if a required routine is missing, OSError for a library that cannot be loaded."""

    def __init__(self, path: Path) -> None:
        name = os.fspath(path)
        # A name without a slash would be looked for in the folders of the system.
        self.library = ctypes.CDLL(str(name) if os.sep in str(name) else os.path.join(".", str(name)))
        types: dict[str, Any] = {field[0]: field[1] for field in c.carreau_cad_m._fields_[1:]}
        found = {routine: self._address(routine) for routine in types}
        missing = [routine for routine in NEEDED if found[routine] is None]
        if missing:
            raise ArgumentError(f"the shared library '{name}' lacks {', '.join(missing)}, alone or in a Fortran module cad_m")
        self.routines = {routine: types[routine](address) for routine, address in found.items() if address is not None}

    def _address(self, routine: str) -> Any:
        for symbol in (routine, f"__cad_m_MOD_{routine}", f"cad_m_mp_{routine}_", routine + "_"):
            if hasattr(self.library, symbol):
                return ctypes.cast(getattr(self.library, symbol), c_void_p).value
        return None

    def give_to(self, session: Session) -> None:
        """Registers the routines in place of others; the session keeps the library."""
        session._kept.append(self)
        session._call(lib().set_cad_m, byref(struct(c.carreau_cad_m, **self.routines)))

    def curve_points(self, face: int, ic: int, shares: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (n, 3) at shares of the interval of a curve, 0 to 1."""
        ref, rank, a, b, t = c_int32(face), c_int32(ic), c_double(), c_double(), c_double()
        places: list[Any] = [ref, rank, a, b, t]
        at = [ctypes.addressof(each) for each in places]
        self.routines["curv_int"](*at[:4])
        uv, points = np.empty(2), np.empty((len(shares), 3))
        for share, point in zip(shares.tolist(), points):
            t.value = a.value + share * (b.value - a.value) if share < 1 else b.value
            self.routines["curv0"](at[0], at[1], at[4], uv.ctypes.data)
            self.routines["surf0"](at[0], uv.ctypes.data, point.ctypes.data)
        return points
