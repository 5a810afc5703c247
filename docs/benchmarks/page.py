#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""page.py [--check]: writes docs/reference/benchmarks.md from run.json, the run that run.py has recorded. --check: fails if the page differs."""
import json
import os
import sys

NO_BREAK = "\u00a0"
FOLDER = os.path.dirname(os.path.abspath(__file__))
PAGE = os.path.join(os.path.dirname(FOLDER), "reference", "benchmarks.md")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def thousands(number):
    return f"{number:,.0f}".replace(",", NO_BREAK)


def seconds(number, digits):
    return f"{number:.{digits}f}{NO_BREAK}s"


def busy(record):
    return max(record["place"]["load_before"], record["place"]["load_after"]) > 1.5


def place(record):
    here = record["place"]
    run = "the long run" if here["long"] else "the short run: one repetition, up to 100 000 triangles, coarse quadrilaterals"
    return (f"Date {here['date']}, commit of {here['commit']}, {run}; {here['carreau']}. {here['processor']}, {here['cores']} cores, {here['system']}, {here['compiler']}; Gmsh {here['gmsh']}. "
            f"The load of the machine was {here['load_before']} before the run and {here['load_after']} after it"
            + (": a busy machine, on which processor times are longer." if busy(record) else "."))


def surface(rows):
    out = []
    for row in rows:
        for who in ("carreau", "gmsh"):
            made = row[who]
            speed = thousands(made["triangles"] / made["seconds"]) + "/s"
            ratio = f"{row['ratio']:.1f}" if who == "carreau" else ""
            out.append((f"{made['case']} {made['size']:g}", who, thousands(made["triangles"]), seconds(made["seconds"], 3), speed, ratio, f"{made['q2_mean']:.3f}",
                        f"{made['q2_p1']:.3f}", f"{made['q2_min']:.3f}", f"{100 * made['degree6']:.1f} %"))
    return table(("surface, size", "by", "triangles", "time", "speed", "times the speed", "Q2 mean", "1 %", "worst", "six edges"), out)


def best_ways(rows, quality):
    """Returns Gmsh's method of the best quality for each case and element."""
    best = {}
    for row in rows:
        key = row["case"], row["size"], row.get("element", "p2")
        if key not in best or row["gmsh"][quality] > best[key]["gmsh"][quality]:
            best[key] = row
    return best.values()


def quads(rows):
    out = []
    for row in best_ways(rows, "mean"):
        for who in ("carreau", "gmsh"):
            made = row[who]
            out.append((f"{row['case']} {row['size']:g}", f"carreau {row['element']}" if who == "carreau" else f"gmsh {row['way']}", thousands(made["quads"]),
                        f"{100 * made['triangle_share']:.1f} %", thousands(made["speed"]) + "/s", f"{made['mean']:.3f}", f"{made['worst']:.3f}", f"{made['jacobian']:.3f}"))
    return table(("shape, size", "by", "quadrilaterals", "area of triangles", "speed", "quality, mean", "worst", "worst scaled Jacobian"), out)


def elements(rows):
    out = []
    for row in best_ways(rows, "shape_mean"):
        for who in ("carreau", "gmsh"):
            made = row[who]
            out.append((f"{row['case']} {row['size']:g}", "carreau p2" if who == "carreau" else f"gmsh {row['way']}", thousands(made["triangles6"]), thousands(made["speed"]) + "/s",
                        f"{made['shape_mean']:.3f}", f"{made['shape_min']:.3f}", f"{made['least_jacobian_min']:.3f}", made["invalid"]))
    return table(("shape, size", "by", "elements", "speed", "shape, mean", "worst", "least Jacobian over its mean", "invalid"), out)


def command(rows, record):
    """Wall clock is meaningful on a quiet machine only, Q2 of triangles that are to be equilateral only."""
    head = ["input", "triangles", "between reading and writing", "Q2 mean", "worst"]
    out = []
    for row in rows:
        unlike = "direction" in row["case"] or "quadrilaterals" in row["case"]
        out.append([row["case"], thousands(row["triangles"]), seconds(row["processor"], 2)] + (["", ""] if unlike else [f"{row['q2_mean']:.3f}", f"{row['q2_min']:.3f}"]))
    if not busy(record):
        head.append("whole run, wall clock")
        out = [cells + [seconds(row["seconds"], 2)] for cells, row in zip(out, rows)]
    return table(head, out)


SECTIONS = [("surface", "Surface meshing beside Gmsh", "Gmsh's Frontal-Delaunay (`generate(2)`) and Carreau (sampling, plane meshes, lift) mesh the same surfaces, by "
             "[compare_gmsh.py](../../tests/bench/compare_gmsh.py).", surface),
            ("quads", "Quadrilaterals beside Gmsh", "[compare_gmsh_quads.py](../../tests/bench/compare_gmsh_quads.py) compares with Gmsh's method of the best mean quality. `q1.0` keeps a few "
             "triangles, `q1.1` none.", quads),
            ("elements", "Curved triangles beside Gmsh", "[compare_gmsh_elements.py](../../tests/bench/compare_gmsh_elements.py) compares with Gmsh's order 2, optimised or not, and `--element p2`. An element "
             "is invalid if a Bernstein coefficient of its Jacobian is not positive.", elements),
            ("command", "Whole runs of the command", "`carreau mesh INPUT ... --threads 1`.", command)]


def page(run):
    """The text of the page of a run."""
    text = f"""# Benchmarks

This page is generated. `python3 docs/benchmarks/run.py BUILD [--long]` runs the benchmarks and writes it, from a build with `-DCARREAU_BENCH=ON`.

{place(run)}

Times are of the processor, with one thread. Q2 is the shape of a triangle, 1 for an equilateral triangle.
"""
    for name, title, how, rows in SECTIONS:
        shown = rows(run[name], *([run] if name == "command" else [])) if name in run else "*Not part of the recorded run.*"
        text += f"\n## {title}\n{how}\n\n{shown}\n"
    return text


def main():
    with open(os.path.join(FOLDER, "run.json"), encoding="utf-8") as file:
        text = page(json.load(file))
    if "--check" in sys.argv:
        with open(PAGE, encoding="utf-8") as file:
            sys.exit(0 if file.read() == text else f"{PAGE} is not the page of run.json: run docs/benchmarks/page.py")
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
