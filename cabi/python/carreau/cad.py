# SPDX-License-Identifier: BSD-3-Clause
"""STEP, IGES and BREP files, by libcarreau_cad."""
from __future__ import annotations

import weakref
from ctypes import byref
from typing import Any, Callable

import numpy as np
from numpy.typing import NDArray

from . import _declarations as c
from ._calls import Path, asked, created, file_name, require, require_cad, struct, text_of
from ._library import cad_lib
from ._records import CadContent, CadDanger, CadFace, CadFigures, CadReport
from ._run import Host, run
from ._session import SessionBase
from .progress import Progress, listener


class CadFile:
    """A file that was read: .step, .stp, .iges, .igs or .brep. Faces and edges have their numbers in the file, from 1.
    Lengths are in millimetres; those of a BREP file have no unit. Edges of no face are left out unless loose_edges is
    given or the file has no face. Raises FileError, ImportError without libcarreau_cad."""

    def __init__(self, path: Path, progress: Progress = None, loose_edges: bool = False) -> None:
        self._handle = created(cad_lib().cad_create)
        self._close = weakref.finalize(self, cad_lib().cad_close, self._handle)
        hears = listener(progress)
        host = _Reading(self._handle)

        def on_progress(share: float, _: Any) -> int:
            return int(host.stopped or bool(hears and hears(share, "reading", 0)))

        callback = c.carreau_cad_progress_fn(host.guarded(lambda *_: {}, on_progress))
        options = struct(c.carreau_cad_options, loose_edges=int(loose_edges), progress=callback)
        require_cad(self._handle, run(host, lambda: int(cad_lib().cad_read(self._handle, file_name(path), byref(options)))))

    def _call(self, function: Callable[..., int], *arguments: Any) -> None:
        require_cad(self._handle, function(self._handle, *arguments))

    def add_to(self, session: SessionBase) -> None:
        """Adds all faces to a session, which keeps what it needs."""
        require(session._handle, cad_lib().cad_add(self._handle, session._handle))

    def set_face_size(self, face: object, size: float) -> None:
        """Wants a size on the face of this number, or on all faces of this name, when hphy_flag = 2."""
        self._call(cad_lib().cad_set_face_size, str(face).encode(), float(size))

    @property
    def content(self) -> CadContent:
        """Numbers of faces and edges, the diagonal, tolerances of gluing."""
        return asked(c.carreau_cad_content, lambda out: self._call(cad_lib().cad_info, out))  # type: ignore[no-any-return]

    @property
    def faces(self) -> list[CadFace]:
        """Numbers, names and colours of the faces, and why one cannot be meshed."""
        return [asked(c.carreau_cad_face, lambda out, k=k: self._call(cad_lib().cad_file_face, k, out))  # type: ignore[misc]
                for k in range(1, self.content.faces + 1)]

    def figures(self, face: int) -> CadFigures:
        """Kind, area, perimeter and box of a face."""
        return asked(c.carreau_cad_figures, lambda out: self._call(cad_lib().cad_measure_face, face, out))  # type: ignore[no-any-return]

    @property
    def losses(self) -> list[str]:
        """What of the file could not be read."""
        return [text_of(cad_lib().cad_loss(self._handle, k)) for k in range(self.content.losses)]

    def inspect(self, tiny: float = 0) -> tuple[CadReport, list[CadDanger]]:
        """What is hard to mesh; edges shorter than `tiny` times the diagonal are dangers (0: 1e-3)."""
        report = asked(c.carreau_cad_report, lambda out: self._call(cad_lib().cad_inspect, tiny, out))
        dangers = [asked(c.carreau_cad_danger, lambda out, k=k: self._call(cad_lib().cad_danger_at, k, out))  # type: ignore[misc]
                   for k in range(report.dangers)]
        return report, dangers

    def point(self, face: int, u: float, v: float) -> NDArray[np.float64]:
        """The point (3) of a face at (u, v) as meshes have them."""
        xyz = np.empty(3)
        self._call(cad_lib().cad_point, face, u, v, xyz, None)
        return xyz


class _Reading(Host):
    """Has no session to be stopped: the progress of the reading says so."""

    stopped = False

    def stop(self) -> None:
        self.stopped = True


def read(path: Path, progress: Progress = None) -> CadFile:
    """Reads a file; see CadFile."""
    return CadFile(path, progress)
