#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every source file states its licence in one of its first lines, as SPDX requires. The top has no file that a run has written.

    check_spdx.py <project> [--add]    --add: writes the line where it is missing
"""
import argparse
import pathlib
import subprocess
import sys

TAG = "SPDX-License-Identifier: BSD-3-Clause"
LINES = 4  # a script has its interpreter first, an encoding may follow
SLASHES, HASH, STARS, BANG, MARKUP = "// {}", "# {}", "/* {} */", "! {}", "<!-- {} -->"
COMMENTS = {".cpp": SLASHES, ".h": STARS, ".hpp": SLASHES, ".c": STARS, ".js": SLASHES, ".css": STARS, ".html": MARKUP, ".f90": BANG,
            ".f": "C {}", ".py": HASH, ".sh": HASH, ".cmake": HASH, ".toml": HASH, ".map": STARS}
TOP = {"CHANGELOG.md", "CMakeLists.txt", "CMakePresets.json", "CONTRIBUTING.md", "LICENSE", "README.md"}
NAMES = {"CMakeLists.txt": HASH, "rules": HASH, "run": HASH}


def tracked(project):
    """Names of the files of the repository; none of an archive without its history."""
    listed = subprocess.run(["git", "-C", project, "ls-files", "-z"], capture_output=True, text=True)
    return [name for name in listed.stdout.split("\0") if name] if listed.returncode == 0 else []


def sources(project):
    names = tracked(project)
    if not names:
        names = [str(p.relative_to(project)) for p in pathlib.Path(project).rglob("*") if p.is_file() and "build" not in p.parts]
    for name in sorted(names):
        path = pathlib.Path(project, name)
        comment = NAMES.get(path.name) or COMMENTS.get(path.suffix)
        if comment and path.is_file() and path.stat().st_size > 0 and "tests/data/" not in path.as_posix():
            yield path, comment


def add(path, comment):
    lines = path.read_text().split("\n")
    if comment == STARS and lines[0].startswith("//"):
        comment = SLASHES
    first = 1 if lines[0].startswith(("#!", "<!DOCTYPE", "<!doctype")) else 0
    path.write_text("\n".join(lines[:first] + [comment.format(TAG)] + lines[first:]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("project")
    parser.add_argument("--add", action="store_true")
    args = parser.parse_args()
    checked, missing = 0, []
    for path, comment in sources(args.project):
        checked += 1
        if TAG not in "\n".join(path.read_text().split("\n")[:LINES]):
            missing.append((path, comment))
    for path, comment in missing:
        if args.add:
            add(path, comment)
        else:
            print(f"{path}: no line {TAG}")
    print(f"{checked} files, {len(missing)} without")
    strays = [name for name in tracked(args.project) if "/" not in name and name not in TOP and not name.startswith(".")]
    for name in strays:
        print(f"{name}: does not belong to the top of the project")
    return 1 if (missing and not args.add) or strays or checked < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
