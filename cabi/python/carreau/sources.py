# SPDX-License-Identifier: BSD-3-Clause
"""The sources of carreau.mesh: files, arrays, formulas, patches, sessions."""
from __future__ import annotations

import fnmatch
import math
import os
import re
from typing import Any, Iterable, Iterator, Optional, Union

import numpy as np

from ._run import callback_error
from .atlas import Atlas
from .cad import CadFile
from .cad_m import CadM
from .errors import ArgumentError, SequenceError
from .formulas import is_formula, patch_of
from .meshes import Mesh
from .planes import PlaneDomain
from .progress import Progress
from .session import Session
from .shapes import is_shape
from .surfaces import Patch

SHARES = np.arange(33) / 32  # of each curve: a circle's box is then known within 0.5 %
CAD = (".step", ".stp", ".iges", ".igs", ".brep", ".brp")
MOLECULES = (".xyzr", ".xyz", ".pdb", ".ent", ".cif", ".mmcif")
GRIDS = (".fmt", ".p3d", ".x", ".grd", ".asc", ".dem", ".txt", ".cyl", ".ijk")
TRIANGLES = (".stl", ".off", ".obj", ".ply", ".mesh", ".meshb", ".vtu", ".vtk", ".msh", ".msh2", ".inp", ".bdf", ".unv", ".su2", ".tri")
PLANE = (".poly", ".node", ".dat", ".bl2d", ".data", ".g")
MOLECULE_OPTIONS = ("surface", "probe", "drop_cavities", "radii")
GRID_OPTIONS = ("format", "smooth", "lengths", "join_angle", "tolerance", "step", "fill", "continuity", "by_distance")
TRIANGLES_OPTIONS = ("sharp", "corner", "given_edges", "ignore_references")
CAD_OPTIONS = ("imprint", "imprint_tolerance", "unit", "scale", "min_feature", "loose_edges")
PLANE_OPTIONS = ("corner_angle", "sizes")


class Source:
    """Geometry for a session, and its known properties."""

    options: tuple[str, ...] = ()  # names of its own options
    glue = (0.0, 0.0)              # tolerances within which curves of one face are one: eps_glue, eps_glue_open
    match = 0.0                    # how far uses of one curve may be apart: eps_match
    short_ends = False             # short curves are exact, and no mistake of a file
    answers_face_sizes = False
    follows_curvature = False      # where no size is given

    def __init__(self, **options: Any) -> None:
        self.given = options

    def add_to(self, session: Session) -> None:
        """Adds the geometry to an empty session."""
        raise NotImplementedError

    def diagonal(self, session: Session) -> float:
        """The diagonal of the box of all curves, once the session has them."""
        return box_diagonal(curve_points(session))

    def has_sizes(self, session: Session) -> bool:
        """True if it has its own sizes."""
        return False

    def face_sizes(self, session: Session, wanted: dict[Any, float]) -> dict[int, float]:
        """Sizes by reference, of faces that the geometry does not answer itself. Raises ArgumentError for no face."""
        known = set(session.faces.tolist())
        for face in wanted:
            if not str(face).isdigit() or int(face) not in known:
                raise ArgumentError(f"face_size: there is no face '{face}'")
        return {int(face): size for face, size in wanted.items()}


def box_diagonal(points: np.ndarray) -> float:  # type: ignore[type-arg]
    """Rounded as std::hypot of the command: sizes that are shares of it are the same to the last bit."""
    spread = (points.max(axis=0) - points.min(axis=0)).tolist()
    largest = max(spread)
    if not largest > 0:
        raise ArgumentError("the curves of the geometry have no extent in space")
    x, y, z = (each / largest for each in spread)
    return float(largest * math.sqrt(x * x + y * y + z * z))


def places_of_curves(session: Session) -> Iterator[tuple[int, int]]:
    """Reference of the face, and rank in it, of all curves."""
    before, ic = None, 0
    for face in session.curves[0].tolist():
        ic = ic + 1 if face == before else 1
        before = face
        yield face, ic


