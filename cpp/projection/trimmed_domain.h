// SPDX-License-Identifier: BSD-3-Clause
// The domain of a face whose boundary is not a rectangle.
#pragma once

#include <optional>
#include <vector>

#include "cad/cad.h"
#include "curve/support.h"
#include "model/model.h"
#include "predicates/polygon_locator.h"
#include "support/box_tree.h"

namespace carreau::projection {

/// Answers from several threads if the host does. Far from the boundary the polygon of the supports decides, near it the curves themselves.
class TrimmedDomain {
 public:
  /// `supports`: of all curves of the face. Ends of curves that are apart in the plane are joined with the nearest other end.
  TrimmedDomain(const Face& face, const std::vector<CurveSupport>& supports);

  enum class Side { outside, inside, crossing };
  /// The side of a box; `crossing` if the boundary comes near it.
  [[nodiscard]] Side side_of(const Vec2& low, const Vec2& high) const;
  /// True if the place lies in the domain or on its boundary.
  [[nodiscard]] bool contains(const Vec2& uv, Cad& cad) const;

 private:
  struct Piece {
    int ic = 0;
    double t0 = 0, t1 = 0, a = 0, b = 0;
    double margin = 0;  // share of the extents
  };
  [[nodiscard]] Vec3 scaled(const Vec2& uv) const {
    return {(uv.x() - low_.x()) / size_.x(), (uv.y() - low_.y()) / size_.y(), 0};
  }

  int ref_;
  Vec2 low_, size_;
  std::vector<Vec2> vertices_;
  std::vector<std::pair<int, int>> edges_;
  std::vector<Piece> pieces_;  // of edges_
  std::optional<PolygonLocator> polygon_;
  BoxTree tree_;  // of the edges, scaled to the unit square
};

/// The curves around a face.
std::vector<BoundaryCurve> boundary_of(const Face& face, const std::vector<CurveSupport>& supports);
/// The box of the boundary curves in the parameter plane; low > high if there are none.
std::pair<Vec2, Vec2> box_of_boundary(const Face& face, const std::vector<CurveSupport>& supports);
/// True if the boundary is the box.
bool is_box(const Face& face, const std::vector<CurveSupport>& supports, const Vec2& low, const Vec2& high);

}  // namespace carreau::projection
