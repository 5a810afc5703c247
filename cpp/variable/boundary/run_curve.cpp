// SPDX-License-Identifier: BSD-3-Clause
#include "variable/boundary/run_curve.h"

#include "support/segment.h"
#include "variable/base/thresholds.h"

namespace carreau::variable {

RunCurve::RunCurve(const BoundaryLoop& loop, const BoundaryRun& run, const Tools& tools, Smoothness smoothness,
                   bool keep_nodes)
    : loop_(&loop), run_(&run), tools_(&tools), keep_nodes_(keep_nodes) {
  if (run.kind == Kind::free_boundary && smoothness != Smoothness::polygon && run.count > 1) fit(smoothness);
}

void RunCurve::fit(Smoothness smoothness) {
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < run_->count + (run_->closed ? 0 : 1); ++k) points.push_back(loop_->nodes[node(k)].point);
  spline_.emplace(points, run_->closed                        ? SplineEnds::periodic
                          : smoothness == Smoothness::natural ? SplineEnds::natural
                                                              : SplineEnds::tangent);
  if (bulges()) spline_.reset();
}

bool RunCurve::bulges() const noexcept {
  for (std::size_t k = 0; k < run_->count; ++k) {
    const Vec2 a = loop_->nodes[node(k)].point, b = loop_->nodes[node(k + 1)].point;
    const double most = thresholds::variable::largest_bulge * spline_->width(k);
    for (const double t : {0.25, 0.5, 0.75})
      if (!(distance_to_segment(spline_->at(k, t), a, b) <= most)) return true;
  }
  return false;
}

Vec2 RunCurve::at(std::size_t edge, double t) const noexcept {
  const std::size_t i = node(edge);
  if (t <= 0) return loop_->nodes[i].point;
  if (t >= 1) return loop_->nodes[node(edge + 1)].point;
  if (spline_ && !keep_nodes_) return spline_->at(edge, t);
  if (loop_->edges[i].follows_tool && !keep_nodes_) {
    const ToolPlace& start = loop_->nodes[i].place;
    return tools_->at(start.tool, start.s - t * loop_->edges[i].way).point;
  }
  return lerp(loop_->nodes[i].point, loop_->nodes[node(edge + 1)].point, t);
}

double RunCurve::curvature_at_node(std::size_t node) const noexcept {
  if (!spline_) return 0;
  return node < run_->count ? spline_->curvature(node, 0) : spline_->curvature(node - 1, 1);
}

}  // namespace carreau::variable
