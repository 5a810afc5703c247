# SPDX-License-Identifier: BSD-3-Clause
"""From words to parameters of a session, with the choices of the command `carreau mesh`."""
from __future__ import annotations

import difflib
import os
from dataclasses import dataclass, field
from typing import Any, Callable, Mapping, Optional, Union

from ._calls import Path
from .errors import ArgumentError
from .formulas import size_function
from .session import Session, parameters
from .sources import PardomSource, SessionSource, Source

#: A model length, or a share of the diagonal of the geometry: "1%".
Length = Union[float, str]
#: Choices of the command where the library leaves things alone; cad_adapters/command/mesh/mesh_parameters.cpp has the reasons.
CHOICES: dict[str, Union[int, float, str]] = {
    "CheckCloseEdges": 20, "CoefRectangle": 0.06, "CheckAdjacentEdges": 20, "edge_gradation": 1.5, "stagger_strips": 1,
    "effort": 1, "narrow_faces": "collapse", "flag": 1, "failing_faces": "leave_out"}
NARROW_RATIO = 4e-4  # faces narrower than this share of the size collapse
USUAL_GRADATION = 1.3  # of sizes by direction
# Parameters that prescribe sizes.
PRESCRIBING = ("hphydef", "hphy_flag", "hgeo_flag", "angle_mesh", "eps_chord", "background_mesh")


@dataclass
class Sizes:
    """The requested options, as in mesh()."""

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
        raise ArgumentError(f"{name} {given!r} is not a length: a number above 0, or a share of the model's diagonal such as '1%'")
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
    # The bounds of the library are for sizes that a formula gives, not for typed sizes.
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


def _set_usual(session: Session, h: dict[str, float], diagonal: float) -> None:
    """Sizes of a CAD file when none is given, as the command chooses them."""
    session["hphy_flag"] = 0
    session["hgeo_flag"] = 1
    session["angle_mesh"] = 15.0
    session["hgeomin"] = h.get("min", min(diagonal / 2000, h.get("max", diagonal)))
    session["hgeomax"] = h.get("max", max(diagonal * 0.05, h.get("min", 0.0)))
    session["gradation"] = USUAL_GRADATION


def _set_sizes(session: Session, sizes: Sizes, source: Source, diagonal: float, env: bool, named: Mapping[str, Any]) -> None:
    h = {name: length(value, name, diagonal) for name in ("size", "min", "max", "chord") if (value := getattr(sizes, name)) is not None}
    if "min" in h and "max" in h and h["min"] > h["max"]:
        raise ArgumentError(f"min {sizes.min} is above max {sizes.max}")
    for name in ("min", "max"):
        if name in h:
            session["hphy" + name] = session["hgeo" + name] = h[name]
    by_curvature = bool(sizes.angle) or "chord" in h
    wanted = "size" in h or sizes.face_size or sizes.size_map is not None or sizes.adapts or source.has_sizes(session)
    usual = source.follows_curvature and not (wanted or env or by_curvature) and not any(name in named for name in PRESCRIBING)
    if usual:
        _set_usual(session, h, diagonal)
    elif wanted or not (env or by_curvature):
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
    # If sizes jump from face to face, stretched triangles leave half of all lengths out of range.
    if session["gradation"] == 0:
        session["gradation"] = USUAL_GRADATION


def _set_choices(session: Session, source: Source, diagonal: float, env: Optional[Path], asked: Mapping[str, Any]) -> None:
    usual_ratio = session["narrow_ratio"]
    # The program blsurf and this function make one mesh of one blsurf.env.
    as_blsurf = env is not None and isinstance(source, PardomSource)
    for name, value in CHOICES.items():
        if not as_blsurf or name in ("flag", "failing_faces"):
            session[name] = value
    if not as_blsurf:
        session["narrow_ratio"] = NARROW_RATIO
    if source.glue[0] > 0:
        session["glue_open"], session["eps_glue"], session["eps_glue_open"] = 1, *source.glue
    if source.match > 0:
        session["eps_match"] = source.match
    if source.short_ends:
        session["eps_ends"] = 1e-9 * diagonal
    if env is not None:
        session.read_env(env)
    # A request for narrow faces uses the library's own ratio, unless another ratio is given.
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


def _set_effort(session: Session, level: int) -> None:
    """Synonyms that an env file has set return to the values of the level."""
    for name, parameter in parameters().items():
        if parameter.set_by:
            session.reset(name)
    session["effort"] = level


def _set_named(session: Session, named: Mapping[str, Any], diagonal: float) -> None:
    """Parameters of the session by their names; lengths may be "1%"."""
    known = parameters()
    for name, value in named.items():
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise ArgumentError(f"there is no option or parameter '{name}'" + (f": did you mean '{near[0]}'?" if near else ""))
        share = isinstance(value, str) and value.endswith("%")
        session[name] = length(value, name, diagonal) if share else value


def prepare(session: Session, source: Source, sizes: Sizes, *, element: Optional[str], independent: bool,
            sharp_angle: Optional[float], effort: Optional[int], threads: int, env: Optional[Path], named: Mapping[str, Any]) -> None:
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
    if effort is not None:
        _set_effort(session, effort)
    if not own or sizes.any:
        _set_sizes(session, sizes, source, diagonal, env is not None, named)
    if element is not None:
        session["element"] = element
    _set_named(session, named, diagonal)
    _set_map(session, sizes, of_faces)


def map_of(size_map: Any, metric: Any) -> Any:
    if size_map is not None and metric is not None:
        raise ArgumentError("size_map and metric are given: only one of them can hold")
    return metric if metric is not None else size_map
