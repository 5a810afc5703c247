// SPDX-License-Identifier: BSD-3-Clause
#include "plane/division/refill.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/kernel/thresholds.h"
#include "plane/kernel/triangulation.h"
#include "support/error.h"

namespace carreau::plane {

namespace {

/// Triangles of a zone whose places will be filled again, as a domain.
class Void {
 public:
  Void(const Zone& zone, const ZoneContext& context, std::span<const std::array<std::int32_t, 3>> triangles,
       const std::vector<std::uint8_t>& removed)
      : zone_(zone), context_(context), local_(zone.vertices.size(), -1) {
    std::vector<std::int64_t> sides;
    sides.reserve(3 * triangles.size());
    const std::size_t room = triangles.size() / 4 + 16;  // a guess: two sides of some layers
    domain.vertices.reserve(room), domain.edges.reserve(room), of.reserve(room);
    for (const auto& t : triangles) {
      add_expected(t);
      for (int i = 0; i < 3; ++i) sides.push_back(key(t[i], t[next3[i]]));
    }
    std::sort(sides.begin(), sides.end());
    for (const auto& t : triangles)
      for (int i = 0; i < 3; ++i) {
        const std::int32_t a = t[i], b = t[next3[i]];
        if (removed[a] == 0) number(a);
        const bool rim = !std::binary_search(sides.begin(), sides.end(), key(b, a));
        if (rim)
          add_edge(a, b, PlaneEdgeKind::boundary);
        else if (a < b && is_imposed(a, b))
          add_edge(a, b, PlaneEdgeKind::internal);
      }
  }

  PlaneDomain domain;
  std::vector<std::int32_t> of;  ///< by vertex of the domain: the vertex of the zone
  double expected = 0;           ///< triangles

 private:
  static std::int64_t key(std::int64_t a, std::int64_t b) { return a << 32 | b; }

  void add_expected(const std::array<std::int32_t, 3>& t) {
    const Vec2 p = zone_.vertices[t[0]], q = zone_.vertices[t[1]], r = zone_.vertices[t[2]];
    const double det = std::max(determinant(context_.metric.at((1.0 / 3) * (p + q + r))), 0.0);
    expected += 2 / std::numbers::sqrt3 * std::abs(cross(q - p, r - p)) * std::sqrt(det);
  }
  int number(std::int32_t v) {
    if (local_[v] < 0) {
      local_[v] = static_cast<std::int32_t>(of.size());
      of.push_back(v);
      domain.vertices.push_back(zone_.vertices[v]);
    }
    return local_[v];
  }
  void add_edge(std::int32_t a, std::int32_t b, PlaneEdgeKind kind) {
    PlaneEdge edge;
    edge.a = number(a), edge.b = number(b), edge.kind = kind;
    domain.edges.push_back(edge);
  }
  [[nodiscard]] bool is_imposed(std::int32_t a, std::int32_t b) const {
    const std::size_t n = zone_.whole.size();
    if (static_cast<std::size_t>(a) >= n || static_cast<std::size_t>(b) >= n) return false;
    return context_.inner.kind(zone_.whole[a], zone_.whole[b]) == PlaneEdgeKind::internal;
  }

  const Zone& zone_;
  const ZoneContext& context_;
  std::vector<std::int32_t> local_;
};

}  // namespace

Refilled refill(const Zone& zone, std::span<const std::uint8_t> free, const ZoneContext& context, Monitor& monitor) {
  std::vector<std::uint8_t> removed(zone.vertices.size(), 0);
  for (std::size_t v = 0; v < removed.size(); ++v) removed[v] = free[v] != 0 && zone.level[v] < refilled_layers;
  Refilled result;
  std::vector<std::array<std::int32_t, 3>> replaced;
  result.triangles.reserve(zone.triangles.size());
  replaced.reserve(zone.triangles.size());
  for (const auto& t : zone.triangles)
    (removed[t[0]] + removed[t[1]] + removed[t[2]] > 0 ? replaced : result.triangles).push_back(t);
  if (replaced.empty()) return result;
  const Void hole(zone, context, replaced, removed);
  try {
    const Field::Known known{.bends = context.known.bends, .triangles = hole.expected};
    const PlaneMesherOptions options{.frontal = context.options.frontal,
                                     .max_triangles = context.options.max_triangles};
    const PlaneMesh mesh = place_undivided(hole.domain, context.metric, known, options, monitor).mesh;
    const std::size_t n = hole.of.size(), next = zone.vertices.size();
    result.added.assign(mesh.vertices.begin() + static_cast<std::ptrdiff_t>(n), mesh.vertices.end());
    const auto of_zone = [&](std::int32_t v) {
      const auto k = static_cast<std::size_t>(v);
      return k < n ? hole.of[k] : static_cast<std::int32_t>(next + k - n);
    };
    for (const auto& t : mesh.triangles) result.triangles.push_back({of_zone(t[0]), of_zone(t[1]), of_zone(t[2])});
  } catch (const DomainError&) {
    result.triangles.insert(result.triangles.end(), replaced.begin(), replaced.end());
  }
  return result;
}

}  // namespace carreau::plane
