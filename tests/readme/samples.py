#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""samples.py README FOLDER PAGE...: writes the block ```c of README as FOLDER/bowl.c, and each program of the pages under its name."""
import os
import re
import sys


def programs(page):
    """Name and text of each program of a page."""
    with open(page, encoding="utf-8") as file:
        return re.findall(r"^```\{code-block\} \w+\n:caption: (\S+)\n(.*?)^```$", file.read(), re.MULTILINE | re.DOTALL)


def write(readme, folder, pages):
    os.makedirs(folder, exist_ok=True)
    with open(readme, encoding="utf-8") as file:
        hosts = re.findall(r"^```c\n(.*?)^```$", file.read(), re.MULTILINE | re.DOTALL)
    if len(hosts) != 1:
        sys.exit(f"{len(hosts)} hosts in C in README where 1 is expected")
    for name, text in [("bowl.c", hosts[0])] + [program for page in pages for program in programs(page)]:
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)


if __name__ == "__main__":
    write(sys.argv[1], sys.argv[2], sys.argv[3:])
