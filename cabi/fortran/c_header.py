# SPDX-License-Identifier: BSD-3-Clause
"""The declarations of carreau.h as plain Python data: functions, structs, callbacks, constants, and their comments."""
import re

COMMENT = re.compile(r"/\*.*?\*/", flags=re.S)
FUNCTION = re.compile(r"CARREAU(?:_CAD)?_API\s+([\w\s\*]+?)\s*\b(carreau_\w+)\s*\(([^)]*)\)\s*;")
CALLBACK = re.compile(r"typedef\s+([\w\s]+?\s*\*?)\s*\(\*(carreau_\w+_fn)\)\(([^)]*)\)\s*;")
STRUCT = re.compile(r"typedef struct (\w+) \{(.*?)\}\s*\w+\s*;", flags=re.S)


def without_comments(text):
    return COMMENT.sub(" ", text)


def first_sentence(comment):
    """The first sentence of a comment of C, as one line; "" when it only lists errors."""
    lines = [re.sub(r"^\s*\* ?", "", line) for line in comment[2:-2].strip().split("\n")]
    tables = [i for i, line in enumerate(lines) if line.startswith("  ")]
    text = " ".join(" ".join(lines[:tables[0]] if tables else lines).split())
    end = re.search(r"[.:](?=\s+[A-Z*])|[.:]$", text)
    return "" if text.startswith("Errors") else text[:end.start()] + "." if end else text


class Header:
    """functions: {name: (result, [(type, argument)])}; structs: {name: [(type, member)]}, in the order of the file, with
    pointers to functions of type "function", which member_functions[struct] has in full; callback_types has the named
    function types;
    comments: {name: first sentence of the comment right before the declaration}; constants: {name: value}."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as header:
            commented = header.read()
        text = without_comments(commented).replace("\\\n", " ")
        self.callback_types = {name: (" ".join(result.split()), self._arguments(arguments))
                               for result, name, arguments in CALLBACK.findall(text)}
        self.callbacks = set(self.callback_types)
        self.functions = {name: (result.strip(), self._arguments(arguments))
                          for result, name, arguments in FUNCTION.findall(text)}
        self.member_functions = {struct: {name: (result.strip(), self._arguments(arguments)) for result, name, arguments
                                          in re.findall(r"(\w+\s*\*?)\s*\(\*(\w+)\)\(([^)]*)\)", body)}
                                 for struct, body in STRUCT.findall(text)}
        self.structs = {name: self._members(body) for name, body in STRUCT.findall(text)}
        self.comments = self._comments(commented)
        self.constants = self._constants(text)

    @staticmethod
    def _comments(text):
        found = {}
        for comment in COMMENT.finditer(text):
            follower = text[comment.end():]
            declared = re.match(r"\n(?:CARREAU(?:_CAD)?_API\s+[\w\s\*]+?\b(carreau_\w+)\s*\(|typedef struct (\w+) \{)", follower)
            if declared:
                found[declared.group(1) or declared.group(2)] = first_sentence(comment.group(0))
        return found

    @staticmethod
    def _constants(text):
        found = {symbol: int(value) for symbol, value in re.findall(r"X\((CARREAU_\w+),\s*(-?\d+)", text)}
        for body in re.findall(r"enum \{([^#]*?)\}", text, flags=re.S):
            for symbol, value in re.findall(r"(CARREAU_\w+)\s*=\s*(-?\d+)", body):
                found[symbol] = int(value)
        for symbol, value in re.findall(r"#define (CARREAU_\w+) \((-[\de+.]+)\)", text):
            found[symbol] = float(value) if "e" in value else int(value)
        return found

    @staticmethod
    def _arguments(text):
        """`double out[]` has the type `double[]`."""
        if text.strip() in ("", "void"):
            return []
        arguments = []
        for argument in text.split(","):
            match = re.fullmatch(r"\s*(.*?)\s*\b(\w+)\s*(\[\d*\])?\s*", argument, flags=re.S)
            arguments.append((" ".join(match.group(1).split()) + ("[]" if match.group(3) else ""), match.group(2)))
        return arguments

    @staticmethod
    def _members(body):
        members = []
        for line in body.split(";"):
            line = " ".join(line.split())
            pointer = re.match(r"void \(\*(\w+)\)", line)
            if pointer:
                members.append(("function", pointer.group(1)))
            elif line:
                match = re.match(r"((?:const )?\w+(?: ?\*+)?) ?(.*)", line)
                for name in match.group(2).split(","):
                    array = re.fullmatch(r"\s*(\w+)(\[\d+\])?\s*", name)
                    members.append((match.group(1).replace(" *", "*") + (array.group(2) or ""), array.group(1)))
        return members
