# SPDX-License-Identifier: BSD-3-Clause
"""CAD from memory: bytes, open files, shapes of FreeCAD, and stand-ins with the protocols of build123d and CadQuery, which
Debian does not have."""
import glob
import io
import os
import shutil
import subprocess
import sys

import pytest

import carreau
from carreau import errors, shapes
from conftest import needs

pytestmark = needs("CARREAU_MAKE_SHAPES")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The folder of the files that make_shapes writes."""
    path = tmp_path_factory.mktemp("shapes")
    subprocess.run([os.environ["CARREAU_MAKE_SHAPES"], str(path)], check=True, capture_output=True)
    return path


def content(path):
    with open(path, "rb") as file:
        return file.read()


def test_bytes_are_as_good_as_a_file(folder):
    path = folder / "inch.step"
    by_path = carreau.mesh(str(path), size=5)
    for source in (content(path), bytearray(content(path)), io.BytesIO(content(path)), open(path, "rb")):
        made = carreau.mesh(source, size=5)
        assert (made.triangles == by_path.triangles).all() and (made.vertices == by_path.vertices).all()


def test_units_and_scales(folder):
    for options, edge in (({}, 25.4), ({"unit": "in"}, 1), ({"unit": "m"}, 0.0254), ({"scale": 2}, 50.8), ({"unit": "in", "scale": 3}, 3)):
        made = carreau.mesh(content(folder / "inch.step"), size="5%", **options)
        assert made.quality.area == pytest.approx(6 * edge ** 2, rel=1e-12)


def test_the_unit_of_the_file_is_reported(folder):
    file = carreau.CadFile(folder / "inch.step", unit="m")
    assert (file.content.unit, file.content.file_unit) == ("m", "in")


@pytest.mark.parametrize("source, said", [(b"", "are not a STEP, IGES or BREP file"), (b"solid", "are not a STEP, IGES or BREP file")])
def test_bytes_that_are_no_shape_are_rejected(source, said):
    with pytest.raises(errors.FileError, match=said):
        carreau.mesh(source)


def test_a_unit_of_nothing_is_rejected(folder):
    with pytest.raises(errors.FileError, match="'parsec' is not a unit of length"):
        carreau.CadFile(folder / "inch.step", unit="parsec")


class Named:
    """A shape that writes its BREP file as CadQuery (a path or a stream), or build123d."""

    def __init__(self, path, solids):
        self.path, self.count = path, solids

    def exportBrep(self, to):
        shutil.copyfile(self.path, to)

    def Solids(self):
        return [None] * self.count


class Labelled:
    """A tree of labelled shapes as build123d's Compound."""

    def __init__(self, path, solids, label="", color=None, children=()):
        self.path, self.count, self.label, self.color, self.children = path, solids, label, color, children

    def export_brep(self, to):
        shutil.copyfile(self.path, to)

    def solids(self):
        return [None] * self.count


class Colour:
    """As CadQuery's Color."""

    def toTuple(self):
        return (1, 0.5, 0, 1)


class Assembly:
    """As CadQuery's: its own shapes come before its children's shapes."""

    def __init__(self, name, shapes, children=(), color=None, compound=None):
        self.name, self.shapes, self.children, self.color, self.compound = name, shapes, children, color, compound

    def toCompound(self):
        return self.compound


def test_shapes_that_write_themselves(folder):
    path = folder / "touching.brep"
    by_path = carreau.mesh(str(path), size=1)
    for shape in (Named(path, 2), Labelled(path, 2), type("Held", (), {"wrapped": Named(path, 2)})(), type("Object", (), {"Shape": Named(path, 2)})()):
        assert carreau.mesh(shape, size=1).quality.area == by_path.quality.area


def test_labels_and_colours_name_the_solids(folder):
    path = folder / "touching.brep"
    tree = Labelled(path, 2, "press", (0, 0, 1), (Labelled(None, 1, "plate", (1, 0, 0)), Labelled(None, 1, "stamp")))
    file = carreau.CadFile(tree)
    assert {(face.solid_name, face.rgb) for face in file.faces} == {("plate", 0xFF0000), ("stamp", 0x0000FF)}
    of_cadquery = Assembly("plate", [Named(None, 1)], [Assembly("stamp", [Named(None, 1)])], Colour(), Named(path, 2))
    file = carreau.CadFile(of_cadquery)
    assert {(face.solid_name, face.rgb) for face in file.faces} == {("plate", 0xFF8000), ("stamp", 0xFF8000)}


