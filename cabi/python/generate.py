#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the C interface for the package carreau: _declarations.py (ctypes) and _records.py (results as tuples
with names).

    generate.py            writes the modules
    generate.py --check    fails when they are out of date

It reads all headers of cabi/include, and carreau_cad.h.

How a declaration of C becomes one of ctypes:
  T name[], const T* name     Int32s, Int64s, Doubles: NumPy arrays of that type, C order, or None
  T* out_value                POINTER(T); so are pointers to structs
  handles                     c_void_p, T** POINTER(c_void_p)
  const char*                 c_char_p; in structs that are filled in, too
  pointers in callbacks       c_void_p: addresses
Headers with CARREAU_CAD_API belong to libcarreau_cad, all others to libcarreau.
"""
import glob
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, os.pardir, "fortran"))
from c_header import Header  # noqa: E402

FOLDER = os.path.join(HERE, "carreau")
HEADERS = sorted(glob.glob(os.path.join(HERE, "../include/*.h"))) + [os.path.join(HERE, "../../cad_adapters/cad/include/carreau_cad.h")]

PLAIN = {"carreau_status": "c_int32", "int32_t": "c_int32", "int64_t": "c_int64", "size_t": "c_size_t", "double": "c_double",
         "void": "None", "void*": "c_void_p", "char*": "c_char_p"}
ARRAYS = {"double": "Doubles", "int32_t": "Int32s", "int64_t": "Int64s", "char* const": "POINTER(c_char_p)"}
PYTHON = {"int32_t": "int", "int64_t": "int", "size_t": "int", "double": "float", "const char*": "str"}
IGNORED = "  # type: ignore[assignment]"  # tuples have a method of that name
NOTICE = '# SPDX-License-Identifier: BSD-3-Clause\n"""{}\n\nWritten by cabi/python/generate.py: not to be edited."""\n'


class Interface:
    """All headers together."""

    def __init__(self, paths):
        self.headers = [Header(path) for path in paths]
        self.structs = {name: members for header in self.headers for name, members in header.structs.items()}
        self.callbacks = {name for header in self.headers for name in header.callbacks}

    def argument(self, c_type):
        """The type of an argument of a function."""
        const, base = c_type.startswith("const "), c_type.replace("const ", "")
        if base in self.callbacks or base in PLAIN:
            return base if base in self.callbacks else PLAIN[base]
        if base.endswith("[]"):
            return ARRAYS[base[:-2]]
        if base.endswith("**"):
            return "POINTER(c_char_p)" if base == "char**" else "POINTER(c_void_p)"
        target = base[:-1]
        if target in ARRAYS:
            return ARRAYS[target] if const else f"POINTER({PLAIN[target]})"
        return f"POINTER({target})" if target in self.structs else "c_void_p"

    @staticmethod
    def of_callback(c_type):
        """An argument or result of a callback: addresses stay numbers, text becomes bytes."""
        base = c_type.replace("const ", "")
        return "c_char_p" if base == "char*" else "c_void_p" if base.endswith("*") else PLAIN[base]

    def function_type(self, signature):
        result, arguments = signature
        # Text that a callback returns is an address: ctypes cannot own it.
        returned = "c_void_p" if result.endswith("*") else PLAIN[result]
        return "CFUNCTYPE({})".format(", ".join([returned] + [self.of_callback(c_type) for c_type, _ in arguments]))

    def member(self, header, struct, c_type, name):
        if c_type == "function":
            return self.function_type(header.member_functions[struct][name])
        base, length = re.fullmatch(r"(.*?)(?:\[(\d+)\])?", c_type).groups()
        plain = base if base in self.callbacks else PLAIN.get(base.replace("const ", ""), "c_void_p")
        return f"{plain} * {length}" if length else plain


def declarations(interface):
    """The text of _declarations.py."""
    lines = [NOTICE.format("The C interface as ctypes sees it."),
             "from ctypes import (CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_int32, c_int64, c_size_t,",
             "                    c_void_p)\n", "from ._arrays import Doubles, Int32s, Int64s\n"]
    for header in interface.headers:
        lines += [f"{name.removeprefix('CARREAU_')} = {value}" for name, value in header.constants.items()]
    for header in interface.headers:
        lines += [f"{name} = {interface.function_type(types)}" for name, types in header.callback_types.items()]
    for header in interface.headers:
        for name, members in header.structs.items():
            fields = "".join(f'        ("{member}", {interface.member(header, name, c_type, member)}),\n' for c_type, member in members)
            lines.append(f"\n\nclass {name}(Structure):\n    _fields_ = [\n{fields}    ]")
    lines.append("\n\n# name: (result, arguments), library by library.")
    for library, of_cad in (("CARREAU", False), ("CARREAU_CAD", True)):
        lines.append(f"{library} = {{")
        for header in interface.headers:
            for name, (result, arguments) in header.functions.items():
                if (name.startswith("carreau_cad_")) == of_cad:
                    given = ", ".join(interface.argument(c_type) for c_type, _ in arguments)
                    lines.append(f'    "{name}": ({interface.argument(result)}, [{given}]),')
        lines.append("}")
    return "\n".join(lines) + "\n"


def record_name(struct):
    return "".join(word.capitalize() for word in struct.removeprefix("carreau_").split("_"))


def results(interface):
    """Structs that functions fill in: {name: header}."""
    found = {}
    for header in interface.headers:
        for _, arguments in header.functions.values():
            for c_type, name in arguments:
                target = c_type.rstrip("*")
                if name.startswith("out_") and target in interface.structs:
                    found.setdefault(target, next(h for h in interface.headers if target in h.structs))
    return found


def python_type(c_type):
    base, length = re.fullmatch(r"(.*?)(?:\[(\d+)\])?", c_type).groups()
    return f"tuple[{', '.join([PYTHON[base]] * int(length))}]" if length else PYTHON[base]


def records(interface):
    """The text of _records.py."""
    lines = [NOTICE.format("Results of the library, as tuples with names. Lengths are model lengths, angles degrees, times seconds."),
             "from __future__ import annotations\n", "from typing import Any, NamedTuple\n", "from . import _declarations as c\n"]
    pairs = []
    for struct, header in results(interface).items():
        said = header.comments.get(struct) or "The struct " + struct + " of the C interface."
        members = [(c_type, name) for c_type, name in header.structs[struct] if name not in ("struct_size", "reserved")]
        rows = "".join(f"    {name}: {python_type(c_type)}{IGNORED if name == 'count' else ''}\n" for c_type, name in members)
        lines.append(f'\nclass {record_name(struct)}(NamedTuple):\n    """{said}"""\n\n{rows}')
        pairs.append(f"    c.{struct}: {record_name(struct)},")
    lines += ["\nRECORDS: dict[type, Any] = {", *pairs, "}"]
    return "\n".join(lines) + "\n"


def main():
    interface = Interface(HEADERS)
    for name, text in (("_declarations.py", declarations(interface)), ("_records.py", records(interface))):
        path = os.path.join(FOLDER, name)
        if sys.argv[1:] != ["--check"]:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            continue
        with open(path, encoding="utf-8") as file:
            if file.read() != text:
                sys.exit(f"{os.path.normpath(path)} does not match the headers. Refresh it: python3 cabi/python/generate.py")


main()
