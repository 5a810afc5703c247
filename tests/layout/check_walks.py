#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""check_walks.py PROJECT: the folders and files that the READMEs of cpp/ name with their folder exist."""
import pathlib
import re
import sys

NAME = re.compile(r"`((?:\.\./)*[a-z_0-9]+(?:/[a-z_0-9]+)+(?:\.h|\.cpp|/)?)`")
ENDINGS = ("", ".h", ".cpp")
PATTERNS = {"cabi/src/x.cpp", "geometry/x", "cpp/io/x"}  # x stands for a name


def main():
    project = pathlib.Path(sys.argv[1])
    named, missing = 0, []
    for readme in sorted((project / "cpp").rglob("README.md")):
        places = [readme.parent, readme.parent.parent, project / "cpp", project / "cpp/surface", project]
        for name in sorted(set(NAME.findall(readme.read_text()))):
            name = name.rstrip("/")
            named += 1
            if name not in PATTERNS and not any((place / (name + end)).exists() for place in places for end in ENDINGS):
                missing.append(f"{readme.relative_to(project)} names {name}, which does not exist")
    print("\n".join(missing) or f"{named} names, all of which exist")
    return 1 if missing or named < 50 else 0


if __name__ == "__main__":
    sys.exit(main())
