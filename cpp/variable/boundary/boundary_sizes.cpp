// SPDX-License-Identifier: BSD-3-Clause
#include "variable/boundary/boundary_sizes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carreau::variable {

namespace {

class Collector {
 public:
  Collector(const Tools& tools, std::size_t vertices, double angle, double h_min)
      : tools_(tools), factor_(2 * std::sin(angle * std::numbers::pi / 180)), h_min_(h_min) {
    sizes_.at_vertices.assign(vertices, infinity);
  }
  void add(const RunCurve& curve) {
    for (std::size_t k = 0; k < curve.edges(); ++k) {
      const BoundaryLoop& loop = curve.loop();
      const std::size_t i = curve.node(k), j = loop.after(i);
      if (curve.run().kind == Kind::imposed) {
        lower(loop.nodes[i], mean_length(loop, i)), lower(loop.nodes[j], mean_length(loop, j));
      } else if (curve.is_spline()) {
        by_curvature(loop.nodes[i], curve.curvature_at_node(k));
        by_curvature(loop.nodes[j], curve.curvature_at_node(k + 1));
      } else if (loop.edges[i].follows_tool) {
        along_tool(loop.nodes[i].place, loop.edges[i].way);
      }
    }
  }
  BoundarySizes take() { return std::move(sizes_); }

 private:
  static double mean_length(const BoundaryLoop& loop, std::size_t i) {
    return (loop.length(i) + loop.length(loop.before(i))) / 2;
  }
  void lower(const BoundaryNode& node, double size) {
    if (node.vertex < 0) return;
    double& h = sizes_.at_vertices[static_cast<std::size_t>(node.vertex)];
    h = std::min(h, std::max(size, h_min_));
  }
  void by_curvature(const BoundaryNode& node, double curvature) {
    if (curvature > 0) lower(node, factor_ / curvature);
  }
  /// Each arc that the way passes.
  void along_tool(const ToolPlace& start, double way) {
    for (double gone = 0; gone < way;) {
      // A little further on, so that a place between two parts is of the next one.
      const double ahead = std::min(1e-9 * way + gone, way);
      const ToolPart& part = tools_.part(tools_.at(start.tool, start.s - ahead).part);
      double rest = tools_.way_back(start.tool, start.s - gone, part.s);
      if (!(rest > 0)) rest = part.length;
      const double next = std::min(way, std::max(gone + rest, ahead + 1e-9 * way));
      if (part.radius > 0)
        sizes_.along_tools.push_back({in_space(tools_.at(start.tool, start.s - gone).point),
                                      in_space(tools_.at(start.tool, start.s - next).point),
                                      std::max(factor_ * part.radius, h_min_)});
      gone = next;
    }
  }
  static Vec3 in_space(const Vec2& p) { return {p.x(), p.y(), 0}; }

  const Tools& tools_;
  double factor_, h_min_;
  BoundarySizes sizes_;
};

}  // namespace

BoundarySizes boundary_sizes(const std::vector<BoundaryShape>& shapes, const Tools& tools, std::size_t vertices,
                             double angle, double h_min) {
  Collector collector(tools, vertices, angle, h_min);
  for (const BoundaryShape& shape : shapes)
    for (const RunCurve& curve : shape.curves) collector.add(curve);
  return collector.take();
}

}  // namespace carreau::variable
