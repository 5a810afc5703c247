#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""coverage.py [--xml FOLDER]: computes the share of public names that are documented. A documented name has a description. If it returns a status, it
states its errors (in its comment, in a comment above it, or by the rule of its section). If it can be called, a program that tests run calls it.
Prints a line for each interface and for each name without complete documentation, and fails if there is such a name.

FOLDER: Doxygen writes its XML of the C++ header there."""
import os
import sys
import tempfile

import c_source
import cpp_pages
import python_pages
from examples import Calls
from interfaces import CPP_HEADERS, PYTHON_PACKAGE, ROOT, Interfaces

CALLED = ("function", "subroutine", "method")


class Share:
    def __init__(self, title):
        self.title, self.names, self.short = title, 0, []

    def add(self, name, *lacks):
        """lacks: (whether something lacks, what)."""
        self.names += 1
        missing = [what for is_missing, what in lacks if is_missing]
        if missing:
            self.short.append(f"  {name}: no " + ", no ".join(missing))

    def show(self):
        documented = self.names - len(self.short)
        print(f"{self.title}: {documented} of {self.names} documented, {100 * documented / max(self.names, 1):.1f} %")
        print("\n".join(self.short) + "\n" if self.short else "", end="")
        return not self.short


def c_share(interfaces):
    share, calls, seen = Share("C"), Calls(ROOT, "c"), set()
    for source in interfaces.headers.values():
        for entity in source.entities:
            name = entity.name or entity.members[0].name
            seen.add(name)
            called = entity.kind == "function"
            share.add(name, (not c_source.has_description(entity.text), "description"),
                      (entity.returns_status and not c_source.states_errors(source, entity), "errors"), (called and not calls.find(name), "example"))
    for name in interfaces.exported():
        if name not in seen:
            share.add(name, (True, "declaration in a header"))
    return share


def fortran_share(interfaces):
    share, calls = Share("Fortran"), Calls(ROOT, "fortran")
    for module in interfaces.modules:
        for entity in module.entities:
            twin = interfaces.c.get(entity.name)
            member, group = interfaces.members.get(entity.name, (None, None))
            described = any(line.strip() for line in entity.text) or twin and c_source.has_description(twin.text) or \
                member and (member.text or group is not None and c_source.has_description(group.text))
            returns = entity.kind == "subroutine" and any(part.name == "status" for part in entity.parts)
            stated = "status" in " ".join(entity.text) or \
                twin and twin.kind == "function" and (not twin.returns_status or c_source.states_errors(interfaces.source_of(twin.name), twin))
            share.add(f"{module.name}: {entity.name}", (not described, "description"), (returns and not stated, "errors"),
                      (entity.kind in CALLED and not calls.find(entity.name), "example"))
    return share


def cpp_share(xml):
    share, calls = Share("C++"), Calls(ROOT, "cpp")
    for entity in cpp_pages.entities(cpp_pages.doxygen(CPP_HEADERS, xml)):
        constructor = entity.scope.rsplit("::", 1)[-1] == entity.name
        share.add(f"{entity.scope}::{entity.name}", (not entity.described, "description"),
                  (entity.kind == "function" and not constructor and not calls.find(entity.name), "example"))
    return share


def python_share():
    share, calls = Share("Python"), Calls(ROOT, "python")
    for entity in python_pages.entities(PYTHON_PACKAGE):
        share.add(f"{entity.path}.{entity.name}", (not entity.described, "description"), (entity.kind in CALLED and not calls.find(entity.name), "example"))
    return share


def main():
    interfaces = Interfaces()
    shares = [c_share(interfaces), fortran_share(interfaces)]
    if os.path.exists(os.path.join(ROOT, CPP_HEADERS[0])):
        with tempfile.TemporaryDirectory() as folder:
            shares.append(cpp_share(sys.argv[2] if sys.argv[1:2] == ["--xml"] else folder))
    if os.path.isdir(os.path.join(ROOT, PYTHON_PACKAGE)):
        shares.append(python_share())
    complete = [share.show() for share in shares]
    names, short = sum(share.names for share in shares), sum(len(share.short) for share in shares)
    print(f"all: {names - short} of {names} documented, {100 * (names - short) / names:.1f} %")
    return 0 if all(complete) else 1


if __name__ == "__main__":
    sys.exit(main())