def curve_points(session: Session) -> np.ndarray:  # type: ignore[type-arg]
    """Samples of all curves in space."""
    return np.concatenate([session.points(face, session.curve_points(face, ic, SHARES)) for face, ic in places_of_curves(session)])


class PatchSource(Source):
    def __init__(self, patches: list[Patch]) -> None:
        super().__init__()
        self.patches = patches

    def add_to(self, session: Session) -> None:
        session.add(self.patches)

    def diagonal(self, session: Session) -> float:
        samples = []
        for face, each in enumerate(self.patches, 1):
            try:
                samples.append(self._samples(face, each))
            except Exception as error:
                raise callback_error(error, {"face": face}) from error
        return box_diagonal(np.concatenate(samples))

    @staticmethod
    def _samples(face: int, each: Patch) -> np.ndarray:  # type: ignore[type-arg]
        uv = [curve.at(curve.a + share * (curve.b - curve.a) if share < 1 else curve.b, 0, face, ic)
              for ic, curve in enumerate(each.curves, 1) for share in SHARES]
        return each.surface(uv, face)


class CadSource(Source):
    answers_face_sizes = True
    follows_curvature = True

    def __init__(self, source: Any, progress: Progress, options: dict[str, Any]) -> None:
        super().__init__()
        own = {name: options.pop(name) for name in CAD_OPTIONS if name in options}
        self.file = source if isinstance(source, CadFile) else CadFile(source, progress, **own)
        self.content = self.file.content
        self.glue = (self.content.glue_tolerance, self.content.open_tolerance)
        self.match = self.content.match_tolerance

    def add_to(self, session: Session) -> None:
        self.file.add_to(session)

    def diagonal(self, session: Session) -> float:
        return self.content.diagonal

    def face_sizes(self, session: Session, wanted: dict[Any, float]) -> dict[int, float]:
        for face, size in wanted.items():
            self._set(str(face), size)
        return {}

    def _set(self, face: str, size: float) -> None:
        """A name may hold a star: itself first."""
        try:
            self.file.set_face_size(face, size)
        except ArgumentError:
            fitting = [each.number for each in self.file.faces if fnmatch.fnmatchcase(each.name, face.replace("[", "[[]"))]
            if not fitting or not set("*?") & set(face):
                raise
            for number in fitting:
                self.file.set_face_size(number, size)


class Loaded(Source):
    """The source of a function of Session that takes a path, or arrays, and options."""

    def __init__(self, load: str, *arguments: Any, short_ends: bool = False, **options: Any) -> None:
        super().__init__(**options)
        self.load, self.arguments, self.short_ends = load, arguments, short_ends

    def add_to(self, session: Session) -> None:
        getattr(session, self.load)(*self.arguments, **self.given)

    def diagonal(self, session: Session) -> float:
        return session.triangles.diagonal if self.load.endswith("_triangles") else super().diagonal(session)

    def has_sizes(self, session: Session) -> bool:
        return self.load.endswith("_plane") and session.plane_has_sizes()


class PardomSource(Source):
    def __init__(self, path: str, host: Any) -> None:
        super().__init__()
        self.path, self.host = path, CadM(host)

    def add_to(self, session: Session) -> None:
        self.host.give_to(session)
        session.read_pardom(self.path)

    def diagonal(self, session: Session) -> float:
        return box_diagonal(np.concatenate([self.host.curve_points(face, ic, SHARES) for face, ic in places_of_curves(session)]))


class SessionSource(Source):
    def add_to(self, session: Session) -> None:
        pass

    def diagonal(self, session: Session) -> float:
        try:
            return session.triangles.diagonal
        except SequenceError:
            return super().diagonal(session)


