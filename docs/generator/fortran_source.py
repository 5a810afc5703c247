# SPDX-License-Identifier: BSD-3-Clause
"""The public entities of a Fortran module of the library, each with the comment (`!>`, `!!`) above it."""
import re
from dataclasses import dataclass, field

HEADS = re.compile(r"^ *(?:pure |elemental |recursive )*(subroutine|function) (\w+)", re.I)
DECLARATION = re.compile(r"^\s*((?:integer|real|logical|character|type|class|procedure)\b.*?)\s*::\s*(.*)$", re.I)


@dataclass
class Component:
    name: str
    type: str
    text: list


@dataclass
class Entity:
    """kind: subroutine, function, type, callback, constant. parts: components of a type, arguments of a procedure."""
    kind: str
    name: str
    section: str
    text: list
    line: int
    signature: str = ""
    parts: list = field(default_factory=list)


def joined(lines):
    """[(number of its first line, line)] with continuations joined; comments stay."""
    out = []
    for number, line in enumerate(lines, 1):
        if out and out[-1][1].rstrip().endswith("&") and "!" not in out[-1][1].split("'")[0].split('"')[0]:
            out[-1] = (out[-1][0], out[-1][1].rstrip()[:-1].rstrip() + " " + line.strip())
        else:
            out.append((number, line))
    return out


def split_names(text):
    """Names of a declaration, commas inside brackets left alone: [("xyz", "(:, :)")]."""
    found = []
    for part in re.findall(r"(?:[^,(]|\((?:[^()]|\([^()]*\))*\))+", text.split("!")[0]):
        match = re.match(r"\s*(\w+)\s*((?:\((?:[^()]|\([^()]*\))*\))?)", part)
        if match:
            found.append(match.groups())
    return found


class Module:
    """name, intro (lines above it), entities in order."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.lines = joined(file.read().split("\n"))
        self.intro, self.entities, self.public, self.name = [], [], set(), ""
        self._read()
        order = {"callback": 0, "type": 1, "constant": 2}
        self.entities = [entity for entity in self.entities if entity.kind == "constant" or entity.name.lower() in self.public]
        self.entities.sort(key=lambda entity: order.get(entity.kind, 3))

    def _read(self):
        text, section, inside, i = [], "", False, 0
        while i < len(self.lines):
            number, line = self.lines[i]
            comment = re.match(r"\s*!(?:>|!)\s?(.*)", line)
            head = HEADS.match(line)
            if comment:
                text.append(comment.group(1).rstrip())
            elif re.match(r"\s*! ---- (.*) ----", line):
                section = re.match(r"\s*! ---- (.*) ----", line).group(1)
            elif re.match(r"module \w+$", line.strip()) and not self.name:
                self.name, self.intro, text = line.split()[1], text, []
            elif re.match(r"\s*public ::", line):
                self.public |= {name.strip().lower() for name in line.split("::")[1].split(",")}
            elif re.match(r"\s*(abstract )?interface\s*$", line):
                inside = True
            elif re.match(r"\s*end interface", line):
                inside = False
            elif re.match(r"\s*type(?:, .*)? :: \w+\s*$", line):
                i = self._type(i, text, section)
                text = []
            elif head:
                i = self._procedure(i, head, text, section, inside)
                text = []
            elif re.search(r"parameter, public ::", line):
                self._constants(line, text, number)
                text = []
            elif line.strip():
                text = []
            i += 1

    def _type(self, i, text, section):
        number, line = self.lines[i]
        entity = Entity("type", line.split("::")[1].strip(), section, text, number)
        if re.search(r"\bpublic\b", line.split("::")[0]):
            self.public.add(entity.name.lower())
        while not re.match(r"\s*end type", self.lines[i + 1][1]):
            i += 1
            line = self.lines[i][1]
            declared = DECLARATION.match(line)
            own = re.search(r"!< ?(.*)$", line)
            if declared:
                for name, shape in split_names(declared.group(2)):
                    entity.parts.append(Component(name, f"{declared.group(1)} :: {name}{shape}", [own.group(1)] if own else []))
        self.entities.append(entity)
        return i + 1

    def _procedure(self, i, head, text, section, inside):
        number, line = self.lines[i]
        kind, name = head.group(1).lower(), head.group(2)
        arguments = re.search(r"\(([^)]*)\)", line[head.end():])
        result = re.search(r"result\((\w+)\)", line)
        names = [argument.strip() for argument in arguments.group(1).split(",") if argument.strip()] if arguments else []
        entity = Entity("callback" if inside else kind, name, section, text, number)
        types = {}
        while not re.match(rf"\s*end {kind} {name}\b", self.lines[i + 1][1], re.I):
            i += 1
            declared = DECLARATION.match(self.lines[i][1])
            if declared:
                for argument, shape in split_names(declared.group(2)):
                    types.setdefault(argument.lower(), f"{declared.group(1)} :: {argument}{shape}")
        wanted = names + ([result.group(1)] if result else [])
        entity.parts = [Component(argument, types.get(argument.lower(), ""), []) for argument in wanted]
        entity.signature = f"{name}({', '.join(names)})" + (f" result({result.group(1)})" if result else "")
        self.entities.append(entity)
        return i + 1

    def _constants(self, line, text, number):
        for part in line.split("::", 1)[1].split(","):
            name, _, value = part.partition("=")
            self.entities.append(Entity("constant", name.strip(), "", text, number, signature=value.split("!")[0].strip()))