def test_names_follow_an_imprint(folder):
    """A cube of side 2 on a plate of 4 x 4 x 1: the contact is one face of both."""
    tree = Labelled(folder / "touching.brep", 2, "press", None, (Labelled(None, 1, "plate"), Labelled(None, 1, "stamp")))
    file = carreau.CadFile(tree, imprint=True)
    assert file.losses == [] and file.content.shared_faces == 1
    shared = [face for face in file.faces if face.other_solid > 0]
    assert [{face.solid_name, face.other_solid_name} for face in shared] == [{"plate", "stamp"}]
    made = carreau.mesh(file, size=0.5)
    assert made.quality.area == pytest.approx(2 * 16 + 4 * 4 + 5 * 4, rel=1e-12)


def test_a_mirror_plane_adds_the_other_half(folder):
    file = carreau.CadFile(folder / "touching.brep")
    before = len(file.faces)
    with pytest.raises(errors.ArgumentError):
        file.mirror((0, 0, 0), (0, 0, 0))
    file.mirror((-50, 0, 0), (1, 0, 0))
    assert len(file.faces) == 2 * before


def test_names_and_sizes_by_number(folder):
    file = carreau.CadFile(folder / "touching.brep")
    file.name_solids(["plate", "cube"])
    file.imprint()
    file.set_size(3, 2, 0.2)  # all faces of the cube
    with pytest.raises(errors.ArgumentError, match="there is no edge 999"):
        file.set_size(1, 999, 1)
    made = carreau.mesh(file, size=1, gradation=1.5, hphy_flag=2)
    shared, = (face.number for face in file.faces if face.other_solid > 0)
    assert made.face_sides(shared) == (1, 2) and made.entity_name(3, 2) == "cube"
    on_cube = [face.number for face in file.faces if 2 in (face.solid, face.other_solid)]
    longest = max(float(((made.vertices[t] - made.vertices[t[[1, 2, 0]]]) ** 2).sum(axis=1).max()) ** 0.5
                  for t, face in zip(made.triangles, made.face_ids) if face in on_cube)
    assert longest < 0.2 * 1.5


def test_names_layers_and_contacts(folder):
    file = carreau.CadFile(folder / "press.step")
    assert [(row.depth, row.kind, row.name, row.layer) for row in file.tree if row.kind in ("assembly", "part")] == [
        (0, "assembly", "press", ""), (1, "part", "plate", "walls"), (1, "part", "stamp", "tools"), (1, "part", "stamp", "tools")]
    assert [file.entity_name(1, k) for k in range(1, file.content.edges + 1)].count("rim") == 1
    assert sum(face.layer == "walls" for face in file.faces) == 6
    assert [(contact.solids, contact.area) for contact in file.contacts] == [((1, 2), pytest.approx(1)), ((1, 3), pytest.approx(1))]


def test_other_objects_than_shapes_are_rejected():
    with pytest.raises(errors.ArgumentError, match="has no exportBrep"):
        shapes.brep_of(object())


FREECAD = next((folder for folder in ("/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib") if glob.glob(folder + "/FreeCAD.so")), "")


@pytest.mark.skipif(not FREECAD or not os.path.exists("/usr/bin/python3"), reason="FreeCAD's Python (freecad-python3) is not there")
def test_a_shape_of_freecad_is_meshed(tmp_path):
    """Runs a separate process of the Python that FreeCAD was built for. FreeCAD and the adapter use one OpenCASCADE."""
    script = f"""
import sys
sys.path.append({FREECAD!r})
import FreeCAD, Part, carreau
box = Part.makeBox(4, 4, 1)
pin = Part.makeCylinder(1, 2, FreeCAD.Vector(2, 2, 1))
made = carreau.mesh(Part.makeCompound([box, pin]), size=0.2, imprint=True)
assert made.quality.open_edges == 0
document = FreeCAD.newDocument()
held = document.addObject("Part::Feature", "plate")
held.Shape = box
assert abs(carreau.mesh(held, size=0.5).quality.area - 48) < 1e-9
file = carreau.CadFile(held)
assert {{face.solid_name for face in file.faces}} == {{"plate"}}, file.faces
"""
    ran = subprocess.run(["/usr/bin/python3", "-c", script], capture_output=True, text=True,
                         env={**os.environ, "PYTHONPATH": os.pathsep.join(each for each in sys.path if each)
                              if sys.executable.startswith("/usr/bin") else os.environ.get("PYTHONPATH", "")})
    assert ran.returncode == 0, ran.stderr
