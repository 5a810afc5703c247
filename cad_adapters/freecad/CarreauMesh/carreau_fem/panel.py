# SPDX-License-Identifier: BSD-3-Clause
"""The task panel: settings, progress, cancel."""
import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from . import mesh_object, mesher, program


class Panel:
    def __init__(self, obj):
        self.obj = obj
        self.running = self.cancelled = False
        self.form = QtGui.QWidget()
        self.form.setWindowTitle("Mesh with Carreau")
        rows = QtGui.QFormLayout(self.form)
        self.lengths = {}
        for name, label in (("ElementSize", "Element size"), ("MinimumSize", "Minimum size"), ("MaximumSize", "Maximum size")):
            self.lengths[name] = self._number(getattr(obj, name).Value, 1e9, 4, "automatic", " mm")
            rows.addRow(label, self.lengths[name])
        self.angle = self._number(obj.Angle.Value, 89, 1, "off", "\u00b0")
        rows.addRow("Curvature angle", self.angle)
        self.gradation = self._number(obj.Gradation, 100, 2, "any", "")
        rows.addRow("Gradation", self.gradation)
        self.order = self._choice(["1st", "2nd"], obj.ElementOrder)
        rows.addRow("Element order", self.order)
        self.engine = self._choice(mesher.ENGINES, obj.Engine)
        rows.addRow("Volume engine", self.engine)
        self.sizes = QtGui.QLineEdit(", ".join(obj.FaceSizes))
        self.sizes.setPlaceholderText("Face3=0.5, Face7=1")
        rows.addRow("Sizes on faces", self.sizes)
        self.program = QtGui.QLineEdit(FreeCAD.ParamGet(program.PARAMETERS).GetString("Program", ""))
        self.program.setPlaceholderText("carreau in PATH")
        rows.addRow("Program", self.program)
        self.bar = QtGui.QProgressBar()
        self.bar.setRange(0, 1)
        rows.addRow(self.bar)
        self.text = QtGui.QPlainTextEdit()
        self.text.setReadOnly(True)
        rows.addRow(self.text)

    @staticmethod
    def _number(value, largest, digits, special, suffix):
        box = QtGui.QDoubleSpinBox()
        box.setRange(0, largest)
        box.setDecimals(digits)
        box.setSpecialValueText(special)
        box.setSuffix(suffix)
        box.setValue(value)
        return box

    @staticmethod
    def _choice(words, chosen):
        box = QtGui.QComboBox()
        box.addItems(words)
        box.setCurrentIndex(words.index(chosen))
        return box

    def getStandardButtons(self):
        return int(QtGui.QDialogButtonBox.Apply | QtGui.QDialogButtonBox.Close)

    def clicked(self, button):
        if button == QtGui.QDialogButtonBox.Apply:
            self.mesh()

    def store(self):
        for name, box in self.lengths.items():
            setattr(self.obj, name, box.value())
        self.obj.Angle, self.obj.Gradation = self.angle.value(), self.gradation.value()
        self.obj.ElementOrder, self.obj.Engine = self.order.currentText(), self.engine.currentText()
        self.obj.FaceSizes = [each.strip() for each in self.sizes.text().split(",") if each.strip()]
        FreeCAD.ParamGet(program.PARAMETERS).SetString("Program", self.program.text().strip())

    def mesh(self):
        """A second press of Apply, or Close, cancels a run."""
        if self.running:
            self.cancelled = True
            return
        self.store()
        self.running, self.cancelled = True, False
        self.text.clear()
        self.bar.setRange(0, 0)
        try:
            mesh_object.mesh(self.obj, self.follow)
            mesh = self.obj.FemMesh
            self.text.appendPlainText(f"{mesh.NodeCount} nodes, {mesh.FaceCount} triangles, {mesh.VolumeCount} tetrahedra, {mesh.GroupCount} groups")
        except program.MeshError as error:
            self.text.appendPlainText(str(error))
            FreeCAD.Console.PrintError(f"{error}\n")
        finally:
            self.running = False
            self.bar.setRange(0, 1)
            self.bar.setValue(1)

    def follow(self, line):
        if line:
            self.text.appendPlainText(line)
        QtCore.QCoreApplication.processEvents()
        return self.cancelled

    def reject(self):
        self.cancelled = True
        self.store()
        FreeCADGui.Control.closeDialog()
        FreeCADGui.ActiveDocument.resetEdit()
        return True

    def accept(self):
        return self.reject()


def show(obj):
    FreeCADGui.Control.closeDialog()
    panel = Panel(obj)
    FreeCADGui.Control.showDialog(panel)
    return panel
