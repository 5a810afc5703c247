# SPDX-License-Identifier: BSD-3-Clause
"""FreeCAD runs this file at its start, with and without windows: the folder of the add-on is in sys.path from then on."""
