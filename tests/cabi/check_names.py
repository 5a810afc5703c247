#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The module carreau has a public procedure for every function of carreau.h, and the same constants.

    check_names.py <carreau.h> <carreau.f90>
"""
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../cabi/fortran"))
from c_header import Header


def compare(what, declared, other):
    missing, unknown = sorted(declared - other), sorted(other - declared)
    for name in missing:
        print(f"{what}: in carreau.h, not in the module: {name}")
    for name in unknown:
        print(f"{what}: in the module, not in carreau.h: {name}")
    return not missing and not unknown


def main():
    header = Header(sys.argv[1])
    with open(sys.argv[2]) as module:
        module = re.sub(r"&\s*\n\s*", "", module.read())
    procedures = set(re.findall(r"^  (?:function|subroutine) (carreau_\w+)", module, flags=re.M))
    public = set()
    for line in re.findall(r"^  public :: (.*)$", module, flags=re.M):
        public |= {name.strip() for name in line.split(",")}
    good = compare("procedure", set(header.functions), procedures - {"carreau_string"})
    good &= compare("public", set(header.functions), {name for name in public if name in procedures} - {"carreau_string"})
    constants = {}
    for line in re.findall(r"parameter, public :: (.*)$", module, flags=re.M):
        for name, value in re.findall(r"(CARREAU_\w+) = (-?[\d.e]+)", line):
            constants[name] = float(value) if "." in value else int(value)
    good &= compare("constant", set(header.constants), set(constants))
    for name, value in header.constants.items():
        if name in constants and constants[name] != value:
            print(f"constant: {name} is {value} in carreau.h, {constants[name]} in the module")
            good = False
    if good:
        print(f"{len(header.functions)} functions and {len(constants)} constants agree")
    return 0 if good and len(header.functions) > 40 and len(constants) > 30 else 1


if __name__ == "__main__":
    sys.exit(main())
