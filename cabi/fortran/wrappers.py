#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the Fortran module of a header from its template: carreau.f90 of carreau.f90.in and carreau.h.

    wrappers.py <header> <template> <module>            writes the module
    wrappers.py --check <header> <template> <module>    fails when the module is out of date

A template is Fortran, with lines that stand for declarations of the header:
  !@ wrap carreau_x                the procedure that calls c_x
  !@ wrap carreau_x a(3, n) b(n) the call also allocates the arrays a and b. n is a count of carreau_mesh_count,
                                   carreau_model_count or carreau_mesh_cell_count. Marks follow an array, without blanks:
                                   a(3, n)+1   its values count from 1
                                   a(n)?       it is not allocated after an error
  !@ type carreau_x                the type of a struct. After the name, logical:a,b names the members that are flags, and
                                   a=1 a first value other than zero
  !@ flags carreau_x a b           the members of a type, which the template has, that are flags
Arguments stand in the order of C. Arguments that C returns through pointers lose out_. The status is the last one. Handles
of sessions and meshes, texts, indices from 1 and sizes of arrays are converted.
"""
import os
import re
import sys

from c_header import Header
from generate import WIDTH, fortran_name, grouped, in_lines, written

HANDLES = ("carreau_session", "carreau_mesh")
KINDS = {"int32_t": "integer(c_int32_t)", "int64_t": "integer(c_int64_t)", "double": "real(c_double)",
         "carreau_status": "integer(c_int32_t)"}
# The functions that give counts, and the names of these in their order.
COUNTS = {"carreau_mesh_count": ("vertices", "triangles", "edges", "faces"), "carreau_model_count": ("faces", "curves", "points"),
          "carreau_mesh_cell_count": ("count",)}
TEXT = "character(len=:), allocatable"


class TemplateError(Exception):
    pass


def base_of(c_type):
    return c_type.replace("const ", "").rstrip("*[]").strip()


class Array:
    """`name(extents)` with its marks, as a directive has it."""

    def __init__(self, word):
        match = re.fullmatch(r"(\w+)\(([^()]*(?:\(\w+\))?[^()]*)\)(\+1)?(\?)?", word)
        if not match:
            raise TemplateError(f"'{word}' is no array")
        self.name, self.extents = match.group(1), [e.strip() for e in match.group(2).split(",")]
        self.from_one, self.may_fail = bool(match.group(3)), bool(match.group(4))
        self.shape = "(" + ", ".join(":" * len(self.extents)) + ")"


class Wrapper:
    """One procedure. declarations: [(attributes, name)] of its arguments; local: likewise its variables."""

    def __init__(self, writer, c_name, arrays):
        self.writer, self.header, self.c_name = writer, writer.header, c_name
        self.arrays = {a.name: a for a in arrays}
        self.c_result, self.c_arguments = self.header.functions[c_name]
        self.names, self.declarations, self.local = [], [], []
        self.before, self.passed, self.after = [], [], []

    def lines(self):
        for k, (c_type, c_argument) in enumerate(self.c_arguments):
            self.argument(k, c_type, c_argument if c_type.startswith("const ") else c_argument.removeprefix("out_"))
        if self.arrays:
            self.count_arrays()
        return self.procedure()

    def declare(self, attributes, name):
        self.names.append(name)
        self.declarations.append((attributes, name))

    def argument(self, k, c_type, name):
        base, const = base_of(c_type), c_type.startswith("const ")
        if base in HANDLES:
            self.handle(c_type, base, name)
        elif c_type == "const char*":
            self.declare("character(len=*), intent(in)", name)
            self.passed.append(f"c_text({name})")
        elif base in self.header.structs and not const:
            self.struct(base, name)
        elif name in self.arrays:
            self.declare(f"{KINDS[base]}, allocatable, intent(out)", name + self.arrays[name].shape)
            self.passed.append(name)
        elif c_type in KINDS:
            self.value(k, c_type, name)
        elif c_type.endswith("[]") and const and base in KINDS:
            self.declare(f"{KINDS[base]}, intent(in)", name + "(:)")
            self.passed.append(name)
        elif c_type == base + "*" and base in KINDS:
            self.declare(f"{KINDS[base]}, intent(out)", name)
            self.before.append(f"{name} = 0")
            self.passed.append(name)
        else:
            raise TemplateError(f"{self.c_name}: no rule wraps {c_type} {name}")

    def handle(self, c_type, base, name):
        is_freed = self.c_name.endswith("_free")
        intent = "inout" if is_freed else "out" if c_type.endswith("**") else "in"
        self.declare(f"type({base}), intent({intent})", name)
        self.passed.append(f"{name}%handle")
        if is_freed:
            self.after.append(f"{name}%handle = c_null_ptr")

    def value(self, k, c_type, name):
        follower = self.c_arguments[k + 1] if k + 1 < len(self.c_arguments) else ("", "")
        if name in ("n", "count", "capacity") and follower[0].endswith("[]"):
            array = follower[1].removeprefix("out_")
            self.passed.append(self.arrays[array].extents[-1] if array in self.arrays else f"size({array}, kind=c_int64_t)")
            return
        self.declare(f"{KINDS[c_type]}, intent(in)", name)
        one = "1_c_int32_t" if c_type == "int32_t" else "1"
        self.passed.append(f"{name} - {one}" if name == "index" else name)

    def struct(self, base, name):
        self.declare(f"type({base}), intent(out)", name)
        self.local.append((f"type({fortran_name(base)})", "c"))
        self.before.append("c%struct_size = size(transfer(c, [c_null_char]))")
        self.passed.append("c")
        self.after.append("if (status /= CARREAU_OK) return")
        self.after += self.writer.copies(base, name)

    def count_arrays(self):
        words = {e for array in self.arrays.values() for e in array.extents}
        source = "carreau_model_count" if self.c_name.startswith("carreau_model_") else "carreau_mesh_count"
        if "count" in words:
            source = "carreau_mesh_cell_count"
        given = [n for n in self.names if n in ("session", "mesh", "part", "kind")]
        counts = list(COUNTS[source])
        taken = {n: f"{n}_count" for n in counts if n in self.arrays}
        self.local.append(("integer(c_int64_t)", ", ".join(taken.get(n, n) for n in counts)))
        rename = lambda e: taken.get(e, e)
        self.passed = [rename(p) if p in counts and p not in self.arrays else p for p in self.passed]
        shapes = [f"{a.name}({', '.join(rename(e) for e in a.extents)})" for a in self.arrays.values()]
        self.before = [f"call {source}({', '.join(given + [rename(n) for n in counts] + ['status'])})",
                       "if (status /= CARREAU_OK) return", f"allocate ({', '.join(shapes)})"]
        failing = [a.name for a in self.arrays.values() if a.may_fail]
        if failing:
            self.after.append(f"if (status /= CARREAU_OK) deallocate ({', '.join(failing)})")
        for array in self.arrays.values():
            if array.from_one:
                guard = "if (status == CARREAU_OK) " if array.may_fail else ""
                self.after.append(f"{guard}{array.name} = {array.name} + 1")

    def procedure(self):
        if self.c_result == "carreau_status":
            self.declare("integer(c_int32_t), intent(out)", "status")
            call, kind, result = "status = ", "subroutine", ""
        elif self.c_result == "void":
            call, kind, result = "call ", "subroutine", ""
        else:
            word = self.c_name.rsplit("_", 1)[-1]
            text = self.c_result == "const char*"
            self.declarations.append((TEXT if text else KINDS[self.c_result], word))
            call, kind, result = f"{word} = " + ("carreau_string(" if text else ""), "function", f" result({word})"
        heads = in_lines(f"  {kind} {self.c_name}(", [re.sub(r"\(.*", "", n) for n in self.names] or [""], "    ", ")" + result)
        lines = list(heads)
        for attributes, names in grouped(self.declarations) + grouped(self.local):
            lines += in_lines(f"    {attributes} :: ", names, "    ")
        lines += ["    " + line for line in self.before]
        end = "))" if call.endswith("carreau_string(") else ")"
        lines += in_lines(f"    {call}{fortran_name(self.c_name)}(", self.passed or [""], "    ", end)
        lines += [line if line.startswith("    ") else "    " + line for line in self.after]
        return lines + [f"  end {kind} {self.c_name}"]


class Template:
    def __init__(self, header):
        self.header = header
        self.flags, self.types = {}, {}

    def members(self, struct):
        return [(t, n) for t, n in self.header.structs[struct] if n not in ("struct_size", "reserved")]

    def copies(self, struct, name):
        """The lines that copy the struct c of C to its Fortran type."""
        lines = []
        for c_type, member in self.members(struct):
            value = f"c%{member}"
            if c_type == "const char*":
                value = f"carreau_string({value})"
            elif member in self.flags.get(struct, ()):
                value += " /= 0"
            lines.append(f"{name}%{member} = {value}")
        return lines

    def type(self, struct, words):
        first = dict(w.split("=") for w in words if "=" in w)
        self.flags[struct] = next((w[len("logical:"):].split(",") for w in words if w.startswith("logical:")), [])
        declarations = []
        for c_type, member in self.members(struct):
            extent = re.search(r"\[(\d+)\]", c_type)
            if c_type == "const char*":
                declarations.append((TEXT, member))
            elif member in self.flags[struct]:
                declarations.append(("logical", f"{member} = {first.get(member, '.false.')}"))
            else:
                declarations.append((KINDS[c_type.split("[")[0]],
                                     f"{member}{'(' + extent.group(1) + ')' if extent else ''} = {first.get(member, '0')}"))
        lines = [f"  type :: {struct}"]
        for attributes, names in grouped(declarations):
            lines += in_lines(f"    {attributes} :: ", names, "    ")
        return lines + [f"  end type {struct}"]

    def expand(self, text):
        lines = []
        for number, line in enumerate(text.split("\n"), 1):
            directive = re.fullmatch(r"\s*!@ (wrap|type|flags) (\w+)\s*(.*)", line)
            if not directive:
                lines.append(line)
                continue
            kind, name, rest = directive.groups()
            try:
                words = re.findall(r"\w+\([^()]*(?:\(\w+\)[^()]*)?\)\S*|\S+", rest)
                if name not in (self.header.functions if kind == "wrap" else self.header.structs):
                    raise TemplateError(f"the header has no {name}")
                if kind == "flags":
                    self.flags[name] = words
                    continue
                lines += (Wrapper(self, name, [Array(w) for w in words]).lines() if kind == "wrap" else self.type(name, words))
            except TemplateError as error:
                raise SystemExit(f"line {number}: {error}") from error
        return "\n".join(lines)


def main():
    check = sys.argv[1] == "--check"
    header, template, module = sys.argv[-3:]
    with open(template, encoding="utf-8") as file:
        text = Template(Header(header)).expand(file.read())
    text = text.replace("! @WRITTEN@", f"! wrappers.py writes this file from {os.path.basename(template)}: do not edit it.")
    too_long = [line for line in text.split("\n") if len(line) > 132]
    if too_long:
        raise SystemExit(f"longer than Fortran allows: {too_long[0]}")
    return written(text, check, [header, template, module])


if __name__ == "__main__":
    sys.exit(main())
