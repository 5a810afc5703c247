# SPDX-License-Identifier: BSD-3-Clause
"""carreau.mesh and its like: from geometry and a few words to a mesh."""
from __future__ import annotations

import logging
import os
from dataclasses import fields as members
from typing import Any, Callable, Mapping, Optional, Union

from ._calls import Path
from .meshes import Mesh
from .planes import PlaneDomain, polygons
from .progress import Progress
from .session import Session
from .sources import Loaded, Source, source_of
from .words import Length, Sizes, length, map_of, prepare

log = logging.getLogger("carreau")


def mesh(source: Any, *, size: Union[None, Length, Callable[..., Any]] = None, min: Optional[Length] = None,
         max: Optional[Length] = None, angle: Optional[float] = None, chord: Optional[Length] = None,
         anisotropic: Union[bool, float] = False, gradation: Optional[float] = None, face_size: Optional[Mapping[Any, Length]] = None,
         size_map: Any = None, metric: Optional[Callable[..., Any]] = None, element: Optional[str] = None,
         independent: bool = False, sharp_angle: Optional[float] = None, effort: Optional[int] = None, threads: int = 0,
         env: Optional[Path] = None, progress: Progress = None, **named: Any) -> Mesh:
    """Meshes a geometry.

    source       a path: STEP, IGES, BREP, .bpt, molecules, grids, triangles, plane files; a formula "z = x * y"; a function
                 of (u, v), with domain; a Patch or several; a Mesh, Atlas, CadFile or PlaneDomain; a pair of arrays,
                 vertices (n, 3) and triangles (m, 3); a Session, whose parameters stay unless they are given; the bytes
                 of a STEP, IGES or BREP file, or an open one; a shape of build123d, CadQuery, pythonocc or FreeCAD
    size         model length, or "1%" of the diagonal; or a function of the place: its parameters name values among x,
                 y, z (n each), xyz (n, 3), u, v, uv, face, and it gives n sizes. Nothing given: 2 % of the diagonal
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
    effort       work beyond the first mesh: 0 none, 1 at most as much as the first mesh, 2 at most twice as much
    threads      0: all; the mesh does not depend on it
    env          a file blsurf.env with parameters
    progress     True: a bar; or a function of (fraction, phase, entity)
    named        options of the source: domain ("box:u0,v0,u1,v1", "disc:u,v,r", "ring:u,v,r0,r1"; curves), surface ("vws",
                 "sas", "ses", "atlas"), probe, host (the library of a .pardom), imprint, unit and scale (of CAD), smooth,
                 sharp, ..., and parameters of the session (hphydef=0.1, ...)

    Faces that cannot be meshed are left out: mesh.failed lists them. Raises CarreauError, with face, curve and (u, v);
    CallbackError from the exception of a callback; KeyboardInterrupt, at once.
    """
    session, geometry = _begin(source, progress, named)
    words = {"size": size, "min": min, "max": max, "angle": angle, "chord": chord, "anisotropic": anisotropic, "gradation": gradation,
             "face_size": face_size or {}, "size_map": map_of(size_map, metric), "element": element, "independent": independent,
             "sharp_angle": sharp_angle, "effort": effort, "threads": threads, "env": env, "progress": progress}
    return _generated(session, geometry, {**words, **named})


def _generated(session: Session, geometry: Source, words: Mapping[str, Any]) -> Mesh:
    """Meshes by the arguments of mesh()."""
    _prepare(session, geometry, words)
    made = session.generate(words.get("progress"))
    for face in made.failed:
        log.warning("face %d has no mesh: %s", face.ref, face.why)
    return made


