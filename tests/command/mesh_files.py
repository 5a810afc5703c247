# SPDX-License-Identifier: BSD-3-Clause
"""Independent readers of the files of `carreau mesh`: vertices, triangles with the name or reference of their face."""
import base64
import math
import struct
import xml.etree.ElementTree as ElementTree
import zlib


class Mesh:
    def __init__(self, vertices, triangles, refs=None, names=None):
        self.vertices = vertices    # [(x, y, z)]
        self.triangles = triangles  # [(i, j, k)] from 0
        self.refs = refs            # reference of each triangle's face, or None
        self.names = names or {}    # reference: name
        self.edges = []             # [(i, j, reference of the curve)]

    def corners(self):
        """Sorted triples of points: equal for two files of one mesh, whatever the order and numbering."""
        return sorted(tuple(sorted(self.vertices[v] for v in t)) for t in self.triangles)

    def corners_of(self, ref):
        return sorted(tuple(sorted(self.vertices[v] for v in t)) for t, r in zip(self.triangles, self.refs) if r == ref)

    def lengths(self):
        edges = {tuple(sorted((t[k], t[k - 1]))) for t in self.triangles for k in range(3)}
        return [sum((a - b) ** 2 for a, b in zip(self.vertices[i], self.vertices[j])) ** 0.5 for i, j in edges]


def read_mesh(path, dimension=None):
    """Medit's text; of the dimension that the file gives."""
    with open(path) as file:
        words = iter(file.read().split())
    mesh = Mesh([], [], [])
    for word in words:
        if word == "Dimension":
            mesh.dimension = int(next(words))
            assert dimension in (None, mesh.dimension), mesh.dimension
        elif word == "Vertices":
            mesh.vertices = [tuple(float(next(words)) for _ in range(mesh.dimension + 1))[:mesh.dimension] for _ in range(int(next(words)))]
        elif word == "Triangles":
            for _ in range(int(next(words))):
                i, j, k, ref = (int(next(words)) for _ in range(4))
                mesh.triangles.append((i - 1, j - 1, k - 1))
                mesh.refs.append(ref)
        elif word == "Edges":
            for _ in range(int(next(words))):
                i, j, ref = (int(next(words)) for _ in range(3))
                mesh.edges.append((i - 1, j - 1, ref))
    return mesh


def read_sol(path):
    """Dimension, types and rows of values of a .sol."""
    with open(path) as file:
        words = file.read().split()
    dimension = int(words[words.index("Dimension") + 1])
    at = words.index("SolAtVertices") + 1
    count, kinds = int(words[at]), int(words[at + 1])
    types = [int(w) for w in words[at + 2:at + 2 + kinds]]
    width = sum({1: 1, 2: dimension, 3: dimension * (dimension + 1) // 2, 4: dimension ** 2}[t] for t in types)
    numbers = [float(w) for w in words[at + 2 + kinds:at + 2 + kinds + count * width]]
    return dimension, types, [numbers[width * i:width * (i + 1)] for i in range(count)]


def write_sol(path, mesh, types, value):
    """Rows of value(*vertex) at the vertices of a mesh."""
    rows = "".join(" ".join(repr(float(x)) for x in value(*p)) + "\n" for p in mesh.vertices)
    with open(path, "w") as file:
        file.write("MeshVersionFormatted 2\nDimension %d\nSolAtVertices\n%d\n%d %s\n%sEnd\n"
                   % (mesh.dimension, len(mesh.vertices), len(types), " ".join(map(str, types)), rows))


def area(mesh):
    """Area of the triangles of a mesh in space."""
    total = 0.0
    for triangle in mesh.triangles:
        a, b, c = (mesh.vertices[v] for v in triangle[:3])
        p, q = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, c)]
        normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
        total += math.sqrt(sum(x * x for x in normal)) / 2
    return total


