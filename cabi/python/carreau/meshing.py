"""carreau.mesh and carreau.adapt: from geometry and a few words to a mesh, with the choices of the command `carreau mesh`."""
from __future__ import annotations

import difflib
import logging
import os
from dataclasses import dataclass, field
from dataclasses import fields as dataclass_fields
from typing import Any, Callable, Mapping, Optional, Union

from ._calls import Path
from .errors import ArgumentError
from .formulas import size_function
from .meshes import Mesh
from .planes import PlaneDomain, polygons
from .progress import Progress
from .session import Session, parameters
from .sources import Loaded, SessionSource, Source, source_of

log = logging.getLogger("carreau")
#: A model length, or a share of the diagonal of the geometry: "1%".
Length = Union[float, str]
#: What the command chooses where the library leaves things alone; cad_adapters/command/mesh_parameters.cpp has the reasons.
CHOICES: dict[str, Union[int, float, str]] = {
    "CheckCloseEdges": 20, "CoefRectangle": 0.06, "CheckAdjacentEdges": 20, "edge_gradation": 1.5, "stagger_strips": 1,
    "shape_trials": 1, "crossing_rounds": 10, "narrow_faces": "collapse", "flag": 1, "failing_faces": "leave_out"}
NARROW_RATIO = 4e-4  # faces narrower than this share of the size collapse
USUAL_GRADATION = 1.3  # of sizes by direction


@dataclass
class Sizes:
    """What was asked for, as in mesh()."""

    size: Union[None, Length, Callable[..., Any]] = None
    min: Optional[Length] = None
    max: Optional[Length] = None
    angle: Optional[float] = None
    chord: Optional[Length] = None
    anisotropic: Union[bool, float] = False
    gradation: Optional[float] = None
    face_size: Mapping[Any, Length] = field(default_factory=dict)
    size_map: Any = None
    adapts: bool = False

    def __post_init__(self) -> None:
        if callable(self.size):
            self.size, self.size_map = None, _only(self.size_map, self.size)

    @property
    def any(self) -> bool:
        given = (self.size, self.min, self.max, self.angle, self.chord, self.gradation, self.size_map)
        return any(each is not None for each in given) or bool(self.face_size) or bool(self.anisotropic) or self.adapts


def _only(first: Any, second: Any) -> Any:
    if first is not None:
        raise ArgumentError("size is a function, and size_map or metric is given, too: only one of them can hold")
    return second


def length(given: Length, name: str, diagonal: float) -> float:
    """A model length, from a number or "1%" of the diagonal. Raises ArgumentError."""
    try:
        value = float(given[:-1]) / 100 * diagonal if isinstance(given, str) and given.endswith("%") else float(given)
    except (TypeError, ValueError):
        value = 0.0
    if not 0 < value < float("inf"):
        raise ArgumentError(f"{name} {given!r} is no length: a number above 0, or a share of the model's diagonal such as '1%'")
    return value


def _set_new(session: Session, name: str, value: float) -> None:
    """A length that is neither set nor known before the first mesh has no value yet."""
    if not session.is_set(name):
        session[name] = value


def _set_physical(session: Session, sizes: Sizes, h: dict[str, float], source: Source, diagonal: float) -> None:
    mapped = sizes.size_map is not None or source.has_sizes(session)
    by_face = (bool(sizes.face_size) and source.answers_face_sizes) or source.has_sizes(session)
    session["hphy_flag"] = 2 if by_face else 1
    if "size" in h or not session.is_set("hphydef"):
        session["hphydef"] = h.get("size", 0.02 * diagonal)
    size = float(session["hphydef"])
    # The bounds of the library are for sizes that a formula gives, not for what a person has typed.
    _set_new(session, "hphymin", min(size, diagonal) * 1e-6)
    # Beside a map, a size that was given is an upper bound.
    if mapped and "size" in h and h.get("max", size + 1) > size:
        session["hphymax"] = size
    else:
        _set_new(session, "hphymax", max(size, diagonal))


