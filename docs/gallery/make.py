#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""make.py BUILD [PAGE]...: makes the pictures of the gallery and of the tutorials, or of the pages given, by the commands that stand above them.
BUILD: a build with tests, where the command and the libraries are up to date; they are installed in a folder that is removed again. Needs
Debian's pngquant and, for the wheel, python3-gmsh."""
import glob
import os
import subprocess
import sys
import tempfile

DOCS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SOURCE = os.path.dirname(DOCS)


def main():
    build = os.path.abspath(sys.argv[1])
    pages = sys.argv[2:] or [os.path.join(DOCS, "gallery.md")] + sorted(glob.glob(os.path.join(DOCS, "tutorials", "[!i]*.md")))
    with tempfile.TemporaryDirectory() as folder:
        prefix = os.path.join(folder, "P")
        subprocess.run(["cmake", "--install", build, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
        for page in pages:
            print(page, flush=True)
            subprocess.run([sys.executable, os.path.join(SOURCE, "tests/readme/page.py"), page, os.path.join(folder, "work"), build, SOURCE,
                            prefix, "--slow", "--pictures"], check=True)


main()
