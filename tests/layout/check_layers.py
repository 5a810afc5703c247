# SPDX-License-Identifier: BSD-3-Clause
"""The layers of cpp/ and of the command: no include runs upwards, no folders include each other, each type has a name of its own, and algorithms do not name processes. CONTRIBUTING.md lists the rooms, each of which may use the rooms before it."""

import pathlib
import re
import sys

from circles import circles

MOST_FILES = 25  # in a folder: a reader does not take in more at a glance
MOST_LINES = 500  # of a source of the trees
PROCESSES = ("support/ranks/", "pipeline/", "session/")  # rooms that name the processes of a run; others pass an Executor on


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


def includes(tree):
    """Pairs of a file and a file that it includes, both of the tree."""
    for file in sorted(tree.rglob("*")):
        if file.suffix in {".h", ".cpp"}:
            for included in re.findall(r'^#include "([^"]+)"', file.read_text(), re.M):
                if (tree / included).is_file():
                    yield file.relative_to(tree).parts, pathlib.PurePath(included).parts


def folder_circles(tree):
    """Folders that include each other: by the files of each folder alone, and by whole sub-folders of one folder."""
    alone, together = {}, {}
    for file, included in includes(tree):
        folder, other = "/".join(file[:-1]), "/".join(included[:-1])
        if folder == other:
            continue
        alone.setdefault(folder, set()).add(other)
        common = 0
        while common < min(len(file), len(included)) - 1 and file[common] == included[common]:
            common += 1
        parts = [path[common] if common < len(path) - 1 else "." for path in (file, included)]
        together.setdefault("/".join(file[:common]), {}).setdefault(parts[0], set()).add(parts[1])
    yield from circles(alone)
    for folder, graph in together.items():
        for group in circles(graph):
            yield [f"{folder}/{part}" for part in group]


def types_by_name(tree):
    """Files that define each type of a namespace that has a name: two of one name are one type for the linker."""
    found = {}
    for file in sorted(tree.rglob("*")):
        if file.suffix not in {".h", ".cpp"}:
            continue
        inside = []
        for line in file.read_text().splitlines():
            if opened := re.match(r"namespace\s*([\w:]*)\s*\{", line):
                inside.append(opened.group(1))
            elif inside and re.match(r"\}\s*// namespace", line):
                inside.pop()
            elif inside and "" not in inside and (defined := re.match(r"(?:struct|class|enum class)\s+(\w+)(?: final)?(?: :[^:].*)?\s*\{", line)):
                found.setdefault("::".join([*inside, defined.group(1)]), set()).add(str(file.relative_to(tree)))
    return found


def complaints(root, name, rooms):
    tree = root / name
    for defined, files in types_by_name(tree).items():
        if len(files) > 1:
            yield f"{name} defines {defined} more than once: " + ", ".join(sorted(files))
    for group in folder_circles(tree):
        yield f"folders of {name} include each other: " + ", ".join(group)
    for file in sorted(tree.rglob("*")):
        if file.is_dir():
            count = sum(1 for f in file.iterdir() if f.suffix in {".h", ".cpp"})
            if count > MOST_FILES:
                yield f"{file.relative_to(root)} holds {count} sources; {MOST_FILES} at most"
        if file.suffix not in {".h", ".cpp"}:
            continue
        path = file.relative_to(tree).as_posix()
        text = file.read_text()
        if (lines := text.count("\n")) > MOST_LINES:
            yield f"{name}/{path} has {lines} lines; {MOST_LINES} at most"
        if name == "cpp" and not path.startswith(PROCESSES) and re.search(r"\bTeam\b|[.>]team\b", re.sub(r"//.*", "", text)):
            yield f"{name}/{path} names a team of processes; algorithms pass an Executor on"
        rank = room_of(path, rooms)
        if rank is None:
            yield f"{name}/{path} is in no room that CONTRIBUTING.md lists"
            continue
        for included in re.findall(r'^#include "([^"]+)"', text, re.M):
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
