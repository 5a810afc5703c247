# SPDX-License-Identifier: BSD-3-Clause
"""The C interface by ctypes: every function of the headers, also functions without a Python counterpart.

    from carreau import capi
    session = carreau.Session()
    capi.lib().set_integer(session._handle, b"verb", 10)     # without its prefix carreau_

Functions return statuses: capi.OK, capi.ERR_ARGUMENT, ... Arrays are NumPy arrays of the right type in C order. The
structs (capi.carreau_cad, ...), callbacks (capi.carreau_surface_fn, ...) and constants have the names of the headers,
constants without CARREAU_.
"""
from . import _declarations
from ._calls import struct
from ._declarations import *  # noqa: F401, F403
from ._library import cad_lib, lib, version

__all__ = ["cad_lib", "lib", "struct", "version"] + [name for name in vars(_declarations) if name.startswith("carreau_") or name.isupper()]
