#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figures of elements of all six kinds, in tables: areas, shapes, interpolation, Jacobians, anisotropic sizes, speed.

    apt-get install gmsh python3-gmsh python3-numpy
    python3 tests/bench/element_figures.py CARREAU [FILE.step ...] [--sizes 3%,2%] [--tables plate,fields,...] [--json FILE]

plate        [0,1]^2 without a disc of radius .5 about (1,1) (HDR fig. 3.6), whose area is 1 - pi/16: its error and its order, shapes, share of
             triangles
fields       sin(2 x + y) exp(z) interpolated on sphere and torus by the elements' own functions, in space: errors and their order
jacobians    sphere, torus, teapot of size .1 and the files: elements whose Bernstein coefficients are not all positive, and the least over its mean
anisotropic  the plate with edges five times as long along x, .1 by .02: shapes in the metric
speed        elements a second of a processor, from a model in memory to a mesh in memory, of the command's first mesh

Gmsh makes the CAD files of plate, sphere and torus, and reads meshes; it measures nothing. Exit status 1 when a figure is missed: no invalid element,
mean shape .85 and worst .35 on the plate at .05, no triangle in q1.1 and q2.1, at most 5 % of the area in q1.0 and q2.0, orders 2 and 4 of areas
and 2 and 3 of interpolation (mean square) within .4, mean shape .8 in the metric.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

from gmsh_runs import ROOT, file_of, gmsh, np, run_process

ELEMENTS = ("p1", "p2", "q1.0", "q1.1", "q2.0", "q2.1")
PLATE = 1 - math.pi / 16
WITHIN = 0.4  # of orders
missed = []


def wanted(good, text):
    if not good:
        missed.append(text)
    return good


def meshed(program, path, size, element, out):
    """The output of `carreau mesh` and of `carreau check`."""
    status, text, problem, _ = run_process([program, "mesh", path, "-o", out, "--size", str(size), "--element", element, "--threads", "1", "--json", "-q"])
    if status not in (0, 1):
        sys.exit(f"{path} {size} {element}: {problem}")
    return json.loads(text), checked(program, out)


def checked(program, path):
    status, text, problem, _ = run_process([program, "check", path, "--json"])
    if status not in (0, 1):
        sys.exit(f"{path}: {problem}")
    found = json.loads(text)
    straight = found["quality"]
    cells = found.get("elements") or {"area": straight["area"], "shape_mean": straight["q1_mean"], "shape_min": straight["q1_min"], "invalid": 0,
                                      "triangle_share": 1, "triangles3": straight["triangles"], "least_jacobian_min": 1}
    cells["count"] = sum(cells.get(kind, 0) for kind in ("triangles3", "triangles6", "quads4", "quads8"))
    return cells


def order(before, after, ratio=2):
    return math.log(before / after) / math.log(ratio)


def plate(program, folder):
    path, out, rows = file_of("plate", folder), os.path.join(folder, "a.msh"), []
    sizes = (0.2, 0.1, 0.05, 0.025)
    print(f"\nplate: errors of the area at h = {sizes}, order over the three halvings; at .05 shapes and triangles\n"
          f"  {'':6}{'':44}{'order':>7}{'elements':>10}{'mean':>8}{'worst':>8}{'triangles':>11}")
    for element in ELEMENTS:
        cells = [meshed(program, path, h, element, out)[1] for h in sizes]
        errors = [abs(row["area"] - PLATE) for row in cells]
        found, middle = order(errors[0], errors[-1], 8), cells[2]
        quads, curved = element[0] == "q", element.startswith(("p2", "q2"))
        wanted(abs(found - (4 if curved else 2)) <= WITHIN, f"order of the area, {element}")
        wanted(middle["shape_mean"] >= 0.85 and middle["shape_min"] >= 0.35, f"shapes on the plate, {element}")
        if quads:
            wanted(middle["triangle_share"] <= (0 if element.endswith(".1") else 0.05), f"triangles on the plate, {element}")
        share = f"{100 * middle['triangle_share']:9.2f} %" if quads else ""
        print(f"  {element:6}{''.join(f'{e:11.2e}' for e in errors)}{found:7.2f}{middle['count']:10d}{middle['shape_mean']:8.3f}{middle['shape_min']:8.3f}{share}")
        rows.append({"element": element, "sizes": sizes, "errors": errors, "order": found, **middle})
    return rows


