#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""command_formats_test.py CARREAU MAKE_SHAPES READERS: names and references of `carreau mesh` survive in all formats that can hold them.
The files are read by readers of the folder READERS, which share no code with the library; Gmsh, if it is there, reads its own."""
import collections
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, MAKE_SHAPES, READERS = sys.argv[1:4]
sys.path.insert(0, READERS)
import mesh_files  # noqa: E402

SHAPES = tempfile.mkdtemp(prefix="carreau shapes ")


class Formats(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="carreau formats ")

    def tearDown(self):
        shutil.rmtree(self.folder)

    def files(self, shape, *options):
        paths = {name: os.path.join(self.folder, "out." + name) for name in ("mesh", "meshb", "vtu", "stl", "msh", "msh2")}
        arguments = [word for path in paths.values() for word in ("-o", path)]
        subprocess.run([PROGRAM, "mesh", os.path.join(SHAPES, shape), "-q", *arguments, *options], check=True, timeout=120)
        return paths

    def test_each_file_holds_the_same_triangles_and_faces(self):
        for shape in ("named_faces.step", "assembly.step", "cylinder.step"):
            with self.subTest(shape=shape):
                paths = self.files(shape, "--size", "0.4")
                medit = mesh_files.read_mesh(paths["mesh"])
                self.assertGreater(len(medit.triangles), 50)
                others = {"meshb": mesh_files.read_meshb(paths["meshb"]), "msh": mesh_files.read_msh(paths["msh"]),
                          "msh2": mesh_files.read_msh(paths["msh2"]), "vtu": mesh_files.read_vtu(paths["vtu"])}
                curves = collections.Counter(ref for _, _, ref in medit.edges)
                for name, mesh in others.items():
                    self.assertEqual(mesh.corners(), medit.corners(), name)
                    for ref in set(medit.refs):
                        self.assertEqual(mesh.corners_of(ref), medit.corners_of(ref), (name, ref))
                    self.assertEqual(collections.Counter(ref for _, _, ref in mesh.edges), curves, name)
                # Text of numbers with nine digits or more, and a solid a face in the order of the references.
                stl = mesh_files.read_stl(paths["stl"])
                self.assertEqual(len(stl.triangles), len(medit.triangles))
                self.assertEqual(len(stl.names), len(set(medit.refs)))
                for solid, ref in enumerate(sorted(set(medit.refs)), 1):
                    for p, q in zip(stl.corners_of(solid), medit.corners_of(ref)):
                        for a, b in zip(p, q):
                            for x, y in zip(a, b):
                                self.assertAlmostEqual(x, y, delta=1e-7)

    def test_names_of_faces_survive(self):
        paths = self.files("named_faces.step", "--size", "0.4")
        medit = mesh_files.read_mesh(paths["mesh"])
        # The unit cube: the names give the places of its faces.
        for name, read in (("msh", mesh_files.read_msh), ("msh2", mesh_files.read_msh), ("vtu", mesh_files.read_vtu)):
            mesh = read(paths[name])
            self.assertEqual(sorted(mesh.names.values()), ["bottom"] + 4 * ["side"] + ["top"], name)
            for ref, label in mesh.names.items():
                heights = {p[2] for corners in mesh.corners_of(ref) for p in corners}
                if label != "side":
                    self.assertEqual(heights, {0.0} if label == "bottom" else {1.0}, name)
                self.assertEqual(mesh.corners_of(ref), medit.corners_of(ref), name)
        solids = mesh_files.read_stl(paths["stl"]).names
        self.assertEqual(sorted(solids.values()), ["bottom"] + 4 * ["side"] + ["top"])

    def test_statuses_of_faces_are_in_vtu(self):
        arrays = mesh_files.read_vtu(self.files("named_faces.step", "--size", "0.4")["vtu"]).arrays
        self.assertEqual(arrays["FieldData", "face_status"], 6 * [1])

    def test_colours_of_faces_are_in_vtu_and_in_pictures(self):
        path = self.files("named_faces.step", "--size", "0.4")["vtu"]
        vtu = mesh_files.read_vtu(path)
        top = {ref for ref, label in vtu.names.items() if label == "top"}
        rgb = vtu.arrays["CellData", "rgb"]
        for cell, ref in enumerate(vtu.refs):
            wanted = (255, 128, 0) if ref in top else (64, 160, 48)  # of the box, which the others are parts of
            for found, value in zip(rgb[3 * cell:3 * cell + 3], wanted):
                self.assertAlmostEqual(found, value, delta=1)
        for ref, colour in zip(vtu.arrays["FieldData", "face_reference"], vtu.arrays["FieldData", "face_rgb"]):
            self.assertAlmostEqual(colour >> 16, 255 if ref in top else 64, delta=1)
        # Orange has no blue, grey and the palette have: drawn without light and shade a row of the top would be orange.
        picture = os.path.join(self.folder, "top.png")
        subprocess.run([PROGRAM, "picture", path, "-o", picture, "--view", "top", "--no-edges", "--size", "64x64"], check=True, timeout=60)
        red, green, blue = mesh_files.read_png(picture)[20][40]
        self.assertGreater(red, green + 30)
        self.assertLess(blue, green - 30)

    def test_faces_that_are_cut_keep_name_and_colour(self):
        paths = self.files("bent.step", "--size", "0.4")
        for name, read in (("msh", mesh_files.read_msh), ("msh2", mesh_files.read_msh), ("vtu", mesh_files.read_vtu)):
            self.assertEqual(read(paths[name]).names, {1: "side", 2: "prism", 3: "prism"}, name)
        self.assertEqual(sorted(mesh_files.read_stl(paths["stl"]).names.values()), ["prism", "prism", "side"])
        vtu = mesh_files.read_vtu(paths["vtu"])
        rgb = vtu.arrays["CellData", "rgb"]
        self.assertEqual({tuple(rgb[3 * cell:3 * cell + 3]) for cell, ref in enumerate(vtu.refs) if ref == 1}, {(255, 0, 0)})
        self.assertEqual(vtu.arrays["FieldData", "face_status"], 3 * [1])

    def test_all_formats_are_read_back(self):
        import json
        results = {}
        for name, path in self.files("named_faces.step", "--size", "0.4").items():
            done = subprocess.run([PROGRAM, "check", path, "--closed", "--json"], capture_output=True, text=True, timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
            results[name] = json.loads(done.stdout)
        for name, result in results.items():
            for key in ("vertices", "triangles", "faces"):
                self.assertEqual(result[key], results["mesh"][key], (name, key))
            for key, figure in results["mesh"]["quality"].items():  # formats order edges, and sums round, in their own way
                self.assertAlmostEqual(result["quality"][key], figure, delta=4e-16 * 147 * abs(figure), msg=(name, key))
            for face, same in zip(result["report"]["faces"], results["mesh"]["report"]["faces"]):
                self.assertEqual(face["triangles"], same["triangles"], name)
                self.assertEqual(face["name"], "" if "mesh" in name else results["vtu"]["report"]["faces"][face["reference"] - 1]["name"])

    def test_gmsh_reads_both_of_its_formats(self):
        try:
            import gmsh
        except ImportError:
            self.skipTest("no module gmsh")
        paths = self.files("named_faces.step", "--size", "0.4")
        medit = mesh_files.read_mesh(paths["mesh"])
        gmsh.initialize()
        try:
            gmsh.option.setNumber("General.Terminal", 0)
            for name in ("msh", "msh2"):
                path = os.path.join(self.folder, f"of_{name}.msh")  # Gmsh knows one suffix
                os.rename(paths[name], path)
                gmsh.open(path)
                kinds, tags, _ = gmsh.model.mesh.getElements(2)
                self.assertEqual((list(kinds), sum(len(t) for t in tags)), ([2], len(medit.triangles)))
                groups = {gmsh.model.getPhysicalName(2, tag): sorted(gmsh.model.getEntitiesForPhysicalGroup(2, tag))
                          for _, tag in gmsh.model.getPhysicalGroups(2)}
                self.assertEqual({label: len(faces) for label, faces in groups.items()}, {"bottom": 1, "top": 1, "side": 4})
                gmsh.clear()
        finally:
            gmsh.finalize()


if __name__ == "__main__":
    try:
        subprocess.run([MAKE_SHAPES, SHAPES], check=True, timeout=120, stdout=subprocess.DEVNULL)
        unittest.main(argv=sys.argv[:1])
    finally:
        shutil.rmtree(SHAPES)
