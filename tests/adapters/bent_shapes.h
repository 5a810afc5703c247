// SPDX-License-Identifier: BSD-3-Clause
// Faces that bend inside: one surface that looks like several faces.
#pragma once

#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>
#include <vector>

namespace shapes {

struct BentShape {
  std::string name;
  std::function<TopoDS_Shape()> make;
  double area = 0, volume = 0;  ///< of closed forms; volume 0: no solid
  int faces = 0;                ///< of the shape
  bool flat = false;            ///< between its bends: triangles are exact
};

/// Roofs, vaults, pipes, pyramids, prisms and solids of revolution, whole and with holes across their bends.
const std::vector<BentShape>& bent_shapes();

/// The roof of shapes.h with an edge inside that lies on a piece of its ridge.
TopoDS_Shape marked_roof();
/// An offset of the roof: its sides do not meet above the ridge.
TopoDS_Shape torn_roof();

}  // namespace shapes
