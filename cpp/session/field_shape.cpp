#include "session/field_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carreau {

namespace {

// Of a curve without support.
constexpr int samples_of_curve = 257;

void set_box(FieldShape& shape) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Vec2 low{far, far}, high{-far, -far};
  for (const Vec2 p : shape.loops.vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  if (low.x <= high.x) shape.low = low, shape.high = high;
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
      } catch (const CallbackError&) {  // what is left of the curve will do
      }
  } catch (const CallbackError&) {
  }
  return points;
}

// Each curve has two ends; pairs them, the nearest first.
void close_loops(FieldShape& shape, const std::vector<int>& ends) {
  struct Pair {
    double distance;
    std::size_t i, j;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = i + 1; j < ends.size(); ++j)
      pairs.push_back({norm(shape.loops.vertices[ends[i]] - shape.loops.vertices[ends[j]]), i, j});
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) { return p.distance < q.distance; });
  std::vector<char> taken(ends.size(), 0);
  for (const Pair& pair : pairs) {
    if (taken[pair.i] != 0 || taken[pair.j] != 0) continue;
    taken[pair.i] = taken[pair.j] = 1;
    shape.gap = std::max(shape.gap, pair.distance);
    shape.loops.segments.emplace_back(ends[pair.i], ends[pair.j]);
  }
}

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
  close_loops(shape, ends);
  set_box(shape);
  return shape;
}

}  // namespace carreau
