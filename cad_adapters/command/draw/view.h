// SPDX-License-Identifier: BSD-3-Clause
// The view of a picture, and how the mesh is fitted into it.
#pragma once

#include <string>
#include <vector>

#include "files/mesh_file.h"

namespace command {

/// A camera far enough to see the whole mesh: right, up and towards the eye, orthonormal.
struct View {
  Point right, up, toward;
};

/// A view from a name (iso, front, back, left, right, top, bottom) or from a direction "x,y,z" that points from the
/// mesh to the eye. z is up (y, when the direction is along z). Throws Failure.
View view_from(const std::string& text);

/// Perspective projection to pixels: x right, y down from the upper left corner. Depth is larger for nearer points, and
/// linear on the image of a plane.
class Projection {
 public:
  /// Fits the points into the rectangle [x0, x0 + width] x [y0, y0 + height] with a margin of 4 %.
  Projection(const View& view, const std::vector<Point>& points, double x0, double y0, double width, double height);

  /// {x, y, depth}.
  [[nodiscard]] Point operator()(const Point& p) const;
  /// The place on the picture with a depth nearer to the eye by `length`.
  [[nodiscard]] Point ahead(const Point& p, double length) const;
  /// False beside or behind the eye, or nearly so: only when the picture does not hold the whole mesh.
  [[nodiscard]] bool is_before_eye(const Point& p) const { return in_camera(p)[2] < 0.9 * distance_; }
  /// The point in the frame of the camera: right, up, toward the eye.
  [[nodiscard]] Point in_camera(const Point& p) const;

 private:
  View view_;
  Point centre_{};
  double distance_ = 1;  ///< from the centre of the mesh to the eye
  double scale_ = 1, x_ = 0, y_ = 0;
};

}  // namespace command
