# SPDX-License-Identifier: BSD-3-Clause
"""The declarations of a header of the C interface, in order, each with its comment.

The headers follow one style: `/* ---- X ---- */` begins a section. A comment is about all declarations that follow it without
an empty line or another comment between. If nothing follows a comment, it is about its section.
"""
import re
from dataclasses import dataclass, field

SECTION = re.compile(r"/\* ---- (.*?) ---- \*/")
TOKEN = re.compile(r"""
    (?P<comment>/\*.*?\*/)
  | (?P<table>\#define\ CARREAU_\w+_TABLE\(X\)(?:[^\n]*\\\n)*[^\n]*)
  | (?P<macro>\#define\ (?P<macro_name>CARREAU_\w+)\ (?P<macro_value>\S[^\n]*?)(?=\s*(?:/\*|\n)))
  | (?P<struct>typedef\ struct\ (?P<struct_name>\w+)\ \{(?P<body>.*?)\n\}\s*\w+\s*;)
  | (?P<opaque>typedef\ struct\ (?P<opaque_name>\w+)\ \w+\s*;)
  | (?P<callback>typedef\ [\w\s\*]+?\(\*(?P<callback_name>\w+)\)\s*\(.*?\)\s*;)
  | (?P<plain>typedef\ \w+\ (?P<plain_name>\w+)\s*;)
  | (?P<enum>enum\ \{(?P<enum_body>.*?)\};)
  | (?P<function>CARREAU(?:_CAD)?_API\s+[^;]*?\b(?P<function_name>carreau_\w+)\s*\([^;]*?\)\s*;)
  | (?P<other>\#[^\n]*(?:\\\n[^\n]*)*|\}[^\n]*|extern[^\n]*)
""", re.S | re.X)
ERRORS = re.compile(r"\bErrors?\b")


@dataclass
class Member:
    name: str
    declaration: str
    text: list


@dataclass
class Entity:
    """kind: function, struct, opaque, callback, enum, macro, statuses, plain. text: the lines of its comment. before: lines of comments
    above in the same block, which hold for it too. first: the first entity of the same comment."""
    kind: str
    name: str
    declaration: str
    line: int
    text: list = field(default_factory=list)
    before: list = field(default_factory=list)
    members: list = field(default_factory=list)
    first: "Entity" = None

    @property
    def returns_status(self):
        return self.kind == "function" and self.declaration.startswith("carreau_status ")


@dataclass
class Section:
    """items: entities, and lists of lines, which are comments about the section."""
    title: str
    items: list = field(default_factory=list)

    @property
    def entities(self):
        return [item for item in self.items if isinstance(item, Entity)]

    @property
    def rules(self):
        return [item for item in self.items if isinstance(item, list)]


def comment_lines(comment):
    """The lines of a comment without its stars, empty ones at its ends dropped."""
    lines = [re.sub(r"^\s*\*? ?" if i else r"^ ", "", line).rstrip() for i, line in enumerate(comment[2:-2].split("\n"))]
    while lines and not lines[0].strip():
        lines.pop(0)
    while lines and not lines[-1].strip():
        lines.pop()
    return lines


def one_line(declaration):
    text = re.sub(r"/\*.*?\*/", " ", declaration, flags=re.S)
    text = " ".join(re.sub(r"CARREAU(?:_CAD)?_API", "", text).split())
    return re.sub(r"\( | \)", lambda bracket: bracket.group(0).strip(), text).rstrip(";").strip()


def flowing(comment):
    """A comment inside a struct or enum as one paragraph."""
    return [" ".join(" ".join(comment_lines(comment)).split())]


def separated(body, separator):
    """[(declaration, comment)] of a body: a comment on the line where a declaration ends is about it, one above about what follows."""
    found, above, place = [], [], 0
    pattern = re.compile(r"\s*(?:(/\*.*?\*/)|((?:[^;,/()]|\([^)]*\)" + ("|," if separator == ";" else "") + r")+)" + separator + r"?)", re.S)
    while place < len(body):
        match = pattern.match(body, place)
        if not match or match.end() == place:
            break
        gap = body[place:match.start(1) if match.group(1) else match.start(2)]
        place = match.end()
        if match.group(2) and match.group(2).strip():
            found.append([match.group(2), above])
            above = []
        elif match.group(1):
            if "\n" not in gap and found and not above:
                found[-1][1] = found[-1][1] + flowing(match.group(1))
            else:
                above = flowing(match.group(1))
    return found


