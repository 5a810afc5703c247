# SPDX-License-Identifier: BSD-3-Clause
"""Reads pages of `carreau report`: their markup, and the mesh that they hold."""
import base64
import json
import math
import re
import xml.etree.ElementTree as ElementTree
import zlib


def unpacked(text, block):
    """Numbers of an array: base64, zlib, planes of bytes, differences."""
    data = zlib.decompress(base64.b64decode(text, validate=True))
    count, width, stride = block["count"], block["bytes"], block["stride"]
    assert len(data) == count * width, (len(data), block)
    numbers = [sum(data[plane * count + i] << 8 * plane for plane in range(width)) for i in range(count)]
    if block["delta"]:
        for i, folded in enumerate(numbers):
            difference = folded >> 1 if folded % 2 == 0 else -(folded + 1 >> 1)
            numbers[i] = ((numbers[i - stride] if i >= stride else 0) + difference) % (1 << 8 * width)
    return numbers


def triples(numbers):
    return [tuple(numbers[i:i + 3]) for i in range(0, len(numbers), 3)]


class Page:
    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.text = file.read()
        self.scripts = dict(re.findall(r'<script type="[^"]*" id="([^"]*)">(.*?)</script>', self.text, re.S))
        # Text that a browser does not read as markup is removed; the rest is XML, which is stricter than HTML.
        bare = re.sub(r"(<(script|style)[^>]*>).*?(</\2>)", r"\1\3", self.text, flags=re.S)
        assert bare.startswith("<!DOCTYPE html>\n")
        self.root = ElementTree.fromstring(bare.split("\n", 1)[1])
        self.head = json.loads(self.scripts["viewer-data"]) if "viewer-data" in self.scripts else None

    def array(self, name):
        return unpacked(self.scripts["data-" + name], self.head["blocks"][name])

    def positions(self):
        low, quantum = self.head["box"]["low"], self.head["box"]["quantum"]
        return [tuple(a + n * q for a, n, q in zip(low, numbers, quantum)) for numbers in triples(self.array("positions"))]

    def triangles(self):
        return triples(self.array("corners"))

    def refs(self):
        return [self.head["faces"][i]["reference"] for i in self.array("faces")]

    def scale(self, key):
        return next(scale for scale in self.head["values"] if scale["key"] == key)

    def values(self, key):
        scale = self.scale(key)
        low, high = scale["low"], scale["high"]

        def value(code):
            share = (code - 1) / 65534
            return math.nan if code == 0 else low * (high / low) ** share if scale["logarithmic"] else low + share * (high - low)
        return [value(code) for code in self.array(key)]

    def find(self, identity):
        return next((e for e in self.root.iter() if e.get("id") == identity), None)

    def rows(self, identity):
        """Texts of the cells of a table, row by row; None: there is no such table."""
        table = self.find(identity)
        return None if table is None else [["".join(cell.itertext()) for cell in row] for row in table.find("tbody")]

    def histogram(self, key):
        return [int(row[2].replace("\u202f", "")) for row in self.rows("histogram-" + key)]
