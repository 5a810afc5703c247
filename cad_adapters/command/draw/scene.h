// SPDX-License-Identifier: BSD-3-Clause
// From a mesh to shaded triangles on a picture.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "draw/ellipses.h"
#include "draw/raster.h"
#include "draw/view.h"
#include "files/mesh_file.h"

namespace command {

enum class Paint { face, reference, quality, size, none };

struct SceneOptions {
  Paint paint = Paint::face;
  bool edges = true;  ///< lines along the sides of triangles; those along curves are always drawn
  VertexMetrics metrics;      ///< whose ellipses are drawn at the vertices; empty: none
  double ellipse_scale = 0.5;  ///< of their half axes
  std::optional<std::array<double, 4>> around;  ///< x, y, z and the radius of what fills the picture; none: the whole mesh
};

/// Sizes of the triangles of a mesh: sides of equilateral triangles of the same area.
struct SizeScale {
  double smallest = 0, largest = 0;

  explicit SizeScale(const MeshArrays& mesh);
  /// 0 for the smallest triangle to 1 for the largest, by the logarithm; 1/2 when all have one size.
  [[nodiscard]] double share(const Point& a, const Point& b, const Point& c) const;
};

/// Of Paint::quality and Paint::size, linear light: colour_scale.h. 0: dark violet, 1/2: blue-green, 1: yellow.
Colour scale_colour(double x);

/// The triangles of `mesh` as `view` shows them in the rectangle [x0, x0 + width] x [y0, y0 + height], in pixels.
/// Triangles whose vertices are not finite are left out.
std::vector<ScreenTriangle> project(const MeshArrays& mesh, const View& view, const SceneOptions& options, double x0,
                                    double y0, double width, double height);

}  // namespace command
