# SPDX-License-Identifier: BSD-3-Clause
"""Calls of functions in programs that tests run, each with the few lines around it."""
import os
import re
import textwrap
from dataclasses import dataclass

AROUND = 3  # lines before and behind a call, at most

# In the order in which they are preferred: programs to read first, then tests. Pages have programs in blocks with a name.
C = ["docs/tutorials", "docs/how-to", "docs", "fortran_examples/c_paraboloid", "fortran_examples/c_torus", "fortran_examples", "tests/cabi/hosts.c", "tests/cabi/c_reference.c",
     "tests/cabi", "tests/adapters", "tests/mpi", "cad_adapters/command", "cad_adapters/bl2d"]
FORTRAN = ["docs/tutorials", "docs/how-to", "docs", "fortran_examples", "tests/cabi", "tests/adapters", "cabi/fortran/blsurf.f90", "cabi/fortran/blsurf_m.f90"]
CPP = ["docs/tutorials", "docs/how-to", "docs", "fortran_examples", "tests/cabi", "tests/cpp_wrapper"]
PYTHON = ["docs/tutorials", "docs/how-to", "docs", "cabi/python/examples", "tests/python"]
LANGUAGES = {"c": (C, (".c", ".cpp", ".h", ".md")), "fortran": (FORTRAN, (".f90", ".md")), "cpp": (CPP, (".cpp", ".md")), "python": (PYTHON, (".py", ".md"))}


@dataclass
class Example:
    path: str
    line: int
    text: str


def files_below(root, places, suffixes):
    found = []
    for place in places:
        path = os.path.join(root, place)
        if os.path.isfile(path):
            found.append(place)
        for folder, folders, names in os.walk(path):
            folders.sort()
            found += [os.path.relpath(os.path.join(folder, name), root) for name in sorted(names) if name.endswith(suffixes)]
    return list(dict.fromkeys(found))


def programs_of(page, language):
    """The lines of a page, those outside of its programs (blocks with a name) empty."""
    inside, lines = False, []
    for line in page.split("\n"):
        fence = line.startswith("```")
        inside = line.startswith(f"```{{code-block}} {language}") or inside and not fence
        lines.append("" if fence or not inside or line.startswith(":caption:") else line)
    return lines


class Calls:
    """language: a key of LANGUAGES."""

    def __init__(self, root, language):
        places, suffixes = LANGUAGES[language]
        self.texts = {}
        for path in files_below(root, places, suffixes):
            with open(os.path.join(root, path), encoding="utf-8") as file:
                text = file.read()
            self.texts[path] = programs_of(text, language) if path.endswith(".md") else text.split("\n")
        self.index = {}
        word = r"\b\w+(?=\s*\()" + (r"|(?<=call )\w+" if language == "fortran" else "")
        for path, lines in self.texts.items():
            for number, line in enumerate(lines):
                for name in set(re.findall(word, line.split("//")[0])):
                    self.index.setdefault(name.lower(), []).append((path, number))
        self.fortran = language == "fortran"

    def find(self, name):
        """The first call in the order of preference that is one statement's worth of reading, or None."""
        for path, number in self.index.get(name.lower(), []):
            lines = self.texts[path]
            if self._is_call(lines[number], name):
                return Example(path, number + 1, self._around(lines, number))
        return None

    def _is_call(self, line, name):
        declares = r"^\s*(?:end\s+)?(?:subroutine|function|type|interface|procedure|public|\w[\w\(\)]*\s+function)\b" if self.fortran \
            else rf"^(?:static |extern |typedef |CARREAU)?[\w\s\*]*\b{name}\s*\([^)]*\)\s*\{{?$|^\s*(?://|\*|#)"
        return not re.search(declares, line, re.I)

    @staticmethod
    def _around(lines, number):
        """No further than an empty line or the end of a function."""
        ends = re.compile(r"^\s*$|^\}|^\s*end (?:subroutine|function|program)|^(?:TEST|int main|static |extern |template)")
        begin = end = number
        while begin > 0 and number - begin < AROUND and not ends.search(lines[begin - 1]):
            begin -= 1
        while end + 1 < len(lines) and end - number < AROUND and not ends.search(lines[end + 1]):
            end += 1
        return textwrap.dedent("\n".join(lines[begin:end + 1]))
