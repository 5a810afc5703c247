// SPDX-License-Identifier: BSD-3-Clause
#include "variable/boundary/boundary_cut.h"

#include <algorithm>
#include <cmath>

#include "curve/unit_discretisation.h"
#include "variable/base/thresholds.h"

namespace carreau::variable {

namespace {

/// Places along a run, with the sizes prescribed there.
struct Samples {
  std::vector<double> s, h;   // length from the start, size
  std::vector<double> place;  // edge + fraction
};

/// The place, edge + fraction, at length s.
double place_at(const Samples& samples, double s) {
  const auto above = std::upper_bound(samples.s.begin(), samples.s.end(), s);
  if (above == samples.s.begin()) return samples.place.front();
  if (above == samples.s.end()) return samples.place.back();
  const auto i = static_cast<std::size_t>(above - samples.s.begin());
  const double t = (s - samples.s[i - 1]) / (samples.s[i] - samples.s[i - 1]);
  return (1 - t) * samples.place[i - 1] + t * samples.place[i];
}

class Cutter {
 public:
  Cutter(const Tools& tools, const SizeMap& sizes) : tools_(tools), sizes_(sizes) {}

  void cut(const BoundaryShape& shape) {
    const auto first = static_cast<int>(result_.domain.vertices.size());
    // A loop needs three edges in all.
    const int at_least = shape.runs.size() >= 3 ? 1 : shape.runs.size() == 2 ? 2 : 3;
    for (const RunCurve& curve : shape.curves) cut_run(curve, at_least);
    const auto end = static_cast<int>(result_.domain.vertices.size());
    for (int v = first; v < end; ++v) {
      const int next = v + 1 < end ? v + 1 : first;
      result_.domain.edges.push_back({.a = v, .b = next, .segment = v - first});
      const Vec2 p = result_.domain.vertices[static_cast<std::size_t>(v)],
                 q = result_.domain.vertices[static_cast<std::size_t>(next)];
      result_.edge_sizes.push_back(sizes_.at((p + q) / 2, guess_));
    }
  }
  CutBoundary take() { return std::move(result_); }

 private:
  [[nodiscard]] double size_at(const RunCurve& curve, std::size_t edge, double t, const Vec2& p) const {
    const BoundaryLoop& loop = curve.loop();
    const std::size_t i = curve.node(edge);
    return sizes_.between({loop.nodes[i].on[0], loop.nodes[loop.after(i)].on[1]}, t, p);
  }
  /// From one place to another, in steps of half the size or less.
  [[nodiscard]] Samples sample(const RunCurve& curve, double from, double to) const {
    Samples samples;
    Vec2 before = curve.at(static_cast<std::size_t>(from), from - std::floor(from));
    double s = 0;
    for (double place = from;;) {
      auto edge = static_cast<std::size_t>(place);
      if (edge == curve.edges()) --edge;
      const double t = place - static_cast<double>(edge);
      const Vec2 p = curve.at(edge, t);
      const double h = size_at(curve, edge, t, p);
      s += norm(p - before);
      if (samples.s.empty() || s > samples.s.back())
        samples.s.push_back(s), samples.h.push_back(h), samples.place.push_back(place);
      before = p;
      if (place >= to) break;
      edge = static_cast<std::size_t>(place);
      const double length = norm(curve.at(edge, 1) - curve.at(edge, 0));
      const double pieces = std::clamp(length / (thresholds::variable::size_step * h), 4.0, 1000.0);
      place = std::min({place + 1 / pieces, static_cast<double>(edge) + 1, to});
    }
    return samples;
  }
  /// Adds the vertices from `from`, not that at `to`.
  void cut_between(const RunCurve& curve, double from, double to, int at_least) {
    const Samples samples = sample(curve, from, to);
    if (samples.s.size() < 2) return add_vertex(curve, from);
    for (const double s : cuts(samples, at_least)) add_vertex(curve, place_at(samples, s));
  }
  static std::vector<double> cuts(const Samples& samples, int at_least) {
    std::vector<double> cuts = split_by_sizes(samples.s, samples.h, SizeLaw::linear, at_least);
    cuts.pop_back();
    return cuts;
  }
  void cut_run(const RunCurve& curve, int at_least) {
    const auto edges = static_cast<double>(curve.edges());
    if (curve.keeps_nodes()) {
      for (std::size_t k = 0; k < curve.edges(); ++k) add_vertex(curve, static_cast<double>(k));
      return;
    }
    double from = 0;
    for (const double corner : tool_corners(curve)) cut_between(curve, from, corner, 1), from = corner;
    cut_between(curve, from, edges, at_least);
  }
  [[nodiscard]] std::vector<double> tool_corners(const RunCurve& curve) const {
    std::vector<double> places;
    for (std::size_t k = 0; k < curve.edges(); ++k) {
      const std::size_t i = curve.node(k);
      const BoundaryLoop::Edge& edge = curve.loop().edges[i];
      if (!edge.follows_tool) continue;
      const ToolPlace& start = curve.loop().nodes[i].place;
      for (const double way : tools_.corners_back(start.tool, start.s, edge.way))
        places.push_back(static_cast<double>(k) + way / edge.way);
      if (k > 0 && places_corner(start)) places.push_back(static_cast<double>(k));
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
  }
  /// A node of the boundary that lies on a sharp corner itself.
  [[nodiscard]] bool places_corner(const ToolPlace& place) const {
    const double reach = 1e-9 * (1 + std::abs(place.s));
    return !tools_.corners_back(place.tool, place.s + reach, 2 * reach).empty();
  }
  void add_vertex(const RunCurve& curve, double place) {
    const auto edge = std::min(static_cast<std::size_t>(place), curve.edges() - 1);
    const double t = place - static_cast<double>(edge);
    Vec2 p = curve.at(edge, t);
    const std::size_t i = curve.node(edge);
    std::int32_t kind = t > 0 ? curve.run().kind : curve.loop().kind_of_node(i);
    if (kind < Kind::bound && !tools_.empty())
      if (const ToolPlace tool = tools_.nearest(p); tool.in_solid) p = tool.point, kind = Kind::bound + tool.tool;
    result_.domain.vertices.push_back(p);
    result_.vertex_kinds.push_back(kind);
    result_.edge_kinds.push_back(curve.run().kind);
  }

  const Tools& tools_;
  const SizeMap& sizes_;
  std::int32_t guess_ = 0;
  CutBoundary result_;
};

}  // namespace

CutBoundary cut_boundary(const std::vector<BoundaryShape>& shapes, const Tools& tools, const SizeMap& sizes) {
  Cutter cutter(tools, sizes);
  for (const BoundaryShape& shape : shapes) cutter.cut(shape);
  return cutter.take();
}

}  // namespace carreau::variable
