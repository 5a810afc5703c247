"""What cabi/include/carreau.h declares: functions, structs, constants, as plain Python data."""
import re


def without_comments(text):
    return re.sub(r"/\*.*?\*/", " ", text, flags=re.S)


class Header:
    def __init__(self, path):
        with open(path) as header:
            self.text = without_comments(header.read())
        joined = self.text.replace("\\\n", " ")
        self.callbacks = set(re.findall(r"\(\*(carreau_\w+_fn)\)", joined))
        self.functions = {}  # name: (result, [types])
        for result, name, args in re.findall(r"CARREAU_API\s+([\w\s\*]+?)\s*\b(carreau_\w+)\s*\(([^)]*)\)\s*;", joined):
            self.functions[name] = (result.strip(), self._types(args))
        self.structs = {}  # name: [(type, member)]
        for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\}\s*\w+\s*;", joined, flags=re.S):
            self.structs[name] = self._members(body)
        self.constants = {}  # name: value
        for symbol, value in re.findall(r"X\((CARREAU_\w+),\s*(-?\d+)", joined):
            self.constants[symbol] = int(value)
        for body in re.findall(r"enum \{([^#]*?)\}", joined, flags=re.S):
            for symbol, value in re.findall(r"(CARREAU_\w+)\s*=\s*(-?\d+)", body):
                self.constants[symbol] = int(value)
        for symbol, value in re.findall(r"#define (CARREAU_\w+) \((-[\de+.]+)\)", joined):
            self.constants[symbol] = float(value) if "e" in value else int(value)

    @staticmethod
    def _types(args):
        if args.strip() in ("", "void"):
            return []
        types = []
        for arg in args.split(","):
            match = re.fullmatch(r"\s*(.*?)\s*\b(\w+)\s*", arg, flags=re.S)
            types.append(" ".join(match.group(1).split()))
        return types

    @staticmethod
    def _members(body):
        members = []
        for line in body.split(";"):
            line = " ".join(line.split())
            if not line:
                continue
            pointer = re.match(r"void \(\*(\w+)\)", line)
            if pointer:
                members.append(("function", pointer.group(1)))
                continue
            match = re.match(r"((?:const )?\w+(?: ?\*+)?) ?(.*)", line)
            for name in match.group(2).split(","):
                array = re.fullmatch(r"\s*(\w+)(\[\d+\])?\s*", name)
                members.append((match.group(1) + (array.group(2) or ""), array.group(1)))
        return members
