# SPDX-License-Identifier: BSD-3-Clause
"""libcarreau and libcarreau_cad: found, loaded once, their functions declared."""
from __future__ import annotations

import ctypes
import glob
import os
from functools import lru_cache
from types import SimpleNamespace
from typing import Any, Iterator

from . import _declarations as c

SOVERSION = 0  # of the C interface that this package speaks
HERE = os.path.dirname(os.path.abspath(__file__))


def _candidates(name: str) -> Iterator[str]:
    """Files that may be lib<name>.so, the most likely first: the path in CARREAU_LIBRARY_PATH, the wheel's own, the one
    installed beside this package, the one that the loader finds."""
    for folder in filter(None, os.environ.get("CARREAU_LIBRARY_PATH", "").split(os.pathsep)):
        yield os.path.join(folder, f"lib{name}.so.{SOVERSION}")
    yield from glob.glob(os.path.join(HERE, "lib", f"lib{name}.so.{SOVERSION}"))
    # <prefix>/lib/python3/dist-packages/carreau, and whatever lies as deep below the same lib.
    folder = HERE
    for _ in range(4):
        folder = os.path.dirname(folder)
        yield from glob.glob(os.path.join(folder, f"lib{name}.so.{SOVERSION}"))
    yield f"lib{name}.so.{SOVERSION}"  # where the loader looks


def _load(name: str) -> ctypes.CDLL:
    tried = []
    for path in _candidates(name):
        try:
            return ctypes.CDLL(path)
        except OSError as error:
            tried.append(f"{path}: {error}")
    said = "\n  ".join(tried) or "there is no such file"
    raise ImportError(f"lib{name} cannot be loaded. CARREAU_LIBRARY_PATH names folders that may hold it.\n  {said}")


def _declared(library: ctypes.CDLL, functions: dict[str, Any]) -> Any:
    """The functions without their prefix. A library that lacks some is an older one: those fail when they are called."""
    found = SimpleNamespace()
    for name, (result, arguments) in functions.items():
        function = getattr(library, name, None)
        if function is not None:
            function.restype, function.argtypes = result, arguments
            setattr(found, name.removeprefix("carreau_"), function)
    return found


@lru_cache(maxsize=None)
def lib() -> Any:
    """The functions of carreau.h, carreau_geometry.h, carreau_atlas.h and carreau_remesh.h. Raises ImportError."""
    return _declared(_load("carreau"), c.CARREAU)


@lru_cache(maxsize=None)
def cad_lib() -> Any:
    """The functions of carreau_cad.h, whose library needs OpenCASCADE. Raises ImportError."""
    lib()  # libcarreau_cad finds it loaded
    return _declared(_load("carreau_cad"), c.CARREAU_CAD)


def version() -> str:
    """The version of the library that runs: "0.1.0"."""
    return str(lib().version().decode())
