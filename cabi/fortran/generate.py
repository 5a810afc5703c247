#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the bindings of the functions and structs of a header as Fortran 2003: carreau_c.f90 of carreau.h,
carreau_geometry_c.f90 of carreau_geometry.h, carreau_cad_c.f90 of carreau_cad.h.

    generate.py <carreau.h> <carreau_c.f90>            writes the module
    generate.py --check <carreau.h> <carreau_c.f90>    fails when the module is out of date

How a declaration of C becomes one of Fortran:
  carreau_x                          c_x, for functions and structs
  carreau_x* of a struct             type(c_x), intent(in) if const, else intent(inout)
  carreau_session*, carreau_mesh*    type(c_ptr), value
  pointers to pointers               type(c_ptr), intent(inout)
  const char*                        character(kind=c_char), intent(in) :: name(*); as a result or member type(c_ptr)
  callbacks                          type(c_funptr)
  T* and T name[]                    a scalar and an array; intent(in) if const, else intent(inout)
  out_name                           name, unless another argument has that name
"""
import os
import re
import sys
import textwrap

from c_header import Header

WIDTH = 120  # columns; Fortran 2003 allows 132
PLAIN = {"carreau_status": ("integer", "c_int32_t"), "int32_t": ("integer", "c_int32_t"),
         "int64_t": ("integer", "c_int64_t"), "size_t": ("integer", "c_size_t"), "double": ("real", "c_double")}


def fortran_name(name):
    return name.replace("carreau_", "c_", 1)


def in_lines(start, items, indent, last=""):
    """`start` and the items, separated by commas, in as many continued lines as it takes."""
    lines, line = [], start
    for i, item in enumerate(items):
        piece = item + (", " if i + 1 < len(items) else last)
        if len(line) + len(piece.rstrip()) > WIDTH - 2 and line.strip() and i > 0:
            lines.append(line.rstrip() + " &")
            line = indent + "  "
        line += piece
    return lines + [line.rstrip()]


def grouped(declarations):
    """Runs of equal attributes: [(attributes, [names])]."""
    groups = []
    for attributes, name in declarations:
        if not groups or groups[-1][0] != attributes:
            groups.append((attributes, []))
        groups[-1][1].append(name)
    return groups


class Writer:
    def __init__(self, header, folder="cabi/"):
        self.header = header
        self.folder = folder
        self.lines = []

    def member(self, c_type):
        """(attributes, initial value) of a member of a struct."""
        base = c_type.split("[")[0]
        if c_type == "function" or base in self.header.callbacks:
            return "type(c_funptr)", "c_null_funptr"
        if base.endswith("*"):
            return "type(c_ptr)", "c_null_ptr"
        kind = "{}({})".format(*PLAIN[base])
        return kind, "0"

    def argument(self, c_type):
        """(attributes, suffix of the name) of an argument."""
        const, base = c_type.startswith("const "), c_type.replace("const ", "")
        intent = "intent(in)" if const else "intent(inout)"
        if base in self.header.callbacks:
            return "type(c_funptr), value", ""
        if base == "char*":
            return "character(kind=c_char), intent(in)", "(*)"
        if base.endswith("**"):
            return "type(c_ptr), intent(inout)", ""
        plain = base.rstrip("*[]")
        if plain in PLAIN:
            kind = "{}({})".format(*PLAIN[plain])
            return kind + ", " + (intent if base != plain else "value"), "(*)" if base.endswith("[]") else ""
        if plain in self.header.structs:
            return f"type({fortran_name(plain)}), {intent}", ""
        return "type(c_ptr), value", ""

    def result(self, name, c_type):
        """(attributes, name) of a function's result; None for a subroutine."""
        if c_type == "void":
            return None
        if c_type == "carreau_status":
            return "integer(c_int32_t)", "status"
        if c_type.endswith("*"):
            return "type(c_ptr)", name.rsplit("_", 1)[-1]
        return "{}({})".format(*PLAIN[c_type]), name.rsplit("_", 1)[-1]

    def add(self, *lines):
        self.lines += lines

    def comment(self, text, indent):
        for i, line in enumerate(textwrap.wrap(text, WIDTH - len(indent) - 3)):
            self.add(f"{indent}{'!>' if i == 0 else '!!'} {line}")

    def type(self, name):
        self.comment(self.header.comments.get(name, ""), "  ")
        self.add(f"  type, bind(c) :: {fortran_name(name)}")
        declarations = []
        for c_type, member in self.header.structs[name]:
            kind, value = self.member(c_type)
            extent = re.search(r"\[(\d+)\]", c_type)
            declarations.append((kind, f"{member}{'(' + extent.group(1) + ')' if extent else ''} = {value}"))
        for kind, names in grouped(declarations):
            self.add(*in_lines(f"    {kind} :: ", names, "    "))
        self.add(f"  end type {fortran_name(name)}", "")

    def procedure(self, name, c_name, result, arguments):
        """arguments: [(attributes, name, suffix)]; result: (attributes, name) or None."""
        keyword = "function" if result else "subroutine"
        self.add(*self.heading(f"    {keyword} {name}(", [a[1] for a in arguments],
                               f" result({result[1]})" if result else "", f' bind(c, name="{c_name}")'))
        attributes = " ".join([a[0] for a in arguments] + [result[0] if result else ""])
        self.add(*in_lines("      import :: ", sorted(set(re.findall(r"\bc_\w+", attributes))), "      "),
                 "      implicit none")
        for kind, names in grouped([(kind, name + suffix) for kind, name, suffix in arguments]):
            self.add(*in_lines(f"      {kind} :: ", names, "      "))
        if result:
            self.add(f"      {result[0]} :: {result[1]}")
        self.add(f"    end {keyword} {name}", "")

    @staticmethod
    def heading(start, names, result, bind):
        lines = in_lines(start, names or [""], "    ", ")" + result)
        if len(lines[-1] + bind) <= WIDTH:
            return lines[:-1] + [lines[-1] + bind]
        return lines[:-1] + [lines[-1] + " &", "       " + bind]

    def function(self, c_name):
        c_result, c_arguments = self.header.functions[c_name]
        names = [name for _, name in c_arguments]
        arguments = []
        for c_type, name in c_arguments:
            short = name[len("out_"):] if name.startswith("out_") else name
            attributes, suffix = self.argument(c_type)
            arguments.append((attributes, name if short in names and short != name else short, suffix))
        self.comment(self.header.comments.get(c_name, ""), "    ")
        self.procedure(fortran_name(c_name), c_name, self.result(c_name, c_result), arguments)

    def module(self, name):
        """name: "carreau", of the header and of the module that uses this one."""
        self.add("! SPDX-License-Identifier: BSD-3-Clause",
                 f"!> The functions and structs of {name}.h as Fortran sees them. Private to module {name}.",
                 f"!! Written by generate.py from {name}.h: do not edit. After a change of the header:",
                 f"!!   python3 cabi/fortran/generate.py {self.folder}include/{name}.h {self.folder}fortran/{name}_c.f90",
                 f"module {name}_c")
        used = ["c_char", "c_double", "c_funptr", "c_int32_t", "c_int64_t", "c_null_funptr", "c_null_ptr", "c_ptr",
                "c_size_t"]
        self.add(*in_lines("  use, intrinsic :: iso_c_binding, only: ", used, "  "), "  implicit none", "  public", "")
        for struct in self.header.structs:
            self.type(struct)
        self.add("  interface")
        for function in self.header.functions:
            self.function(function)
        if name == "carreau":
            self.comment("strlen of the C library: the length of a text that the library returns.", "    ")
            self.procedure("c_strlen", "strlen", ("integer(c_size_t)", "length"), [("type(c_ptr), value", "text", "")])
        self.lines.pop()
        self.add("  end interface", f"end module {name}_c")
        return "\n".join(self.lines) + "\n"


def written(text, check, paths):
    """Writes the text to the last path, or compares it with the file there. Returns the exit status: 1 if they differ."""
    if not check:
        with open(paths[-1], "w", encoding="utf-8") as module:
            module.write(text)
        return 0
    with open(paths[-1], encoding="utf-8") as module:
        if module.read() == text:
            return 0
    print(f"{paths[-1]} is older than {' or '.join(paths[:-1])}. Write it again:\n  python3 {sys.argv[0]} {' '.join(paths)}")
    return 1


def main():
    check = sys.argv[1] == "--check"
    header_path, module_path = sys.argv[-2:]
    name = os.path.basename(header_path).removesuffix(".h")
    folder = "cad_adapters/cad/" if name == "carreau_cad" else "cabi/"
    text = Writer(Header(header_path), folder).module(name)
    return written(text, check, [header_path, module_path])


if __name__ == "__main__":
    sys.exit(main())
