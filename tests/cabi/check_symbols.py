#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The shared library exports exactly the functions of cabi/abi/symbols.txt, each under the version VERSION.

    check_symbols.py <libcarreau.so> <symbols.txt> --version VERSION [--refresh] [--nm NM]
"""
import argparse
import subprocess
import sys


def exported(nm, library, version):
    lines = subprocess.run([nm, "-D", "--defined-only", library], check=True, capture_output=True, text=True).stdout
    names = [line.split()[-1] for line in lines.splitlines() if line.strip()]
    return sorted(name for name in names if name != version)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("library")
    parser.add_argument("symbols")
    parser.add_argument("--refresh", action="store_true")
    parser.add_argument("--nm", default="nm")
    parser.add_argument("--version", required=True)
    args = parser.parse_args()
    versioned = exported(args.nm, args.library, args.version)
    found = [name.removesuffix("@@" + args.version) for name in versioned]
    for name in versioned:
        if not name.endswith("@@" + args.version):
            sys.exit(f"exported without the version {args.version}: {name}")
    if args.refresh:
        with open(args.symbols, "w") as out:
            out.write("\n".join(found) + "\n")
        return 0
    with open(args.symbols) as listed_file:
        listed = listed_file.read().split()
    for name in sorted(set(found) - set(listed)):
        print(f"exported, not in the list: {name}")
    for name in sorted(set(listed) - set(found)):
        print(f"in the list, not exported: {name}")
    if found == listed:
        print(f"{len(found)} symbols, as listed")
        return 0
    print(f"If this is wanted (a removal or a change needs a new CARREAU_SOVERSION), refresh the list:\n"
          f"  python3 {sys.argv[0]} {args.library} {args.symbols} --refresh")
    return 1


if __name__ == "__main__":
    sys.exit(main())
