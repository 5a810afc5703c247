#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""stage.py FOLDER: writes the input of Sphinx there: the pages of docs/, README and similar files, READMEs of folders, and manual pages.
Also writes the reference of each interface from its sources, and listings of the programs that pages name."""
import os
import shutil
import subprocess
import sys

import c_pages
import cpp_pages
import fortran_pages
import python_pages
from examples import Calls
from interfaces import CPP_HEADERS, HEADERS, MODULES, PYTHON_PACKAGE, ROOT, Interfaces
from links import Places, markdown_page
from text import Names, heading

SKIPPED = {"build", "out", ".git", "generator", "__pycache__"}
LANGUAGES = {".c": "c", ".h": "c", ".cpp": "cpp", ".hpp": "cpp", ".f90": "fortran", ".py": "python", ".sh": "sh", ".cmake": "cmake"}


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


class Stage:
    def __init__(self, folder):
        self.folder = folder
        self.places = Places(ROOT, HEADERS, MODULES)
        shutil.rmtree(folder, ignore_errors=True)

    def write(self, page, text):
        path = os.path.join(self.folder, page)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def write_lines(self, pages, folder):
        for page, lines in pages.items():
            self.write(f"{folder}/{page}.rst", "\n".join(lines) + "\n")

    def markdown(self):
        """All pages of Markdown, and the pictures beside the pages of docs/."""
        for folder, folders, names in os.walk(ROOT):
            folders[:] = sorted(name for name in folders if name not in SKIPPED and not name.startswith(("build-", ".")) and
                                not os.path.exists(os.path.join(folder, name, "CMakeCache.txt")))  # a build, whatever its name
            for name in sorted(names):
                path = os.path.relpath(os.path.join(folder, name), ROOT)
                if name.endswith(".md"):
                    self.write(markdown_page(path), self.places.rewritten(read(path), path))
                elif path.startswith("docs/") and name.endswith((".png", ".svg")):
                    target = os.path.join(self.folder, path.removeprefix("docs/"))
                    os.makedirs(os.path.dirname(target), exist_ok=True)
                    shutil.copy(os.path.join(ROOT, path), target)

    def manual(self):
        """Manual pages as man shows them."""
        names = sorted(os.listdir(os.path.join(ROOT, "docs/man")))
        for name in names:
            shown = subprocess.run(["groff", "-man", "-Tutf8", "-P-cbou", "-rLL=110n"], input=read(f"docs/man/{name}"), text=True, capture_output=True, check=True,
                                   env=os.environ | {"GROFF_NO_SGR": "1"})
            lines = heading(name.removesuffix(".1")) + [".. code-block:: text", ""] + ["   " + line.rstrip() for line in shown.stdout.strip("\n").split("\n")]
            self.write(f"reference/command/{name}.rst", "\n".join(lines) + "\n")
        self.write("reference/command/index.rst", "\n".join(heading("Commands and files") + [".. toctree::", ""] + [f"   {name}" for name in names]) + "\n")

    def reference(self):
        interfaces = Interfaces()
        parts = ["c/index", "fortran/index"]
        c_roles, fortran_roles = c_pages.roles_of(interfaces.headers.values()), fortran_pages.roles_of(interfaces.modules)
        pages = c_pages.CPages(Names(c_roles, interfaces.statuses), Calls(ROOT, "c"), self.places.listings)
        for header, source in interfaces.headers.items():
            self.write_lines(pages.header(header, source), "reference/c")
        self.index("reference/c", "C", [header.removesuffix(".h") for header in interfaces.headers],
                   "A header for each subject. The rules in :doc:`carreau/index` hold for all of them.")
        pages = fortran_pages.FortranPages(Names(c_roles | fortran_roles, interfaces.statuses), interfaces.c, interfaces.members,
                                           Calls(ROOT, "fortran"), self.places.listings)
        for module in interfaces.modules:
            self.write_lines(pages.module(module), "reference/fortran")
        self.index("reference/fortran", "Fortran", [module.name for module in interfaces.modules],
                   "Fortran 2003 modules with the names of C. What C says of a routine is repeated here: in Fortran indices count from 1 "
                   "and arrays are turned round, so that *n x 3* is ``(3, n)``.")
        if os.path.exists(os.path.join(ROOT, CPP_HEADERS[0])):
            parts.insert(1, "cpp/index")
            cpp_pages.stage(self, CPP_HEADERS, Calls(ROOT, "cpp"))
        if os.path.isdir(os.path.join(ROOT, PYTHON_PACKAGE)):
            parts.append("python/index")
            python_pages.stage(self, PYTHON_PACKAGE, Names(c_roles, interfaces.statuses), Calls(ROOT, "python"))
        self.manual()
        self.index("reference", "Reference", [part.removesuffix("/index") for part in parts + ["command/index"]],
                   "Made from the sources: the headers, the modules, the manual pages. The code below a function is from a program that the tests run.")

    def index(self, folder, title, names, text):
        lines = heading(title) + [text, "", ".. toctree::", "   :maxdepth: 2", ""] + [f"   {name}/index" for name in names]
        self.write(f"{folder}/index.rst", "\n".join(lines) + "\n")

    def rooms(self):
        """The READMEs of folders, for readers of the code."""
        pages = sorted(os.path.relpath(os.path.join(folder, name), os.path.join(self.folder, "code"))
                       for folder, _, names in os.walk(os.path.join(self.folder, "code")) for name in names)
        lines = heading("The code, folder by folder") + [".. toctree::", "   :maxdepth: 1", "", "   ../contributing"]
        self.write("code/index.rst", "\n".join(lines + ["   " + page.removesuffix(".md") for page in pages]) + "\n")

    def listing(self):
        """The files that pages link to."""
        for path in sorted(self.places.listings):
            name = os.path.basename(path)
            self.write(f"listings/{path}", read(path))
            language = LANGUAGES.get(os.path.splitext(name)[1], "text")
            self.write(f"listings/{path}.rst", "\n".join([":orphan:", ""] + heading(path) + [f".. literalinclude:: {name}", f"   :language: {language}", "   :linenos:", ""]))


def main():
    stage = Stage(sys.argv[1])
    stage.markdown()
    stage.reference()
    stage.rooms()
    stage.listing()


main()