def struct_members(body):
    members = []
    for declaration, text in separated(body, ";"):
        declaration = " ".join(declaration.split())
        pointer = re.match(r".*\(\*(\w+)\)", declaration)
        if pointer:
            members.append(Member(pointer.group(1), declaration, text))
            continue
        base, names = re.match(r"((?:const )?\w+(?: ?\*+)?) ?(.*)", declaration).groups()
        for name in names.split(","):
            members.append(Member(re.sub(r"\[.*", "", name.strip()), f"{base} {name.strip()}", text))
    return members


def enum_members(body):
    members = []
    for declaration, text in separated(body, ","):
        name, value = (part.strip() for part in declaration.split("="))
        members.append(Member(name, f"{name} = {value}", text))
    return members


def status_members(table):
    return [Member(name, f"{name} = {value}", [meaning]) for name, value, meaning in
            re.findall(r'X\((CARREAU_\w+),\s*(-?\d+),\s*"(.*?)"\)', table)]


class Source:
    """intro: the lines of the comment above the header; sections: in order."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        self.intro = comment_lines(re.search(r"/\*(?! clang-format).*?\*/", text, re.S).group(0))
        body = text.index('extern "C" {')
        self.sections = [Section("Declarations")]
        self._read(text, body)
        self.sections = [section for section in self.sections if section.items]

    @property
    def entities(self):
        return [entity for section in self.sections for entity in section.entities]

    def _read(self, text, place):
        self.block, self.comment, self.first, self.unused = [], [], None, None
        for token in TOKEN.finditer(text, place):
            gap = text[place:token.start()]
            if gap.count("\n") > 1:
                self._end_of_block()
            place = token.end()
            if token.group("comment"):
                self._comment(token.group("comment"), trailing="\n" not in gap and self.first is not None)
            elif not token.group("other"):
                self._entity(token, text.count("\n", 0, token.start()) + 1)
        self._end_of_block()

    def _end_of_block(self):
        if self.unused:
            self.sections[-1].items.append(self.unused)
        self.block, self.comment, self.first, self.unused = [], [], None, None

    def _comment(self, comment, trailing):
        section = SECTION.fullmatch(comment)
        if section:
            self._end_of_block()
            self.sections.append(Section(section.group(1)))
        elif trailing:
            self.last.text = self.last.text + flowing(comment) if self.last.first is self.last else flowing(comment)
        else:
            if self.unused:
                self.sections[-1].items.append(self.unused)
            self.block = self.block + self.comment
            self.comment = self.unused = comment_lines(comment)
            self.first = None

    def _entity(self, token, line):
        kind = token.lastgroup if token.lastgroup in ("table", "struct") else next(
            kind for kind in ("table", "macro", "struct", "opaque", "callback", "plain", "enum", "function") if token.group(kind))
        if kind == "macro" and token.group("macro_name").endswith(("_API", "_H", "_ROW")):
            return
        if kind == "enum" and "CARREAU_STATUS_TABLE" in token.group("enum_body"):
            return
        entity = Entity("statuses" if kind == "table" else kind, "", one_line(token.group(kind)), line, self.comment, self.block)
        if kind == "table":
            entity.members = status_members(token.group("table"))
        elif kind == "struct":
            entity.name, entity.members = token.group("struct_name"), struct_members(token.group("body"))
        elif kind == "enum":
            entity.members = enum_members(token.group("enum_body"))
        elif kind == "macro":
            entity.name, entity.declaration = token.group("macro_name"), token.group("macro_value")
        else:
            entity.name = token.group(kind + "_name")
        entity.first = self.first = self.first or entity
        self.last, self.unused = entity, None
        self.sections[-1].items.append(entity)


def has_description(lines):
    """True if the comment has text besides the errors."""
    return bool(ERRORS.split(" ".join(lines))[0].strip())


def rules_about(source, entity):
    """Texts elsewhere whose errors hold for an entity: of its section, or of all functions below."""
    found = []
    for section in source.sections:
        inside = entity in section.entities
        for item in section.items:
            text = " ".join(item.text if isinstance(item, Entity) else item)
            if "Errors of the functions below" in text or inside and "Errors of these functions" in text:
                found.append(text)
            elif inside and isinstance(item, list):
                found.append(text)
            if item is entity:
                return found
    return found


def states_errors(source, entity):
    """In its own comment, in one above in its block, or by a rule of its section."""
    return any(ERRORS.search(text) for text in [" ".join(entity.text), " ".join(entity.before)] + rules_about(source, entity))
