# SPDX-License-Identifier: BSD-3-Clause
"""STEP, IGES and BREP files, by libcarreau_cad."""
from __future__ import annotations

import logging
import os
import weakref
from ctypes import byref, c_char_p, c_int64
from typing import Any, Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from . import _declarations as c
from ._calls import asked, created, file_name, require, require_cad, struct, text_of
from ._library import cad_lib
from ._records import CadContact, CadContent, CadDanger, CadFace, CadFigures, CadReport, CadSmallFeature, CadTreeRow
from ._run import Host, run
from ._session import SessionBase
from .errors import ArgumentError
from .progress import Progress, listener
from .shapes import brep_of, is_shape, solids_of

log = logging.getLogger("carreau")


class CadFile:
    """A file that was read: .step, .stp, .iges, .igs or .brep. Faces and edges have their numbers in the file, from 1.

    source             a path; the bytes of a file, or an open file; or a shape of build123d, CadQuery, pythonocc or FreeCAD
                       (carreau.shapes), whose names and colours of solids come with it
    progress           True: a bar; or a function of (fraction, phase, entity)
    loose_edges        edges of no face are meshed, too; edges of a file without a face always are
    imprint            parts that touch share faces and edges; imprint_tolerance: up to which distance
    unit               of the coordinates: "m", "in", ...; "": millimetres, or as they are in a BREP file, which has none
    scale              multiplies all coordinates, after the unit
    min_feature        holes, bosses, fillets, chamfers, steps and faces below this length are removed: see small_features
    format             of bytes: "step", "iges" or "brep"; "": by their content

    Raises FileError, ArgumentError, ImportError without libcarreau_cad."""

    def __init__(self, source: Any, progress: Progress = None, loose_edges: bool = False, *, imprint: bool = False,
                 imprint_tolerance: float = 0, unit: str = "", scale: float = 1, min_feature: float = 0, format: str = "") -> None:
        self._handle = created(cad_lib().cad_create)
        self._close = weakref.finalize(self, cad_lib().cad_close, self._handle)
        solids = solids_of(source) if is_shape(source) else []
        options = struct(c.carreau_cad_options, loose_edges=int(loose_edges), imprint=int(imprint and not solids),
                         imprint_tolerance=imprint_tolerance, unit=unit.encode(), scale=scale, min_feature=min_feature)
        self._listening(progress, lambda hears: self._read(source, format, options, hears))
        if solids and len(solids) == self.content.solids:
            self.name_solids([each.name for each in solids], [each.rgb for each in solids])
        elif solids:
            log.warning("%d solids have names, and the shape has %d: no name is given", len(solids), self.content.solids)
        if imprint and solids:
            self.imprint(imprint_tolerance, progress)

    def _listening(self, progress: Progress, call: Callable[[Any], int]) -> None:
        """Runs call(callback of the C interface)."""
        hears = listener(progress)
        host = _Reading(self._handle)

        def on_progress(share: float, _: Any) -> int:
            return int(host.stopped or bool(hears and hears(share, "reading", 0)))

        callback = c.carreau_cad_progress_fn(host.guarded(lambda *_: {}, on_progress))
        require_cad(self._handle, run(host, lambda: int(call(callback))))

    def _read(self, source: Any, format: str, options: Any, hears: Any) -> int:
        options.progress = hears
        if isinstance(source, (str, os.PathLike)):
            return int(cad_lib().cad_read(self._handle, file_name(source), byref(options)))
        content = bytes(source if isinstance(source, (bytes, bytearray, memoryview)) else
                        brep_of(source) if is_shape(source) else source.read())
        return int(cad_lib().cad_read_bytes(self._handle, content, len(content), format.encode(), byref(options)))

    def imprint(self, tolerance: float = 0, progress: Progress = None) -> None:
        """Makes parts that touch share faces and edges. Numbers of faces change. A fuse that fails is in losses."""
        self._listening(progress, lambda hears: int(cad_lib().cad_imprint(self._handle, tolerance, hears, None)))

    def mirror(self, point: Sequence[float], normal: Sequence[float]) -> None:
        """Cuts faces across the plane, or adds the other half of a body on one side of it. Numbers of faces change."""
        planes = [np.array(each, np.float64) for each in (point, normal)]
        if any(each.shape != (3,) for each in planes):
            raise ArgumentError("a point and a normal of three numbers are required")
        self._call(cad_lib().cad_mirror, *planes)

    def name_solids(self, names: Sequence[str], colours: Sequence[int] = ()) -> None:
        """Names all solids; colours: of each, 0xRRGGBB, -1: none; empty: none has one."""
        texts = (c_char_p * len(names))(*[each.encode() for each in names])
        rgb = np.array(colours if len(colours) else [-1] * len(names), np.int32)
        if len(rgb) != len(names):
            raise ArgumentError(f"{len(names)} names and {len(rgb)} colours")
        self._call(cad_lib().cad_name_solids, len(names), texts, rgb)

    def _call(self, function: Callable[..., int], *arguments: Any) -> None:
        require_cad(self._handle, function(self._handle, *arguments))

    def add_to(self, session: SessionBase) -> None:
        """Adds all faces to a session, which keeps the data that it needs."""
        require(session._handle, cad_lib().cad_add(self._handle, session._handle))

    def set_face_size(self, face: object, size: float) -> None:
        """Prescribes a size on the face of this number, or on all faces of this name, when hphy_flag = 2."""
        self._call(cad_lib().cad_set_face_size, str(face).encode(), float(size))

    def set_size(self, dimension: int, number: int, size: float) -> None:
        """Prescribes a size on a vertex (dimension 0), an edge (1), a face (2) or all faces of a solid (3), by
        number."""
        self._call(cad_lib().cad_set_size, dimension, number, float(size))

    @property
    def content(self) -> CadContent:
        """Numbers of faces and edges, the diagonal, tolerances of gluing."""
        return asked(c.carreau_cad_content, lambda out: self._call(cad_lib().cad_info, out))  # type: ignore[no-any-return]

    @property
    def small_features(self) -> list[CadSmallFeature]:
        """The features that min_feature found, and whether each is removed."""
        return [asked(c.carreau_cad_small_feature, lambda out, k=k: self._call(cad_lib().cad_small_feature_at, k, out))  # type: ignore[misc]
                for k in range(self.content.small_features)]

    @property
    def faces(self) -> list[CadFace]:
        """Numbers, names and colours of the faces, and why one cannot be meshed."""
        return [asked(c.carreau_cad_face, lambda out, k=k: self._call(cad_lib().cad_file_face, k, out))  # type: ignore[misc]
                for k in range(1, self.content.faces + 1)]

    def entity_name(self, dimension: int, number: int) -> str:
        """The name of a vertex (dimension 0), an edge (1), a face (2) or a solid (3); "": none."""
        return str(text_of(cad_lib().cad_entity_name(self._handle, dimension, number)))

    @property
    def tree(self) -> list[CadTreeRow]:
        """Assemblies, parts, solids, and entities with a name, a colour or a layer of their own."""
        return [asked(c.carreau_cad_tree_row, lambda out, k=k: self._call(cad_lib().cad_tree_at, k, out))  # type: ignore[misc]
                for k in range(self.content.tree_rows)]

    @property
    def contacts(self) -> list[CadContact]:
        """Solids whose faces lie on each other, and the common area."""
        count = c_int64()
        self._call(cad_lib().cad_count_contacts, byref(count))
        return [asked(c.carreau_cad_contact, lambda out, k=k: self._call(cad_lib().cad_contact_at, k, out))  # type: ignore[misc]
                for k in range(count.value)]

    def figures(self, face: int) -> CadFigures:
        """Kind, area, perimeter and box of a face."""
        return asked(c.carreau_cad_figures, lambda out: self._call(cad_lib().cad_measure_face, face, out))  # type: ignore[no-any-return]

    @property
    def losses(self) -> list[str]:
        """The parts of the file that could not be read."""
        return [text_of(cad_lib().cad_loss(self._handle, k)) for k in range(self.content.losses)]

    def inspect(self, tiny: float = 0) -> tuple[CadReport, list[CadDanger]]:
        """Potential meshing problems; edges shorter than `tiny` times the diagonal count (0: 1e-3)."""
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
    """Stops the reading by its progress, since there is no session to be stopped."""

    stopped = False

    def stop(self) -> None:
        self.stopped = True


def read(source: Any, progress: Progress = None, **options: Any) -> CadFile:
    """Reads a file, bytes or a shape; see CadFile."""
    return CadFile(source, progress, **options)
