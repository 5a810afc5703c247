# SPDX-License-Identifier: BSD-3-Clause
"""Listings of commands, each after `$ `, with their output; … stands for any lines."""
import re
import sys

def same(shown, printed):
    """Times, and how many threads a machine has, differ from run to run."""
    if shown.startswith("seconds") and printed.startswith("seconds"):
        shown, printed = (re.sub(r"[\d.]+|threads?", "#", line) for line in (shown, printed))
    return shown.rstrip() == printed.rstrip()


def matches(shown, printed):
    """Lines of a listing, in which ... stands for any lines."""
    if not shown:
        return not printed
    if shown[0] == "…":
        return any(matches(shown[1:], printed[k:]) for k in range(len(printed) + 1))
    return bool(printed) and same(shown[0], printed[0]) and matches(shown[1:], printed[1:])


def refreshed(shown, printed):
    """Each line that differs in numbers only gets today's numbers."""
    def words(line):
        return re.sub(r"\d[\d.]*", "#", line)
    return [line if line == "…" or line in printed else next((p for p in printed if words(p) == words(line)), line) for line in shown]


def listing(block, text, run):
    """Runs the commands of a block of a page; the page, with the listings of today where they differ and --refresh is given."""
    at = [i for i, line in enumerate(block) if line.startswith("$ ")]
    for begin, end in zip(at, at[1:] + [len(block)]):
        shown, printed = block[begin + 1:end], run(block[begin][2:]).splitlines()
        if matches(shown, printed):
            continue
        if "--refresh" not in sys.argv:
            sys.exit("the page shows\n" + "\n".join(shown) + "\nand\n" + "\n".join(printed) + "\nis printed; --refresh changes the page")
        text = text.replace("\n".join(shown), "\n".join(refreshed(shown, printed)))
    return text
