#!/usr/bin/env python3
"""samples.py README FOLDER: writes the blocks ```c, ```cpp and ```fortran of README as FOLDER/sample.c, FOLDER/sample.f90, and those
that use carreau_cad as FOLDER/step.c, FOLDER/step.cpp and FOLDER/step.f90.

samples.py --links FILE...: every file that these pages link to exists.
"""
import os
import re
import sys


def block(text, language, of_cad):
    """The block of a language that does, or does not, use carreau_cad."""
    blocks = [block for block in re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
              if ("carreau_cad_open" in block) == of_cad]
    if len(blocks) != 1:
        sys.exit(f"{len(blocks)} blocks of {language} in README where 1 is expected")
    return blocks[0]


def missing_links(page):
    """A sentence on the links of a page that lead nowhere, or ""."""
    with open(page, encoding="utf-8") as file:
        links = re.findall(r"\]\((?!https?:|#)([^)#]+)(?:#[^)]*)?\)", file.read())
    folder = os.path.dirname(os.path.abspath(page))
    missing = [link for link in links if not os.path.exists(os.path.join(folder, link))]
    return f"{page} links to files that do not exist: {missing}" if missing else ""


def main():
    if sys.argv[1] == "--links":
        sys.exit("\n".join(missing_links(page) for page in sys.argv[2:]).strip() or 0)
    with open(sys.argv[1], encoding="utf-8") as file:
        text = file.read()
    os.makedirs(sys.argv[2], exist_ok=True)
    for language, name in (("c", "sample.c"), ("fortran", "sample.f90"), ("c", "step.c"), ("cpp", "step.cpp"), ("fortran", "step.f90")):
        with open(os.path.join(sys.argv[2], name), "w", encoding="utf-8") as file:
            file.write(block(text, language, name.startswith("step")))


main()
