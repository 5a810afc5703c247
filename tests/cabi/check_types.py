#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""gfortran and the C compiler read carreau_c.f90 and carreau.h alike: the same layout of every struct, the same types of
every argument and result. The script that writes carreau_c.f90 is not trusted with it.

    check_types.py <gfortran> <cc> <carreau.h> <carreau_c.f90>
"""
import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../cabi/fortran"))
from c_header import Header

PLAIN = {"carreau_status": "int", "int32_t": "int", "int64_t": "long", "size_t": "long", "double": "double"}


def as_gfortran_prints(c_type, header, result=False):
    """Type of C in the words of -fc-prototypes: a type(c_ptr) is void *, whatever it points to."""
    c_type = c_type.replace("const ", "").replace(" ", "").replace("[]", "*")
    if c_type in header.callbacks:
        return "function"
    if c_type == "char*":
        return "void*" if result else "char*"
    if c_type == "void" or result and c_type.endswith("*"):
        return "void" + c_type[len(c_type.rstrip("*")):]
    base = c_type.rstrip("*")
    tail = c_type[len(base):]
    if base in PLAIN:
        return PLAIN[base] + tail
    return "c_" + base[len("carreau_"):] + "*" if tail == "*" and base in header.structs else "void*"


def printed_type(text):
    """Type of a declaration of -fc-prototypes, without its name."""
    text = text.strip()
    if "(*" in text:
        return "function"
    return re.sub(r"\s+|const ", "", re.fullmatch(r"(.*?)\w+", text, flags=re.S).group(1))


def functions_agree(header, prototypes):
    good = True
    found = {}
    for result, name, arguments in re.findall(r"^(\w+ \*?)(carreau_\w+) \((.*)\);$", prototypes, flags=re.M):
        arguments = re.sub(r"\(\*(\w+)\)\(\)", r"(*\1)", arguments)
        found[name] = [result.replace(" ", "")] + [printed_type(a) for a in arguments.split(",") if a.strip()]
    for name in sorted(set(found) | set(header.functions)):
        result, arguments = header.functions.get(name, ("nothing", []))
        wanted = [as_gfortran_prints(result, header, result=True)] + [as_gfortran_prints(t, header) for t, _ in arguments]
        if found.get(name) != wanted:
            print(f"{name}: carreau.h has {wanted}, carreau_c has {found.get(name)}")
            good = False
    return good


def layout_program(header, structs):
    """A program of C that compiles only when each struct of Fortran has the size and the offsets of its twin of C."""
    lines = ["#include <stddef.h>", "#include <carreau.h>", structs]
    for name, members in header.structs.items():
        twin = "c_" + name[len("carreau_"):]
        lines.append(f'_Static_assert(sizeof({name}) == sizeof({twin}), "size of {name}");')
        for _, member in members:
            lines.append(f'_Static_assert(offsetof({name}, {member}) == offsetof({twin}, {member}), "{name}.{member}");')
            lines.append(f'_Static_assert(sizeof((({name}*)0)->{member}) == sizeof((({twin}*)0)->{member}), '
                         f'"size of {name}.{member}");')
    return "\n".join(lines) + "\n"


def main():
    gfortran, compiler, header_path, module = sys.argv[1:]
    header = Header(header_path)
    with tempfile.TemporaryDirectory() as folder:
        prototypes = subprocess.run([gfortran, "-fc-prototypes", "-fsyntax-only", "-J", folder, module], check=True,
                                    capture_output=True, text=True).stdout
        prototypes = prototypes[prototypes.index("typedef struct"):]
        structs = "\n".join(re.findall(r"typedef struct \w+ \{.*?\} \w+;", prototypes, flags=re.S))
        source = os.path.join(folder, "layout.c")
        with open(source, "w") as file:
            file.write(layout_program(header, structs))
        layout = subprocess.run([compiler, "-std=c11", "-fsyntax-only", "-I" + os.path.dirname(header_path), source])
    good = functions_agree(header, prototypes) and layout.returncode == 0
    if good:
        print(f"{len(header.functions)} functions and {len(header.structs)} structs agree")
    return 0 if good and len(header.functions) > 40 and len(header.structs) > 15 else 1


if __name__ == "__main__":
    sys.exit(main())
