#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""references.py SOURCE CARREAU: everything that a page (.md) or a manual page names exists: targets of links with their headings, files and folders of the
repository, manual pages, sub-commands and options of CARREAU."""
import glob
import os
import re
import subprocess
import sys

SOURCE, CARREAU = sys.argv[1:3]
FOLDERS = ("cpp", "cabi", "cad_adapters", "docs", "tests", "fortran_examples", "cmake")


def read(path):
    with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
        return file.read()


def pages():
    """All pages of the repository, builds and hidden folders left out."""
    found = []
    for folder, folders, names in os.walk(SOURCE):
        folders[:] = [name for name in folders if name not in ("build", "out") and not name.startswith((".", "build-")) and
                      not os.path.exists(os.path.join(folder, name, "CMakeCache.txt"))]
        found += [os.path.relpath(os.path.join(folder, name), SOURCE) for name in names if name.endswith(".md")]
    return sorted(found)


def parts(text):
    """The prose of a page and its listings."""
    fence = re.compile(r"^```([^\n]*)\n(.*?)^```$", re.M | re.S)
    return fence.sub("", text), fence.findall(text)


def anchors(text):
    """Headings as links name them."""
    headings = re.findall(r"^#+ (.*)$", parts(text)[0], re.M)
    return {re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()).replace(" ", "-") for heading in headings}


def broken_links(page, prose):
    for link in re.findall(r"\]\((?!https?:)([^)\s]+)\)", re.sub(r"`[^`]*`", "", prose)):
        file, _, anchor = link.partition("#")
        target = os.path.normpath(os.path.join(os.path.dirname(page), file)) if file else page
        if not os.path.exists(os.path.join(SOURCE, target)):
            yield f"the link {link} leads nowhere"
        elif anchor and target.endswith(".md") and anchor not in anchors(read(target)):
            yield f"{target} has no heading {anchor}"


def missing_files(page, prose):
    """Paths in code that begin with a folder of the repository, from its root or from the room of the page; x stands for a name."""
    for code in re.findall(r"`([^`\n]+)`", prose):
        path = re.match(rf"(?:~/carreau/)?((?:{'|'.join(FOLDERS)})/[\w./*-]+)$", code)
        if path and not re.search(r"/x(/|\.|$)", path.group(1)) and not any(glob.glob(os.path.join(base, path.group(1)) + suffix) for base in (SOURCE, os.path.join(SOURCE, os.path.dirname(page)), os.path.join(SOURCE, "cpp"))
                            for suffix in ("", ".h", ".cpp", "_test.cpp")):
            yield f"{path.group(1)} does not exist"


def help_of(command):
    """All options of a sub-command."""
    done = subprocess.run([CARREAU, command, "--help-all"], capture_output=True, text=True, check=False)
    text = done.stdout if done.returncode == 0 else subprocess.run([CARREAU, command, "--help"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", "\n".join(line.split("  ")[1] for line in text.splitlines() if re.match(r"  -", line))))


def options():
    text = subprocess.run([CARREAU, "--help"], capture_output=True, text=True, check=True).stdout
    commands = [line.split()[0] for line in text.split("ubcommands:\n")[1].split("\n\n")[0].splitlines()]
    return {command: help_of(command) | {"--help-all"} for command in commands}


KNOWN = options()
ALL = set().union(*KNOWN.values()) | {"--version"}


def unknown_options(code):
    """In a line of commands, or in code of the prose that is one option."""
    alone = re.match(r"(--[a-z][\w-]*)(?:[ =]|$)", code)
    if alone and alone.group(1) not in ALL:
        yield f"no command has the option {alone.group(1)}"
    for command, words in re.findall(r"(?<![\w/.~-])carreau ([a-z]+)((?:'[^']*'|\"[^\"]*\"|[^|;&#\n`'\"])*)", code):
        if command not in KNOWN:
            continue
        words = re.sub(r"'[^']*'|\"[^\"]*\"", "", words)
        for option in re.findall(r"(?<=\s)(--?[a-z][\w-]*)", words):
            if option not in KNOWN[command]:
                yield f"carreau {command} has no option {option}"


def of_page(page):
    prose, listings = parts(read(page))
    yield from broken_links(page, prose)
    yield from missing_files(page, prose)
    if "/" not in page or page.startswith("docs/"):
        for code in re.findall(r"`([^`\n]+)`", prose):
            yield from unknown_options(code)
        for language, block in listings:
            if language.split(" ")[0] in ("sh", "console", "text"):
                for line in block.replace("\\\n", "").splitlines():
                    yield from unknown_options("carreau " + line.split("carreau ", 1)[1] if "carreau " in line else "")


def of_manual(name):
    text = re.sub(r"\\f.", "", read(f"docs/man/{name}")).replace("\\-", "-").replace("\\(aq", "'")
    for page in re.findall(r"^\.BR ((?:carreau|blsurf|bl2d)[\w-]*) \(1\)", text, re.M):
        if not os.path.exists(os.path.join(SOURCE, f"docs/man/{page}.1")):
            yield f"there is no manual page {page}"
    for line in text.splitlines():
        yield from unknown_options(re.sub(r"^\.[BRI]+ ", "", line))


def main():
    found = [f"{page}: {sentence}" for page in pages() for sentence in of_page(page)]
    found += [f"docs/man/{name}: {sentence}" for name in sorted(os.listdir(os.path.join(SOURCE, "docs/man"))) for sentence in of_manual(name)]
    sys.exit("\n".join(found) or 0)


if __name__ == "__main__":
    main()