def read_meshb(path):
    """GMF: code 1, version, then sections: code, position of the next one, count, rows. Versions 2 and 3: doubles."""
    with open(path, "rb") as file:
        data = file.read()
    one, version = struct.unpack("<ii", data[:8])
    assert one == 1 and version in (2, 3, 4), (one, version)
    long = "i" if version == 2 else "q"
    count_code = "i" if version < 4 else "q"
    whole = "i" if version < 4 else "q"
    at, mesh = 8, Mesh([], [], [])
    while at:
        code, following = struct.unpack_from("<i" + long, data, at)
        start = at + 4 + struct.calcsize("<" + long)
        if code == 3:
            assert struct.unpack_from("<i", data, start)[0] == 3
        elif code in (4, 5, 6):
            count, = struct.unpack_from("<" + count_code, data, start)
            row = {4: "<3d" + whole, 5: "<3" + whole, 6: "<4" + whole}[code]
            start += struct.calcsize("<" + count_code)
            rows = [struct.unpack_from(row, data, start + i * struct.calcsize(row)) for i in range(count)]
            if code == 4:
                mesh.vertices = [r[:3] for r in rows]
            elif code == 5:
                mesh.edges = [(i - 1, j - 1, ref) for i, j, ref in rows]
            else:
                mesh.triangles = [(i - 1, j - 1, k - 1) for i, j, k, _ in rows]
                mesh.refs = [r[3] for r in rows]
        elif code == 54:
            break
        at = following
    return mesh


def read_stl(path):
    """ASCII: a solid a face, its name or number."""
    with open(path) as file:
        lines = [line.split(None, 1) for line in file if line.strip()]
    mesh, number, solids = Mesh([], [], []), {}, []
    for word, *rest in lines:
        if word == "solid":
            solids.append(rest[0].strip() if rest else "")
        elif word == "vertex":
            point = tuple(float(x) for x in rest[0].split())
            number.setdefault(point, len(number))
            mesh.triangles.append(number[point])
        elif word == "endfacet":
            mesh.refs.append(len(solids))
    corners = mesh.triangles
    mesh.triangles = [tuple(corners[i:i + 3]) for i in range(0, len(corners), 3)]
    mesh.vertices = list(number)
    mesh.names = dict(enumerate(solids, 1))
    return mesh


def read_msh(path):
    """Gmsh 4.1 and 2.2, ASCII."""
    with open(path) as file:
        lines = [line.rstrip("\n") for line in file]
    sections, at = {}, 0
    while at < len(lines):
        name = lines[at].strip()
        if name.startswith("$"):
            end = lines.index("$End" + name[1:], at)
            sections[name[1:]] = lines[at + 1:end]
            at = end
        at += 1
    version = sections["MeshFormat"][0].split()[0]
    groups = {}
    for line in sections.get("PhysicalNames", ["0"])[1:]:
        dimension, tag, name = line.split(None, 2)
        groups[int(dimension), int(tag)] = name.strip('"')
    mesh = Mesh([], [], [])
    number = {}
    if version.startswith("2"):
        for line in sections["Nodes"][1:]:
            tag, x, y, z = line.split()
            number[int(tag)] = len(mesh.vertices)
            mesh.vertices.append((float(x), float(y), float(z)))
        for line in sections["Elements"][1:]:
            _, kind, tags, *rest = (int(word) for word in line.split())
            nodes = rest[tags:]
            if kind == 2:
                mesh.triangles.append(tuple(number[n] for n in nodes))
                mesh.refs.append(rest[1])
                if (2, rest[0]) in groups:
                    mesh.names[rest[1]] = groups[2, rest[0]]
            elif kind == 1:
                mesh.edges.append((number[nodes[0]], number[nodes[1]], rest[1]))
        return mesh
    assert version == "4.1", version
    counts, *rest = sections["Entities"]
    points, curves, surfaces, _ = (int(word) for word in counts.split())
    for line in rest[points + curves:points + curves + surfaces]:
        words = line.split()
        tags = int(words[7])
        if tags:
            mesh.names[int(words[0])] = groups[2, int(words[8])]
    rows = iter(sections["Nodes"][1:])
    for header in rows:
        _, _, _, n = (int(word) for word in header.split())
        tags = [int(next(rows)) for _ in range(n)]
        for tag in tags:
            number[tag] = len(mesh.vertices)
            mesh.vertices.append(tuple(float(x) for x in next(rows).split()[:3]))
    rows = iter(sections["Elements"][1:])
    for header in rows:
        _, entity, kind, n = (int(word) for word in header.split())
        for _ in range(n):
            nodes = [number[int(word)] for word in next(rows).split()[1:]]
            if kind == 2:
                mesh.triangles.append(tuple(nodes))
                mesh.refs.append(entity)
            elif kind == 1:
                mesh.edges.append((*nodes, entity))
    return mesh


