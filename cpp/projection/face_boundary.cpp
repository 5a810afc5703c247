// SPDX-License-Identifier: BSD-3-Clause
#include "projection/face_boundary.h"

#include <cstddef>

#include "support/infinity.h"
#include "support/rounding_of.h"

namespace carreau::projection {

namespace {

bool bounds_face(const Face& face, std::size_t curve) { return face.curves[curve].type == CurveType::boundary; }

}  // namespace

std::pair<Vec2, Vec2> box_of_boundary(const Face& face, const std::vector<CurveSupport>& supports) {
  Vec2 low{infinity, infinity}, high{-infinity, -infinity};
  for (std::size_t c = 0; c < supports.size(); ++c) {
    if (!bounds_face(face, c)) continue;
    for (const Vec2& p : supports[c].uv) low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  return {low, high};
}

bool is_box(const Face& face, const std::vector<CurveSupport>& supports, const Vec2& low, const Vec2& high) {
  const Vec2 near = rounding_of::places * (high - low);
  for (std::size_t c = 0; c < supports.size(); ++c) {
    if (!bounds_face(face, c)) continue;
    for (const Vec2& p : supports[c].uv) {
      const Vec2 from = (p - low).cwiseMin(high - p);
      if (from.x() > near.x() && from.y() > near.y()) return false;
    }
  }
  return true;
}

std::vector<BoundaryCurve> boundary_of(const Face& face, const std::vector<CurveSupport>& supports) {
  std::vector<BoundaryCurve> boundary;
  for (std::size_t c = 0; c < supports.size(); ++c)
    if (bounds_face(face, c)) boundary.push_back({static_cast<int>(c) + 1, supports[c].t, supports[c].uv});
  return boundary;
}

}  // namespace carreau::projection
