# SPDX-License-Identifier: BSD-3-Clause
"""Adds the command to FreeCAD, and a toolbar and a menu entry to the FEM workbench."""
from carreau_fem import command

command.install()
