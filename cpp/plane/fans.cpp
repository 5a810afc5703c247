#include "plane/fans.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "predicates/predicates.h"

namespace carreau::plane {

namespace {

// Least metric distance of a ring's vertex to the degenerate side as a whole.
constexpr double least_height = 0.5;
constexpr int integration_steps = 64;

class FanBuilder {
 public:
  FanBuilder(const PlaneDomain& domain, const ControlSpace& space) : domain_(domain), space_(space) {}

  PlaneDomain run() {
    PlaneDomain result = domain_;
    for (const PlaneEdge& edge : domain_.edges)
      if (edge.kind == PlaneEdgeKind::degenerate) add_ring(edge, result);
    return result;
  }

 private:
  // The other end of the boundary edge that arrives at `v` or leaves it, -1 when that edge is degenerate too or there are several.
  int neighbour(int v, bool arriving) const {
    int found = -1;
    for (const PlaneEdge& e : domain_.edges) {
      if (e.kind == PlaneEdgeKind::internal || (arriving ? e.b : e.a) != v) continue;
      if (found >= 0 || e.kind == PlaneEdgeKind::degenerate) return -1;
      found = arriving ? e.a : e.b;
    }
    return found;
  }

  // Cumulated metric length along p - q.
  std::vector<double> lengths(Vec2 p, Vec2 q) const {
    std::vector<double> sum{0};
    const Vec2 step = (1.0 / integration_steps) * (q - p);
    for (int k = 0; k < integration_steps; ++k) sum.push_back(sum.back() + length(space_.at(lerp(p, q, (k + 0.5) / integration_steps)), step));
    return sum;
  }

  bool is_clear(Vec2 p, Vec2 q, int from, int to) const {
    for (const PlaneEdge& e : domain_.edges) {
      const Vec2 a = domain_.vertices[e.a], b = domain_.vertices[e.b];
      const bool at_from = e.a == from || e.b == from, at_to = e.a == to || e.b == to;
      const int pa = orientation(p, q, a), pb = orientation(p, q, b);
      if (at_from && at_to) return false;
      if (at_from || at_to) {
        // They share an end: only running along each other is a conflict.
        if (pa == 0 && pb == 0) return false;
        continue;
      }
      if (pa * pb <= 0 && orientation(a, b, p) * orientation(a, b, q) <= 0 && (pa != 0 || pb != 0)) return false;
    }
    return true;
  }

  void add_ring(const PlaneEdge& edge, PlaneDomain& result) const {
    const int from = neighbour(edge.a, true), to = neighbour(edge.b, false);
    if (from < 0 || to < 0 || from == to) return;
    const Vec2 p = domain_.vertices[from], q = domain_.vertices[to], a = domain_.vertices[edge.a], b = domain_.vertices[edge.b];
    // The side a -> b has the domain on its left: the ring must lie there, and run along with it.
    if (orientation(a, b, p) <= 0 || orientation(a, b, q) <= 0 || !is_clear(p, q, from, to)) return;
    const std::vector<double> sum = lengths(p, q);
    const int n = std::max({1, static_cast<int>(std::lround(sum.back())), edge.least_fan});
    if (n < 2 || !std::isfinite(sum.back()) || n > 10000) return;
    std::vector<Vec2> ring;
    for (int i = 1, k = 0; i < n; ++i) {
      const double target = sum.back() * i / n;
      while (k + 1 < integration_steps && sum[k + 1] < target) ++k;
      const Vec2 v = lerp(p, q, (k + (target - sum[k]) / (sum[k + 1] - sum[k])) / integration_steps);
      const Metric2 m = space_.at(v);
      const double height = cross(b - a, v - a) * std::sqrt(determinant(m)) / length(m, b - a);
      if (!(height >= least_height)) return;
      ring.push_back(v);
    }
    int previous = from;
    for (const Vec2 v : ring) {
      result.vertices.push_back(v);
      const auto next = static_cast<int>(result.vertices.size()) - 1;
      result.edges.push_back({previous, next, PlaneEdgeKind::internal});
      previous = next;
    }
    result.edges.push_back({previous, to, PlaneEdgeKind::internal});
  }

  const PlaneDomain& domain_;
  const ControlSpace& space_;
};

}  // namespace

PlaneDomain with_fans(const PlaneDomain& domain, const ControlSpace& space) { return FanBuilder(domain, space).run(); }

}  // namespace carreau::plane
