// SPDX-License-Identifier: BSD-3-Clause
#include "plane/placement/advancing_front.h"

#include <algorithm>
#include <cmath>

#include "plane/kernel/thresholds.h"
#include "plane/placement/circumcentres.h"
#include "plane/placement/front.h"
#include "plane/placement/respacing.h"

namespace carreau::plane {

namespace {

// In a field that bends, the triangle is isosceles in the chart about its centroid, which is found in chart_rounds with
// it.
Candidate apex_in_charts(const Placement& placement, const FrontEdge& edge, const Vec2& first) {
  const Triangulation& mesh = placement.mesh;
  const Vec2 a = mesh.at(edge.a), b = mesh.at(edge.b);
  Vec2 top = first;
  for (int k = 0; k < chart_rounds; ++k) {
    const ChartedTriangle y(placement.field, a, b, top, !mesh.is_kinked(edge.a, edge.b));
    const Vec2 e = y.b - y.a;
    const double l2 = dot(e, e), height = std::sqrt(std::max(1 - 0.25 * l2, min_apex_height2) / l2);
    top = y.chart.point(0.5 * (y.a + y.b) + height * Vec2{-e.y(), e.x()}, top);
  }
  return {top, placement.field.at(top), edge.edge, edge.a};
}

// Apex of the unit isosceles triangle on an edge, on the metric's normal, the metric being corrected once by that at
// the apex.
Candidate apex(const Placement& placement, const FrontEdge& edge) {
  const Vertex &A = placement.mesh.vertices[edge.a], &B = placement.mesh.vertices[edge.b];
  const double ex = B.x - A.x, ey = B.y - A.y;
  const Vec2 middle{0.5 * (A.x + B.x), 0.5 * (A.y + B.y)};
  const auto place = [&](Metric2 m) {
    const double l2 = m.a * ex * ex + 2 * m.b * ex * ey + m.c * ey * ey;
    const double height2 = std::max(1 - 0.25 * l2, min_apex_height2);
    const double k = std::sqrt(height2 / (std::max(determinant(m), 1e-300) * l2));
    return Vec2{middle.x() - k * (m.b * ex + m.c * ey), middle.y() + k * (m.a * ex + m.b * ey)};
  };
  const Metric2 at_ends = 0.5 * (A.metric() + B.metric());
  const Metric2 at_apex = placement.field.at(place(at_ends));
  if (placement.mesh.is_bent(edge.a, edge.b)) return apex_in_charts(placement, edge, place(placement.field.at(middle)));
  return {place(0.5 * (at_ends + at_apex)), at_apex, edge.edge, edge.a};
}

void place_layer(const Placement& placement, Front& front, Layer& layer) {
  std::vector<FrontEdge>& edges = front.edges;
  layer.points.clear();
  for (int pass = 0; pass < 2; ++pass)  // open chains first, then closed ones
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (edges[k].chained || (pass == 0 && edges[k].has_previous)) continue;
      layer.chain.clear();
      auto id = static_cast<std::int32_t>(k);
      for (; id >= 0 && !edges[id].chained; id = edges[id].next) {
        edges[id].chained = true;
        layer.chain.push_back(apex(placement, edges[id]));
      }
      respace(placement, layer, id == static_cast<std::int32_t>(k));
    }
}

// In strides, coarse ones first: one after the other along a curved front, each point would swallow the fan of all
// before it.
void insert_layer(Placement& placement, const std::vector<Candidate>& points) {
  const auto n = static_cast<int>(points.size());
  for (int stride = first_stride; stride >= 1; stride /= 2) {
    const int step = stride == first_stride ? stride : 2 * stride;
    for (int k = stride == first_stride ? 0 : stride; k < n; k += step)
      try_insert(placement, points[k], layer_distance);
  }
}

}  // namespace

void advance_front(Placement& placement) {
  judge_all(placement);
  Front front;
  Layer layer{strain_limit(placement.field)};
  placement.forget_touched();
  front.find(placement);
  while (!front.edges.empty()) {
    placement.monitor.checkpoint();
    place_layer(placement, front, layer);
    insert_layer(placement, layer.points);
    front.find_again(placement);
  }
  insert_circumcentres(placement, large_radius, point_distance);
  insert_circumcentres(placement, large_radius, last_distance);
}

}  // namespace carreau::plane
