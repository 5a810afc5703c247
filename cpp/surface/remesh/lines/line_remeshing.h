// SPDX-License-Identifier: BSD-3-Clause
// Remeshing of sharp lines, across the ends of their curves.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "support/monitor.h"
#include "surface/remesh/base/cross_patch_mesh.h"
#include "surface/remesh/lines/line_places.h"

namespace carreau {

/// A vertex that is left of a line, and where it is on it.
struct LineNode {
  std::int32_t vertex;
  double arc;
};

/// A line during remeshing.
struct WorkedLine {
  std::unique_ptr<LineGeometry> places;
  std::vector<LineNode> left;
  bool closed;
  bool fixed = false;  ///< its vertices stay

  WorkedLine(const SharpLine& line, std::unique_ptr<LineGeometry> geometry);
};

/// Collapses edges of lines until there are as many as their length in the prescribed metric wants (RR-2818 sec. 4.5),
/// and moves their vertices until edges are of equal length in it, where triangles beside agree with the surface.
/// Vertices changed. Throws what the host throws, and Cancelled.
std::vector<std::int32_t> remesh_lines(CrossPatchMesh& mesh, std::span<WorkedLine> lines, Monitor& monitor);

}  // namespace carreau
