#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""compare_molecules.py CARREAU [FILE.xyzr...] [--sizes 0.6,0.4,0.3] [--repeat N]: the area that the solvent reaches by Carreau and FreeSASA, the surface
that excludes it by Carreau, PyMOL and EDTSurf, in one run. The probe is 1.4.

    apt-get install freesasa pymol edtsurf

The peers' methods:
- FreeSASA samples: slices of each sphere (Lee and Richards, 1000), or points (Shrake and Rupley, 10 000). It has no mesh.
- PyMOL marches through a grid (surface_quality 0, 1, 2: cells of .5, .3 and .25 or so) over the dots that its probe cannot enter, and moves
  vertices to those dots: an approximation, whose triangles come without neighbours (equal places are made one vertex here).
- EDTSurf fills a grid of voxels (scale: cells to a unit of length, unless the molecule is too large for its memory), takes the distance transform and
  marches through it; vertices are then smoothed. Its radii are its own: they are measured here from files of one atom, and its rows have a row of
  Carreau beside them for balls of these radii.
- Carreau meshes the exact spheres and tori. `exact` is its area and volume in closed form, which its own meshes do not use.

Areas and volumes of peers are measured on their triangles. Seconds are the least of N runs (3): of the whole process,
and of the surface alone where a program reports it. PyMOL and EDTSurf use one thread here; Carreau has --threads 1.
"""
import argparse
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DATA = os.path.join(SOURCE, "tests/data/molecule")
ELEMENT_OF_RADIUS = {1.7: "C", 1.55: "N", 1.52: "O", 1.8: "P", 1.2: "H", 1.1: "H"}
PROBE = 1.4
ROW = "{:10} {:22} {:>9} {:>8} {:>8} {:>10} {:>7} {:>10} {:>7} {:>7} {:>7} {:>6}"

PYMOL = """
import json, sys, time
from pymol import cmd
atoms, quality, target = json.loads(sys.argv[-1])
cmd.load(atoms + ".pdb", "m")
radii = [float(line.split()[3]) for line in open(atoms + ".xyzr")]
cmd.alter("m", "vdw = radii[index - 1]", space={"radii": radii})
cmd.rebuild()
cmd.set("solvent_radius", %r)
cmd.set("surface_mode", 1)
cmd.set("surface_quality", quality)
cmd.hide("everything")
start = time.perf_counter()
cmd.show("surface")
cmd.save(target)
print("seconds", time.perf_counter() - start)
""" % PROBE


def read_atoms(path):
    return [tuple(float(word) for word in line.split()[:4]) for line in open(path) if line.strip()]


def write_atoms(stem, atoms):
    """stem.pdb and stem.xyzr: the same places, with the three decimals of PDB files."""
    with open(stem + ".pdb", "w") as pdb, open(stem + ".xyzr", "w") as xyzr:
        for i, (x, y, z, r) in enumerate(atoms):
            element = ELEMENT_OF_RADIUS[round(r, 3)]
            pdb.write(f"ATOM  {i + 1:5d}  {element:<3} ALA A   1    {x:8.3f}{y:8.3f}{z:8.3f}  1.00  0.00          {element:>2}\n")
            xyzr.write(f"{x:.3f} {y:.3f} {z:.3f} {r}\n")
        pdb.write("END\n")


def timed(command, folder):
    start = time.perf_counter()
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    return time.perf_counter() - start, done


def best(repeat, run):
    runs = [run() for _ in range(repeat)]
    return min(r[0] for r in runs), min(r[1] for r in runs), runs[-1][2]


def weld(vertices, triangles, path):
    """An .off file in which equal places are one vertex and triangles without an area are left out."""
    number, kept, places = {}, [], []
    for p in vertices:
        if p not in number:
            number[p] = len(places)
            places.append(p)
    for t in triangles:
        corners = [number[vertices[k]] for k in t]
        if len(set(corners)) == 3:
            kept.append(corners)
    with open(path, "w") as file:
        file.write(f"OFF\n{len(places)} {len(kept)} 0\n")
        file.writelines(f"{x!r} {y!r} {z!r}\n" for x, y, z in places)
        file.writelines("3 {} {} {}\n".format(*t) for t in kept)
    return places, kept


def area_and_volume(vertices, triangles):
    area = volume = 0.0
    for i, j, k in triangles:
        a, b, c = vertices[i], vertices[j], vertices[k]
        u, v = [b[n] - a[n] for n in range(3)], [c[n] - a[n] for n in range(3)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        area += math.hypot(*n) / 2
        volume += sum(x * y for x, y in zip(a, n)) / 6
    return area, abs(volume)


def read_obj(path):
    vertices, triangles = [], []
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append(tuple(float(x) for x in words[1:4]))
        elif words[:1] == ["f"]:
            triangles.append([int(word.split("/")[0]) - 1 for word in words[1:4]])
    return vertices, triangles


def read_ply(path):
    lines = open(path).read().split("\n")
    n, m = (int(re.search(rf"element {what} (\d+)", "\n".join(lines[:20])).group(1)) for what in ("vertex", "face"))
    first = lines.index("end_header") + 1
    vertices = [tuple(float(x) for x in line.split()[:3]) for line in lines[first:first + n]]
    return vertices, [[int(x) for x in line.split()[1:4]] for line in lines[first + n:first + n + m]]


def by_pymol(folder, stem, quality):
    script, target = os.path.join(folder, "pymol_run.py"), os.path.join(folder, "pymol.obj")
    with open(script, "w") as file:
        file.write(PYMOL)
    argument = json.dumps([os.path.join(folder, stem), quality, target])
    whole, done = timed(["/usr/bin/python3", "-m", "pymol", "-cqk", script, "--", argument], folder)
    return whole, float(re.search(r"seconds (\S+)", done.stdout).group(1)), read_obj(target)


def by_edtsurf(folder, stem, scale):
    whole, done = timed(["EDTSurf", "-i", stem + ".pdb", "-o", "edt", "-s", "3", "-c", "1", "-h", "1", "-p", repr(PROBE), "-f", repr(scale)], folder)
    return whole, float(re.search(r"Total time (\S+)", done.stdout).group(1)), read_ply(os.path.join(folder, "edt.ply"))


def radius_of_edtsurf(folder, element):
    """Mean distance of the vertices of one atom's surface on its finest grid from the centre; 0: it has none."""
    with open(os.path.join(folder, "one.pdb"), "w") as file:
        file.write(f"ATOM      1  {element:<3} ALA A   1       0.000   0.000   0.000  1.00  0.00          {element:>2}\nEND\n")
    timed(["EDTSurf", "-i", "one.pdb", "-o", "one", "-s", "1", "-c", "1", "-h", "1", "-f", "20"], folder)
    vertices, _ = read_ply(os.path.join(folder, "one.ply"))
    return round(sum(math.hypot(*p) for p in vertices) / max(len(vertices), 1), 2)


