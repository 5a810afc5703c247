# SPDX-License-Identifier: BSD-3-Clause
"""The layers of cpp/: no include runs upwards. CONTRIBUTING.md lists the rooms, each of which may use those before it."""

import pathlib
import re
import sys

MOST_FILES = 25  # in a folder: more are not taken in at a glance


def listed_rooms(contributing):
    """Rooms in their order: folders of cpp/, or single files without their suffix, the longest match counting."""
    block = re.search(r"```layers\n(.*?)```", contributing, re.S)
    if block is None:
        raise SystemExit("CONTRIBUTING.md has no block of layers")
    return [room for line in block[1].splitlines() for room in line.split("#")[0].split()]


def room_of(path, rooms):
    """Rank of the room that holds a file, None when no room does."""
    stem = path.rsplit(".", 1)[0]
    ranks = [i for i, room in enumerate(rooms) if stem == room or path.startswith(room + "/")]
    return max(ranks, key=lambda i: len(rooms[i]), default=None)


def complaints(root):
    rooms = listed_rooms((root / "CONTRIBUTING.md").read_text())
    engine = root / "cpp"
    for file in sorted(engine.rglob("*")):
        if file.is_dir():
            count = sum(1 for f in file.iterdir() if f.suffix in {".h", ".cpp"})
            if count > MOST_FILES:
                yield f"{file.relative_to(root)} holds {count} sources; {MOST_FILES} at most"
        if file.suffix not in {".h", ".cpp"}:
            continue
        path = file.relative_to(engine).as_posix()
        rank = room_of(path, rooms)
        if rank is None:
            yield f"cpp/{path} is in no room that CONTRIBUTING.md lists"
            continue
        for included in re.findall(r'^#include "([^"]+)"', file.read_text(), re.M):
            if not (engine / included).is_file():
                yield f"cpp/{path} includes {included}, which is not of the engine"
            elif (other := room_of(included, rooms)) is None or other > rank:
                yield f"cpp/{path} includes {included}, of a room that comes later"


def main():
    found = list(complaints(pathlib.Path(sys.argv[1])))
    print("\n".join(found) or "no include runs upwards")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
