#!/usr/bin/env python3
"""samples.py README FOLDER: writes the blocks ```c and ```fortran of README as FOLDER/sample.c and FOLDER/sample.f90.

samples.py --links FILE...: every file that these pages link to exists.
"""
import os
import re
import sys


def block(text, language):
    blocks = re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
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
    for language, suffix in (("c", "c"), ("fortran", "f90")):
        with open(os.path.join(sys.argv[2], "sample." + suffix), "w", encoding="utf-8") as file:
            file.write(block(text, language))


main()
