// SPDX-License-Identifier: BSD-3-Clause
#include "gradation/facing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gradation/thresholds.h"
#include "mesh/triangle_search.h"
#include "support/rounding_of.h"
#include "support/work_sizes.h"

namespace carreau {

namespace {

using namespace thresholds::gradation;

class Facing {
 public:
  Facing(const GradationGraph& graph, Monitor& monitor) : graph_(graph), search_(graph.xyz, corners(graph), &monitor) {}

  std::optional<FacingPlace> from(int place, double reach, const std::function<bool(int, int)>& apart) {
    const Vec3 p = position(place), n = graph_.places[place].normal;
    found_.clear();
    search_.beside_segment(p - reach * n, p + reach * n, found_);
    std::optional<FacingPlace> nearest;
    for (const std::int32_t t : found_) {
      if (!apart(place, graph_.triangles[t][0])) continue;
      const auto hit = meet(place, p, n, t);
      if (hit && hit->gap <= (nearest ? nearest->gap : reach)) {
        if (nearest && hit->gap == nearest->gap && nearest->triangle < t) continue;
        nearest = hit;
      }
    }
    return nearest;
  }

 private:
  static std::vector<std::array<std::int32_t, 3>> corners(const GradationGraph& graph) {
    std::vector<std::array<std::int32_t, 3>> triangles;
    triangles.reserve(graph.triangles.size());
    for (const auto& t : graph.triangles)
      triangles.push_back({graph.places[t[0]].vertex, graph.places[t[1]].vertex, graph.places[t[2]].vertex});
    return triangles;
  }
  [[nodiscard]] Vec3 position(int place) const noexcept { return graph_.xyz[graph_.places[place].vertex]; }

  // Intersection of a triangle with the line through p along n.
  [[nodiscard]] std::optional<FacingPlace> meet(int place, const Vec3& p, const Vec3& n, int t) const {
    const auto& c = graph_.triangles[t];
    std::array<Vec3, 3> x;
    for (int i = 0; i < 3; ++i) x[i] = position(c[i]);
    const Vec3 normal = cross(x[1] - x[0], x[2] - x[0]);
    const double area = norm(normal), steep = dot(normal, n);
    if (!(area > 0) || std::abs(steep) < head_on * area) return {};
    const double way = dot(normal, x[0] - p) / steep;
    const Vec3 at = p + way * n;
    std::array<double, 3> w{};
    for (int i = 0; i < 3; ++i) {
      w[i] = dot(cross(x[(i + 2) % 3] - x[(i + 1) % 3], at - x[(i + 1) % 3]), normal) / (area * area);
      if (w[i] < -rounding_of::places) return {};
    }
    return FacingPlace{place, std::abs(way + bulge(c, x, w, normal) * area / steep), t, at};
  }

  // Height of the surface over a point of a triangle, along its normal. An arc of radius r rises by l^2 / (8 r) over
  // the middle of its chord l; its normals turn by l / r.
  [[nodiscard]] double bulge(const std::array<int, 3>& c, const std::array<Vec3, 3>& x, const std::array<double, 3>& w,
                             const Vec3& normal) const {
    double height = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const auto out = [&](int k) {
        const Vec3 m = graph_.places[c[k]].normal;
        return dot(m, normal) < 0 ? -1 * m : m;
      };
      height += 0.5 * w[i] * w[j] * dot(x[j] - x[i], out(j) - out(i));
    }
    return height;
  }

  const GradationGraph& graph_;
  TriangleSearch search_;
  std::vector<std::int32_t> found_;
};

}  // namespace

std::vector<FacingPlace> find_facing_places(const GradationGraph& graph, const std::function<double(int)>& reach,
                                            const std::function<bool(int, int)>& apart, Monitor& monitor) {
  std::vector<FacingPlace> found;
  if (graph.triangles.empty()) return found;
  Facing facing(graph, monitor);
  for (std::size_t p = 0; p < graph.places.size(); ++p) {
    if (p % work_sizes::searches == 0) monitor.checkpoint();
    if (const auto place = facing.from(static_cast<int>(p), reach(static_cast<int>(p)), apart)) found.push_back(*place);
  }
  return found;
}

}  // namespace carreau