class Bench:
    def __init__(self, carreau, repeat, folder):
        self.carreau, self.repeat, self.folder = os.path.abspath(carreau), repeat, folder

    def exact(self, stem):
        out = subprocess.run([self.carreau, "areas", stem + ".xyzr", "--probe", repr(PROBE), "--json"], cwd=self.folder, capture_output=True, text=True, check=True).stdout
        ses = next(s for s in json.loads(out)["surfaces"] if s["surface"] == "ses")
        return ses["area"], ses["volume"]

    def row(self, name, program, exact, whole, alone, vertices, triangles):
        path = os.path.join(self.folder, "checked.off")
        places, kept = weld(vertices, triangles, path)
        out = subprocess.run([self.carreau, "check", path, "--json"], capture_output=True, text=True).stdout
        quality = json.loads(out)["quality"]
        area, volume = area_and_volume(places, kept)
        errors = [f"{100 * (value / true - 1):+.2f}" for value, true in zip((area, volume), exact)]
        print(ROW.format(name, program, len(kept), f"{whole:.3f}", f"{alone:.3f}", f"{area:.2f}", errors[0], f"{volume:.2f}", errors[1], f"{quality['q2_mean']:.4f}",
                         f"{quality['q2_min']:.3f}", quality["open_edges"]), flush=True)

    def ours(self, name, stem, exact, size):
        target = os.path.join(self.folder, "ours.off")

        def run():
            whole, done = timed([self.carreau, "mesh", stem + ".xyzr", "--surface", "ses", "--probe", repr(PROBE), "--size", repr(size), "--threads", "1", "-q", "-o", target], self.folder)
            if done.returncode != 0:
                sys.exit(done.stderr)
            return whole, whole, None
        whole, _, _ = best(self.repeat, run)
        lines = [line.split() for line in open(target) if line.strip() and not line.startswith("#")]
        n, m = int(lines[1][0]), int(lines[1][1])
        self.row(name, f"Carreau {size}", exact, whole, whole, [tuple(map(float, w[:3])) for w in lines[2:2 + n]], [[int(x) for x in w[1:4]] for w in lines[2 + n:2 + n + m]])

    def reached(self, name, atoms):
        """The accessible area: FreeSASA takes radii from the column of occupancies."""
        with open(os.path.join(self.folder, "sasa.pdb"), "w") as file:
            for i, (x, y, z, r) in enumerate(atoms):
                file.write(f"ATOM  {i + 1:5d}  C   ALA A{i // 20 + 1:4d}    {x:8.3f}{y:8.3f}{z:8.3f}{r:6.2f}  0.00           C\n")
        whole, done = timed([self.carreau, "areas", "bondi.xyzr", "--probe", repr(PROBE), "--json"], self.folder)
        exact = next(s for s in json.loads(done.stdout)["surfaces"] if s["surface"] == "sas")["area"]
        print(ROW.format(name, "accessible, exact", "", f"{whole:.3f}", "", f"{exact:.4f}", "", "", "", "", "", ""))
        for method, option, n in (("slices", "-L", 1000), ("points", "-S", 10000)):
            whole, done = timed(["freesasa", "-O", option, "-n", str(n), f"--probe-radius={PROBE}", "sasa.pdb"], self.folder)
            area = float(re.search(r"Total\s*:\s*(\S+)", done.stdout).group(1))
            print(ROW.format(name, f"FreeSASA {n} {method}", "", f"{whole:.3f}", "", f"{area:.2f}", f"{100 * (area / exact - 1):+.3f}", "", "", "", "", ""))

    def molecule(self, path, sizes, radii):
        name, atoms = os.path.basename(path).split(".")[0], read_atoms(path)
        write_atoms(os.path.join(self.folder, "bondi"), atoms)
        self.reached(name, atoms)
        exact = self.exact("bondi")
        print(ROW.format(name, "exact", "", "", "", f"{exact[0]:.2f}", "", f"{exact[1]:.2f}", "", "", "", ""))
        for size in sizes:
            self.ours(name, "bondi", exact, size)
        for quality in (0, 1, 2):
            whole, alone, mesh = best(self.repeat, lambda: by_pymol(self.folder, "bondi", quality))
            self.row(name, f"PyMOL quality {quality}", exact, whole, alone, *mesh)
        own = [(x, y, z, radii[ELEMENT_OF_RADIUS[round(r, 3)]]) for x, y, z, r in atoms]
        write_atoms(os.path.join(self.folder, "own"), [a for a, b in zip(atoms, own) if b[3] > 0])
        with open(os.path.join(self.folder, "own.xyzr"), "w") as file:
            file.writelines(f"{x:.3f} {y:.3f} {z:.3f} {r}\n" for x, y, z, r in own if r > 0)
        exact = self.exact("own")
        print(ROW.format(name, "exact, EDTSurf's radii", "", "", "", f"{exact[0]:.2f}", "", f"{exact[1]:.2f}", "", "", "", ""))
        self.ours(name, "own", exact, sizes[1] if len(sizes) > 1 else sizes[0])
        for scale in (4.0, 8.0, 16.0):
            whole, alone, mesh = best(self.repeat, lambda: by_edtsurf(self.folder, "own", scale))
            self.row(name, f"EDTSurf scale {scale:g}", exact, whole, alone, *mesh)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("carreau")
    parser.add_argument("files", nargs="*", default=[os.path.join(DATA, "caffeine.xyzr"), os.path.join(DATA, "1bna.xyzr")])
    parser.add_argument("--sizes", default="0.6,0.4,0.3")
    parser.add_argument("--repeat", type=int, default=3)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        radii = {element: radius_of_edtsurf(folder, element) for element in ("C", "N", "O", "P", "H")}
        print("radii of EDTSurf:", ", ".join(f"{element} {radius}" for element, radius in radii.items()))
        print(ROW.format("molecule", "by", "triangles", "seconds", "surface", "area", "%", "volume", "%", "Q2", "worst", "open"))
        bench = Bench(given.carreau, given.repeat, folder)
        for path in given.files:
            bench.molecule(path, [float(word) for word in given.sizes.split(",")], radii)


if __name__ == "__main__":
    main()
