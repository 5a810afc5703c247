#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every function of the C interface can be had from the C++ headers: each name of a list of symbols is called in one of them.

    check_wrapper.py <symbols.txt> <header or folder>...
"""
import pathlib
import re
import sys


def headers_of(paths):
    for path in map(pathlib.Path, paths):
        yield from path.rglob("*.hpp") if path.is_dir() else [path]


def main():
    symbols = set(pathlib.Path(sys.argv[1]).read_text().split())
    code = "\n".join(re.sub(r"//.*", "", header.read_text()) for header in headers_of(sys.argv[2:]))
    missing = sorted(symbols - set(re.findall(r"\bcarreau_\w+", code)))
    for name in missing:
        print(f"not in the C++ headers: {name}")
    print(f"{len(symbols) - len(missing)} of {len(symbols)} functions")
    return 1 if missing or not symbols else 0


if __name__ == "__main__":
    sys.exit(main())
