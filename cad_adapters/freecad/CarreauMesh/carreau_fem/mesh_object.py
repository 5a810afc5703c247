# SPDX-License-Identifier: BSD-3-Clause
"""The mesh in a document: a Fem::FemMeshObject that knows its part and its settings."""
import FreeCAD

from . import mesher, program


class CarreauMesh:
    """Proxy of the object."""

    def __init__(self, obj):
        obj.Proxy = self
        self.Type = "Fem::FemMeshCarreau"
        for kind, name, group, text in (
                ("App::PropertyLink", "Part", "Mesh", "Object whose shape is meshed"),
                ("App::PropertyLength", "ElementSize", "Sizes", "Length of edges; 0: chosen by curvature"),
                ("App::PropertyLength", "MinimumSize", "Sizes", "Smallest length; 0: any"),
                ("App::PropertyLength", "MaximumSize", "Sizes", "Largest length; 0: any"),
                ("App::PropertyAngle", "Angle", "Sizes", "Angle between edges and curved surfaces; 0: not followed"),
                ("App::PropertyFloat", "Gradation", "Sizes", "Largest growth from edge to edge; 0: any"),
                ("App::PropertyStringList", "FaceSizes", "Sizes", "Sizes on faces in millimetres: Face3=0.5"),
                ("App::PropertyEnumeration", "ElementOrder", "Mesh", "Order of elements"),
                ("App::PropertyEnumeration", "Engine", "Mesh", "Program that fills the solids")):
            obj.addProperty(kind, name, group, text)
        obj.ElementOrder = ["1st", "2nd"]
        obj.ElementOrder = "2nd"
        obj.Engine = mesher.ENGINES

    def __getstate__(self):
        return self.Type

    def __setstate__(self, state):
        self.Type = state

    dumps, loads = __getstate__, __setstate__

    def execute(self, obj):
        """Meshes are made by the command alone: a recomputed document keeps them."""


class ViewCarreauMesh:
    def __init__(self, view):
        view.Proxy = self

    def getIcon(self):
        return ":/icons/fem-femmesh-from-shape.svg"

    def setEdit(self, view, mode=0):
        from . import panel
        panel.show(view.Object)
        return True

    def unsetEdit(self, view, mode=0):
        import FreeCADGui
        FreeCADGui.Control.closeDialog()
        return True

    def doubleClicked(self, view):
        import FreeCADGui
        FreeCADGui.getDocument(view.Object.Document).setEdit(view.Object.Name)
        return True

    def __getstate__(self):
        return None

    def __setstate__(self, state):
        return None

    dumps, loads = __getstate__, __setstate__


def make(document, part, analysis=None, name="CarreauMesh"):
    """A mesh object without a mesh, in the analysis if there is one."""
    obj = document.addObject("Fem::FemMeshObjectPython", name)
    CarreauMesh(obj)
    obj.Part = part
    if FreeCAD.GuiUp:
        ViewCarreauMesh(obj.ViewObject)
    if analysis is not None:
        analysis.addObject(obj)
    return obj


def analysis_of(obj):
    return next((each for each in obj.InList if each.isDerivedFrom("Fem::FemAnalysis")), None)


def settings_of(obj):
    """Raises program.MeshError for an unreadable face size."""
    sizes = {}
    for each in obj.FaceSizes:
        name, _, size = each.partition("=")
        try:
            sizes[int(name.strip()[4:] if name.strip().startswith("Face") else name)] = float(size)
        except ValueError:
            raise program.MeshError(f"'{each}' is not a size on a face, for example Face3=0.5.") from None
    return mesher.Settings(size=obj.ElementSize.Value, minimum=obj.MinimumSize.Value, maximum=obj.MaximumSize.Value, angle=obj.Angle.Value,
                           gradation=obj.Gradation, order=2 if obj.ElementOrder == "2nd" else 1, engine=obj.Engine, face_sizes=sizes)


def mesh(obj, progress=None):
    """Meshes the part of the object. Returns the lines of carreau. Raises program.MeshError."""
    if obj.Part is None or not hasattr(obj.Part, "Shape"):
        raise program.MeshError("The mesh has no part with a shape.")
    analysis = analysis_of(obj)
    made, lines = mesher.mesh_shape(obj.Part.Shape, settings_of(obj), progress, obj.Part, analysis.Group if analysis is not None else ())
    obj.FemMesh = made
    return lines
