# SPDX-License-Identifier: BSD-3-Clause
"""All exceptions of the package, with the place of the error."""
from __future__ import annotations

import math
from typing import Optional

from . import _declarations as c


class CarreauError(Exception):
    """The base of all exceptions. The text is the library's sentence.

    status   number of carreau_status, and its name
    face     reference of the face                      0: it is about none
    ic       rank of a curve in that face, from 1       0: none
    curve    reference of the curve                     0: none
    point    reference of the point                     0: none
    line     line of the file in the sentence, from 1   0: none
    uv       parameters in the face                     None: none
    t        parameter on the curve                     None: none
    """

    status: int = c.ERR_INTERNAL

    def __init__(self, sentence: str, face: int = 0, ic: int = 0, curve: int = 0, point: int = 0, line: int = 0,
                 uv: Optional[tuple[float, float]] = None, t: Optional[float] = None) -> None:
        super().__init__(sentence)
        self.face, self.ic, self.curve, self.point, self.line = face, ic, curve, point, line
        self.uv = uv if uv is not None and all(map(math.isfinite, uv)) else None
        self.t = t if t is not None and math.isfinite(t) else None


class ArgumentError(CarreauError, ValueError):
    """An argument or the value of a parameter violates its precondition."""

    status = c.ERR_ARGUMENT


class ModelError(CarreauError):
    """Faces, curves, points or references contradict one another."""

    status = c.ERR_MODEL


class FileError(CarreauError, OSError):
    """A file cannot be opened, read, understood or written."""

    status = c.ERR_FILE


class CallbackError(CarreauError):
    """A callback has failed, or its result is not usable. Its exception is the cause (__cause__)."""

    status = c.ERR_CALLBACK


class DomainError(CarreauError):
    """A parameter domain does not close, crosses itself or is turned the wrong way."""

    status = c.ERR_DOMAIN


class LimitError(CarreauError):
    """The mesh would exceed the limit set by max_triangles or by memory."""

    status = c.ERR_LIMIT


class Cancelled(CarreauError):
    """The run was stopped on request."""

    status = c.ERR_CANCELLED


class OutOfMemory(CarreauError, MemoryError):
    """An allocation failed."""

    status = c.ERR_MEMORY


class SequenceError(CarreauError):
    """The call needs the result of another call that was not made or did not succeed."""

    status = c.ERR_SEQUENCE


class PartialError(CarreauError):
    """Some faces could not be meshed; the session's mesh holds the others."""

    status = c.ERR_PARTIAL


class BusyError(CarreauError):
    """The session is running: its callbacks cannot use it, but for stop()."""

    status = c.ERR_BUSY


class InternalError(CarreauError):
    """A defect of the library; please report it."""

    status = c.ERR_INTERNAL


BY_STATUS: dict[int, type[CarreauError]] = {
    kind.status: kind for kind in (ArgumentError, ModelError, FileError, CallbackError, DomainError, LimitError, Cancelled,
                                   OutOfMemory, SequenceError, PartialError, BusyError, InternalError)}
