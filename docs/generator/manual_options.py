#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""manual_options.py CARREAU [--check]: writes the section OPTIONS of the manual pages docs/man/carreau-*.1 from the help of CARREAU: the same groups,
order and lines, with the paragraphs of manual_details.txt. --check: fails if a page differs."""
import glob
import os
import re
import subprocess
import sys

DOCS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OPTION = re.compile(r"--?[a-z][a-z-]*")


def details():
    """Paragraphs for a command and an option: blocks that begin with a line [COMMAND... OPTION]."""
    found = {}
    with open(os.path.join(DOCS, "generator", "manual_details.txt"), encoding="utf-8") as file:
        blocks = re.findall(r"^\[([^\]]*)\]\n(.*?)(?=^\[|\Z)", file.read(), re.M | re.S)
    for head, text in blocks:
        *commands, option = head.split()
        for command in commands:
            found[command, option] = " ".join(text.split())
    return found


def roff(text):
    """Plain text, its options bold."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    text = re.sub(r"(?<![\w-])(\\-(?:\\-)?[a-z][a-z]*(?:\\-[a-z]+)*)", r"\\fB\1\\fR", text)
    text = re.sub(r"'", r"\\(aq", text)
    return "\\&" + text if text.startswith(".") else text


def groups(program, command):
    """Title, and names, value and line of each option, as help prints them."""
    text = subprocess.run([program, command, "--help-all"], capture_output=True, text=True, check=True).stdout
    found = []
    for line in text.splitlines():
        if re.fullmatch(r"[A-Z][\w ]*:", line) and line != "Positionals:":
            found.append((line[:-1], []))
        elif line.startswith("  -") and found:
            names, _, rest = line.strip().partition("  ")
            words = names.split(" ", 1)
            found[-1][1].append((words[0].split(","), words[1] if len(words) > 1 else "", rest.strip()))
    return [(title, options) for title, options in found if options]


def section(program, command, paragraphs):
    lines = [".SH OPTIONS"]
    for title, options in groups(program, command):
        lines.append(f".SS {title}")
        for names, value, line in options:
            shown = ", ".join(f"\\fB{name}\\fR" for name in names).replace("-", "\\-")
            lines += [".TP", shown + (f" \\fI{value}\\fR" if value else "").replace("-", "\\-"), roff(line) + "."]
            more = paragraphs.get((command, names[-1])) or paragraphs.get((command, names[0]))
            if more:
                lines.append(roff(more))
    return "\n".join(lines) + "\n"


def main():
    program, paragraphs, different = sys.argv[1], details(), []
    for path in sorted(glob.glob(os.path.join(DOCS, "man", "carreau-*.1"))):
        command = re.search(r"carreau-(\w+)\.1$", path).group(1)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        begin = text.index(".SH OPTIONS\n")
        end = text.index("\n.SH ", begin) + 1
        made = text[:begin] + section(program, command, paragraphs) + text[end:]
        if made != text:
            different.append(path)
            if "--check" not in sys.argv:
                with open(path, "w", encoding="utf-8") as file:
                    file.write(made)
    if "--check" in sys.argv and different:
        sys.exit(f"these pages do not have the options that help prints; run docs/generator/manual_options.py: {different}")


if __name__ == "__main__":
    main()
