# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of FreeCAD's shapes by the program carreau."""
