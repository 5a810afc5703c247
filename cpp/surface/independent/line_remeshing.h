// SPDX-License-Identifier: BSD-3-Clause
// Remeshing of sharp lines, across the ends of their curves.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "support/monitor.h"
#include "surface/independent/base/free_mesh.h"
#include "surface/independent/line_places.h"

namespace carreau {

/// Largest distance of edges from their line.
struct LineTolerance {
  double deviation = 0;      ///< model length; 0: `share_of_size` counts
  double share_of_size = 0;  ///< of the size
};

/// A remaining vertex of a line, with its place on the line.
struct LineNode {
  std::int32_t vertex;
  double arc;
};

/// A line during remeshing.
struct WorkedLine {
  std::unique_ptr<LineGeometry> places;
  std::vector<LineNode> left;
  bool closed;

  WorkedLine(const SharpLine& line, std::unique_ptr<LineGeometry> geometry);
};

/// Collapses edges of lines until their number fits the length of the line in the prescribed metric (RR-2818 sec. 4.5).
/// Moves their vertices until edges are of equal length in it, if triangles beside agree with the surface. Returns the
/// vertices changed. Throws the exceptions of the host, and Cancelled.
std::vector<std::int32_t> remesh_lines(FreeMesh& mesh, std::span<WorkedLine> lines, const LineTolerance& tolerance,
                                       Monitor& monitor);

}  // namespace carreau
