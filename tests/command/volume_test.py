#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""volume_test.py CARREAU [MAKE_SHAPES]: tetrahedra by every engine of this machine: the surface stays, groups, formats, closed forms by CalculiX, a
sentence for each mistake."""
import json
import math
import os
import re
import shutil
import signal
import stat
import subprocess
import sys
import time
import unittest

from medit_volume import Medit, box, inner_edges, off, sides
from work_folder import WorkFolder

PROGRAM = os.path.abspath(sys.argv[1])
SHAPES = os.path.abspath(sys.argv[2]) if len(sys.argv) > 2 else ""
WorkFolder.program = PROGRAM
BESIDE = os.path.join(os.path.dirname(PROGRAM), "carreau_netgen")
ENGINES = [name for name, program in (("tetgen", "tetgen"), ("gmsh", "gmsh"), ("netgen", BESIDE)) if shutil.which(program)]


class VolumeTest(WorkFolder):
    def volume(self, *words):
        return json.loads(self.result("volume", *words, "--json", "-q").stdout)["volume"]

    def result(self, *words):
        result = self.run_program(*words)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def failure(self, *words, path=None):
        environment = dict(os.environ, PATH=path) if path is not None else None
        result = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, timeout=240, env=environment)
        self.assertEqual(result.returncode, 2, result.stderr)
        return result.stderr

    def cube(self):
        return self.write("cube.off", off(*box((0, 0, 0), (1, 1, 1))))

    def cavity(self):
        """A cube with a cavity, and a small cube inside it."""
        corners, triangles = box((0, 0, 0), (4, 4, 4))
        inner, turned = box((1, 1, 1), (3, 3, 3), 8)
        ball, last = box((1.5, 1.5, 1.5), (2, 2, 2), 16)
        return self.write("cavity.off", off(corners + inner + ball, triangles + [(a, c, b) for a, b, c in turned] + last))

    def make_shapes(self):
        if not SHAPES:
            self.skipTest("without OpenCASCADE")
        subprocess.run([SHAPES, self.folder], check=True, capture_output=True)

    # ---- engines ----

    def test_each_engine_keeps_the_surface(self):
        self.done("mesh", self.cube(), "-o", "surface.mesh", "--size", "0.25", "-q")
        surface = Medit(self.path("surface.mesh"))
        for engine in ENGINES:
            figures = self.volume("cube.off", "-o", "cube.mesh", "--size", "0.25", "--engine", engine)
            mesh = Medit(self.path("cube.mesh"))
            self.assertEqual(mesh.nodes[:len(surface.nodes)], surface.nodes, engine)
            self.assertEqual(mesh.triangles, surface.triangles, engine)
            self.assertAlmostEqual(mesh.volumes()[1], 1, 12)
            self.assertEqual((figures["engine"], figures["tetrahedra"], figures["vertices"]), (engine, len(mesh.tetrahedra), len(mesh.nodes)))
            count = sides(mesh)
            self.assertEqual({key for key, n in count.items() if n == 1}, {tuple(sorted(t[:3])) for t in mesh.triangles})
            self.assertLessEqual(max(count.values()), 2)

    def test_sizes_inside_follow_the_size_map_or_grow_from_the_surface(self):
        centre = "sqrt((x-0.5)^2+(y-0.5)^2+(z-0.5)^2)"
        fields = (("0.04+0.3*" + centre, lambda p: 0.04 + 0.3 * math.dist(p, (0.5, 0.5, 0.5))),  # the surface is coarse
                  ("0.06+0*u", lambda p: 0.06 * 1.1 + 0.3 * min(min(x, 1 - x) for x in p)))  # the map is for faces alone
        for formula, size in fields:
            for engine in ENGINES:
                self.volume(self.cube(), "-o", "sized.mesh", "--size-map", formula, "--gradation", "1.3", "--engine", engine)
                ratios = [math.dist(p, q) / size([(x + y) / 2 for x, y in zip(p, q)]) for p, q in inner_edges(Medit(self.path("sized.mesh")))]
                mean = sum(ratios) / len(ratios)
                self.assertTrue(0.75 < mean < 1.25, (formula, engine, mean))

    def test_a_cavity_stays_empty_and_the_cube_inside_is_a_solid(self):
        for engine in ENGINES:
            figures = self.volume(self.cavity(), "-o", "cavity.mesh", "--size", "0.6", "--engine", engine)
            volumes = Medit(self.path("cavity.mesh")).volumes()
            self.assertAlmostEqual(volumes[1], 64 - 8, 10)
            self.assertAlmostEqual(volumes[2], 0.125, 12)
            self.assertEqual([solid["number"] for solid in figures["solids"]], [1, 2])

    def test_an_assembly_has_conforming_solids(self):
        self.make_shapes()
        for engine in ENGINES:
            figures = self.volume("assembly.step", "--imprint", "-o", "assembly.mesh", "-o", "assembly.msh", "--engine", engine)
            self.assertGreater(len(figures["solids"]), 1)
            mesh = Medit(self.path("assembly.mesh"))
            for solid in figures["solids"]:
                self.assertAlmostEqual(mesh.volumes()[solid["number"]], solid["volume"], 9)
            with open(self.path("assembly.msh")) as file:
                groups = [line.split()[0] for line in file.read().split("$PhysicalNames\n")[1].split("$EndPhysicalNames")[0].splitlines()[1:]]
            self.assertGreater(groups.count("2"), 0)
            self.assertEqual(groups.count("3"), len({solid["name"] for solid in figures["solids"]}))

    def test_elements_of_order_two_follow_the_surface(self):
        self.make_shapes()
        if "gmsh" not in ENGINES:
            self.skipTest("without gmsh")
        self.volume("cylinder.step", "-o", "c.mesh", "--element", "p2", "--size", "10%", "--engine", "gmsh")
        mesh = Medit(self.path("c.mesh"))
        self.assertEqual({len(t) for t in mesh.tetrahedra}, {11})
        self.assertEqual({len(t) for t in mesh.triangles}, {7})
        # The volume of ten-node elements by Gauss points (four of them are exact up to order 2; the Jacobian is of order 3).
        corners, middles = .5854101966249685, .1381966011250105
        volume = 0
        for t in mesh.tetrahedra:
            x = [mesh.nodes[v] for v in t[:10]]
            for k in range(4):
                bary = [corners if i == k else middles for i in range(4)]
                by = [[(4 * bary[i] - 1) * x[i][c] for c in range(3)] for i in range(4)]
                for e, (i, j) in enumerate(((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))):
                    for c in range(3):
                        by[i][c] += 4 * bary[j] * x[4 + e][c]
                        by[j][c] += 4 * bary[i] * x[4 + e][c]
                p, q, r = ([by[i][c] - by[0][c] for c in range(3)] for i in (1, 2, 3))
                six = p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0])
                self.assertGreater(six, 0)
                volume += six / 24
        low, high = ([f(p[k] for p in mesh.nodes) for k in range(3)] for f in (min, max))
        extent = sorted(h - a for a, h in zip(low, high))
        expected = min((abs(volume / v - 1) for v in (math.pi / 4 * extent[0] ** 2 * extent[2], math.pi / 4 * extent[2] ** 2 * extent[0])))
        self.assertLess(expected, 2e-3)

    # ---- files ----

    def test_other_programs_read_the_files(self):
        if not ENGINES:
            self.skipTest("without engines")
        files = ["cube" + suffix for suffix in (".msh", ".msh2", ".inp", ".su2", ".vtu", ".mesh")]
        figures = self.volume(self.cube(), *(word for name in files for word in ("-o", name)), "--size", "0.4", "--group", "base=face:1")
        if shutil.which("gmsh"):
            for name in ("cube.msh", "cube.msh2"):
                shutil.copy(self.path(name), self.path("read.msh"))
                text = subprocess.run(["gmsh", "read.msh", "-0"], cwd=self.folder, capture_output=True, text=True).stdout
                self.assertNotIn("Error", text + name)
                self.assertIn(f"{figures['vertices']} nodes", text)
        with open(self.path("cube.inp")) as file:
            text = file.read()
        self.assertIn("*ELEMENT, TYPE=C3D4, ELSET=solid_1", text)
        self.assertIn("*SURFACE, NAME=base, TYPE=ELEMENT", text)
        with open(self.path("cube.su2")) as file:
            text = file.read()
        self.assertIn(f"NELEM= {figures['tetrahedra']}\n", text)
        self.assertIn("MARKER_TAG= base", text)
        # This program takes the outer faces of each file.
        for name in files:
            checked = json.loads(self.run_program("check", name, "--closed", "--json").stdout)
            self.assertEqual([each for each in checked["defects"] if not each.endswith("it belongs to no triangle")], [], name)

    def test_surfaces_are_handed_over(self):
        names = ("c.smesh", "c.poly", "c.vol", "c.msh", "c.geo")
        self.done("mesh", self.cavity(), *(word for name in names for word in ("-o", name)), "--size", "0.6", "-q")
        if "tetgen" in ENGINES:
            for name in ("c.smesh", "c.poly"):
                subprocess.run(["tetgen", "-pYA", name], cwd=self.folder, check=True, capture_output=True)
                with open(self.path("c.1.ele")) as file:
                    attributes = {line.split()[5] for line in file.read().splitlines()[1:] if not line.startswith("#")}
                self.assertEqual(attributes, {"1", "2"})
        if "gmsh" in ENGINES:
            text = subprocess.run(["gmsh", "-3", "c.geo", "-o", "filled.msh2", "-format", "msh2"], cwd=self.folder, capture_output=True, text=True).stdout
            self.assertNotIn("Error", text)
            with open(self.path("filled.msh2")) as file:
                elements = [line.split() for line in file.read().split("$Elements\n")[1].splitlines()[1:-1]]
            self.assertEqual({row[4] for row in elements if row[1] == "4"}, {"1", "2"})
        if "netgen" in ENGINES:
            subprocess.run([BESIDE, "c.vol", "filled.vol", "1"], cwd=self.folder, check=True, capture_output=True)
            self.assertTrue(os.path.exists(self.path("filled.vol")))

    # ---- closed forms ----

    def solved(self, deck):
        """Displacements by node, and reaction forces."""
        if shutil.which("ccx") is None:
            self.skipTest("without CalculiX")
        self.write("deck.inp", deck)
        run = subprocess.run(["ccx", "deck"], cwd=self.folder, capture_output=True, text=True)
        self.assertIn("Job finished", run.stdout[:3000])
        values, rows = {}, None
        with open(self.path("deck.dat")) as file:
            for line in file:
                words = line.split()
                if words[:1] in (["displacements"], ["forces"], ["total"]):
                    rows = values.setdefault(words[0], {})
                elif rows is not None and words:
                    numbers = list(map(float, words))
                    rows[int(numbers[0]) if len(numbers) == 4 else 0] = numbers[-3:]
        return values

    def test_calculix_bends_a_cantilever(self):
        if not ENGINES:
            self.skipTest("without engines")
        length, width, height, load, young = 10.0, 1.0, 1.0, 1.0, 1000.0
        self.write("beam.off", off(*box((0, 0, 0), (length, width, height))))
        self.result("volume", "beam.off", "-o", "beam.inp", "--element", "p2", "--size", "0.5", "-q", "--group", "root=face:1")
        # Faces of the file have one number for each flat region: the root is found by its nodes.
        with open(self.path("beam.inp")) as file:
            nodes = [line.split(",") for line in file.read().split("NSET=all_nodes\n")[1].split("*")[0].splitlines()]
        places = {int(n): tuple(map(float, xyz)) for n, *xyz in nodes}
        root = [n for n, p in places.items() if p[0] == 0]
        tip = [n for n, p in places.items() if p[0] == length]
        listed = lambda name, members: f"*NSET, NSET={name}\n" + "\n".join(map(str, members)) + "\n"  # noqa: E731
        # Shear is a body force on the last tenth, so that no nodal weights are needed: the closed form has its lever.
        found = self.solved("*INCLUDE, INPUT=beam.inp\n" + listed("fix", root) + listed("tip", tip) +
                            f"*MATERIAL, NAME=m\n*ELASTIC\n{young}, 0.\n*DENSITY\n1.\n*SOLID SECTION, ELSET=all_solids, MATERIAL=m\n*STEP\n*STATIC\n"
                            f"*BOUNDARY\nfix, 1, 3\n*DLOAD\nall_solids, GRAV, {load}, 0, 0, -1\n*NODE PRINT, NSET=tip\nU\n*END STEP\n")
        deflection = -sum(u[2] for u in found["displacements"].values()) / len(tip)
        # Weight q = 1 a length, no Poisson effect: bending q L^4 / 8 E I and shear q L^2 / 2 (5/6) G A.
        expected = length ** 4 / (8 * young / 12) + length ** 2 / (2 * 5 / 6 * young / 2)
        self.assertAlmostEqual(deflection / expected, 1, delta=2e-3)

    def test_calculix_presses_a_thick_sphere(self):
        """An eighth of a sphere from STEP under pressure inside: Lame's radial displacement."""
        self.make_shapes()
        gmsh = shape_maker(self)
        gmsh.model.occ.cut([(3, gmsh.model.occ.addSphere(0, 0, 0, 2))], [(3, gmsh.model.occ.addSphere(0, 0, 0, 1))])
        gmsh.model.occ.intersect(gmsh.model.occ.getEntities(3), [(3, gmsh.model.occ.addBox(0, 0, 0, 3, 3, 3))])
        gmsh.model.occ.synchronize()
        gmsh.write(self.path("sphere.step"))
        gmsh.finalize()
        self.result("volume", "sphere.step", "-o", "sphere.inp", "--element", "p2", "--size", "0.25", "-q", "--group-by", "part")
        with open(self.path("sphere.inp")) as file:
            text = file.read()
        nodes = [line.split(",") for line in text.split("NSET=all_nodes\n")[1].split("*")[0].splitlines()]
        places = {int(n): tuple(map(float, xyz)) for n, *xyz in nodes}
        radius = {n: math.dist(p, (0, 0, 0)) for n, p in places.items()}
        planes = "".join(f"*NSET, NSET=plane{k}\n" + "\n".join(str(n) for n, p in places.items() if abs(p[k]) < 1e-9) + "\n" for k in range(3))
        inside = {n for n, r in radius.items() if abs(r - 1) < 1e-6}
        surfaces = [block.split("\n", 1) for block in text.split("*NSET, NSET=")[1:]]  # each face, and the part
        inner, = [name.strip() for name, body in surfaces if set(map(int, body.split("*")[0].split())) <= inside]
        young, poisson, pressure = 1000.0, 0.3, 1.0
        found = self.solved("*INCLUDE, INPUT=sphere.inp\n" + planes + "*NSET, NSET=watched\n" + "\n".join(map(str, sorted(inside))) + "\n" +
                            f"*MATERIAL, NAME=m\n*ELASTIC\n{young}, {poisson}\n*SOLID SECTION, ELSET=all_solids, MATERIAL=m\n*STEP\n*STATIC\n"
                            "*BOUNDARY\nplane0, 1\nplane1, 2\nplane2, 3\n*DSLOAD\n" + f"{inner}, P, {pressure}\n*NODE PRINT, NSET=watched\nU\n*END STEP\n")
        a, b = 1.0, 2.0
        expected = pressure * a ** 3 / (young * (b ** 3 - a ** 3)) * ((1 - 2 * poisson) * a + (1 + poisson) * b ** 3 / (2 * a ** 2))
        for n, u in found["displacements"].items():
            along = sum(x * y for x, y in zip(u, places[n]))
            self.assertAlmostEqual(along / expected, 1, delta=0.01)
        mean = sum(sum(x * y for x, y in zip(u, places[n])) for n, u in found["displacements"].items()) / len(found["displacements"])
        self.assertAlmostEqual(mean / expected, 1, delta=2e-3)

    def test_calculix_stretches_a_bolted_assembly(self):
        """Two plates and a bolt of two materials, from STEP: springs in parallel and in series without Poisson effects."""
        self.make_shapes()
        gmsh = shape_maker(self)
        occ = gmsh.model.occ
        for z in (0, 1):
            occ.cut([(3, occ.addBox(-1.5, -1.5, z, 3, 3, 1))], [(3, occ.addCylinder(0, 0, z - 1, 0, 0, 3, 0.5))])
        occ.addCylinder(0, 0, 0, 0, 0, 2, 0.5)
        occ.synchronize()
        gmsh.write(self.path("bolted.step"))
        gmsh.finalize()
        figures = self.volume("bolted.step", "--imprint", "-o", "bolted.inp", "--element", "p2", "--size", "0.4",
                              "--group", "plates=solid:1-2", "--group", "bolt=solid:3")
        self.assertEqual([solid["name"] for solid in figures["solids"]], ["plates", "plates", "bolt"])
        with open(self.path("bolted.inp")) as file:
            text = file.read()
        self.assertIn("ELSET=plates", text)
        nodes = [line.split(",") for line in text.split("NSET=all_nodes\n")[1].split("*")[0].splitlines()]
        places = {int(n): tuple(map(float, xyz)) for n, *xyz in nodes}
        level = lambda name, z: f"*NSET, NSET={name}\n" + "\n".join(str(n) for n, p in places.items() if abs(p[2] - z) < 1e-9) + "\n"  # noqa: E731
        fixed = "*NSET, NSET=corner\n" + str(min(places, key=lambda n: sum((x + 9) for x in places[n]))) + "\n"
        found = self.solved("*INCLUDE, INPUT=bolted.inp\n" + level("low", 0) + level("high", 2) + fixed +
                            "*MATERIAL, NAME=soft\n*ELASTIC\n70., 0.\n*MATERIAL, NAME=hard\n*ELASTIC\n210., 0.\n*SOLID SECTION, ELSET=plates, MATERIAL=soft\n"
                            "*SOLID SECTION, ELSET=bolt, MATERIAL=hard\n*STEP\n*STATIC\n*BOUNDARY\nlow, 3, 3\nhigh, 3, 3, 0.1\nlow, 1, 2\n"
                            "*NODE PRINT, NSET=high, TOTALS=ONLY\nRF\n*END STEP\n")
        area = math.pi / 4
        expected = 0.1 / 2 * (70 * (9 - area) + 210 * area)
        total = next(rows[0][2] for key, rows in found.items() if key == "total")
        self.assertAlmostEqual(total / expected, 1, delta=1e-4)

    # ---- mistakes ----

    def test_open_and_crossing_surfaces_are_named_before_the_engine_starts(self):
        corners, triangles = box((0, 0, 0), (1, 1, 1))
        self.write("open.off", off(corners, triangles[:-2]))
        self.fake("tetgen", ": > started")
        sentence = self.failure("volume", "open.off", "-o", "x.msh", "--engine", "tetgen", "--size", "0.5", path=self.path("bin"))
        self.assertIn("the surface is open: the edge from (", sentence)
        second, others = box((0.4, 0.3, 0.6), (1.4, 1.3, 1.6), 8)
        self.write("crossing.off", off(corners + second, triangles + others))
        sentence = self.failure("volume", "crossing.off", "-o", "x.msh", "--engine", "tetgen", "--size", "0.5", path=self.path("bin"))
        self.assertRegex(sentence, r"pairs of triangles cross; faces \d+ and \d+: ")
        self.assertFalse(os.path.exists(self.path("started")))
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith("x.")], [])

    def test_shells_with_material_on_the_wrong_side_are_named(self):
        corners, triangles = box((0, 0, 0), (4, 4, 4))
        inner, outward = box((1, 1, 1), (3, 3, 3), 8)
        self.write("nested.off", off(corners + inner, triangles + outward))
        sentence = self.failure("volume", "nested.off", "-o", "nested.mesh", "--size", "20%", "--engine", ENGINES[0])
        self.assertRegex(sentence, r"the shell of faces? [\d, ]+(and \d+ more )?at \([\d., ]+\) of solid 2 lies inside solid 1, which has no cavity there")
        self.assertNotIn("did not fill", sentence)

    def test_reversed_shells_are_named(self):
        self.make_shapes()
        gmsh = shape_maker(self)
        gmsh.model.occ.cut([(3, gmsh.model.occ.addBox(0, 0, 0, 4, 4, 4))], [(3, gmsh.model.occ.addBox(1, 1, 1, 2, 2, 2))])
        gmsh.model.occ.synchronize()
        gmsh.write(self.path("hollow.brep"))
        gmsh.finalize()
        with open(self.path("hollow.brep")) as file:
            text = file.read()
        head, shells, tail = re.fullmatch(r"(.*\nSo\n\n\d{7}\n)(.*?)(\*.*)", text, re.S).groups()
        self.assertEqual(self.volume("hollow.brep", "-o", "hollow.mesh", "--size", "20%", "--engine", ENGINES[0])["engine"], ENGINES[0])
        first, outer, second, inner = re.fullmatch(r"([+-])(\d+ 0 )([+-])(\d+ 0 )", shells).groups()
        flipped = {"+": "-", "-": "+"}
        for signs, expected in (((first, flipped[second]), "out of this shell, which lies inside the solid"),
                                ((flipped[first], second), "into this shell, which no other shell of the solid holds")):
            self.write("odd.brep", head + signs[0] + outer + signs[1] + inner + tail)
            sentence = self.failure("volume", "odd.brep", "-o", "odd.mesh", "--size", "20%", "--engine", ENGINES[0])
            self.assertRegex(sentence, r"No engine can fill solid 1.*: the normals of its shell of faces .* at \([\d., ]+\) point " + expected)

    def test_solids_that_touch(self):
        """Triangles with common vertices share their sides; solids of a CAD file must be imprinted."""
        corners, triangles = box((0, 0, 0), (1, 1, 1))
        second, others = box((1, 0, 0), (2, 1, 1), 8)
        self.write("touching.off", off(corners + second, triangles + others))
        for engine in ENGINES:
            figures = self.volume("touching.off", "-o", "x.mesh", "--engine", engine, "--size", "0.5")
            self.assertEqual([round(solid["volume"], 12) for solid in figures["solids"]], [1, 1])
            self.assertAlmostEqual(Medit(self.path("x.mesh")).volumes()[2], 1, 12)
        self.make_shapes()
        if not ENGINES:
            return
        gmsh = shape_maker(self)
        for x in (0, 1):
            gmsh.model.occ.addBox(x, 0, 0, 1, 1, 1)
        gmsh.model.occ.synchronize()
        gmsh.write(self.path("two.step"))
        gmsh.finalize()
        self.assertRegex(self.failure("volume", "two.step", "-o", "x.msh", "--size", "0.5"),
                         r"24 pairs of triangles cross; faces \d+ and \d+: .* Solids that touch must share faces: see --imprint\.")
        self.volume("two.step", "-o", "x.msh", "--size", "0.5", "--imprint")

    def test_engines_that_are_missing_or_fail(self):
        self.cube()
        self.assertIn("No engine is on this machine: install gmsh or tetgen",
                      self.failure("volume", "cube.off", "-o", "x.msh", path="/nowhere") if "netgen" not in ENGINES else "No engine is on this machine: install gmsh or tetgen")
        self.assertIn("The engine tetgen is not on this machine: install tetgen.",
                      self.failure("volume", "cube.off", "-o", "x.msh", "--engine", "tetgen", path="/nowhere"))
        words = ("volume", "cube.off", "-o", "x.msh", "--engine", "tetgen", "--size", "0.5", "--engine-seconds", "2", "-q")
        for script, sentence in (("echo first; echo It broke >&2; exit 3", "exit status 3. Its last lines:\n  first\n  It broke"), ("kill -SEGV $$", "signal 11"),
                                 ("exec sleep 60", "it exceeded 2 s"), ("exit 0", "The engine wrote no file part.1.node"),
                                 ("printf '1 3 0 0\\n1 0 0 0\\n' > part.1.node; printf '0 4 0\\n' > part.1.ele", "left out vertices"),
                                 ("echo nonsense > part.1.node; echo > part.1.ele", "part.1.node is not as expected at byte 0")):
            self.fake("tetgen", script)
            said = self.failure(*words, path=self.path("bin") + ":" + os.environ["PATH"])
            self.assertIn(sentence, said)
            self.assertIn("The surface is in 'x.surface.msh'.", said)
            self.assertFalse(os.path.exists(self.path("x.msh")))
            self.assertIn("defects     none", self.run_program("check", "x.surface.msh").stdout)
            os.remove(self.path("x.surface.msh"))

    def test_a_signal_ends_the_engine_and_removes_its_files(self):
        self.cube()
        os.mkdir(self.path("temporary"))
        self.fake("tetgen", 'echo $$ > "%s"; exec sleep 60' % self.path("engine"))
        environment = dict(os.environ, PATH=self.path("bin") + ":" + os.environ["PATH"], TMPDIR=self.path("temporary"))
        run = subprocess.Popen([PROGRAM, "volume", "cube.off", "-o", "x.msh", "--engine", "tetgen", "--size", "0.5", "-q"], cwd=self.folder, env=environment,
                               stderr=subprocess.PIPE)
        wait = lambda done: any(done() or time.sleep(0.05) for _ in range(400))  # noqa: E731
        self.assertTrue(wait(lambda: os.path.exists(self.path("engine")) and os.path.getsize(self.path("engine")) > 0))
        with open(self.path("engine")) as file:
            engine = int(file.read())
        run.terminate()
        self.assertEqual(run.wait(20), -signal.SIGTERM)
        run.stderr.close()
        self.assertTrue(wait(lambda: os.listdir(self.path("temporary")) == []))
        self.assertTrue(wait(lambda: not os.path.exists(f"/proc/{engine}/exe") if os.path.isdir("/proc/self") else True))
        self.assertFalse(os.path.exists(self.path("x.msh")))

    def test_results_that_are_wrong_are_found(self):
        """A real engine, whose files are changed."""
        real = shutil.which("tetgen")
        if real is None:
            self.skipTest("without tetgen")
        self.cube()
        for change, sentence in (("sed -i '2s/ 0 / 0.001 /' part.1.node", "moved the vertex at ("), ("sed -i '2d; 1s/^ *[0-9]*/&/' part.1.ele; awk 'NR==1{$1=$1-1}1' part.1.ele > e; mv e part.1.ele", "did not fill solid 1"),
                                 ("awk 'NR>1 && NF>5{$6=7}1' part.1.ele > e; mv e part.1.ele", "filled a region 7")):
            self.fake("tetgen", f'{real} "$@" && {change}')
            said = self.failure("volume", "cube.off", "-o", "x.msh", "--engine", "tetgen", "--size", "0.5", path=self.path("bin") + ":" + os.environ["PATH"])
            self.assertIn(sentence, said)

    def test_words_that_contradict(self):
        self.cube()
        if not ENGINES:
            self.skipTest("without engines")
        self.assertIn("quadrilaterals: choose --element p1 or p2", self.failure("volume", "cube.off", "-o", "x.msh", "--element", "q1.0"))
        self.assertIn("cannot hold elements p2", self.failure("volume", "cube.off", "-o", "x.su2", "--element", "p2"))
        self.assertIn("x.stl", self.failure("volume", "cube.off", "-o", "x.stl"))
        self.assertIn("--engine", self.failure("volume", "cube.off", "-o", "x.msh", "--engine", "mine"))

    def fake(self, name, script):
        os.makedirs(self.path("bin"), exist_ok=True)
        path = self.path(os.path.join("bin", name))
        with open(path, "w") as file:
            file.write("#!/bin/sh\n" + script + "\n")
        os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)


def shape_maker(test):
    """Gmsh's module, which makes solids and writes STEP files."""
    try:
        import gmsh
    except ImportError:
        test.skipTest("without python3-gmsh")
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    return gmsh


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
