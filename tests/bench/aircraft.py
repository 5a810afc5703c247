#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""aircraft.py CARREAU FOLDER [--fine]: an aircraft out of 57 grids, adapted to sizes that are smallest on two paraboloids.

A like of HDR sec. 4.7.4, whose grids of a Boeing are not public: fuselage with poles at nose and tail, wings, tailplanes and fin
with their tips, which meet the fuselage along common nodes, and two nacelles. As there, sizes are computed at the vertices of
a mesh only, and the next mesh is made from them. Prints a line a mesh; fails when one is not closed."""
import json
import math
import os
import subprocess
import sys

QUARTER, ALONG, SPAN, ROUND = 16, 24, 24, 8  # intervals of grids
LENGTH, RADIUS = 70.0, 3.2
STATIONS = {"nose": 0.0, "wing": 21.0, "middle": 38.0, "tail": 55.0, "end": 66.0}


def radius(x):
    if x < 14:
        return RADIUS * math.sqrt(max(0.0, 1 - ((14 - x) / 14) ** 2))
    return RADIUS if x <= 42 else RADIUS * math.sqrt(max(0.0, 1 - ((x - 42) / (LENGTH - 42)) ** 2))


def on_fuselage(x, angle):
    r = radius(x)
    return (x, r * math.cos(angle), r * math.sin(angle))


def blend(p, q, w):
    return tuple((1 - w) * a + w * b for a, b in zip(p, q))


class Block:
    def __init__(self, columns, rows, at):
        self.columns, self.rows = columns, rows
        self.nodes = [at(i, j) for j in range(rows) for i in range(columns)]


def shell(x0, x1, sector, along):
    """A quarter of the fuselage between two stations; clustered where it ends in a pole."""
    first = sector * math.pi / 2 - math.pi / 4

    def x_of(i):
        t = i / along
        if x0 == 0:
            t = 1 - math.cos(t * math.pi / 2)
        elif x1 == LENGTH:
            t = math.sin(t * math.pi / 2)
        return x0 + (x1 - x0) * t

    return Block(along + 1, QUARTER + 1, lambda i, j: on_fuselage(x_of(i), first + j / QUARTER * math.pi / 2))


def thickness(xi):
    """Half thickness of NACA 0012 with a sharp trailing edge, for a chord of 1."""
    return 0.6 * (0.2969 * math.sqrt(xi) - 0.126 * xi - 0.3516 * xi**2 + 0.2843 * xi**3 - 0.1036 * xi**4) if xi < 1 else 0.0


class Surface:
    """A wing on the middle of a quarter of the fuselage."""

    def __init__(self, sector, window, root, tip, span):
        self.angle, self.window, self.root, self.tip, self.span = sector * math.pi / 2, window, root, tip, span
        half = QUARTER // 2
        # From the trailing edge along one side to the leading edge: xi of its nodes; the window gives the cuts.
        self.xi = [1 - 0.3 * k / half for k in range(half)]
        self.xi += [0.7 - 0.62 * k / ALONG for k in range(ALONG)]
        self.xi += [0.08 * (1 - k / half) ** 2 for k in range(half + 1)]

    def section(self, k, side, s):
        """Node k of the upper (side 1) or lower (-1) line at share s of the span."""
        (x0, c0), (x1, c1) = self.root, self.tip
        x_le, chord = x0 + s * (x1 - x0), c0 + s * (c1 - c0)
        x, q = x_le + chord * self.xi[k], side * chord * thickness(self.xi[k])
        x_root, q_root = x0 + c0 * self.xi[k], side * c0 * thickness(self.xi[k])
        out = (1 - s) * math.sqrt(radius(x_root) ** 2 - q_root**2) + s * self.span
        return self.place(x, out, q)

    def place(self, x, out, across):
        c, n = math.cos(self.angle), math.sin(self.angle)
        return (x, out * c - across * n, out * n + across * c)

    def blocks(self):
        m = len(self.xi)
        upper = Block(m, SPAN + 1, lambda i, j: self.section(i, 1, j / SPAN))
        lower = Block(m, SPAN + 1, lambda i, j: self.section(i, -1, j / SPAN))
        return [upper, lower, Block(m, ROUND + 1, self.cap)] + self.window_blocks()

    def cap(self, i, j):
        if j in (0, ROUND):
            return self.section(i, 1 if j == 0 else -1, 1)
        half = self.tip[1] * thickness(self.xi[i])
        phi = math.pi * j / ROUND
        x = self.section(i, 1, 1)[0]
        return self.place(x, self.span + half * math.sin(phi), half * math.cos(phi))

    def root_parameters(self, k, side):
        x, q = self.root[0] + self.root[1] * self.xi[k], side * self.root[1] * thickness(self.xi[k])
        return (x, self.angle + math.asin(q / radius(x)))

    def window_blocks(self):
        """The fuselage between the root and a rectangle of stations and angles around it, in five blocks."""
        half, m = QUARTER // 2, len(self.xi)
        x0, x1 = self.window
        a0, a1 = self.angle - math.pi / 4, self.angle + math.pi / 4
        up = [self.root_parameters(k, 1) for k in range(m)]
        low = [self.root_parameters(k, -1) for k in range(m)]
        right = [(x1, a0 + (a1 - a0) * k / QUARTER) for k in range(QUARTER + 1)]
        left = [(x0, a) for _, a in right]
        top = [(x1 + (x0 - x1) * k / ALONG, a1) for k in range(ALONG + 1)]
        bottom = [(x, a0) for x, _ in top]
        cut = half + ALONG
        sides = [(up[: half + 1], right[half:]), (up[half : cut + 1], top), (up[cut:] + low[cut : m - 1][::-1], left[::-1]),
                 (low[half : cut + 1], bottom), (low[: half + 1], right[half::-1])]
        return [self.between(inner, outer) for inner, outer in sides]

    def between(self, inner, outer):
        rows = 12

        def at(i, j):
            return on_fuselage(*blend(inner[i], outer[i], j / rows))

        block = Block(len(inner), rows + 1, at)
        return block


def nacelle(y):
    """A ring around an axis along x, closed both ways."""

    def at(i, j):
        a, b = 2 * math.pi * (i % 32) / 32, 2 * math.pi * (j % 24) / 24
        r = 1.4 + 0.6 * math.cos(b)
        return (22 + abs(y) * 0.35 + 2.2 * math.sin(b), y + r * math.cos(a), -2.6 + r * math.sin(a))

    return Block(33, 25, at)


def aircraft():
    s = STATIONS
    blocks = [shell(0, s["wing"], k, ALONG) for k in range(4)]
    wing_window, tail_window = (s["wing"], s["middle"]), (s["tail"], s["end"])
    blocks += [shell(*wing_window, k, ALONG) for k in (1, 3)]
    blocks += [shell(s["middle"], s["tail"], k, ALONG) for k in range(4)]
    blocks += [shell(*tail_window, 3, ALONG)]
    blocks += [shell(s["end"], LENGTH, k, ALONG) for k in range(4)]
    for sector in (0, 2):
        blocks += Surface(sector, wing_window, (24, 10), (42, 3), 30).blocks()
    for sector in (0, 2):
        blocks += Surface(sector, tail_window, (57, 6), (65, 2.2), 10).blocks()
    blocks += Surface(1, tail_window, (56.5, 7), (66, 3), 11).blocks()
    return blocks + [nacelle(-11), nacelle(11)]


def write_plot3d(path, blocks):
    with open(path, "w") as file:
        file.write(f"{len(blocks)}\n" + "".join(f"{b.columns} {b.rows} 1\n" for b in blocks))
        for b in blocks:
            for axis in range(3):
                file.write("\n".join(f"{p[axis]:.16g}" for p in b.nodes) + "\n")


def wanted_size(p, smallest):
    """Grows with the distance from two paraboloids around the axis."""
    least = math.inf
    for apex, width in ((18, 25), (46, 40)):
        rr = p[1] ** 2 + p[2] ** 2
        distance = abs(p[0] - apex - rr / width) / math.sqrt(1 + 4 * rr / width**2)
        least = min(least, distance)
    return min(1.2, smallest + 0.12 * least)


def vertices_of(path):
    with open(path) as file:
        words = file.read().split()
    at = words.index("Vertices")
    n = int(words[at + 1])
    return [tuple(float(x) for x in words[at + 2 + 4 * k : at + 5 + 4 * k]) for k in range(n)]


def write_sizes(mesh, smallest):
    sizes = [wanted_size(p, smallest) for p in vertices_of(mesh)]
    with open(mesh.removesuffix(".mesh") + ".sol", "w") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices {len(sizes)}\n1 1\n")
        file.write("\n".join(f"{h:.16g}" for h in sizes) + "\nEnd\n")


def run(program, *arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    return json.loads(done.stdout)


def main():
    program, folder = sys.argv[1:3]
    smallest = 0.06 if "--fine" in sys.argv else 0.2
    grid = os.path.join(folder, "aircraft.fmt")
    blocks = aircraft()
    write_plot3d(grid, blocks)
    print(f"{len(blocks)} grids, {sum(len(b.nodes) for b in blocks)} nodes")
    counts = []
    mesh = os.path.join(folder, "aircraft0.mesh")
    sizes = ["--size", "0.6"]
    for step in range(5):
        made = run(program, "mesh", grid, *sizes, "--lengths", "--join", "30", "-o", mesh, "--json")["mesh"]
        run(program, "check", mesh, "--closed", "--json", "--allow-crossings")  # fails on a defect
        counts.append(made["triangles"])
        print(f"mesh {step}: {made['triangles']:8} triangles, Q2 mean {made['q2_mean']:.4f}, worst {made['q2_min']:.4f}, "
              f"{made['open_edges']} open edges")
        if made["open_edges"] or made["q2_mean"] < 0.9:
            sys.exit("the mesh is open, or its mean quality is below .9")
        write_sizes(mesh, smallest)
        sizes = ["--size-map", mesh, "--gradation", "1.3"]
        mesh = os.path.join(folder, f"aircraft{step + 1}.mesh")
    if abs(counts[-1] - counts[-2]) > 0.05 * counts[-1]:
        sys.exit("the last two meshes differ by more than 5 % in number")


if __name__ == "__main__":
    main()
