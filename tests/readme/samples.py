#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""samples.py README FOLDER: writes the blocks ```c, ```cpp and ```fortran of README as FOLDER/sample.c, .cpp and .f90, and those
that use carreau_cad as FOLDER/step.c, FOLDER/step.cpp and FOLDER/step.f90.

samples.py --links FILE...: every file that these pages link to exists.
"""
import os
import re
import sys


def block(text, language, of_cad):
    """The block of a language that does, or does not, use carreau_cad."""
    blocks = [block for block in re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
              if ("include <carreau_cad" in block or "use carreau_cad" in block) == of_cad]
    if len(blocks) != 1:
        sys.exit(f"{len(blocks)} blocks of {language} in README where 1 is expected")
    return blocks[0]


def write(text, folder, name):
    """The programs of a bowl as <name>.c, .cpp, .f90 in a folder, those that mesh a STEP file as step.c and so on."""
    for language, suffix in (("c", ".c"), ("cpp", ".cpp"), ("fortran", ".f90")):
        for stem in (name, "step"):
            with open(os.path.join(folder, stem + suffix), "w", encoding="utf-8") as file:
                file.write(block(text, language, stem == "step"))


def missing_links(page):
    """A sentence on the links of a page that lead nowhere, or ""."""
    with open(page, encoding="utf-8") as file:
        prose = re.sub(r"^```.*?^```$", "", file.read(), flags=re.MULTILINE | re.DOTALL)  # [](...) is C++, too
    links = re.findall(r"\]\((?!https?:|#)([^)#]+)(?:#[^)]*)?\)", prose)
    folder = os.path.dirname(os.path.abspath(page))
    missing = [link for link in links if not os.path.exists(os.path.join(folder, link))]
    return f"{page} links to files that do not exist: {missing}" if missing else ""


def main():
    if sys.argv[1] == "--links":
        sys.exit("\n".join(missing_links(page) for page in sys.argv[2:]).strip() or 0)
    with open(sys.argv[1], encoding="utf-8") as file:
        text = file.read()
    os.makedirs(sys.argv[2], exist_ok=True)
    write(text, sys.argv[2], "sample")


if __name__ == "__main__":
    main()
