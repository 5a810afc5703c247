# SPDX-License-Identifier: BSD-3-Clause
"""From a shape to a Fem::FemMesh with groups; without windows."""
import os

import Fem

from . import program

ENGINES = ["Automatic", "gmsh", "tetgen", "netgen", "Surface only"]


class Settings:
    """Lengths in millimetres; 0 or "" means that carreau chooses."""

    def __init__(self, size=0.0, minimum=0.0, maximum=0.0, angle=0.0, gradation=0.0, order=2, engine="Automatic", face_sizes=None):
        self.size, self.minimum, self.maximum, self.angle, self.gradation = size, minimum, maximum, angle, gradation
        self.order, self.engine = order, engine
        self.face_sizes = dict(face_sizes or {})  # by number of the face, from 1

    def words(self, shape, output):
        """Words of the command line."""
        surface = self.engine == "Surface only"
        words = ["mesh" if surface else "volume", shape, "-o", output, "--element", f"p{self.order}"]
        for option, value in (("--size", self.size), ("--min", self.minimum), ("--max", self.maximum), ("--angle", self.angle),
                              ("--gradation", self.gradation)):
            if value > 0:
                words += [option, repr(float(value))]
        for face, size in sorted(self.face_sizes.items()):
            words += ["--face-size", f"{face}={float(size)!r}"]
        if not surface and self.engine != "Automatic":
            words += ["--engine", self.engine]
        return words


class Content:
    """Arrays of a Medit file: nodes (x, y, z), triangles and tetrahedra (nodes from 1), and the numbers of their faces and solids."""

    def __init__(self, path):
        with open(path, encoding="ascii") as file:
            words = file.read().split()
        self.nodes, self.triangles, self.faces, self.tetrahedra, self.solids = [], [], [], [], []
        at = 0
        while at < len(words):
            word = words[at]
            at += 1
            if word in ("MeshVersionFormatted", "Dimension"):
                at += 1
            elif word == "End":
                break
            elif word == "Vertices":
                at = self._rows(words, at, 4, lambda row: self.nodes.append(tuple(map(float, row[:3]))))
            elif word in ("Edges", "EdgesP2"):
                at = self._rows(words, at, 3 if word == "Edges" else 4, lambda row: None)
            elif word in ("Triangles", "TrianglesP2"):
                at = self._rows(words, at, 4 if word == "Triangles" else 7, self._triangle)
            elif word in ("Tetrahedra", "TetrahedraP2"):
                at = self._rows(words, at, 5 if word == "Tetrahedra" else 11, self._tetrahedron)
            else:
                raise program.MeshError(f"The mesh file has an unexpected section {word}.")

    @staticmethod
    def _rows(words, at, length, use):
        count = int(words[at])
        for start in range(at + 1, at + 1 + count * length, length):
            use(words[start:start + length])
        return at + 1 + count * length

    def _triangle(self, row):
        self.triangles.append(list(map(int, row[:-1])))
        self.faces.append(int(row[-1]))

    def _tetrahedron(self, row):
        self.tetrahedra.append(list(map(int, row[:-1])))
        self.solids.append(int(row[-1]))


def freecad_order(n):
    """Nodes of a tetrahedron as FreeCAD has them: its first two corners are exchanged."""
    return [n[1], n[0], n[2], n[3]] if len(n) == 4 else [n[1], n[0], n[2], n[3], n[4], n[6], n[5], n[8], n[7], n[9]]


def fem_mesh(content):
    """A Fem::FemMesh with groups Face<i> of triangles and Solid<i> of tetrahedra. Returns it with the numbers of triangles by face, and of
    tetrahedra by solid."""
    mesh = Fem.FemMesh()
    for number, (x, y, z) in enumerate(content.nodes, 1):
        mesh.addNode(x, y, z, number)
    by_face, by_solid = {}, {}
    for number, (nodes, face) in enumerate(zip(content.triangles, content.faces), 1):
        mesh.addFace(nodes, number)
        by_face.setdefault(face, []).append(number)
    for number, (nodes, solid) in enumerate(zip(content.tetrahedra, content.solids), len(content.triangles) + 1):
        mesh.addVolume(freecad_order(nodes), number)
        by_solid.setdefault(solid, []).append(number)
    for name, kind, members in (("Face", "Face", by_face), ("Solid", "Volume", by_solid)):
        for number, elements in sorted(members.items()):
            mesh.addGroupElements(mesh.addGroup(f"{name}{number}", kind), elements)
    return mesh, by_face, by_solid


def numbers_of(references, part, prefix):
    """Numbers of the faces ("Face") or solids ("Solid") of a part that an object of an analysis refers to; None if it refers to others, too."""
    numbers = []
    for feature, names in references or []:
        for name in (names,) if isinstance(names, str) else names:
            if feature is not part or not name.startswith(prefix):
                return None
            numbers.append(int(name[len(prefix):]))
    return numbers


def add_analysis_groups(mesh, content, by_face, by_solid, part, members):
    """Adds the groups by which FreeCAD's solvers find nodes, faces and volumes of constraints and materials exactly: NAME_Nodes, NAME_Faces,
    NAME_Volumes. Others are found by their places. A group with the label of the object is for other solvers."""
    for each in members:
        references = getattr(each, "References", None)
        if not references:
            continue
        faces, solids = numbers_of(references, part, "Face"), numbers_of(references, part, "Solid")
        if faces:
            elements = [element for face in faces for element in by_face.get(face, [])]
            nodes = sorted({node for element in elements for node in content.triangles[element - 1]})
            mesh.addGroupElements(mesh.addGroup(f"{each.Name}_Nodes", "Node"), nodes)
            for name in (f"{each.Name}_Faces", each.Label):
                mesh.addGroupElements(mesh.addGroup(name, "Face"), elements)
        elif solids:
            elements = [element for solid in solids for element in by_solid.get(solid, [])]
            for name in (f"{each.Name}_Volumes", each.Label):
                mesh.addGroupElements(mesh.addGroup(name, "Volume"), elements)


def mesh_shape(shape, settings, progress=None, part=None, members=()):
    """Meshes a shape. progress(line) may cancel by returning True. Raises program.MeshError."""
    if shape.isNull() or not shape.Faces:
        raise program.MeshError("The selected object has no faces.")
    if settings.engine != "Surface only" and not shape.Solids:
        raise program.MeshError("The selected object has no solid: choose the engine 'Surface only'.")
    with program.temporary_folder() as folder:
        shape.exportBrep(os.path.join(folder, "shape.brep"))
        lines = program.run(settings.words("shape.brep", "mesh.mesh"), folder, progress)
        content = Content(os.path.join(folder, "mesh.mesh"))
    mesh, by_face, by_solid = fem_mesh(content)
    add_analysis_groups(mesh, content, by_face, by_solid, part, members)
    return mesh, lines