def _set_geometric(session: Session, sizes: Sizes, h: dict[str, float], diagonal: float) -> None:
    session["hgeo_flag"] = 1
    if sizes.angle:
        session["angle_mesh"] = sizes.angle
    if "chord" in h:
        session["eps_chord"] = h["chord"]
        session["geo_guarantee"] = 1  # a distance that was given is a bound, not an aim
        session["geo_rule"] = "both" if sizes.angle else "chord"
    _set_new(session, "hgeomin", diagonal / 500)
    _set_new(session, "hgeomax", diagonal / 5)


def _set_sizes(session: Session, sizes: Sizes, source: Source, diagonal: float, env: bool) -> None:
    h = {name: length(value, name, diagonal) for name in ("size", "min", "max", "chord") if (value := getattr(sizes, name)) is not None}
    if "min" in h and "max" in h and h["min"] > h["max"]:
        raise ArgumentError(f"min {sizes.min} is above max {sizes.max}")
    for name in ("min", "max"):
        if name in h:
            session["hphy" + name] = session["hgeo" + name] = h[name]
    by_curvature = bool(sizes.angle) or "chord" in h
    if "size" in h or sizes.face_size or sizes.size_map is not None or source.has_sizes(session) or sizes.adapts or not (env or by_curvature):
        _set_physical(session, sizes, h, source, diagonal)
    elif not env:
        session["hphy_flag"] = 0  # the curvature alone governs
    if by_curvature:
        _set_geometric(session, sizes, h, diagonal)
    if sizes.anisotropic:
        _set_anisotropic(session, 1000.0 if sizes.anisotropic is True else float(sizes.anisotropic))
    if sizes.gradation is not None:
        session["gradation"] = sizes.gradation


def _set_anisotropic(session: Session, ratio: float) -> None:
    if session["hgeo_flag"] == 0:
        raise ArgumentError("anisotropic stretches sizes that follow the curvature: it goes with angle or chord")
    session["geo_metric"] = 1
    session["anisotropy_max"] = ratio
    # Where sizes jump from face to face, stretched triangles leave half of all lengths out of range.
    if session["gradation"] == 0:
        session["gradation"] = USUAL_GRADATION


def _set_choices(session: Session, source: Source, diagonal: float, env: Optional[Path], asked: Mapping[str, Any]) -> None:
    usual_ratio = session["narrow_ratio"]
    for name, value in CHOICES.items():
        session[name] = value
    session["narrow_ratio"] = NARROW_RATIO
    if source.glue[0] > 0:
        session["glue_open"], session["eps_glue"], session["eps_glue_open"] = 1, *source.glue
    if source.short_ends:
        session["eps_ends"] = 1e-9 * diagonal
    if env is not None:
        session.read_env(env)
    # Who asks for narrow faces means those of the library's own ratio, unless he gives another.
    if ("narrow_faces" in asked or session["narrow_faces"] != "collapse") and session["narrow_ratio"] == NARROW_RATIO:
        session["narrow_ratio"] = usual_ratio


def _set_map(session: Session, sizes: Sizes, of_faces: dict[int, float]) -> None:
    given = sizes.size_map
    if isinstance(given, tuple):  # files
        session.load_background(*given)
        given = None
    elif isinstance(given, str):
        given = size_function(given)
    if given is None and not of_faces:
        return
    if given is not None or of_faces:
        session["hmean_flag"] = -1  # a curve has the smallest size of the faces beside it
    session.set_sizes(given, face_sizes=of_faces)


def _set_named(session: Session, named: Mapping[str, Any], diagonal: float) -> None:
    """Parameters of the session by their names; "1%" of those that are lengths."""
    known = parameters()
    for name, value in named.items():
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise ArgumentError(f"there is no option or parameter '{name}'" + (f": did you mean '{near[0]}'?" if near else ""))
        share = isinstance(value, str) and value.endswith("%")
        session[name] = length(value, name, diagonal) if share else value