def _prepare(session: Session, geometry: Source, words: Mapping[str, Any]) -> None:
    """Geometry and parameters, by the words of mesh()."""
    rest = dict(words)
    rest.pop("progress", None)
    if "metric" in rest:
        rest["size_map"] = map_of(rest.get("size_map"), rest.pop("metric"))
    chosen = Sizes(**{each.name: rest.pop(each.name) for each in members(Sizes) if each.name in rest})
    usual = {"element": None, "independent": False, "sharp_angle": None, "effort": None, "threads": 0, "env": None}
    others: dict[str, Any] = {name: rest.pop(name, value) for name, value in usual.items()}
    prepare(session, geometry, chosen, named=rest, **others)


def adapt(source: Any, values: Callable[..., Any], tolerance: float = 0.01, *, size: Optional[Length] = None,
          min: Optional[Length] = None, max: Optional[Length] = None, gradation: Optional[float] = None,
          shape: str = "isotropic", iterations: int = 5, threads: int = 0, progress: Progress = None, **named: Any) -> Mesh:
    """Meshes a geometry so that a field is interpolated within a tolerance.

    source       as for mesh()
    values       the field: a function whose parameters name values among x, y, z (n each) or xyz (n, 3); it gives n
                 values
    tolerance    largest error, in units of the field; with relative=True a share of its value
    size         of the mesh to begin with: "5%" or a model length; min, max: bounds of sizes
    shape        "isotropic", "anisotropic", or "graph" in the plane
    iterations   meshes made at most
    named        estimator ("hessian", "curvature", "deformation"), recovery, relative, ratio, floor, convergence,
                 differences, as in Session.adapt, and the arguments of mesh()

    mesh.session.adaptation reports errors before and after. Raises as mesh().
    """
    ours = ("relative", "recovery", "ratio", "floor", "convergence", "differences", "estimator")
    loop = {name: named.pop(name) for name in ours if name in named}
    if "estimator" in loop:
        loop["source"] = loop.pop("estimator")
    session, geometry = _begin(source, progress, named)
    _prepare(session, geometry, {"size": size, "min": min, "max": max, "gradation": gradation, "threads": threads, "adapts": True, **named})
    diagonal = geometry.diagonal(session)
    bounds: dict[str, Any] = {"hmin": length(min or "0.2%", "min", diagonal), "hmax": length(max or "20%", "max", diagonal)}
    made: Mesh = session.adapt(values, tolerance, shape=shape, iterations=iterations, progress=progress, **bounds, **loop)
    return made


def plane(source: Any, *, sizes: Optional[Path] = None, corner_angle: float = 0, **words: Any) -> Mesh:
    """Meshes a domain of the plane.

    source         a file .poly, .mesh, .meshb, .bl2d, .data or .g; a PlaneDomain; or closed polygons, (n, 2) each;
                   polygons inside others bound holes
    sizes          a file .sol, .hg or .h with a size or metric for each vertex of a file
    corner_angle   above 0, degrees: polygons of a file become splines that end where they turn by more
    words          arguments of mesh()
    """
    if isinstance(source, (str, os.PathLike)):
        session = Session()
        geometry: Source = Loaded("load_plane", source, sizes=sizes, corner_angle=corner_angle)
        return _generated(session, geometry, words)
    return mesh(source if isinstance(source, PlaneDomain) else polygons(*source), **words)


def fields(source: Any, path: Path, *, longest: int = 0, channels: Any = (), face: int = 0, multi_part: bool = False,
           **words: Any) -> Mesh:
    """Meshes a geometry, and writes the fields that governed the mesh of each face as images .exr or .png
    (docs/how-to/see_sizes.md); a Mesh of a session is taken as it is. longest: pixels of the longer side; channels: their groups,
    none: all; words: arguments of mesh()."""
    made = source if isinstance(source, Mesh) and source.session is not None else mesh(source, **words)
    assert made.session is not None
    made.session.write_fields(path, longest=longest, channels=channels, face=face, multi_part=multi_part)
    return made


def _begin(source: Any, progress: Progress, named: dict[str, Any]) -> tuple[Session, Source]:
    geometry = source_of(source, progress, named)
    return (source if isinstance(source, Session) else Session()), geometry
