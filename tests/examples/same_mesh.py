#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs a program that prints the fingerprint of its mesh, and compares it with the fingerprint of a .mesh file: the same
coordinates to the last bit, and the same triangles, in the same order.

same_mesh.py PROGRAM FILE
"""
import re
import struct
import subprocess
import sys

from check_mesh import read


def fingerprint(numbers):
    """FNV-1a of 64-bit numbers, lowest byte first."""
    value = 14695981039346656037
    for number in numbers:
        for byte in struct.pack("<Q", number):
            value = (value ^ byte) * 1099511628211 & 0xffffffffffffffff
    return f"{value:016x}"


def main():
    program, path = sys.argv[1:]
    output = subprocess.run([program], capture_output=True, text=True, check=True).stdout
    printed = re.search(r"^fingerprint ([0-9a-f]{16})$", output, re.MULTILINE)
    if not printed:
        sys.exit(f"{program} prints no fingerprint:\n{output}")
    _, sections = read(path)
    bits = [struct.unpack("<Q", struct.pack("<d", float(x)))[0] for v in sections["Vertices"] for x in v[:3]]
    corners = [int(v) - 1 for t in sections["Triangles"] for v in t[:3]]
    ours = fingerprint(bits + corners)
    print(f"{program}: {printed[1]}\n{path}: {ours}")
    sys.exit(0 if printed[1] == ours else 1)


main()
