# SPDX-License-Identifier: BSD-3-Clause
"""Sessions without geometry and mesh: parameters, sizes, messages, runs."""
from __future__ import annotations

import logging
import weakref
from ctypes import byref, c_char_p, c_double, c_int32, c_void_p
from typing import Any, Callable, Mapping, Optional, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _declarations as c
from ._arrays import doubles
from ._calls import Path, asked, counted, created, file_name, record, require, session_error, struct, text_of
from ._library import lib
from ._records import Interface, Parameter, Report
from ._run import Host, run
from ._studies import Studies
from .errors import SequenceError
from .progress import PHASES, Bar, Progress, listener
from .sizes import SizeCallbacks

log = logging.getLogger("carreau")
LOG_LEVELS = {c.LEVEL_ERROR: logging.ERROR, c.LEVEL_WARNING: logging.WARNING, c.LEVEL_SUMMARY: logging.INFO}
Value = Union[int, float, str]
Self = TypeVar("Self", bound="SessionBase")


class SessionBase(Studies):
    """Holds parameters and runs the library. Session adds geometries and meshes."""

    def __init__(self, **parameters: Value) -> None:
        self._handle: c_void_p = created(lib().session_create)
        self._close = weakref.finalize(self, lib().session_free, self._handle)
        self._host = Host(self._handle)
        self._kept: list[Any] = []  # callbacks of geometries, until the session is gone
        self._sizes: list[Any] = []  # callbacks of sizes: of the latest mesh, which is measured with them, and since
        self._runs = 0
        self.messages: list[tuple[int, str]] = []
        self._listen()
        for name, value in parameters.items():
            self[name] = value

    def _listen(self) -> None:
        messages = self.messages

        def on_message(level: int, text: bytes, _: Any) -> None:
            messages.append((level, text.decode("utf-8", "replace")))
            log.log(LOG_LEVELS.get(level, logging.DEBUG), "%s", messages[-1][1])

        self._on_message = c.carreau_message_fn(on_message)
        require(self._handle, lib().set_message_callback(self._handle, self._on_message, None))

    def close(self) -> None:
        """Frees geometry and mesh now, and not when the last reference to the session disappears. Meshes keep their
        arrays."""
        self._close()
        self._kept.clear()

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _call(self, function: Callable[..., int], *arguments: Any) -> None:
        """A function of the library on this session. Raises CarreauError."""
        if not self._close.alive:
            raise ValueError("the session is closed")
        status = function(self._handle, *arguments)
        if status != c.OK:
            raise self._host.take_error() or session_error(self._handle, status)

    # ---- parameters ----

    def __setitem__(self, name: str, value: Value) -> None:
        word = name.encode()
        if isinstance(value, str):
            self._call(lib().set_text if _kind(name) == c.TEXT else lib().set_word, word, value.encode())
        elif _kind(name) == c.REAL:
            self._call(lib().set_real, word, float(value))
        else:
            self._call(lib().set_integer, word, int(value)) if value == int(value) else self._call(lib().set_real, word, value)

    def __getitem__(self, name: str) -> Value:
        kind, word = _kind(name), name.encode()
        out: Any = {c.TEXT: c_char_p, c.REAL: c_double}.get(kind, c_int32)()
        self._call({c.TEXT: lib().get_text, c.REAL: lib().get_real}.get(kind, lib().get_integer), word, byref(out))
        return text_of(out.value)  # type: ignore[no-any-return]

    def is_set(self, name: str) -> bool:
        """True if a parameter has a value now: a length that is a share of the diagonal has none before a mesh is made."""
        try:
            return self[name] is not None
        except SequenceError:
            return False

    def reset(self, name: Optional[str] = None) -> None:
        """Sets one parameter, or all, back to the default."""
        if name is None:
            self._call(lib().reset_parameters)
        else:
            self._call(lib().reset_parameter, name.encode())

    def read_env(self, path: Path) -> None:
        """Sets the parameters that a blsurf.env has before its first action."""
        self._call(lib().read_env, file_name(path))

    # ---- sizes ----

    def set_sizes(self, function: Optional[Callable[..., Any]] = None, *, face_sizes: Optional[Mapping[int, float]] = None,
                  on_curve: Optional[Callable[..., Any]] = None, at_point: Optional[Callable[..., Any]] = None) -> None:
        """Prescribes sizes (model length) or metrics by functions; see carreau.sizes.SizeCallbacks. Without any: none."""
        sizes = SizeCallbacks(self._host, function, face_sizes, on_curve, at_point).struct()
        self._call(lib().set_metric_callbacks, byref(sizes))
        self._sizes.append(sizes)

    def name_entities(self, dimension: int, refs: ArrayLike, name: str) -> None:
        """Names points (dimension 0), curves (1), faces (2) or solids (3). Entities of one name form a group in files."""
        numbers = np.atleast_1d(np.asarray(refs, np.int32))
        self._call(lib().model_name_entities, dimension, len(numbers), numbers, name.encode())

    def set_face_sides(self, face: int, solid: int, other_solid: int = 0) -> None:
        """Sets the solids on both sides of a face, from 1: the solid that its triangles look out of, and the other solid; 0:
        none."""
        self._call(lib().model_set_face_sides, face, solid, other_solid)

    def add_periodicity(self, slaves: ArrayLike = (), masters: ArrayLike = (), transform: Optional[ArrayLike] = None) -> None:
        """Makes slaves[i] the image of masters[i], faces by reference, under a map (3, 4), R | d; None: found.

        Without faces all pairs are found that the map has.
        """
        rows = [np.atleast_1d(np.asarray(faces, np.int32)).ravel() for faces in (slaves, masters)]
        if len(rows[0]) != len(rows[1]):
            raise ValueError(f"{len(rows[0])} slaves have {len(rows[1])} masters")
        numbers = None if transform is None else doubles(np.asarray(transform, float).ravel(), "transform", None)
        if numbers is not None and len(numbers) != 12:
            raise ValueError(f"a transform has 12 numbers, not {len(numbers)}")
        self._call(lib().model_add_periodicity, rows[0], rows[1], len(rows[0]), numbers)

    def add_period(self, direction: ArrayLike) -> None:
        """Makes faces periodic by the translation along a direction (3) by the extent of the model."""
        self._call(lib().model_add_period, doubles(direction, "direction", None))

    def divide_curve(self, face: int, ic: int, edges: Union[int, ArrayLike], *, arithmetic: float = 1, geometric: float = 1) -> None:
        """Prescribes the edges of curve number ic, from 1, of a face, and so of all curves that are one with it.

        edges        their number, 0: no prescription; or the parameters (n) of all vertices inside the curve, ascending
        arithmetic   lengths grow by the same step, and the last is so many times as long as the first
        geometric    each edge is so many times as long as its predecessor
        """
        if np.ndim(edges) == 1:
            t = doubles(edges, "edges", None)
            self._call(lib().model_divide_curve_at, face, ic, len(t), t)
            return
        kind, ratio = (c.ARITHMETIC, arithmetic) if arithmetic != 1 else (c.GEOMETRIC, geometric) if geometric != 1 else (c.EQUAL, 1)
        self._call(lib().model_divide_curve, face, ic, int(edges), kind, float(ratio))  # type: ignore[arg-type]

    # ---- runs ----

    def _long(self, function: Callable[..., int], *arguments: Any) -> None:
        """As _call, for calls that may take long: Ctrl-C stops them."""
        if not self._close.alive:
            raise ValueError("the session is closed")
        status = run(self._host, lambda: function(self._handle, *arguments))
        if status != c.OK:
            raise session_error(self._handle, status)

    def _run(self, function: Callable[..., int], *arguments: Any, progress: Progress = None) -> None:
        """The same with progress."""
        hears = listener(progress)
        self.messages.clear()

        def on_progress(phase: int, entity: int, fraction: float, _: Any) -> int:
            assert hears is not None
            return 1 if hears(fraction, PHASES[phase], entity) else 0

        callback = c.carreau_progress_fn(self._host.guarded(lambda *_: {}, on_progress)) if hears else c.carreau_progress_fn(0)
        self._call(lib().set_progress_callback, callback, None)
        try:
            self._long(function, *arguments)
        finally:
            self._call(lib().set_progress_callback, c.carreau_progress_fn(0), None)
            if isinstance(hears, Bar):
                hears.close()

    def run_env(self, path: Path, progress: Progress = None) -> None:
        """Runs all actions of a blsurf.env (RT-0232 sec. 3.3)."""
        try:
            self._run(lib().run_env, file_name(path), progress=progress)
        finally:
            self._runs += 1

    def stop(self) -> None:
        """Requests the run under way to stop, which it does within 100 ms; from a callback, or another thread."""
        if self._close.alive:
            lib().stop(self._handle)

    # ---- results ----

    @property
    def report(self) -> Report:
        """The work of the last run: calls of callbacks, seconds."""
        return asked(c.carreau_report, lambda out: self._call(lib().session_report, out))  # type: ignore[no-any-return]

    @property
    def interfaces(self) -> list[Interface]:
        """The curves of the last mesh in space."""
        count = counted(lambda out: self._call(lib().session_interface_count, out))
        return [asked(c.carreau_interface, lambda out, k=k: self._call(lib().session_interface, k, out))  # type: ignore[misc]
                for k in range(count)]


def _kind(name: str) -> int:
    """The type of a parameter; integer for an unknown parameter, whose call then fails."""
    known = parameters().get(name)
    return c.INTEGER if known is None else known.type


_known: dict[str, Parameter] = {}


def parameters() -> dict[str, Parameter]:
    """All parameters of sessions by their names: help, range, default."""
    if not _known:
        for k in range(lib().parameter_count()):
            info = struct(c.carreau_parameter)
            lib().parameter_info(k, byref(info))
            each = record(info)
            _known[each.name] = each
    return _known
