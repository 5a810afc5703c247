# SPDX-License-Identifier: BSD-3-Clause
"""NumPy arrays as arguments of the library, and its memory as NumPy arrays: nothing is copied on the way."""
from __future__ import annotations

from ctypes import c_void_p
from typing import Any, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray


class _Argument(c_void_p):
    """A pointer argument that takes arrays of one type in C order, or None."""

    dtype: Any = None

    @classmethod
    def from_param(cls, value: Optional[NDArray[Any]]) -> Any:
        if value is None:
            return None
        if not isinstance(value, np.ndarray) or value.dtype != cls.dtype or not value.flags.c_contiguous:
            raise TypeError(f"an array of {np.dtype(cls.dtype)} in C order is needed, not {value!r}")
        return c_void_p(value.ctypes.data)


class Doubles(_Argument):
    """double[]"""

    dtype = np.float64


class Int32s(_Argument):
    """int32_t[]"""

    dtype = np.int32


class Int64s(_Argument):
    """int64_t[]"""

    dtype = np.int64


class _Memory:
    """Memory of the library for np.asarray."""

    __slots__ = ("__array_interface__",)

    def __init__(self, address: int, shape: tuple[int, ...], typestr: str, read_only: bool) -> None:
        self.__array_interface__ = {"data": (address, read_only), "shape": shape, "typestr": typestr, "version": 3}


_DOUBLE, _INT32 = np.dtype(np.float64).str, np.dtype(np.int32).str


def view(address: int, shape: tuple[int, ...], read_only: bool = False) -> NDArray[np.float64]:
    """The doubles at an address, until the callback that got it returns."""
    return np.asarray(_Memory(address, shape, _DOUBLE, read_only))


def view_int32(address: int, shape: tuple[int, ...]) -> NDArray[np.int32]:
    """A view of int32_t, likewise."""
    return np.asarray(_Memory(address, shape, _INT32, False))


def _shaped(array: NDArray[Any], name: str, shape: Sequence[Optional[int]]) -> NDArray[Any]:
    fits = array.ndim == len(shape) and all(want is None or have == want for have, want in zip(array.shape, shape))
    if fits:
        return array
    wanted = " x ".join("n" if want is None else str(want) for want in shape)
    raise ValueError(f"{name} has the shape {array.shape}; it must be {wanted}")


def doubles(values: ArrayLike, name: str, *shape: Optional[int]) -> NDArray[np.float64]:
    """An array of float64 in C order; itself if it is one already. Raises ValueError for another shape (None: any)."""
    return _shaped(np.ascontiguousarray(values, dtype=np.float64), name, shape)


def int32s(values: ArrayLike, name: str, *shape: Optional[int]) -> NDArray[np.int32]:
    """An array of int32, likewise. Raises ValueError if a value is not a whole number of 32 bits."""
    given = np.asarray(values)
    if given.dtype == np.int32:
        return _shaped(np.ascontiguousarray(given), name, shape)
    array = np.ascontiguousarray(given.astype(np.int32))
    if given.size and not np.array_equal(array, given):
        raise ValueError(f"{name} must hold whole numbers of 32 bits")
    return _shaped(array, name, shape)