def vtu_arrays(path):
    """{(section, name): values} of all arrays of an unstructured grid: text, inline or appended, base64 or raw, zlib or not."""
    with open(path, "rb") as file:
        data = file.read()
    appended = b""
    at = data.find(b"<AppendedData")
    if at >= 0:
        start = data.index(b"_", data.index(b">", at)) + 1
        appended = data[start:data.rindex(b"</AppendedData>")]
        raw = b'encoding="raw"' in data[at:start]
        data = data[:at] + b"</VTKFile>"
    root = ElementTree.fromstring(data)
    size = 8 if root.get("header_type") == "UInt64" else 4
    packed = root.get("compressor") is not None
    header = "<Q" if size == 8 else "<I"

    def block(content):
        if not packed:
            length, = struct.unpack_from(header, content)
            return content[size:size + length]
        blocks, _, _ = struct.unpack_from("<3" + header[1], content)
        sizes = struct.unpack_from(f"<{blocks}" + header[1], content, 3 * size)
        result, offset = b"", (3 + blocks) * size
        for n in sizes:
            result += zlib.decompress(content[offset:offset + n])
            offset += n
        return result

    arrays = {}
    for section, array in ((section, array) for section in root.iter() for array in section
                           if array.tag in ("DataArray", "Array")):
        form, kind = array.get("format"), array.get("type")
        code = {"Float64": "d", "Float32": "f", "Int32": "i", "Int64": "q", "UInt8": "B", "Int8": "b", "UInt32": "I", "UInt64": "Q"}
        if form == "ascii":
            words = array.text.split()
            values = [float(w) if kind.startswith("Float") else int(w) for w in words if kind != "String"]
            if kind == "String":  # codes of bytes, 0 at the end of each
                values = [text.decode() for text in bytes(int(w) for w in words).split(b"\0")[:-1]]
        else:
            content = appended[int(array.get("offset")):] if form == "appended" else base64.b64decode(array.text)
            if form == "appended" and not raw:
                content = base64.b64decode(content)
            content = block(content)
            if kind == "String":
                values = [word.decode() for word in content.split(b"\0")]
            else:
                values = list(struct.unpack("<" + str(len(content) // struct.calcsize(code[kind])) + code[kind], content))
        if section.tag == "FieldData" and array.get("Name") in ("face_name", "face_why") and kind == "UInt8":
            values = [text.decode() for text in bytes(values).split(b"\0")[:-1]]
        arrays[section.tag, array.get("Name")] = values
    return arrays


def read_vtu(path):
    arrays = vtu_arrays(path)
    points = arrays["Points", "Points"]
    mesh = Mesh([tuple(points[i:i + 3]) for i in range(0, len(points), 3)], [], [])
    mesh.arrays = arrays
    mesh.names = dict(zip(arrays["FieldData", "face_reference"], arrays.get(("FieldData", "face_name"), [])))
    start = 0
    for end, kind, ref in zip(arrays["Cells", "offsets"], arrays["Cells", "types"], arrays["CellData", "reference"]):
        cell = tuple(arrays["Cells", "connectivity"][start:end])
        start = end
        if kind == 5:
            mesh.triangles.append(cell)
            mesh.refs.append(ref)
        elif kind == 3:
            mesh.edges.append((*cell, ref))
    return mesh


def read_png(path):
    """Rows of (r, g, b)."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        assert zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            assert (depth, colour) == (8, 2)
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    raw, step = zlib.decompress(packed), 3 * width
    rows, above = [], bytearray(step)
    for y in range(height):
        method, line = raw[y * (step + 1)], bytearray(raw[y * (step + 1) + 1:(y + 1) * (step + 1)])
        for i in range(step):
            left = line[i - 3] if i >= 3 else 0
            corner = above[i - 3] if i >= 3 else 0
            p = left + above[i] - corner
            paeth = min((abs(p - left), 0, left), (abs(p - above[i]), 1, above[i]), (abs(p - corner), 2, corner))[2]
            line[i] = (line[i] + (0, left, above[i], (left + above[i]) // 2, paeth)[method]) & 255
        rows.append([tuple(line[3 * x:3 * x + 3]) for x in range(width)])
        above = line
    return rows
