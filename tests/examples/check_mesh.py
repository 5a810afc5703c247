#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks a .mesh file against known properties; prints every broken claim and exits with 1.

check_mesh.py FILE [--open N] [--euler N] [--triangles N PERCENT] [--area A PERCENT] [--vertex REF X Y Z] [--worst Q2]
                   [--mean Q2] [--curves SHARED FREE] [--on "F(x, y, z)"] [--around X Y Z N] [--dimension D] [--not-orientable]
--curves: references of curves whose edges have two triangles, and one. --on: every vertex is a zero of F, to rounding.
--around: the vertex there has at least N triangles.
Independent of the library: reads the ASCII format itself.
"""
import argparse
import collections
import math

SIZES = {"Vertices": None, "Triangles": 4, "Edges": 3}


def read(path):
    words = open(path).read().split()
    i, sections, dimension = 0, {}, 3
    while i < len(words):
        word = words[i]
        if word == "MeshVersionFormatted":
            i += 2
        elif word == "Dimension":
            dimension, i = int(words[i + 1]), i + 2
        elif word == "End":
            return dimension, sections
        else:
            n = int(words[i + 1])
            width = SIZES[word] or dimension + 1
            block = words[i + 2:i + 2 + n * width]
            sections[word] = [block[k:k + width] for k in range(0, n * width, width)]
            i += 2 + n * width
    raise SystemExit(f"{path}: no End")


def sub(p, q):
    return [a - b for a, b in zip(p, q)]


def cross(p, q):
    return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]


def norm(p):
    return math.sqrt(sum(a * a for a in p))


def main():
    ap = argparse.ArgumentParser()
    ap.add_argument("file")
    ap.add_argument("--open", type=int)
    ap.add_argument("--euler", type=int)
    ap.add_argument("--triangles", type=float, nargs=2)
    ap.add_argument("--area", type=float, nargs=2)
    ap.add_argument("--vertex", type=float, nargs=4)
    ap.add_argument("--worst", type=float)
    ap.add_argument("--mean", type=float)
    ap.add_argument("--curves", type=int, nargs=2)
    ap.add_argument("--on")
    ap.add_argument("--around", type=float, nargs=4)
    ap.add_argument("--dimension", type=int, default=3)
    ap.add_argument("--not-orientable", action="store_true")
    args = ap.parse_args()
    dimension, sections = read(args.file)
    wrong = []

    def claim(true, sentence):
        if not true:
            wrong.append(sentence)

    claim(dimension == args.dimension, f"dimension {dimension}, not {args.dimension}")
    points = [[float(x) for x in v[:dimension]] + [0.0] * (3 - dimension) for v in sections["Vertices"]]
    refs = [int(v[-1]) for v in sections["Vertices"]]
    triangles = [[int(x) - 1 for x in t[:3]] for t in sections["Triangles"]]
    faces = [int(t[3]) for t in sections["Triangles"]]
    sides = collections.defaultdict(list)
    area, worst, mean = 0.0, 1.0, 0.0
    for t, face in zip(triangles, faces):
        a, b, c = (points[v] for v in t)
        twice = norm(cross(sub(b, a), sub(c, a)))
        squares = sum(norm(sub(p, q)) ** 2 for p, q in ((a, b), (b, c), (c, a)))
        area += twice / 2
        quality = 2 * math.sqrt(3) * twice / squares if squares else 0
        worst, mean = min(worst, quality), mean + quality / len(triangles)
        for p, q in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])):
            sides[min(p, q), max(p, q)].append((face, p < q))
    claim(len({v for t in triangles for v in t}) == len(points), "a vertex belongs to no triangle")
    claim(all(len(s) <= 2 for s in sides.values()), "an edge has more than two triangles")
    open_edges = sum(len(s) == 1 for s in sides.values())
    turned = sum(len(s) == 2 and s[0][1] == s[1][1] for s in sides.values())
    inside = sum(len(s) == 2 and s[0] == s[1] for s in sides.values())
    claim(inside == 0, f"{inside} edges inside a face whose triangles are turned against each other")
    claim((turned > 0) == args.not_orientable, f"{turned} edges between triangles turned against each other")
    claim(worst > 1e-9, "a triangle has no area")
    if args.open is not None:
        claim(open_edges == args.open, f"{open_edges} open edges, not {args.open}")
    if args.euler is not None:
        euler = len(points) - len(sides) + len(triangles)
        claim(euler == args.euler, f"Euler characteristic {euler}, not {args.euler}")
    if args.triangles:
        n, percent = args.triangles
        claim(abs(len(triangles) - n) <= percent / 100 * n, f"{len(triangles)} triangles, not within {percent} % of {n:.0f}")
    if args.area:
        a, percent = args.area
        claim(abs(area - a) <= percent / 100 * a, f"area {area}, not within {percent} % of {a}")
    if args.worst is not None:
        claim(worst >= args.worst, f"worst Q2 {worst}, below {args.worst}")
    if args.mean is not None:
        claim(mean >= args.mean, f"mean Q2 {mean}, below {args.mean}")
    if args.vertex:
        ref, *where = args.vertex
        claim(any(r == int(ref) and norm(sub(p, where)) == 0 for p, r in zip(points, refs)),
              f"no vertex at {where} has the reference {int(ref)}")
    if args.on:
        names = {"sqrt": math.sqrt, "hypot": math.hypot}
        far = max(abs(eval(args.on, names, {"x": p[0], "y": p[1], "z": p[2]})) for p in points)
        claim(far <= 1e-13, f"a vertex with {args.on} = {far}, not 0")
    if args.around:
        *where, n = args.around
        most = max((sum(v in t for t in triangles) for v, p in enumerate(points) if norm(sub(p, where)) <= 1e-12), default=0)
        claim(most >= n, f"{most} triangles meet at {where}, not {n:.0f} or more")
    if args.curves:
        by_ref = collections.defaultdict(set)
        for e in sections["Edges"]:
            p, q = sorted(int(x) - 1 for x in e[:2])
            by_ref[e[2]].add(len(sides[p, q]))
        counts = collections.Counter(min(n) for n in by_ref.values() if len(n) == 1)
        claim([counts[2], counts[1]] == args.curves and len(by_ref) == sum(args.curves),
              f"{counts[2]} curves shared by two patches and {counts[1]} free, not {args.curves}")
    for sentence in wrong:
        print(f"{args.file}: {sentence}")
    print(f"{args.file}: {len(points)} vertices, {len(triangles)} triangles, {open_edges} open edges, area {area:.6g}, worst Q2 {worst:.3f}")
    raise SystemExit(1 if wrong else 0)


if __name__ == "__main__":
    main()
