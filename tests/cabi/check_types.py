#!/usr/bin/env python3
"""The bindings of carreau_c.f90 have the types of carreau.h, and are as reviewed in cabi/abi/prototypes.h.

    check_types.py <gfortran> <carreau.h> <carreau_c.f90> <prototypes.h> [--refresh]
"""
import re
import subprocess
import sys
import tempfile

from c_header import Header

PLAIN = {"carreau_status": "int", "int32_t": "int", "int64_t": "long", "size_t": "long", "double": "double"}


def as_gfortran_prints(c_type, header, result=False):
    """Type of C in the words of -fc-prototypes: a type(c_ptr) is void *, whatever it points to. `result`: of a function's
    result or of a member of a struct."""
    c_type = c_type.replace("const ", "").replace(" ", "")
    if c_type in header.callbacks or c_type == "function":
        return "function"
    if c_type == "void":
        return "void"
    if c_type == "char*":
        return "void*" if result else "char*"
    if result and c_type.endswith("*"):
        return "void*"
    base = c_type.rstrip("*[]0123456789")
    tail = c_type[len(base):]
    if base in PLAIN:
        return PLAIN[base] + tail
    if tail == "*" and base in header.structs:
        return "c_" + base[len("carreau_"):] + "*"
    return "void*"


def spaceless(text):
    return re.sub(r"\s+", "", text.replace("const ", ""))


def printed_type(text):
    """Type of a declaration of -fc-prototypes, without its name."""
    text = text.strip()
    if "(*" in text:
        return "function"
    match = re.fullmatch(r"(.*?)(\w+)(\[\d+\])?", text, flags=re.S)
    return spaceless(match.group(1)) + (match.group(3) or "")


def main():
    refresh = "--refresh" in sys.argv
    gfortran, header_path, module, reviewed = [arg for arg in sys.argv[1:] if arg != "--refresh"]
    header = Header(header_path)
    with tempfile.TemporaryDirectory() as folder:
        prototypes = subprocess.run([gfortran, "-fc-prototypes", "-fsyntax-only", "-J", folder, module], check=True,
                                    capture_output=True, text=True).stdout
    prototypes = prototypes[prototypes.index("typedef struct"):prototypes.index("\n#ifdef __cplusplus\n}")]
    if refresh:
        with open(reviewed, "w") as out:
            out.write("/* What gfortran -fc-prototypes prints of cabi/fortran/carreau_c.f90; see tests/cabi/check_types.py. */\n"
                      + prototypes)
    good = True

    structs = {name: body for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \w+;", prototypes, flags=re.S)}
    for name, members in header.structs.items():
        fortran_name = "c_" + name[len("carreau_"):]
        wanted = [(as_gfortran_prints(c_type, header, result=True), member.lower()) for c_type, member in members]
        found = []
        for line in structs.pop(fortran_name, "").split(";"):
            if line.strip():
                member = re.search(r"\(\*(\w+)\)", line) or re.search(r"(\w+)(\[\d+\])?$", line.strip())
                found.append((printed_type(line), member.group(1).lower()))
        if wanted != found:
            good = False
            print(f"struct {name}: carreau.h has {wanted}\n  {fortran_name} has {found}")
    for name in structs:
        good = False
        print(f"struct {name} is not in carreau.h")

    functions = re.findall(r"^(\w+ \*?)(carreau_\w+) \((.*)\);$", prototypes, flags=re.M)
    for result, name, args in functions:
        if name not in header.functions:
            continue  # check_names.py says so
        c_result, c_args = header.functions[name]
        wanted = [as_gfortran_prints(c_result, header, result=True)] + [as_gfortran_prints(a, header) for a in c_args]
        args = re.sub(r"\(\*(\w+)\)\(\)", r"(*\1)", args)
        # A text that is returned through a pointer is a type(c_ptr) by reference: void *, as is a handle.
        found = [spaceless(result)] + [printed_type(a) for a in args.split(",") if a.strip()]
        if wanted != found:
            good = False
            print(f"{name}: carreau.h has {wanted}, carreau_c has {found}")

    with open(reviewed) as reviewed_file:
        same = reviewed_file.read().split("*/\n", 1)[-1] == prototypes
    if not same:
        print(f"the prototypes differ from {reviewed}: review them, then refresh the file:\n  python3 {sys.argv[0]} "
              f"{gfortran} {header_path} {module} {reviewed} --refresh")
    if good and same:
        print(f"{len(functions)} functions and {len(header.structs)} structs agree")
    return 0 if good and same and len(functions) == len(header.functions) else 1


if __name__ == "__main__":
    sys.exit(main())