def _begins_as_grid(path: str) -> bool:
    """Files .xyz are molecules, or grids of PLOT3D: binary, or with counts of nodes at first."""
    with open(path, "rb") as file:
        begin = file.read(256)
    if b"\0" in begin:
        return True
    lines = begin.decode("utf-8", "replace").split("\n") + ["", ""]
    counts = [len(line.split()) if re.fullmatch(r"[\d\s]+", line) else 0 for line in lines[:2]]
    if counts[0] != 1:
        return counts[0] > 1
    return counts[1] > 1 and not lines[2].strip()[:1].isalpha()


def _of_path(path: str, progress: Progress, options: dict[str, Any]) -> Source:
    suffix = os.path.splitext(path)[1].lower()

    def own(names: Iterable[str]) -> dict[str, Any]:
        return {name: options.pop(name) for name in names if name in options}

    if options.get("surface") == "atlas":
        options.pop("surface")
        mesh = Mesh.read(path)
        return Loaded("add_atlas", Atlas(mesh.vertices, mesh.triangles), short_ends=True)
    if suffix == ".pardom":
        if "host" not in options:
            raise ArgumentError(f"'{path}' has no geometry: host names the shared library that has")
        return PardomSource(path, options.pop("host"))
    if suffix in GRIDS or "format" in options or (suffix == ".xyz" and _begins_as_grid(path)):
        return Loaded("load_grid", path, short_ends=True, **({"format": "plot3d"} if suffix == ".xyz" else {}), **own(GRID_OPTIONS))
    if suffix in MOLECULES:
        return Loaded("load_molecule", path, short_ends=True, **own(MOLECULE_OPTIONS))
    if suffix in PLANE:
        return Loaded("load_plane", path, **own(PLANE_OPTIONS))
    if suffix in TRIANGLES:
        return Loaded("load_triangles", path, **own(TRIANGLES_OPTIONS))
    return Loaded("load_bezier", path) if suffix == ".bpt" else CadSource(path, progress, options)


def source_of(given: Any, progress: Progress, options: dict[str, Any]) -> Source:
    """The geometry of whatever was given; takes its own options out of `options`."""
    domain: Optional[Any] = options.pop("domain", None)
    if isinstance(given, (str, os.PathLike)):
        path = os.fspath(given)
        if is_formula(str(path)) and not os.path.exists(path):
            return PatchSource([patch_of(str(path), domain)])
        if domain is not None:
            raise ArgumentError(f"domain goes with formulas and functions, not with '{path}'")
        return _of_path(str(path), progress, options)
    if callable(given) and not isinstance(given, (Patch, Session)):
        return PatchSource([Patch(given, (0, 0, 1, 1) if domain is None else domain)])
    if domain is not None:
        raise ArgumentError("domain goes with formulas and functions")
    return _of_object(given, progress, options)


def _is_cad(given: Any) -> bool:
    """A file that was read, the bytes of a file, an open file, or a shape of another program."""
    return isinstance(given, (CadFile, bytes, bytearray, memoryview)) or is_shape(given) or hasattr(given, "read")


def _of_object(given: Any, progress: Progress, options: dict[str, Any]) -> Source:
    if isinstance(given, Session):
        return SessionSource()
    if isinstance(given, Patch):
        return PatchSource([given])
    if isinstance(given, Atlas):
        return Loaded("add_atlas", given, short_ends=True)
    if isinstance(given, PlaneDomain):
        return Loaded("add_plane", given)
    if not isinstance(given, Mesh) and _is_cad(given):
        return CadSource(given, progress, options)
    own = {name: options.pop(name) for name in TRIANGLES_OPTIONS if name in options}
    if isinstance(given, Mesh):
        return Loaded("add_triangles", given.vertices, given.triangles, **own)
    items: Union[list[Any], tuple[Any, ...]] = given if isinstance(given, (list, tuple)) else list(given)
    if items and all(isinstance(each, Patch) for each in items):
        return PatchSource(list(items))
    if len(items) == 2:
        return Loaded("add_triangles", *items, **own)
    raise ArgumentError("a source is a path, a formula, a function, patches, a Session, a Mesh, a shape or the bytes of a CAD file, or a pair of arrays (vertices, triangles)")
