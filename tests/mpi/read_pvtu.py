#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""VTK reads a .pvtu: without ghosts it has every vertex and triangle of the .vtu of one process once, at the same places and
with the same corners and references.

    read_pvtu.py <x.pvtu> <one.vtu> <ranks> [kept]

kept: ranks keep the faces that they have meshed, and a late one may have none.
"""
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy


def read(reader, path):
    reader.SetFileName(path)
    assert reader.CanReadFile(path), path
    reader.Update()
    return reader.GetOutput()


def triangles_of(grid):
    """Corners of the triangles, and which cells they are."""
    types = vtk_to_numpy(grid.GetCellTypesArray())
    cells = np.flatnonzero(types == vtk.VTK_TRIANGLE)
    offsets, nodes = (vtk_to_numpy(a) for a in (grid.GetCells().GetOffsetsArray(), grid.GetCells().GetConnectivityArray()))
    return np.array([nodes[offsets[c]:offsets[c] + 3] for c in cells]), cells


def array(data, name):
    return vtk_to_numpy(data.GetArray(name))


def main():
    path, one, ranks = sys.argv[1], sys.argv[2], int(sys.argv[3])
    parts, whole = read(vtk.vtkXMLPUnstructuredGridReader(), path), read(vtk.vtkXMLUnstructuredGridReader(), one)
    assert parts.GetCellData().GetGlobalIds() is not None and parts.GetPointData().GetGlobalIds() is not None
    corners, cells = triangles_of(parts)
    assert len(cells) == parts.GetNumberOfCells()
    wanted, cells_of_one = triangles_of(whole)
    ghost, number = array(parts.GetCellData(), "vtkGhostType"), array(parts.GetCellData(), "GlobalElementIds")
    of_point = array(parts.GetPointData(), "GlobalPointIds")
    xyz, xyz_of_one = (vtk_to_numpy(g.GetPoints().GetData()) for g in (parts, whole))
    assert (xyz == xyz_of_one[of_point]).all(), "vertices are where they are"
    assert (of_point[corners] == wanted[number]).all(), "triangles, ghosts too, have their corners"
    assert sorted(number[ghost == 0]) == list(range(len(wanted))), "every triangle is somebody's own once"
    own_points = of_point[array(parts.GetPointData(), "vtkGhostType") == 0]
    assert sorted(own_points) == list(range(len(xyz_of_one))), "and every vertex"
    references = array(whole.GetCellData(), "reference")[cells_of_one]
    assert (array(parts.GetCellData(), "reference") == references[number]).all()
    owners = set(array(parts.GetCellData(), "owner")[ghost == 0])
    assert owners == set(range(ranks)) or (sys.argv[4:] == ["kept"] and owners < set(range(ranks)))
    assert (ghost != 0).any() == (len(owners) > 1)
    # Ghosts as VTK itself reads them.
    remove = vtk.vtkRemoveGhosts()
    remove.SetInputData(parts)
    remove.Update()
    assert remove.GetOutput().GetNumberOfCells() == len(wanted)
    print("VTK", vtk.vtkVersion.GetVTKVersion(), "reads", len(wanted), "triangles once, and", int((ghost != 0).sum()), "ghosts")


main()
