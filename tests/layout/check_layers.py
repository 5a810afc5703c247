# SPDX-License-Identifier: BSD-3-Clause
"""The layers of cpp/ and of the command: no include runs upwards. CONTRIBUTING.md lists the rooms, each of which may use the rooms before it."""

import pathlib
import re
import sys

MOST_FILES = 25  # in a folder: a reader does not take in more at a glance


def listed_trees(contributing):
    """Pairs of a folder and its rooms in their order: folders, or single files without their suffix. The longest match counts."""
    blocks = re.findall(r"```layers (\S+)\n(.*?)```", contributing, re.S)
    if not blocks:
        raise SystemExit("CONTRIBUTING.md has no block of layers")
    return [(tree, [room for line in block.splitlines() for room in line.split("#")[0].split()]) for tree, block in blocks]


def room_of(path, rooms):
    """Rank of the room that holds a file, None when no room does."""
    stem = path.rsplit(".", 1)[0]
    ranks = [i for i, room in enumerate(rooms) if stem == room or path.startswith(room + "/")]
    return max(ranks, key=lambda i: len(rooms[i]), default=None)


def complaints(root, name, rooms):
    tree = root / name
    for file in sorted(tree.rglob("*")):
        if file.is_dir():
            count = sum(1 for f in file.iterdir() if f.suffix in {".h", ".cpp"})
            if count > MOST_FILES:
                yield f"{file.relative_to(root)} holds {count} sources; {MOST_FILES} at most"
        if file.suffix not in {".h", ".cpp"}:
            continue
        path = file.relative_to(tree).as_posix()
        rank = room_of(path, rooms)
        if rank is None:
            yield f"{name}/{path} is in no room that CONTRIBUTING.md lists"
            continue
        for included in re.findall(r'^#include "([^"]+)"', file.read_text(), re.M):
            if not (tree / included).is_file():
                yield f"{name}/{path} includes {included}, which is not in {name}"
            elif (other := room_of(included, rooms)) is None or other > rank:
                yield f"{name}/{path} includes {included}, of a room that comes later"


def main():
    root = pathlib.Path(sys.argv[1])
    trees = listed_trees((root / "CONTRIBUTING.md").read_text())
    found = [complaint for name, rooms in trees for complaint in complaints(root, name, rooms)]
    print("\n".join(found) or "no include runs upwards")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
