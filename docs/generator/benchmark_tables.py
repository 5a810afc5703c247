# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/benchmarks.md, from the run that docs/benchmarks/run.py has written: `<!-- table: surface -->` is the place of one."""
import json
import os
import re

NO_BREAK = "\u00a0"
MARK = re.compile(r"^<!-- table: (\w+) -->$", re.M)


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def thousands(number):
    return f"{number:,.0f}".replace(",", NO_BREAK)


def seconds(number, digits):
    return f"{number:.{digits}f}{NO_BREAK}s"


def busy(told):
    return max(told["place"]["load_before"], told["place"]["load_after"]) > 1.5


def place(told):
    here = told["place"]
    run = "the long run" if here["long"] else "the short run: one repetition, up to 100 000 triangles, coarse quadrilaterals"
    return (f"Of {here['date']}, commit of {here['commit']}, {run}. {here['processor']}, {here['cores']} cores, {here['system']}, {here['compiler']}; Gmsh {here['gmsh']}. "
            f"The load of the machine was {here['load_before']} before and {here['load_after']} after"
            + (": it was busy, and processor times are longer than on a quiet one." if busy(told) else "."))


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
    """Of each case and element Gmsh's way of the best quality."""
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


def command(rows, told):
    """Wall clock says something on a quiet machine only, Q2 of triangles that are to be equilateral only."""
    head = ["input", "triangles", "between reading and writing", "Q2 mean", "worst"]
    out = []
    for row in rows:
        unlike = "direction" in row["case"] or "quadrilaterals" in row["case"]
        out.append([row["case"], thousands(row["triangles"]), seconds(row["processor"], 2)] + (["", ""] if unlike else [f"{row['q2_mean']:.3f}", f"{row['q2_min']:.3f}"]))
    if not busy(told):
        head.append("whole run, wall clock")
        out = [cells + [seconds(row["seconds"], 2)] for cells, row in zip(out, rows)]
    return table(head, out)


TABLES = {"surface": surface, "quads": quads, "elements": elements, "command": command}


def filled(text, folder):
    """A page with its tables; what the run lacks is said."""
    path = os.path.join(folder, "run.json")
    if not os.path.exists(path):
        return MARK.sub("*No run is recorded.*", text)
    with open(path, encoding="utf-8") as file:
        told = json.load(file)

    def lines(mark):
        name = mark.group(1)
        return place(told) if name == "place" else TABLES[name](told[name], *([told] if name == "command" else [])) if name in told else "*Not part of the run recorded.*"

    return MARK.sub(lines, text)
