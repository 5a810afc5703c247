// Vertices of a boundary that come near its edges in space.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "support/segment.h"
#include "support/vec.h"

namespace carreau {

/// Vertices in the order of the coordinate along which they are spread most.
class NearVertices {
 public:
  explicit NearVertices(const std::vector<Vec3>& points) : points_(points), order_(points.size()) {
    Vec3 low = points.empty() ? Vec3{} : points.front(), high = low;
    for (const Vec3& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const Vec3 extent = high - low;
    axis_ = extent.x() >= extent.y() && extent.x() >= extent.z() ? 0 : extent.y() >= extent.z() ? 1 : 2;
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [this](int v, int w) { return points_[v][axis_] < points_[w][axis_]; });
  }

  /// Vertices within `reach` of the segment (a, b) that are at neither end of it, until `visit` says false.
  template <typename Visit>
  void each_beside(Vec3 a, Vec3 b, double reach, Visit&& visit) const {
    const double low = std::min(a[axis_], b[axis_]) - reach, high = std::max(a[axis_], b[axis_]) + reach;
    auto it = std::lower_bound(order_.begin(), order_.end(), low,
                               [this](int v, double value) { return points_[v][axis_] < value; });
    for (; it != order_.end() && points_[*it][axis_] <= high; ++it) {
      const Vec3 p = points_[*it];
      if (!(p == a) && !(p == b) && distance_to_segment(p, a, b) <= reach && !visit(*it)) return;
    }
  }

  [[nodiscard]] bool any_beside(const Vec3& a, const Vec3& b, double reach) const {
    bool any = false;
    each_beside(a, b, reach, [&](int) { return any = true, false; });
    return any;
  }

 private:
  const std::vector<Vec3>& points_;
  std::vector<int> order_;
  int axis_ = 0;
};

}  // namespace carreau
