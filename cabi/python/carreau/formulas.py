# SPDX-License-Identifier: BSD-3-Clause
"""Formulas as text, evaluated with NumPy: the formulas of the command (muParser), and nothing that could do harm."""
from __future__ import annotations

import re
from typing import Any, Callable, Mapping, Optional

import numpy as np

from .domains import domain_of
from .errors import ArgumentError
from .surfaces import Patch

Values = Mapping[str, Any]
Node = Callable[[Values], Any]
FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: getattr(np, name) for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "sqrt", "log2", "log10", "rint",
                                            "sign", "abs")},
    "asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2, "asinh": np.arcsinh, "acosh": np.arccosh,
    "atanh": np.arctanh, "ln": np.log, "log": np.log, "min": lambda *a: np.minimum.reduce(np.broadcast_arrays(*a)),
    "max": lambda *a: np.maximum.reduce(np.broadcast_arrays(*a)), "sum": lambda *a: sum(a), "avg": lambda *a: sum(a) / len(a)}
CONSTANTS = {"pi": np.pi, "_pi": np.pi, "_e": np.e}
BINARY: list[dict[str, Callable[[Any, Any], Any]]] = [  # from the weakest
    {"||": np.logical_or}, {"&&": np.logical_and},
    {"==": np.equal, "!=": np.not_equal, "<=": np.less_equal, ">=": np.greater_equal, "<": np.less, ">": np.greater},
    {"+": np.add, "-": np.subtract}, {"*": np.multiply, "/": np.true_divide}]
TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|([A-Za-z_]\w*)|(\|\||&&|[=!<>]=|[-+*/^()<>?:,!]))")


class _Parser:
    def __init__(self, text: str, names: str) -> None:
        self.text, self.names, self.tokens, at = text, names, [], 0
        while text[at:].strip():
            match = TOKEN.match(text, at)
            if match is None:
                self.refuse(at, "this is not a part of a formula")
            assert match is not None
            self.tokens.append((match.lastindex, match.group(match.lastindex or 0), match.start(match.lastindex or 0)))
            at = match.end()
        self.next = 0

    def refuse(self, at: int, why: str) -> None:
        raise ArgumentError(f"The formula '{self.text}' is wrong at position {at + 1}: {why}.")

    def peek(self) -> str:
        return str(self.tokens[self.next][1]) if self.next < len(self.tokens) else ""

    def place(self) -> int:
        return int(self.tokens[self.next][2]) if self.next < len(self.tokens) else len(self.text)

    def take(self, *words: str) -> Optional[str]:
        if self.peek() in words and self.next < len(self.tokens):
            self.next += 1
            return str(self.tokens[self.next - 1][1])
        return None

    def need(self, word: str) -> None:
        if self.take(word) is None:
            self.refuse(self.place(), f"'{word}' is missing")

    def whole(self) -> Node:
        node = self.choice()
        if self.next < len(self.tokens):
            self.refuse(self.place(), f"'{self.peek()}' is not expected here")
        return node

    def choice(self) -> Node:
        condition = self.binary(0)
        if self.take("?") is None:
            return condition
        yes = self.choice()
        self.need(":")
        no = self.choice()
        return lambda v: np.where(np.asarray(condition(v)) != 0, yes(v), no(v))

    def binary(self, level: int) -> Node:
        if level == len(BINARY):
            return self.unary()
        node = self.binary(level + 1)
        while (word := self.take(*BINARY[level])) is not None:
            node = _pair(BINARY[level][word], node, self.binary(level + 1))
        return node

    def unary(self) -> Node:
        if self.take("-"):
            inner = self.unary()
            return lambda v: -inner(v)
        if self.take("!"):
            negated = self.unary()
            return lambda v: np.logical_not(negated(v))
        if self.take("+"):
            return self.unary()
        base = self.atom()
        return _pair(np.power, base, self.unary()) if self.take("^") else base

    def atom(self) -> Node:
        at = self.place()
        if self.take("("):
            node = self.choice()
            self.need(")")
            return node
        if self.next == len(self.tokens):
            self.refuse(at, "something is missing")
        kind, word, _ = self.tokens[self.next]
        self.next += 1
        if kind == 1:
            number = float(word)
            return lambda v: number
        if kind == 3:
            self.refuse(at, f"'{word}' is not expected here")
        return self.named(str(word), at)

    def named(self, word: str, at: int) -> Node:
        if word in FUNCTIONS:
            self.need("(")
            arguments = [self.choice()]
            while self.take(","):
                arguments.append(self.choice())
            self.need(")")
            function = FUNCTIONS[word]
            return lambda v: function(*[each(v) for each in arguments])
        if word in CONSTANTS:
            constant = CONSTANTS[word]
            return lambda v: constant
        if word not in self.names:
            self.refuse(at, f"'{word}' is unknown; there are {', '.join(self.names)}")
        return lambda v: v[word]


def _pair(function: Callable[[Any, Any], Any], a: Node, b: Node) -> Node:
    return lambda v: function(a(v), b(v))


def compiled(text: str, names: str = "xyzuv") -> Node:
    """The formula as a function of a mapping from names (one letter each) to arrays. Raises ArgumentError with the position."""
    if not text.strip():
        raise ArgumentError("The formula is empty.")
    return _Parser(text, names).whole()


def is_formula(text: str) -> bool:
    """True if a source is "z = ...", or "x = ...; y = ...; z = ..."."""
    return re.match(r"\s*[xyz]\s*=(?!=)", text) is not None


def patch_of(text: str, domain: Any = None) -> Patch:
    """The patch of "z = f(x, y)", or of x, y and z in u and v. domain: as of the command; None: box:-1,-1,1,1."""
    equations: dict[str, str] = {}
    for equation in text.split(";"):
        if not is_formula(equation):
            raise ArgumentError(f"'{equation}' is not an equation of x, y or z.")
        name, _, right = equation.partition("=")
        if name.strip() in equations:
            raise ArgumentError(f"There are two equations of {name.strip()}.")
        equations[name.strip()] = right
    curves = domain_of("box:-1,-1,1,1" if domain is None else domain)
    if set(equations) == {"z"}:
        z = compiled(equations["z"], "xy")
        return Patch(lambda u, v: (u, v, z({"x": u, "y": v})), curves)
    if set(equations) != {"x", "y", "z"}:
        raise ArgumentError("A surface is 'z = ...' in x and y, or 'x = ...; y = ...; z = ...' in u and v.")
    xyz = [compiled(equations[name], "uv") for name in "xyz"]
    return Patch(lambda u, v: tuple(each({"u": u, "v": v}) for each in xyz), curves)


def size_function(text: str) -> Callable[..., Any]:
    """Sizes by a formula in x, y, z, u and v, for Session.set_sizes."""
    node = compiled(text)

    def size(x: Any, y: Any, z: Any, u: Any, v: Any) -> Any:
        return np.broadcast_to(np.asarray(node({"x": x, "y": y, "z": z, "u": u, "v": v}), dtype=np.float64), np.shape(x))

    return size
