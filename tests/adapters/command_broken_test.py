#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""command_broken_test.py CARREAU MAKE_SHAPES: `carreau mesh` on files that are broken: a sentence and a status each."""
import itertools
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, MAKE_SHAPES = sys.argv[1:3]
SHAPES = tempfile.mkdtemp(prefix="carreau shapes ")
ALL_FACES, SOME_FACES, NONE = 0, 1, 2


def content(name):
    with open(os.path.join(SHAPES, name)) as file:
        return file.read()


class Broken(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau broken ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def mesh(self, name, text, size="5%"):
        """Status, standard error, and the summary (None: no mesh)."""
        path, out = (os.path.join(self.folder, each) for each in (name, "out.mesh"))
        with open(path, "w") as file:
            file.write(text)
        # In bounded time: such a file takes a fraction of a second.
        done = subprocess.run([PROGRAM, "mesh", path, "-o", out, "--size", size, "-q", "--json"], capture_output=True,
                              text=True, timeout=60)
        self.assertEqual(os.path.exists(out), done.returncode in (ALL_FACES, SOME_FACES), done.stderr)
        if os.path.exists(out):
            os.remove(out)
        return done.returncode, done.stderr, json.loads(done.stdout) if done.stdout else None

    def refused(self, name, text, *sentences):
        status, error, _ = self.mesh(name, text)
        self.assertEqual(status, NONE, error)
        self.assertIn(name, error)
        for sentence in sentences:
            self.assertIn(sentence, error)

    def lost(self, name, text, *sentences, faces=7):
        """The plate without some faces, which are reported; the others have their area in the whole plate."""
        status, error, summary = self.mesh(name, text)
        self.assertEqual(status, SOME_FACES, error)
        for sentence in sentences:
            self.assertIn(sentence, error)
        meshed = [face for face in summary["faces"] if face["status"] == "meshed"]
        told = len(summary["not_read"]) + len(summary["faces"]) - len(meshed)
        self.assertGreaterEqual(told, 1)
        self.assertEqual(len(meshed) + told, faces, error)
        self.assertGreaterEqual(len(meshed), 1)
        self.assertLessEqual(summary["mesh"]["area"], self.area() * (1 + 1e-6))
        return summary

    @classmethod
    def area(cls):
        if not hasattr(cls, "whole"):
            done = subprocess.run([PROGRAM, "info", os.path.join(SHAPES, "plate.step"), "--json"], capture_output=True, text=True)
            cls.whole = json.loads(done.stdout)["area"]
        return cls.whole

    # The surface of the hole: the only rational one. Each list of numbers of it, with the place in the text.
    def spline(self, text):
        surface = re.search(r"B_SPLINE_SURFACE_WITH_KNOTS\((\([\d,\s]+\)),(\([\d,\s]+\)),(\([^)]*\)),(\([^)]*\)),\.UNSPECIFIED\.\)\s*"
                            r"GEOMETRIC_REPRESENTATION_ITEM\(\)\s*RATIONAL_B_SPLINE_SURFACE\((\(.*?\)\s*)\) REPRESENTATION", text, re.S)
        self.assertIsNotNone(surface)
        return surface

    def with_list(self, number, change):
        text = content("plate.step")
        surface = self.spline(text)
        values = surface.group(number)[1:-1].split(",")
        return text[:surface.start(number)] + "(" + ",".join(change(values)) + ")" + text[surface.end(number):]

    def test_the_plate_is_whole(self):
        for suffix in ("step", "brep", "igs"):
            status, error, summary = self.mesh("plate." + suffix, content("plate." + suffix))
            self.assertEqual((status, error, len(summary["faces"]), summary["not_read"]), (ALL_FACES, "", 7, []))
            self.assertTrue(summary["closed"])

    def test_weights_of_step_that_are_none(self):
        text = content("plate.step")
        surface = self.spline(text)
        weights = surface.group(5)
        for value in ("0.", "-1.", "NaN", "1.E30", "1.E999", "'a'", "$", ""):
            for count in (0, 1):  # all, one
                broken = text[:surface.start(5)] + re.sub(r"[\d.]+", value, weights, count=count) + text[surface.end(5):]
                self.lost("weights.step", broken, "ADVANCED_FACE: #", "B_SPLINE_SURFACE_WITH_KNOTS: ", "weights")
        for value in ("1.E-300",):  # positive, but the surface is another one
            broken = text[:surface.start(5)] + re.sub(r"0\.5", value, weights, count=1) + text[surface.end(5):]
            self.lost("weights.step", broken, "1 of 7 faces have no mesh")

    def test_knots_of_step_that_do_not_ascend(self):
        for change in (lambda k: k[::-1], lambda k: [k[1], k[0]] + k[2:], lambda k: k[:-1] + ["1.E30"], lambda k: ["NaN"] + k[1:],
                       lambda k: len(k) * [k[0]]):
            self.lost("knots.step", self.with_list(3, change), "ADVANCED_FACE: #", "B_SPLINE_SURFACE_WITH_KNOTS: ")

    def test_multiplicities_of_step_without_sense(self):
        for change in (lambda m: ["9"] + m[1:], lambda m: ["0"] + m[1:], lambda m: ["-3"] + m[1:], lambda m: ["2000000000"] + m[1:],
                       lambda m: m[1:], lambda m: ["x"] + m[1:]):
            self.lost("multiplicities.step", self.with_list(1, change), "ADVANCED_FACE: #", "B_SPLINE_SURFACE_WITH_KNOTS: ")

    def test_coordinates_of_step_that_are_none(self):
        text = content("plate.step")
        points = list(re.finditer(r"#(\d+) = CARTESIAN_POINT\('',\(([^,()]*),([^,()]*),([^,()]*)\)\)", text))
        # Vertices and poles: each stands in one to three faces. The first is the origin of the whole part.
        for i in range(1, len(points), 12):
            for value in ("NaN", "1.E30", "1.E300", "-1.E999", "$", "'x'", ""):
                broken = text[:points[i].start(2)] + value + text[points[i].end(2):]
                status, error, summary = self.mesh("points.step", broken)
                self.assertEqual(status, SOME_FACES, (points[i].group(0), value, error))
                self.assertIn(f"#{points[i].group(1)} CARTESIAN_POINT: ", error)
                self.assertLess(summary["diagonal"], 10)
        for value in ("NaN", "1.E30", "$"):
            broken = text[:points[0].start(2)] + value + text[points[0].end(2):]
            status, error, _ = self.mesh("origin.step", broken)
            self.assertEqual(status, SOME_FACES)
            self.assertIn(f"#{points[0].group(1)} CARTESIAN_POINT: ", error)

    def test_faces_that_step_loses_are_reported(self):
        text = content("plate.step")
        face = list(re.finditer(r"#(\d+) = ADVANCED_FACE\('',\((.*?)\),(#\d+),\.[TF]\.\);", text, re.S))[2]
        name = f"#{face.group(1)} ADVANCED_FACE: "

        def swapped(group, value):
            return text[:face.start(group)] + value + text[face.end(group):]
        for group, value in ((3, "$"), (3, "#99999"), (3, "#12"), (3, face.group(3) + ",#12"), (2, "#99999"), (2, "$")):
            self.lost("face.step", swapped(group, value), name)
        for line in ("", face.group(0).replace("ADVANCED_FACE", "ADVENTURE_FACE"), face.group(0).replace("#", "", 1)):
            self.lost("face.step", text[:face.start()] + line + text[face.end():], "CLOSED_SHELL: ")
        summary = self.lost("face.step", swapped(3, "$"), "1 entity of the file could not be read: " + name[:-2])
        self.assertEqual(len(summary["faces"]), 6)
        info = subprocess.run([PROGRAM, "info", os.path.join(self.folder, "face.step")], capture_output=True, text=True)
        self.assertIn("not read: 1\n  " + name, info.stdout)

    def test_faults_outside_of_geometry_lose_no_face(self):
        text = content("plate.step")
        broken = re.sub(r"(#\d+ = PRODUCT_DEFINITION_CONTEXT\()'[^']*'", r"\g<1>$", text)
        self.assertNotEqual(broken, text)
        self.assertEqual(self.mesh("context.step", broken)[0], ALL_FACES)

    def test_annotations_that_cannot_be_read_lose_no_face(self):
        text = content("plate.step")
        broken = text.replace("ENDSEC;\nEND-ISO", "#90001 = TEXT_LITERAL('note','5 CM',#90002,'left',.RIGHT.,#90002);\n"
                              "#90002 = CARTESIAN_POINT('',(0.,0.,0.));\n"
                              "#90003 = SHAPE_REPRESENTATION('',(#90001),#90004);\n#90004 = DIRECTION('',(1.,0.,0.));\nENDSEC;\nEND-ISO")
        self.assertNotEqual(broken, text)
        status, error, summary = self.mesh("note.step", broken)
        self.assertEqual((status, summary["not_read"]), (ALL_FACES, []), error)
        self.assertEqual(summary["warnings"], ["1 entity that carries no face was not read: #90001 TEXT_LITERAL"])

    def test_names_and_counts_of_attributes_lose_no_face(self):
        text = content("plate.step")
        area = self.mesh("plain.step", text)[2]["mesh"]["area"]
        unset = re.sub(r"(CARTESIAN_POINT|ADVANCED_FACE|DIRECTION|EDGE_CURVE|CLOSED_SHELL|VERTEX_POINT)\('[^']*',", r"\1($,", text)
        more = re.sub(r"(EDGE_LOOP\('',\([^()]*\))\)", r"\1,.T.)", text)
        missing = re.sub(r"(CARTESIAN_POINT|EDGE_LOOP)\('',", r"\1(", text.replace("REPRESENTATION_ITEM('')", "REPRESENTATION_ITEM()"))
        for broken in (unset, more, missing):
            self.assertNotEqual(broken, text)
            status, error, summary = self.mesh("names.step", broken)
            self.assertEqual((status, len(summary["faces"]), summary["mesh"]["area"]), (ALL_FACES, 7, area), error)
            self.assertEqual(len(summary["warnings"]), 1)
            self.assertIn("entities are wrong and were repaired", summary["warnings"][0])

    def test_files_of_wires_are_meshed_as_edges(self):
        path, out = os.path.join(SHAPES, "wires.brep"), os.path.join(self.folder, "out.mesh")
        done = subprocess.run([PROGRAM, "mesh", path, "-o", out, "--size", "0.1"], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, ALL_FACES, done.stderr)
        with open(out) as file:
            mesh = file.read()
        self.assertEqual(re.search(r"\nEdges\s+(\d+)", mesh).group(1), "30")
        self.assertNotIn("Triangles", mesh)

    def test_edges_of_no_face_are_left_out(self):
        path, out = os.path.join(SHAPES, "loose.brep"), os.path.join(self.folder, "out.mesh")
        counts = []
        for option in ((), ("--loose-edges",)):
            done = subprocess.run([PROGRAM, "mesh", path, "-o", out, "--size", "0.1", "--json", *option], capture_output=True,
                                  text=True, timeout=60)
            self.assertEqual(done.returncode, ALL_FACES, done.stderr)
            summary = json.loads(done.stdout)
            self.assertEqual(summary["warnings"], [] if option else ["3 edges of no face are not in the mesh (loose-edges adds them)"])
            counts.append(summary["mesh"]["vertices"])
        self.assertEqual(counts[1], counts[0] + 31)

    @staticmethod
    def vertices(path):
        with open(path) as file:
            words = file.read().split("Vertices", 1)[1].split()
        return [tuple(float(x) for x in words[4 * i + 1:4 * i + 4]) for i in range(int(words[0]))]

    @staticmethod
    def box(points):
        """Corners, to nine places."""
        return tuple(tuple(round(pick(p[k] for p in points), 9) for k in range(3)) for pick in (min, max))

    def test_files_to_which_an_assembly_refers(self):
        parts = [name for name in os.listdir(SHAPES) if name.startswith("outside")]
        self.assertEqual(len(parts), 3)
        for name in parts:
            shutil.copy(os.path.join(SHAPES, name), self.folder)
        path, out = os.path.join(self.folder, "outside.step"), os.path.join(self.folder, "out.mesh")
        command = [PROGRAM, "mesh", path, "-o", out, "--size", "10%", "--json"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, ALL_FACES, done.stderr)
        self.assertEqual(len(json.loads(done.stdout)["faces"]), 13)  # of two blocks and a ball
        # The blocks are 1 x 2 x 3, the ball has radius 1: each stands where the assembly puts it.
        points = self.vertices(out)
        for low, high in (((10, 0, 0), (11, 2, 3)), ((20, 0, 0), (21, 2, 3))):
            block = [p for p in points if low[0] - 1 < p[0] < high[0] + 1]
            self.assertEqual(self.box(block), (low, high))
            for corner in itertools.product(*zip(low, high)):
                self.assertLess(min(math.dist(corner, p) for p in block), 1e-9)
        ball = [p for p in points if p[0] < 5]
        self.assertEqual(len(points) - len(ball), len([p for p in points if 9 < p[0] < 22]))
        for p in ball:
            self.assertAlmostEqual(math.dist(p, (0, 0, 10)), 1, places=9)
        missing = next(name for name in parts if "block" in name)
        os.remove(os.path.join(self.folder, missing))
        done = subprocess.run(command, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, SOME_FACES, done.stderr)
        self.assertIn(f"file '{missing}', to which the file refers, cannot be read", done.stderr)
        self.assertEqual(len(json.loads(done.stdout)["faces"]), 1)

    TESSELLATED = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF'));
ENDSEC;
DATA;
#1=COORDINATES_LIST('',8,((0.,0.,0.),(1.,0.,0.),(1.,1.,0.),(0.,1.,0.),(0.,0.,1.),(1.,0.,1.),(1.,1.,1.),(0.,1.,1.)));
#2=COMPLEX_TRIANGULATED_FACE('bottom',#1,4,((0.,0.,-1.)),$,(1,4,2,3),((1,2,3,4)),());
#3=COMPLEX_TRIANGULATED_FACE('top',#1,8,$,$,(),(),((5,6,7,8)));
#4=TRIANGULATED_FACE('sides; ',#1,8,(),$,(),((1,2,6),(1,6,5),(2,3,7),(2,7,6),(3,4,8),(3,8,7),(4,1,5),(4,5,8)));
#5=TESSELLATED_SHELL('',(#2,#3,#4),$);
#6=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.));
ENDSEC;
END-ISO-10303-21;
"""

    def test_tessellated_shells_are_surfaces_given_as_triangles(self):
        status, error, summary = self.mesh("cube.stp", self.TESSELLATED)
        self.assertEqual(status, ALL_FACES, error)
        self.assertTrue(summary["closed"])
        self.assertAlmostEqual(summary["mesh"]["area"], 600, places=6)
        self.assertEqual(len(summary["faces"]), 3)
        for old, new in (("(4,5,8)", "(4,5,9)"), ("TESSELLATED_SHELL('',(#2,", "TESSELLATED_SHELL('',(#77,"), ("((1,2,3,4)),())", "((1,x,3,4)),())"),
                         ("#1=COORDINATES_LIST", "#1=CARTESIAN_POINT")):
            self.assertIn(old, self.TESSELLATED)
            self.refused("cube.stp", self.TESSELLATED.replace(old, new), "#")

    # Cubes of 1 cm: turned, so that its x, y, z are the assembly's -y, -z, x, and moved by 5 cm; moved by -7 cm, with the
    # assembly's representation first.
    ASSEMBLY = """#10=PRODUCT_DEFINITION('whole','',$,$);
#11=PRODUCT_DEFINITION_SHAPE('','',#10);
#12=SHAPE_REPRESENTATION('',(#40,#41,#42),$);
#13=SHAPE_DEFINITION_REPRESENTATION(#11,#12);
#20=PRODUCT_DEFINITION('cube','',$,$);
#21=PRODUCT_DEFINITION_SHAPE('','',#20);
#22=SHAPE_REPRESENTATION('',(#40),$);
#23=SHAPE_DEFINITION_REPRESENTATION(#21,#22);
#24=TESSELLATED_SHAPE_REPRESENTATION('',(#5),$);
#25=SHAPE_REPRESENTATION_RELATIONSHIP('','',#22,#24);
#30=NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','','',#10,#20,$);
#31=PRODUCT_DEFINITION_SHAPE('','',#30);
#32=ITEM_DEFINED_TRANSFORMATION('','',#40,#41);
#33=(REPRESENTATION_RELATIONSHIP('(','',#22,#12)REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#32)SHAPE_REPRESENTATION_RELATIONSHIP());
#34=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#33,#31);
#35=NEXT_ASSEMBLY_USAGE_OCCURRENCE('2','','',#10,#20,$);
#36=PRODUCT_DEFINITION_SHAPE('','',#35);
#37=ITEM_DEFINED_TRANSFORMATION('','',#42,#40);
#38=(REPRESENTATION_RELATIONSHIP('','',#12,#22)REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#37)SHAPE_REPRESENTATION_RELATIONSHIP());
#39=CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#38,#36);
#40=AXIS2_PLACEMENT_3D('',#50,$,$);
#41=AXIS2_PLACEMENT_3D('',#51,#53,#54);
#42=AXIS2_PLACEMENT_3D('',#52,$,$);
#50=CARTESIAN_POINT('',(0.,0.,0.));
#51=CARTESIAN_POINT('',(5.,0.,0.));
#52=CARTESIAN_POINT('',(0.,0.,-7.));
#53=DIRECTION('',(1.,0.,0.));
#54=DIRECTION('',(0.,-2.,0.));
"""

    def assembly(self, old="", new=""):
        self.assertIn(old, self.ASSEMBLY)
        return self.TESSELLATED.replace("#6=(LENGTH", self.ASSEMBLY.replace(old, new) + "#6=(LENGTH")

    def test_tessellated_components_stand_where_their_assembly_puts_them(self):
        path, out = os.path.join(self.folder, "two.stp"), os.path.join(self.folder, "two.mesh")
        with open(path, "w") as file:
            file.write(self.assembly())
        done = subprocess.run([PROGRAM, "mesh", path, "-o", out, "--size", "20%", "--json"], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, ALL_FACES, done.stderr)
        summary, points = json.loads(done.stdout), self.vertices(out)
        self.assertEqual((len(summary["faces"]), summary["closed"]), (6, True))
        self.assertAlmostEqual(summary["mesh"]["area"], 1200, places=6)
        self.assertEqual(self.box([p for p in points if p[0] > 25]), ((50, -10, -10), (60, 0, 0)))
        self.assertEqual(self.box([p for p in points if p[0] < 25]), ((0, 0, -70), (10, 10, -60)))

    def test_other_schemas_have_no_tessellated_shapes(self):
        self.refused("old.stp", self.TESSELLATED.replace("AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF", "AUTOMOTIVE_DESIGN"),
                     "holds no faces but tessellated ones")
        self.refused("old.stp", self.assembly().replace("AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF", "AUTOMOTIVE_DESIGN"),
                     "holds no faces but tessellated ones")

    def test_tessellated_assemblies_without_sense(self):
        for old, new, sentence in (("#10,#20,$);\n#31", "#10,#10,$);\n#31", "#30: the assembly is a part of itself"),
                                   ("ITEM_DEFINED_TRANSFORMATION('','',#40,#41)", "CARTESIAN_TRANSFORMATION_OPERATOR_3D('',$,$,#50,$,$)", "#32: only"),
                                   ("(0.,-2.,0.)", "(2.,0.,0.)", "#41: its two directions are parallel"),
                                   ("(0.,-2.,0.)", "(0.,0.,0.)", "#54: the direction has no length"),
                                   ("#41=AXIS2_PLACEMENT_3D('',#51", "#41=AXIS2_PLACEMENT_3D('',#99", "it refers to #99"),
                                   ("(5.,0.,0.)", "(1.E999,0.,0.)", "#51: a coordinate is not finite")):
            self.refused("two.stp", self.assembly(old, new), sentence)

    def test_brep_files_without_a_table_are_reported_on_standard_error_only(self):
        for table in ("Surfaces", "Curves ", "TShapes"):
            status, error, summary = self.mesh("table.brep", content("plate.brep").replace(table, "x" + table))
            self.assertEqual(status, NONE, error)
            self.assertEqual(list(summary), ["format", "error"])  # nothing else: what OpenCASCADE prints would not be JSON
            self.assertIn("table.brep", error)

    def test_brep_files_with_numbers_without_sense(self):
        text = content("plate.brep")
        start = text.index("\n9 0 1 1 0 ")  # the surface of the hole
        end = text.index("\nTriangulations")
        surface = text[start:end]

        def swapped(old, new, count=1):
            self.assertIn(old, surface)
            return text[:start] + surface.replace(old, new, count) + text[end:]
        lines = surface.split("\n")
        for weight in ("0", "-1", "nan", "inf", "1e30"):
            status, error, _ = self.mesh("weights.brep", swapped("  0.5 ", f"  {weight} "))
            self.assertIn(status, (SOME_FACES, NONE), weight)
            self.assertTrue(error)
        for coordinate in ("nan", "inf", "1e30", "1e300", "x", ""):
            status, error, _ = self.mesh("poles.brep", swapped("0.90000000000000013", coordinate))
            self.assertIn(status, (SOME_FACES, NONE), coordinate)
            self.assertTrue(error)
        knots = [line for line in lines if line.startswith(("2.09", "4.18"))]
        self.assertEqual(len(knots), 2)
        for old, new in ((knots[0], knots[1]), (knots[0], "1e30 2"), (knots[0], "nan 2"), (knots[0], "2.1 9"), (knots[0], "2.1 0"),
                         (knots[0], "2.1 -5"), (knots[0], "2.1 2000000000")):
            status, error, _ = self.mesh("knots.brep", swapped(old, new))
            self.assertIn(status, (SOME_FACES, NONE), (old, new))
            self.assertTrue(error)

    def test_iges_files_with_numbers_without_sense(self):
        lines = content("plate.igs").split("\n")
        rows = [i for i, line in enumerate(lines) if len(line) > 72 and line[72] == "P" and line.startswith("128,")]
        self.assertEqual(len(rows), 7)
        rows = [i for i in range(rows[-1], len(lines)) if lines[i][72:73] == "P" and lines[i][64:72] == lines[rows[-1]][64:72]]
        for row in rows[:-1]:  # the last one tells the range of the parameters, which nobody needs
            number = max(re.finditer(r"[\d.]{5,}", lines[row][:64]), key=lambda m: len(m.group()), default=None)
            for value in ("1D30", "NAN", "1D300") if number else ():
                line = (lines[row][:number.start()] + value + lines[row][number.end():64]).ljust(64) + lines[row][64:]
                status, error, _ = self.mesh("surface.igs", "\n".join(lines[:row] + [line] + lines[row + 1:]))
                self.assertIn(status, (SOME_FACES, NONE), line)
                self.assertTrue(error)

    def test_files_that_are_cut_off(self):
        for suffix in ("step", "brep", "igs"):
            text = content("plate." + suffix)
            for percent in (1, 5, 10, 25, 50, 60, 70, 80, 90, 94, 97, 99):
                status, error, _ = self.mesh("cut." + suffix, text[:len(text) * percent // 100])
                self.assertIn(status, (SOME_FACES, NONE), (suffix, percent))
                self.assertTrue(error)

    def test_files_that_hold_nothing(self):
        for suffix in ("step", "brep", "igs"):
            self.refused("empty." + suffix, "", "suffix")
            self.refused("zeros." + suffix, 4096 * "\0", "suffix")
        self.refused("head.step", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n")
        self.refused("head.brep", "DBRep_DrawableShape\n")
        lines = content("plate.igs").split("\n")
        self.refused("head.igs", "\n".join(line for line in lines if line[72:73] in "SGT"))
        step = content("plate.step")
        self.refused("noface.step", re.sub(r"#\d+ = ADVANCED_FACE\(.*?;", "", step, flags=re.S))
        self.refused("names.step", step.replace("ADVANCED_FACE", "NO_SUCH_THING"))


if __name__ == "__main__":
    try:
        subprocess.run([MAKE_SHAPES, SHAPES], check=True, timeout=120, stdout=subprocess.DEVNULL)
        unittest.main(argv=sys.argv[:1])
    finally:
        shutil.rmtree(SHAPES)