def prepare(session: Session, source: Source, sizes: Sizes, *, element: Optional[str], independent: bool,
            sharp_angle: Optional[float], threads: int, env: Optional[Path], named: Mapping[str, Any]) -> None:
    """Gives a session the geometry and all parameters, in the order of the command: its own choices, the env file, words,
    parameters by name."""
    source.add_to(session)
    own = isinstance(source, SessionSource)
    if own and not sizes.any:
        diagonal = 1.0 if not any(isinstance(each, str) and each.endswith("%") for each in named.values()) else source.diagonal(session)
    else:
        diagonal = source.diagonal(session)
    wanted = {face: length(each, "face_size", diagonal) for face, each in sizes.face_size.items()}
    of_faces = source.face_sizes(session, wanted)
    if threads or not own:
        session["threads"] = threads or os.cpu_count() or 1
    if not own:
        _set_choices(session, source, diagonal, env, named)
    if independent:
        session["patches"] = "independent"
    if sharp_angle is not None:
        session["sharp_angle"] = sharp_angle
    if not own or sizes.any:
        _set_sizes(session, sizes, source, diagonal, env is not None)
    if element is not None:
        session["element"] = element
    _set_named(session, named, diagonal)
    _set_map(session, sizes, of_faces)


def mesh(source: Any, *, size: Union[None, Length, Callable[..., Any]] = None, min: Optional[Length] = None,
         max: Optional[Length] = None, angle: Optional[float] = None, chord: Optional[Length] = None,
         anisotropic: Union[bool, float] = False, gradation: Optional[float] = None, face_size: Optional[Mapping[Any, Length]] = None,
         size_map: Any = None, metric: Optional[Callable[..., Any]] = None, element: Optional[str] = None,
         independent: bool = False, sharp_angle: Optional[float] = None, threads: int = 0, env: Optional[Path] = None,
         progress: Progress = None, **named: Any) -> Mesh:
    """Meshes a geometry.

    source       a path: STEP, IGES, BREP, .bpt, molecules, grids, triangles, plane files; a formula "z = x * y"; a function
                 of (u, v), with domain; a Patch or several; a Mesh, Atlas, CadFile or PlaneDomain; a pair of arrays,
                 vertices (n, 3) and triangles (m, 3); a Session, whose parameters stay but for those that are given
    size         model length, or "1%" of the diagonal; or a function of the place: names what it takes of x, y, z (n
                 each), xyz (n, 3), u, v, uv, face, and gives n sizes. Nothing given: 2 % of the diagonal
    min, max     bounds of sizes
    angle        largest angle between edges and the surface, degrees: sizes follow the curvature
    chord        largest distance from the surface
    anisotropic  sizes that follow the curvature differ by direction; a number: their largest ratio
    gradation    largest ratio of sizes one edge apart; 0: any
    face_size    {number or name of a face: length}; names may hold * and ?
    size_map     sizes by a formula in x, y, z, u, v; or a pair of files (.mesh, .sol); or a function, as size
    metric       a function of the place, as size, that gives (n, 6) metrics xx xy xz yy yz zz
    element      "p1", "p2", "q1.0", "q1.1", "q2.0", "q2.1"
    independent  triangles cross borders between faces that meet smoothly, at less than sharp_angle (degrees)
    threads      0: all; the mesh does not depend on it
    env          a file blsurf.env with parameters
    progress     True: a bar; or a function of (fraction, phase, entity)
    named        options of the source: domain ("box:u0,v0,u1,v1", "disc:u,v,r", "ring:u,v,r0,r1"; curves), surface ("vws",
                 "sas", "ses", "atlas"), probe, host (the library of a .pardom), smooth, sharp, ..., and parameters of the session (hphydef=0.1, ...)

    Faces that cannot be meshed are left out: mesh.failed tells them. Raises CarreauError, with face, curve and (u, v);
    CallbackError from what a callback has raised; KeyboardInterrupt, at once.
    """
    session, geometry = _begin(source, progress, named)
    words = {"size": size, "min": min, "max": max, "angle": angle, "chord": chord, "anisotropic": anisotropic, "gradation": gradation,
             "face_size": face_size or {}, "size_map": _map_of(size_map, metric), "element": element, "independent": independent,
             "sharp_angle": sharp_angle, "threads": threads, "env": env, "progress": progress}
    return _generated(session, geometry, {**words, **named})


