# SPDX-License-Identifier: BSD-3-Clause
"""Files .msh with pairs, glued to themselves."""
import math


def sections(path):
    """Lines of each section of a file .msh, by its name."""
    found, name = {}, None
    with open(path, encoding="utf-8") as file:
        for line in file.read().splitlines():
            if line.startswith("$End"):
                name = None
            elif line.startswith("$"):
                name = line[1:]
                found[name] = []
            elif name:
                found[name].append(line.split())
    return found


class Mesh:
    """A file .msh of version 2.2: points by number, elements by face, periodic pairs."""

    def __init__(self, path):
        content = sections(path)
        self.points = {int(n): tuple(map(float, p)) for n, *p in content["Nodes"][1:]}
        self.cells, self.nodes = {}, {}  # corners, and all nodes
        for element in content["Elements"][1:]:
            kind, face, nodes = int(element[1]), int(element[4]), [int(n) for n in element[5:]]
            if kind in (2, 9, 21, 23, 3, 10, 16, 36, 37):
                self.cells.setdefault(face, []).append(nodes[:3 if kind in (2, 9, 21, 23) else 4])
                self.nodes.setdefault(face, []).append(nodes)
        self.pairs, rows = [], iter(content.get("Periodic", [["0"]])[1:])
        for dimension, slave, master in rows:
            affine = [float(x) for x in next(rows)[1:]]
            count = int(next(rows)[0])
            nodes = [tuple(map(int, next(rows))) for _ in range(count)]
            self.pairs.append((int(dimension), int(slave), int(master), affine, nodes))

    def faces(self):
        return [pair for pair in self.pairs if pair[0] == 2]

    def mismatch(self):
        """Largest |T(x) - y| of the pairs."""
        worst = 0
        for _, _, _, a, nodes in self.pairs:
            for slave, master in nodes:
                x, y = self.points[master], self.points[slave]
                image = [sum(a[4 * i + k] * x[k] for k in range(3)) + a[4 * i + 3] for i in range(3)]
                worst = max(worst, math.dist(image, y))
        return worst

    def classes(self):
        """The number of each point in the glued mesh."""
        parent = {n: n for n in self.points}

        def find(n):
            while parent[n] != n:
                parent[n] = parent[parent[n]]
                n = parent[n]
            return n

        for *_, nodes in self.pairs:
            for slave, master in nodes:
                a, b = find(slave), find(master)
                parent[max(a, b)] = min(a, b)
        return {n: find(n) for n in self.points}

    def without_one_master(self):
        """Returns the slaves (dimension, number) that have several masters or whose chain of masters returns to them."""
        masters = {}
        for dimension, slave, master, *_ in self.pairs:
            if slave != master:
                masters.setdefault((dimension, slave), set()).add((dimension, master))

        def returns(slave):
            above = min(masters[slave])
            for _ in masters:
                if above not in masters or above == slave:
                    break
                above = min(masters[above])
            return above == slave

        return [slave for slave, all in masters.items() if len(all) > 1 or returns(slave)]

    def same_cells(self, slave, master, nodes):
        """The pairs of nodes carry the elements of a master onto the elements of its slave."""
        to_slave = {m: s for s, m in nodes}
        images = sorted(tuple(sorted(to_slave[n] for n in cell)) for cell in self.cells[master])
        return images == sorted(tuple(sorted(cell)) for cell in self.cells[slave])

    def euler_of_skin(self):
        """Returns V - E + F of the glued faces that are in no pair. Each edge must have two elements."""
        paired = {f for pair in self.faces() for f in pair[1:3]}
        glued = self.classes()
        cells = [tuple(glued[n] for n in cell) for face, all in self.cells.items() if face not in paired for cell in all]
        return euler(cells)

    def skin_pieces(self):
        """Returns, ascending, the numbers of pieces in the components of the glued faces that are in no pair."""
        paired = {f for pair in self.faces() for f in pair[1:3]}
        cells = [tuple(cell) for face, all in self.cells.items() if face not in paired for cell in all]
        glued, piece = self.classes(), components(cells)
        whole = components([tuple(glued[n] for n in cell) for cell in cells])
        pieces = {}
        for cell in cells:
            pieces.setdefault(whole[glued[cell[0]]], set()).add(piece[cell[0]])
        return sorted(map(len, pieces.values()))

    def volume(self):
        """Returns the volume inside a closed surface, by the divergence theorem."""
        total = 0
        for cells in self.cells.values():
            for cell in cells:
                for k in range(1, len(cell) - 1):
                    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (self.points[n] for n in (cell[0], cell[k], cell[k + 1]))
                    total += (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)) / 6
        return total


def components(cells):
    """Returns a number of the connected component of each node."""
    parent = {n: n for cell in cells for n in cell}

    def find(n):
        while parent[n] != n:
            parent[n] = parent[parent[n]]
            n = parent[n]
        return n

    for first, *others in cells:
        for n in others:
            parent[find(n)] = find(first)
    return {n: find(n) for n in parent}


def euler(cells):
    """Returns V - E + F of closed cells; raises AssertionError when an edge has other than two."""
    edges = {}
    for cell in cells:
        for a, b in zip(cell, cell[1:] + cell[:1]):
            key = (min(a, b), max(a, b))
            edges[key] = edges.get(key, 0) + 1
    open_edges = [e for e, n in edges.items() if n != 2]
    if open_edges:
        raise AssertionError(f"{len(open_edges)} edges have other than two cells, first {open_edges[0]}")
    return len({n for cell in cells for n in cell}) - len(edges) + len(cells)
