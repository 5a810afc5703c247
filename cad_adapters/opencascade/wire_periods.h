// SPDX-License-Identifier: BSD-3-Clause
// Loops that OpenCASCADE's reader leaves open on periodic surfaces.
#pragma once

#include <Geom2d_Curve.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <vector>

namespace carreau_occ {

/// An edge of a wire and its curve in the parameter plane of a face. The edge has its orientation in the wire.
struct EdgeImage {
  TopoDS_Edge edge;
  Handle(Geom2d_Curve) curve;
  double first = 0, last = 1;
};

/// Moves curves by whole periods of the face's surface so that the wire closes, and leaves out "degenerate" edges that
/// are no point of space: OpenCASCADE 7.6 adds such ones where it has put two circles of a surface of revolution a
/// period apart. Curves that move are copies. A wire that closes, or that this does not close, stays as it is.
/// `wire` in any order, for the face taken forward. May throw Standard_Failure.
void close_over_periods(std::vector<EdgeImage>& wire, const TopoDS_Face& face);

}  // namespace carreau_occ
