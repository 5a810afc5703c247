# SPDX-License-Identifier: BSD-3-Clause
"""A run of the library: exceptions of callbacks end it, and so does Ctrl-C, at once."""
from __future__ import annotations

import os
import signal
import threading
from contextlib import contextmanager, suppress
from ctypes import c_void_p
from typing import Any, Callable, Iterator, Optional

from ._library import lib
from .errors import CallbackError


class Host:
    """The data that the callbacks of a session share. It knows the handle and not the session, so that no cycle keeps
    either."""

    def __init__(self, handle: c_void_p) -> None:
        self.handle = handle
        self.error: Optional[BaseException] = None  # the first one
        self.where: dict[str, Any] = {}
        self.inside = 0  # callbacks of the user that run now
        self.interrupted = False

    def stop(self) -> None:
        lib().stop(self.handle)

    def fail(self, error: BaseException, where: dict[str, Any]) -> None:
        """Keeps the exception of a callback, and ends the run: no other face is begun."""
        if self.error is None:
            self.error, self.where = error, where
        self.stop()

    def guarded(self, where: Callable[..., dict[str, Any]], body: Callable[..., Optional[int]]) -> Callable[..., int]:
        """`body` as a callback of the library, which no exception leaves; where(*arguments) describes its place."""
        def callback(*arguments: Any) -> int:
            try:
                self.inside += 1
                return body(*arguments) or 0
            except BaseException as error:
                self.fail(error, where(*arguments))
                return 1
            finally:
                self.inside -= 1
        return callback

    def take_error(self) -> Optional[BaseException]:
        """The exception that the run raises in place of the library's own error."""
        error, self.error = self.error, None
        return callback_error(error, self.where) if isinstance(error, Exception) else error


def callback_error(error: Exception, where: dict[str, Any]) -> CallbackError:
    """The CallbackError of an exception of a callback, with the place; a function of single places has already given
    its own."""
    place = {**where, **getattr(error, "_carreau_place", {})}
    made = CallbackError(f"{place_text(place)}a callback has raised {type(error).__name__}: {error}", **place)
    made.__cause__ = error
    return made


def place_text(where: dict[str, Any]) -> str:
    """"face 3, u = 0.5, v = 1: "."""
    parts = [f"{name} {where[key]}" for key, name in (("point", "point"), ("face", "face"), ("ic", "curve")) if where.get(key)]
    if where.get("uv") is not None:
        parts.append("u = {:.6g}, v = {:.6g}".format(*where["uv"]))
    if where.get("t") is not None:
        parts.append(f"t = {where['t']:.6g}")
    return ", ".join(parts) + ": " if parts else ""


class _Watcher:
    """Hears signals while the library runs and Python does not: the interpreter's own handler writes their numbers into
    a pipe at once."""

    def __init__(self, host: Host) -> None:
        self.host = host
        self.ear, self.mouth = os.pipe()
        os.set_blocking(self.mouth, False)
        self.before = signal.set_wakeup_fd(self.mouth, warn_on_full_buffer=False)
        self.thread = threading.Thread(target=self.listen, name="carreau-signals", daemon=True)
        self.thread.start()

    def listen(self) -> None:
        while heard := os.read(self.ear, 64):
            if signal.SIGINT in heard:
                self.host.interrupted = True
                self.host.stop()
            if self.before >= 0:  # of an event loop, which may have enough to read
                with suppress(OSError):
                    os.write(self.before, heard)

    def close(self) -> None:
        signal.set_wakeup_fd(self.before)
        os.close(self.mouth)
        self.thread.join()
        os.close(self.ear)


@contextmanager
def _listening(host: Host) -> Iterator[Callable[[], None]]:
    """Gives a function that raises KeyboardInterrupt, as the program's own handler would, when Ctrl-C was pressed
    meanwhile."""
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(before):
        yield lambda: None
        return
    known: Callable[..., Any] = before

    def on_interrupt(number: int, frame: Any) -> None:
        host.interrupted = True
        host.stop()
        if host.inside:  # a callback that takes long ends, too
            known(number, frame)

    def pass_on() -> None:
        if host.interrupted:
            known(signal.SIGINT, None)

    watcher = _Watcher(host)
    signal.signal(signal.SIGINT, on_interrupt)
    try:
        yield pass_on
    finally:
        signal.signal(signal.SIGINT, before)
        watcher.close()


def run(host: Host, call: Callable[[], int]) -> int:
    """The status of a call that may run callbacks. Raises the exception of a callback, as the cause of a CallbackError,
    and KeyboardInterrupt."""
    host.error, host.interrupted = None, False
    with _listening(host) as pass_on:
        pass_on()  # a run would forget what was asked before it
        status = call()
    error = host.take_error()
    if error is not None:
        raise error
    pass_on()
    return status


