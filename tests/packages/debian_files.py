#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Each file of an installed tree belongs to exactly one package of debian/, and each pattern there finds a file.

    debian_files.py TREE PROJECT [PACKAGE_THAT_WAS_NOT_BUILT...]
"""
import fnmatch
import pathlib
import sys

TRIPLET = "x86_64-linux-gnu"  # any name does: the tree has lib, a package lib/<triplet>


def as_packaged(path):
    """The path below / that Debian's build gives a file of the tree."""
    parts = list(path.parts)
    if parts[0] == "lib" and parts[1] not in ("python3",) and not parts[1].startswith("python3"):
        parts.insert(1, TRIPLET)
    return "/".join(["usr"] + parts)


def matches(pattern, path):
    """As dh_install: a pattern takes a file, or the folder that it is in; * stays in one folder."""
    wanted, parts = pattern.rstrip("/").split("/"), path.split("/")
    return len(parts) >= len(wanted) and all(fnmatch.fnmatchcase(p, w) for p, w in zip(parts, wanted))


def main():
    tree, project, optional = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), set(sys.argv[3:])
    patterns = [(install.stem, line) for install in sorted((project / "debian").glob("*.install"))
                for line in install.read_text().split("\n") if line]
    used, faults, files = set(), [], 0
    for file in sorted(p.relative_to(tree) for p in tree.rglob("*") if not p.is_dir() or p.is_symlink()):
        path = as_packaged(file)
        files += 1
        found = [(package, pattern) for package, pattern in patterns if matches(pattern, path)]
        used.update(found)
        packages = sorted({package for package, _ in found})
        if len(packages) != 1:
            faults.append(f"{path}: {'in no package' if not packages else 'in ' + ', '.join(packages)}")
    faults += [f"{package}.install: nothing is {pattern}" for package, pattern in patterns
               if (package, pattern) not in used and package not in optional]
    print("\n".join(faults) or f"{files} files in {len({package for package, _ in used})} packages")
    return 1 if faults or files == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
