// SPDX-License-Identifier: BSD-3-Clause
#include "fields/field_shape.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/infinity.h"

namespace carreau {

namespace {

// Samples of a curve without support.
constexpr int samples_of_curve = 257;

void set_box(FieldShape& shape) {
  Vec2 low{infinity, infinity}, high{-infinity, -infinity};
  for (const Vec2& p : shape.loops.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  if (low.x() <= high.x()) shape.low = low, shape.high = high;
}

// Appends a polyline and returns the ranks of its ends.
std::pair<int, int> append(PlaneSegments& lines, std::span<const Vec2> points) {
  const int first = static_cast<int>(lines.vertices.size());
  lines.vertices.insert(lines.vertices.end(), points.begin(), points.end());
  const int last = static_cast<int>(lines.vertices.size()) - 1;
  for (int i = first; i < last; ++i) lines.segments.emplace_back(i, i + 1);
  return {first, last};
}

std::vector<Vec2> sampled(Cad& cad, int face, int ic) {
  std::vector<Vec2> points;
  try {
    const Interval interval = cad.curve_interval(face, ic);
    for (int i = 0; i < samples_of_curve; ++i) try {
        const double w = static_cast<double>(i) / (samples_of_curve - 1);
        points.push_back(cad.curve(face, ic, want_position, (1 - w) * interval.a + w * interval.b).c);
      } catch (const CallbackError&) {  // the rest of the curve suffices
      }
  } catch (const CallbackError&) {
  }
  return points;
}

// Pairs ends of curves.
class LoopCloser {
 public:
  LoopCloser(FieldShape& shape, std::vector<int> ends)
      : shape_(shape), ends_(std::move(ends)), taken_(ends_.size(), 0) {}

  void run() {
    join_those_that_meet();
    join_nearest_first();
  }

 private:
  [[nodiscard]] Vec2 at(std::size_t i) const { return shape_.loops.vertices[static_cast<std::size_t>(ends_[i])]; }
  void join(std::size_t i, std::size_t j) {
    taken_[i] = taken_[j] = 1;
    shape_.gap = std::max(shape_.gap, norm(at(i) - at(j)));
    shape_.loops.segments.emplace_back(ends_[i], ends_[j]);
  }

  // Joins coincident ends: nearly all of them.
  void join_those_that_meet() {
    double extent = 0;
    for (const Vec2& p : shape_.loops.vertices) extent = std::max({extent, std::abs(p.x()), std::abs(p.y())});
    const double tolerance = 1e-9 * extent;
    std::vector<std::size_t> order(ends_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [this](std::size_t i, std::size_t j) { return at(i).x() < at(j).x(); });
    for (std::size_t a = 0; a < order.size(); ++a)
      for (std::size_t b = a + 1; b < order.size() && taken_[order[a]] == 0; ++b) {
        if (at(order[b]).x() - at(order[a]).x() > tolerance) break;
        if (taken_[order[b]] == 0 && norm(at(order[b]) - at(order[a])) <= tolerance) join(order[a], order[b]);
      }
  }

  void join_nearest_first() {
    struct Pair {
      double distance;
      std::size_t i, j;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < ends_.size(); ++i)
      for (std::size_t j = i + 1; j < ends_.size(); ++j)
        if (taken_[i] == 0 && taken_[j] == 0) pairs.push_back({norm(at(i) - at(j)), i, j});
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) { return p.distance < q.distance; });
    for (const Pair& pair : pairs)
      if (taken_[pair.i] == 0 && taken_[pair.j] == 0) join(pair.i, pair.j);
  }

  FieldShape& shape_;
  std::vector<int> ends_;
  std::vector<char> taken_;
};

}  // namespace

FieldShape shape_of(const PlaneDomain& domain) {
  FieldShape shape;
  shape.loops.vertices = shape.lines.vertices = domain.vertices;
  for (const PlaneEdge& edge : domain.edges) {
    shape.lines.segments.emplace_back(edge.a, edge.b);
    if (edge.kind != PlaneEdgeKind::internal) shape.loops.segments.emplace_back(edge.a, edge.b);
  }
  set_box(shape);
  return shape;
}

FieldShape shape_of(const Face& face, std::span<const CurveSupport> supports, Cad& cad, Monitor& monitor) {
  FieldShape shape;
  std::vector<int> ends;
  for (std::size_t c = 0; c < face.curves.size(); ++c) {
    monitor.checkpoint();
    const std::vector<Vec2> points =
        supports.empty() ? sampled(cad, face.ref, static_cast<int>(c) + 1) : supports[c].uv;
    if (points.size() < 2) continue;
    append(shape.lines, points);
    if (face.curves[c].type != CurveType::boundary) continue;
    const auto [first, last] = append(shape.loops, points);
    ends.insert(ends.end(), {first, last});
  }
  LoopCloser(shape, std::move(ends)).run();
  set_box(shape);
  return shape;
}

}  // namespace carreau
