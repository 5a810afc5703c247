#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""page.py PAGE WORK BUILD SOURCE PREFIX [--refresh]: runs every listing of a page of docs/ in order, in a folder that is empty at first. BUILD is installed
in PREFIX, and ~/carreau is the clone SOURCE.

    ```sh                    commands, run as they stand
    ```sh slow likewise; only with --slow
    ```console               commands after `$ `, and their output
    ```{code-block} c        with `:caption: bowl.c`: a file of that name
    ```text  ```json         content of a file or a program, not run
    ```cmake  ```python      run by other tests (commands.py, tests/python)

Another kind is an error. So is a picture of the page that its commands do not make (`img/x.png`: x.png), unless the
gallery has it. --refresh: writes the listings that differ into the page. --pictures: puts the pictures where the page
shows them, with 256 colours above 150 kB (Debian's pngquant)."""
import os
import re
import shutil
import subprocess
import sys

from listings import listing
from sandbox import Sandbox

BLOCK = re.compile(r"^```([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LARGEST = 150_000  # bytes of a picture
SHOWN = ("text", "json", "cmake", "python", "{toctree}", "{figure}", "{contents}")


def file_of(block):
    """Name and text of a file that a page shows."""
    caption = re.match(r":caption: (\S+)\n+", block)
    if not caption:
        sys.exit(f"a program without a name (`:caption: x.c`):\n{block}")
    return caption.group(1), block[caption.end():]


def pictures_of(block):
    return re.findall(r"[\w.]+\.(?:png|svg)", block)


def pictures_of_gallery(source):
    with open(os.path.join(source, "docs/gallery.md"), encoding="utf-8") as file:
        return re.findall(r"!\[[^\]]*\]\((?:\.\./)?(?:gallery/)?([^)/]+\.(?:png|svg))\)", file.read())


def show(page, sandbox, shown):
    for name in shown:
        made, target = os.path.join(sandbox.folder, os.path.basename(name)), os.path.join(os.path.dirname(os.path.abspath(page)), name)
        if not os.path.exists(made):
            continue
        if made.endswith(".png") and os.path.getsize(made) > LARGEST:  # 256 colours will do
            subprocess.run(["pngquant", "--force", "--speed", "1", "--output", made, "256", made], check=True)
        if os.path.getsize(made) > LARGEST:
            sys.exit(f"{name} has {os.path.getsize(made)} bytes, more than {LARGEST}")
        shutil.copyfile(made, target)


def main():
    page, work, build, source, prefix = sys.argv[1:6]
    sandbox = Sandbox(work, build, source, prefix)
    with open(page, encoding="utf-8") as file:
        text = file.read()
    refreshed, run, later = text, 0, []
    for language, block in BLOCK.findall(text):
        if language == "sh" or language == "sh slow" and "--slow" in sys.argv:
            sandbox.run(block)
        elif language == "sh slow":
            later += pictures_of(block)
        elif language == "console":
            refreshed = listing(block.splitlines(), refreshed, sandbox.run)
        elif language.startswith("{code-block} "):
            sandbox.write(*file_of(block))
        elif language.split(" ")[0] not in SHOWN:
            sys.exit(f"{page}: ```{language} is a listing that nobody runs")
        run += language in ("sh", "console")
    shown = re.findall(r"!\[[^\]]*\]\((\S+\.(?:png|svg))\)", text)
    later += [] if page.endswith("gallery.md") else pictures_of_gallery(source)
    missing = [name for name in shown if not sandbox.size(os.path.basename(name)) and os.path.basename(name) not in later]
    if missing:
        sys.exit(f"{page}: no command makes {missing}")
    if "--pictures" in sys.argv:
        show(page, sandbox, shown)
    if refreshed != text:
        with open(page, "w", encoding="utf-8") as file:
            file.write(refreshed)
    print(f"{run} listings of {os.path.basename(page)} run")


main()
