# SPDX-License-Identifier: BSD-3-Clause
"""Shapes that other programs hold in memory: build123d, CadQuery, pythonocc and FreeCAD.

This module imports no such program. A shape crosses as the bytes of a BREP file, which it writes itself: by
exportBrep(path) (CadQuery, FreeCAD), by export_brep(path) (build123d), or by the writer of the package that its
OpenCASCADE shape, itself or its member `wrapped`, comes from (OCP, OCC.Core)."""
from __future__ import annotations

import importlib
import os
import tempfile
from typing import Any, Callable, Iterator, NamedTuple

from .errors import ArgumentError

WRITERS = ("exportBrep", "export_brep")
PACKAGES = ("OCP", "OCC")  # that wrap OpenCASCADE's own classes


class Solid(NamedTuple):
    """The attributes of a solid besides its shape."""

    name: str
    rgb: int  # 0xRRGGBB, -1: none


def is_shape(given: Any) -> bool:
    """True if brep_of() can have the bytes of an object."""
    return _writer(given) is not None or any(_is_wrapped(given, name) for name in ("wrapped", "Shape")) or _is_assembly(given) or _is_workplane(given)


def brep_of(given: Any) -> bytes:
    """The bytes of a BREP file with the shape. Raises ArgumentError."""
    if _is_assembly(given):
        given = given.toCompound()
    elif _is_workplane(given):
        given = _one_of(given.vals())
    elif _writer(given) is None and hasattr(given, "Shape"):
        given = given.Shape  # an object of a document of FreeCAD
    write = _writer(given) or _writer(getattr(given, "wrapped", None))
    if write is None:
        raise ArgumentError(f"{type(given).__name__} has no exportBrep, no export_brep and no shape of OpenCASCADE")
    with tempfile.TemporaryDirectory(prefix="carreau-") as folder:
        path = os.path.join(folder, "shape.brep")
        write(path)
        with open(path, "rb") as file:
            return file.read()


def solids_of(given: Any) -> list[Solid]:
    """Names and colours of the solids, in the order of brep_of(); empty: nothing has a name or a colour."""
    found = list(_solids(given, Solid("", -1)))
    return found if any(each.name or each.rgb >= 0 for each in found) else []


def _solids(given: Any, above: Solid) -> Iterator[Solid]:
    """`above`: attributes of the assembly that holds it, used by parts without their own."""
    own = Solid(str(_first(given, ("label", "name", "Label")) or above.name), _rgb(_first(given, ("color",)), above.rgb))
    children = list(_first(given, ("children",)) or ())
    if not children:
        yield from [own] * _count(given)
        return
    if _is_assembly(given):
        yield from [own] * sum(_count(each) for each in given.shapes)  # before those of children
    for each in children:
        yield from _solids(each, own)


def _first(given: Any, names: tuple[str, ...]) -> Any:
    for name in names:
        value = getattr(given, name, None)
        if value is not None and not callable(value):
            return value
    return None


def _count(given: Any) -> int:
    """The attributes of the solids of a shape."""
    if _is_assembly(given):
        return sum(_count(each) for each in given.shapes)
    if _is_workplane(given):
        return sum(_count(each) for each in given.vals())
    for name in ("Solids", "solids"):
        solids = getattr(given, name, None)
        if solids is not None:
            return len(solids() if callable(solids) else solids)
    return _count(given.Shape) if hasattr(given, "Shape") else 0


def _rgb(colour: Any, otherwise: int) -> int:
    """0xRRGGBB of a colour that is a tuple of shares, or can become one."""
    if colour is None:
        return otherwise
    shares = colour.toTuple() if hasattr(colour, "toTuple") else colour.to_tuple() if hasattr(colour, "to_tuple") else tuple(colour)
    red, green, blue = (round(255 * min(max(float(share), 0), 1)) for share in shares[:3])
    return red << 16 | green << 8 | blue


def _writer(given: Any) -> "Callable[[str], Any] | None":
    for name in WRITERS:
        if callable(getattr(given, name, None)):
            return getattr(given, name)  # type: ignore[no-any-return]
    package = type(given).__module__.split(".")[0]
    if package not in PACKAGES or not type(given).__name__.startswith("TopoDS"):
        return None
    if package == "OCP":
        tools = importlib.import_module("OCP.BRepTools").BRepTools
        return lambda path: tools.Write_s(given, path)
    tools = importlib.import_module("OCC.Core.BRepTools")
    write = tools.breptools.Write if hasattr(tools, "breptools") else tools.breptools_Write
    return lambda path: write(given, path)


def _is_wrapped(given: Any, name: str) -> bool:
    return _writer(getattr(given, name, None)) is not None


def _is_assembly(given: Any) -> bool:
    """True for an assembly of CadQuery."""
    return callable(getattr(given, "toCompound", None)) and hasattr(given, "children")


def _is_workplane(given: Any) -> bool:
    """True for a workplane of CadQuery."""
    return callable(getattr(given, "vals", None)) and callable(getattr(given, "val", None))


def _one_of(shapes: list[Any]) -> Any:
    if len(shapes) == 1:
        return shapes[0]
    compound = getattr(importlib.import_module(type(shapes[0]).__module__), "Compound")
    return compound.makeCompound(shapes)
