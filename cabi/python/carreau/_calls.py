# SPDX-License-Identifier: BSD-3-Clause
"""Calls of the library: a status becomes an exception, a struct a tuple with names."""
from __future__ import annotations

import os
from ctypes import byref, c_int64, c_void_p, sizeof
from typing import Any, Callable, Union

import numpy as np
from numpy.typing import NDArray

from . import _declarations as c
from ._library import cad_lib, lib
from ._records import RECORDS
from .errors import BY_STATUS, CarreauError, InternalError

Path = Union[str, "os.PathLike[str]"]


def text_of(value: Any) -> Any:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else value


def file_name(path: Path) -> bytes:
    return os.fsencode(path)


def struct(kind: Any, **members: Any) -> Any:
    """A struct with its size; members that are not given are zero."""
    made = kind(**members)
    made.struct_size = sizeof(kind)
    return made


def address(array: Any) -> Any:
    """The address of an array, for members that are pointers. The caller keeps the array."""
    return None if array is None else array.ctypes.data


def record(value: Any) -> Any:
    """The tuple of a struct that was filled in; texts are copied."""
    kind = RECORDS[type(value)]
    fields = ((name, getattr(value, name)) for name in kind._fields)
    return kind(**{name: tuple(each) if hasattr(each, "_length_") else "" if each is None and name != "user" else text_of(each)
                   for name, each in fields})


def _where(handle: Any) -> dict[str, Any]:
    place = struct(c.carreau_error_place)
    if lib().last_error_place(handle, byref(place)) != c.OK:
        return {}
    return {"face": place.face, "ic": place.ic, "curve": place.curve, "point": place.point, "line": place.line,
            "uv": (place.uv[0], place.uv[1]), "t": place.t}


def error_of(status: int, sentence: Any, **where: Any) -> CarreauError:
    said = text_of(sentence) or text_of(lib().status_meaning(status))
    return BY_STATUS.get(status, InternalError)(said, **where)


def session_error(handle: Any, status: int) -> CarreauError:
    return error_of(status, lib().last_error(handle), **_where(handle))


def require(handle: Any, status: int) -> None:
    """Checks a status of a session. Raises CarreauError."""
    if status != c.OK:
        raise session_error(handle, status)


def require_by(last_error: Callable[[Any], Any], handle: Any, status: int) -> None:
    """Checks a status of any other handle. Raises CarreauError."""
    if status != c.OK:
        raise error_of(status, last_error(handle))


def require_mesh(handle: Any, status: int) -> None:
    require_by(lib().mesh_last_error, handle, status)


def require_cad(handle: Any, status: int) -> None:
    require_by(cad_lib().cad_last_error, handle, status)


def created(create: Callable[[Any], int]) -> c_void_p:
    """A new handle."""
    handle = c_void_p()
    status = create(byref(handle))
    if status != c.OK:
        raise error_of(status, b"")
    return handle


def asked(kind: Any, ask: Callable[[Any], None]) -> Any:
    """The record of a struct that the call ask(pointer) fills in."""
    filled = struct(kind)
    ask(byref(filled))
    return record(filled)


def counted(ask: Callable[[Any], None]) -> int:
    """A number that the call ask(pointer) returns."""
    count = c_int64()
    ask(byref(count))
    return count.value


def table(ask: Callable[[int, Any, Any], None], columns: int) -> NDArray[np.float64]:
    """Rows of doubles of functions that count them first: ask(capacity, array, pointer)."""
    count = c_int64()
    ask(0, None, byref(count))
    rows = np.empty((count.value, columns))
    if count.value:
        ask(count.value, rows, byref(count))
    return rows


