# SPDX-License-Identifier: BSD-3-Clause
"""Tetrahedra in files .mesh, and surfaces of boxes."""


def box(low, high, first=0):
    """Corners and outward triangles of a box."""
    corners = [tuple((high if i >> k & 1 else low)[k] for k in range(3)) for i in range(8)]
    sides = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))
    return corners, [tuple(first + v for v in (q[0], q[k], q[k + 1])) for q in sides for k in (1, 2)]


def off(corners, triangles):
    return "\n".join([f"OFF\n{len(corners)} {len(triangles)} 0", *(" ".join(map(repr, map(float, p))) for p in corners), *(f"3 {a} {b} {c}" for a, b, c in triangles)]) + "\n"


class Medit:
    """A file .mesh: nodes, triangles and tetrahedra (from 0) with the references behind them."""

    def __init__(self, path):
        with open(path) as file:
            words = file.read().split()
        self.sections, at = {}, 0
        width = {"Vertices": 4, "Triangles": 4, "TrianglesP2": 7, "Tetrahedra": 5, "TetrahedraP2": 11, "Edges": 3, "EdgesP2": 4}
        while at < len(words):
            if words[at] in width:
                n, w = int(words[at + 1]), width[words[at]]
                self.sections[words[at]] = [words[i:i + w] for i in range(at + 2, at + 2 + n * w, w)]
                at += 1 + n * w
            at += 1
        self.nodes = [tuple(map(float, row[:3])) for row in self.sections["Vertices"]]
        rows = lambda *names: [[int(v) - 1 for v in row[:-1]] + [int(row[-1])] for name in names for row in self.sections.get(name, [])]  # noqa: E731
        self.triangles, self.tetrahedra = rows("Triangles", "TrianglesP2"), rows("Tetrahedra", "TetrahedraP2")

    def volumes(self):
        """Volumes of straight tetrahedra by solid."""
        found = {}
        for t in self.tetrahedra:
            a, b, c, d = (self.nodes[v] for v in t[:4])
            p, q, r = ([x[k] - a[k] for k in range(3)] for x in (b, c, d))
            six = p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0])
            assert six > 0
            found[t[-1]] = found.get(t[-1], 0) + six / 6
        return found


def sides(mesh):
    """How often each side of a tetrahedron comes."""
    count = {}
    for t in mesh.tetrahedra:
        for skipped in range(4):
            key = tuple(sorted(t[:4][:skipped] + t[:4][skipped + 1:]))
            count[key] = count.get(key, 0) + 1
    return count


def inner_edges(mesh):
    """Both ends of each edge of a tetrahedron that has an end inside."""
    outside = {v for t in mesh.triangles for v in t[:-1]}
    edges = {tuple(sorted((a, b))) for t in mesh.tetrahedra for i, a in enumerate(t[:4]) for b in t[:i]}
    return [(mesh.nodes[a], mesh.nodes[b]) for a, b in sorted(edges) if a not in outside or b not in outside]
