// SPDX-License-Identifier: BSD-3-Clause
// Borders of charts, cut by the sizes: sharp lines, and cuts between charts of one region.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surface/remesh/base/cross_patch_mesh.h"
#include "surface/remesh/lines/line_remeshing.h"
#include "surface/remesh/planes/find_charts.h"

namespace carreau {

/// Edges of the new mesh, in a row, with the chart on each side; -1: no chart.
struct BorderChain {
  std::vector<std::int32_t> vertices;
  std::int32_t left = -1, right = -1;
};

struct Borders {
  std::vector<BorderChain> chains;
  std::vector<std::vector<LineNode>> lines;      ///< by line: vertices of the previous mesh
  std::vector<std::vector<KeptPlaces>> on_line;  ///< by line and node; none where a corner stays as it is
  std::vector<SurfacePlace> added;               ///< vertices of cuts; they follow the vertices of the previous mesh
  std::vector<std::int32_t> number;  ///< by vertex of the previous mesh: its number at a place on a border; -1: no such place
};

struct BorderInput {
  const FlatAtlas& atlas;
  const ProjectedCharts& charts;
  std::span<const SharpLine> lines;
  std::span<const WorkedLine> worked;  ///< by line
  std::span<const double> size;        ///< by vertex of the previous mesh
  std::span<const char> exact;         ///< by chart: see ProjectedCharts
  std::span<const char> kept;          ///< for each vertex of the previous mesh: its chart stays as it is
  SurfaceTolerances tolerance;
  Cad& cad;
  std::span<const std::int32_t> twin = {};  ///< RemeshingFrame::twin
};

/// Returns nothing if edges have more than two triangles, or lines too few vertices for the sizes.
std::optional<Borders> cut_borders(const BorderInput& input, Monitor& monitor);

// The two steps of cut_borders().
/// One sharp line: edges of equal length in sizes, all within tolerance of the line. `at_least`: edges.
struct DividedLine {
  std::vector<LineNode> nodes;
  std::vector<KeptPlaces> places;
};
std::optional<DividedLine> divide_line(const BorderInput& input, std::size_t line, int at_least);
[[nodiscard]] std::size_t nearest_node(const std::vector<LineNode>& nodes, double arc);

/// Cuts between charts, straightened. `borders` has the sharp lines already.
class LinePoints;
void trace_cuts(const BorderInput& input, const LinePoints& points, Borders& borders, Monitor& monitor);

/// Places in the new mesh of the atlas's vertices on sharp lines.
class LinePoints {
 public:
  LinePoints(const BorderInput& input, const Borders& borders);
  struct Point {
    std::int32_t vertex = -1;  ///< -1: on no sharp line
    Vec3 xyz;
  };
  [[nodiscard]] const Point& of(std::int32_t v) const { return point_[v]; }

 private:
  std::vector<Point> point_;
};

}  // namespace carreau