def field(p):
    return np.sin(2 * p[..., 0] + p[..., 1]) * np.exp(p[..., 2])


def interpolation_error(path):
    """Mean square root and largest of the differences between the field and its interpolation, at inner points of triangles of order 1 or 2."""
    s, t = np.array([(s, t) for s in np.arange(0.1, 1, 0.2) for t in np.arange(0.1, 1 - s, 0.2)]).T
    r = 1 - s - t
    shapes = {2: np.stack([r, s, t], axis=1),
              9: np.stack([r * (2 * r - 1), s * (2 * s - 1), t * (2 * t - 1), 4 * r * s, 4 * s * t, 4 * t * r], axis=1)}
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(path)
        tags, xyz, _ = gmsh.model.mesh.getNodes()
        rank = np.zeros(int(max(tags)) + 1, dtype=np.int64)
        rank[np.asarray(tags, dtype=np.int64)] = np.arange(len(tags))
        differences = []
        for kind, _, nodes in zip(*gmsh.model.mesh.getElements(2)):
            n = shapes[kind]
            places = np.asarray(xyz).reshape(-1, 3)[rank[np.asarray(nodes, dtype=np.int64)].reshape(-1, n.shape[1])]
            inside, values = np.einsum("qn,cnk->cqk", n, places), field(places) @ n.T
            differences.append(np.abs(field(inside) - values).ravel())
        found = np.concatenate(differences)
        return math.sqrt((found * found).mean()), found.max()
    finally:
        gmsh.finalize()


def fields(program, folder):
    out, rows = os.path.join(folder, "a.msh"), []
    sizes = (0.2, 0.1, 0.05)
    print(f"\nfields: errors of interpolation at h = {sizes}, order over both halvings: in the mean square, and the largest one")
    for name in ("sphere", "torus"):
        path = file_of(name, folder)
        for element in ("p1", "p2"):
            errors = []
            for h in sizes:
                meshed(program, path, h, element, out)
                errors.append(interpolation_error(out))
            mean, largest = zip(*errors)
            found = order(mean[0], mean[-1], 4)
            wanted(abs(found - (3 if element == "p2" else 2)) <= WITHIN, f"order of interpolation, {name} {element}")
            print(f"  {name:8}{element:6}{''.join(f'{e:11.2e}' for e in mean)}{found:7.2f}   {''.join(f'{e:11.2e}' for e in largest)}"
                  f"{order(largest[0], largest[-1], 4):7.2f}")
            rows.append({"case": name, "element": element, "sizes": sizes, "mean": mean, "largest": largest, "order": found})
    return rows


def jacobians(program, folder, files, sizes):
    out, rows = os.path.join(folder, "a.msh"), []
    cases = [(name, 0.1) for name in ("sphere", "torus", "teapot")] + [(path, size) for path in files for size in sizes]
    print("\njacobians: invalid elements / least coefficient over its mean\n  " + " " * 36 + "".join(f"{element:>16}" for element in ELEMENTS[1:]))
    for name, size in cases:
        line = f"  {os.path.basename(name):30} {size!s:>5}"
        for element in ELEMENTS[1:]:
            _, cells = meshed(program, file_of(name, folder), size, element, out)
            wanted(cells["invalid"] == 0, f"{cells['invalid']} invalid elements, {os.path.basename(name)} {size} {element}")
            line += f"{cells['invalid']:8d} /{cells['least_jacobian_min']:6.3f}"
            rows.append({"case": name, "size": size, "element": element, **cells})
        print(line, flush=True)
    return rows