def _generated(session: Session, geometry: Source, words: Mapping[str, Any]) -> Mesh:
    """By the words of mesh()."""
    rest = dict(words)
    progress = rest.pop("progress", None)
    if "metric" in rest:
        rest["size_map"] = _map_of(rest.get("size_map"), rest.pop("metric"))
    chosen = Sizes(**{each.name: rest.pop(each.name) for each in dataclass_fields(Sizes) if each.name in rest})
    usual = {"element": None, "independent": False, "sharp_angle": None, "threads": 0, "env": None}
    others: dict[str, Any] = {name: rest.pop(name, value) for name, value in usual.items()}
    prepare(session, geometry, chosen, named=rest, **others)
    made = session.generate(progress)
    for face in made.failed:
        log.warning("face %d has no mesh: %s", face.ref, face.why)
    return made


def adapt(source: Any, values: Callable[..., Any], tolerance: float = 0.01, *, size: Optional[Length] = None,
          min: Optional[Length] = None, max: Optional[Length] = None, gradation: Optional[float] = None,
          shape: str = "isotropic", iterations: int = 5, threads: int = 0, progress: Progress = None, **named: Any) -> Mesh:
    """Meshes a geometry so that a field is interpolated within a tolerance.

    source       as for mesh()
    values       the field: a function that names what it takes of x, y, z (n each) or xyz (n, 3), and gives n values
    tolerance    largest error, in units of the field; with relative=True a share of its value
    size         of the mesh to begin with: "5%" or a model length; min, max: bounds of sizes
    shape        "isotropic", "anisotropic", or "graph" in the plane
    iterations   meshes made at most
    named        estimator ("hessian", "curvature", "deformation"), recovery, relative, ratio, floor, convergence,
                 differences, which Session.adapt has, and those of mesh()

    mesh.session.adaptation reports errors before and after. Raises as mesh().
    """
    ours = ("relative", "recovery", "ratio", "floor", "convergence", "differences", "estimator")
    loop = {name: named.pop(name) for name in ours if name in named}
    if "estimator" in loop:
        loop["source"] = loop.pop("estimator")
    session, geometry = _begin(source, progress, named)
    chosen = Sizes(size=size, min=min, max=max, gradation=gradation, adapts=True)
    prepare(session, geometry, chosen, element=None, independent=False, sharp_angle=None, threads=threads, env=None, named=named)
    diagonal = geometry.diagonal(session)
    bounds: dict[str, Any] = {"hmin": length(min or "0.2%", "min", diagonal), "hmax": length(max or "20%", "max", diagonal)}
    made: Mesh = session.adapt(values, tolerance, shape=shape, iterations=iterations, progress=progress, **bounds, **loop)
    return made


def plane(source: Any, *, sizes: Optional[Path] = None, corner_angle: float = 0, **words: Any) -> Mesh:
    """Meshes a domain of the plane.

    source         a file .poly, .mesh, .meshb, .bl2d, .data or .g; a PlaneDomain; or closed polygons, (n, 2) each, of which
                   those inside others bound holes
    sizes          a file .sol, .hg or .h with a size or metric for each vertex of a file
    corner_angle   above 0, degrees: polygons of a file become splines that end where they turn by more
    words          those of mesh()
    """
    if isinstance(source, (str, os.PathLike)):
        session = Session()
        geometry: Source = Loaded("load_plane", source, sizes=sizes, corner_angle=corner_angle)
        return _generated(session, geometry, words)
    return mesh(source if isinstance(source, PlaneDomain) else polygons(*source), **words)


def fields(source: Any, path: Path, *, longest: int = 0, channels: Any = (), face: int = 0, multi_part: bool = False,
           **words: Any) -> Mesh:
    """Meshes a geometry, and writes what governed the mesh of each face as images .exr or .png (docs/fields.md); a Mesh of
    a session is taken as it is. longest: pixels of the longer side; channels: their groups, none: all; words: those of
    mesh()."""
    made = source if isinstance(source, Mesh) and source.session is not None else mesh(source, **words)
    assert made.session is not None
    made.session.write_fields(path, longest=longest, channels=channels, face=face, multi_part=multi_part)
    return made


def _begin(source: Any, progress: Progress, named: dict[str, Any]) -> tuple[Session, Source]:
    geometry = source_of(source, progress, named)
    return (source if isinstance(source, Session) else Session()), geometry


def _map_of(size_map: Any, metric: Any) -> Any:
    if size_map is not None and metric is not None:
        raise ArgumentError("size_map and metric are given: only one of them can hold")
    return metric if metric is not None else size_map
