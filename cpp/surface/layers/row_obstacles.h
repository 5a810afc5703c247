// SPDX-License-Identifier: BSD-3-Clause
// Edges and points that rows must not reach.
#pragma once

#include "support/box_tree.h"
#include "surface/layers/row_face.h"

namespace carreau {

/// Keeps a reference to the face.
class RowObstacles {
 public:
  explicit RowObstacles(const RowFace& face);
  /// Lowers Column::levels: its last vertex keeps a distance from each obstacle.
  void end(Column& column) const;

 private:
  /// An imposed edge or an imposed point.
  struct Obstacle {
    Vec3 a, b;
    Vec3 up{0, 0, 0};  ///< across the curve into the face, if it has layers
    double total = 0;  ///< height of all of its rows; 0: none
    double sagitta = 0;  ///< of the line in (u, v) over the edge
    Vec3 bulge{0, 0, 0};  ///< LayerCurves::bulge()
  };
  static Vec3 nearest_on(const Obstacle& edge, const Vec3& p);
  [[nodiscard]] bool is_clear(const Column& column, const Obstacle& obstacle, const Vec3& p, double height, double row,
                              double sagitta, double bulge) const;

  const RowFace& face_;
  std::vector<Obstacle> obstacles_;
  BoxTree tree_;
};

}  // namespace carreau