def stretched_child(path, element, out):
    """Edges of .1 along x, of .02 across."""
    sys.path.insert(0, os.path.join(ROOT, "cabi", "python"))
    import carreau
    made = carreau.mesh(path, element=element, threads=1, metric=lambda xyz: np.tile([100.0, 0, 0, 2500, 0, 2500], (len(xyz), 1)))
    made.write(out)


def anisotropic(program, folder):
    path, out, rows = file_of("plate", folder), os.path.join(folder, "a.mesh"), []
    build = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(program))))
    folders = [os.path.join(build, part) for part in ("cabi", "cad_adapters/cad", "lib")] + [os.environ.get("CARREAU_LIBRARY_PATH", "")]
    print("\nanisotropic: shapes in the metric, share of triangles")
    for element in ELEMENTS[2:4]:
        subprocess.run([sys.executable, os.path.abspath(__file__), "--stretched", path, element, out], check=True,
                       env={**os.environ, "CARREAU_LIBRARY_PATH": os.pathsep.join(folders)})
        with open(out) as file:
            lines = file.read().splitlines()
        first = [line.strip() for line in lines].index("Vertices") + 1
        for k in range(first + 1, first + 1 + int(lines[first])):
            x, y, z, ref = lines[k].split()
            lines[k] = f"{float(x) / 0.1!r} {float(y) / 0.02!r} {float(z) / 0.02!r} {ref}"
        with open(out, "w") as file:
            file.write("\n".join(lines) + "\n")
        cells = checked(program, out)
        wanted(cells["shape_mean"] >= 0.8, f"shapes in the metric, {element}")
        print(f"  {element:6}{cells['count']:8d} elements (the metric has the area of {PLATE * 500:.0f} squares), mean {cells['shape_mean']:.3f}, worst {cells['shape_min']:.3f}, "
              f"triangles {100 * cells['triangle_share']:.2f} %")
        rows.append({"element": element, **cells})
    return rows


def speed(program, folder):
    out, rows = os.path.join(folder, "a.msh"), []
    print("\nspeed: elements, thousands a second\n  " + " " * 14 + "".join(f"{element:>16}" for element in ELEMENTS))
    for name, size in (("plate", 0.05), ("plate", 0.01), ("sphere", 0.03), ("torus", 0.1), ("teapot", 0.1)):
        line = f"  {name:8}{size:6g}"
        for element in ELEMENTS:
            told, cells = meshed(program, file_of(name, folder), size, element, out)
            seconds = min([told["seconds"]["processor"]] + [meshed(program, file_of(name, folder), size, element, out)[0]["seconds"]["processor"] for _ in range(2)])
            line += f"{cells['count']:9d}{cells['count'] / seconds / 1000:7.0f}"
            rows.append({"case": name, "size": size, "element": element, "count": cells["count"], "seconds": seconds})
        print(line, flush=True)
    return rows


def main():
    if len(sys.argv) == 5 and sys.argv[1] == "--stretched":
        stretched_child(*sys.argv[2:])
        return 0
    parser = argparse.ArgumentParser(description="Figures of elements of all kinds")
    parser.add_argument("carreau", help="the program carreau")
    parser.add_argument("files", nargs="*", help="CAD files, .bpt files")
    parser.add_argument("--sizes", default="3%,2%", help="of the files")
    parser.add_argument("--tables", default="plate,fields,jacobians,anisotropic,speed")
    parser.add_argument("--json", help="file for all figures")
    options = parser.parse_args()
    made = {}
    with tempfile.TemporaryDirectory() as folder:
        makers = {"plate": plate, "fields": fields, "anisotropic": anisotropic, "speed": speed,
                  "jacobians": lambda program, where: jacobians(program, where, options.files, options.sizes.split(","))}
        for table in options.tables.split(","):
            made[table] = makers[table](options.carreau, folder)
    print(f"\n{len(missed)} figures below those wanted{''.join(chr(10) + '  ' + text for text in missed)}")
    if options.json:
        with open(options.json, "w") as file:
            json.dump(made, file, indent=1)
    return 1 if missed else 0


sys.exit(main())
