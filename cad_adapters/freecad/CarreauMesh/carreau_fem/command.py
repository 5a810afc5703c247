# SPDX-License-Identifier: BSD-3-Clause
"""The command "Mesh with Carreau", and its place in the FEM workbench."""
import FreeCAD
import FreeCADGui
from PySide import QtGui

from . import mesh_object

NAME = "FEM_MeshCarreau"
TITLE = "Mesh with Carreau"


def chosen_part(selection, document):
    """The selected object with a shape, or the only one of the document; None: no such object, or several."""
    with_shape = [each for each in selection if hasattr(each, "Shape") and each.Shape.Faces]
    if with_shape:
        return with_shape[0]
    visible = [each for each in document.Objects if hasattr(each, "Shape") and each.Shape.Solids and not any(hasattr(user, "Shape") for user in each.InList)]
    return visible[0] if len(visible) == 1 else None


def chosen_analysis(selection, document):
    found = [each for each in [*selection, *document.Objects] if each.isDerivedFrom("Fem::FemAnalysis")]
    return found[0] if found else None


class MeshWithCarreau:
    def GetResources(self):
        return {"Pixmap": "fem-femmesh-from-shape", "MenuText": TITLE, "ToolTip": "Meshes the selected body by Carreau, with groups of faces and solids"}

    def IsActive(self):
        return FreeCAD.ActiveDocument is not None

    def Activated(self):
        document, selection = FreeCAD.ActiveDocument, FreeCADGui.Selection.getSelection()
        part = chosen_part(selection, document)
        if part is None:
            QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), TITLE, "Select the body to be meshed.")
            return
        document.openTransaction(TITLE)
        obj = mesh_object.make(document, part, chosen_analysis(selection, document))
        document.commitTransaction()
        FreeCADGui.getDocument(document).setEdit(obj.Name)


def add_to_workbench(name):
    """A toolbar and an entry of the menu Mesh while the FEM workbench is active."""
    window = FreeCADGui.getMainWindow()
    bar = window.findChild(QtGui.QToolBar, "CarreauMesh")
    if name != "FemWorkbench":
        if bar is not None:
            bar.hide()
        return
    if bar is None:
        bar = window.addToolBar(TITLE)
        bar.setObjectName("CarreauMesh")
        action = bar.addAction(QtGui.QIcon(":/icons/fem-femmesh-from-shape.svg"), TITLE)
        action.setToolTip(TITLE)
        action.triggered.connect(lambda: FreeCADGui.runCommand(NAME))
    bar.show()
    for menu in window.menuBar().findChildren(QtGui.QMenu):
        if menu.title().replace("&", "") == "Mesh" and TITLE not in [action.text() for action in menu.actions()]:
            menu.addAction(bar.actions()[0])


def install():
    FreeCADGui.addCommand(NAME, MeshWithCarreau())
    window = FreeCADGui.getMainWindow()
    window.workbenchActivated.connect(add_to_workbench)
