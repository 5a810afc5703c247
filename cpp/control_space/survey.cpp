// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "control_space/thresholds.h"
#include "metric/metric2_algebra.h"
#include "support/error.h"
#include "support/rounding_of.h"
#include "support/shares.h"

namespace carreau::detail {

const double area_per_vertex = 0.5 * std::numbers::sqrt3;

namespace {

using namespace thresholds::control_space;

// The points of the box's regular n x n grid of cell centres that are inside.
std::vector<Vec2> inner_grid(const Survey& s, const PolygonLocator& locator, int n) {
  std::vector<Vec2> points;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Vec2 p{s.low.x() + (i + 0.5) / n * (s.high.x() - s.low.x()),
                   s.low.y() + (j + 0.5) / n * (s.high.y() - s.low.y())};
      if (locator.contains(p)) points.push_back(p);
    }
  return points;
}

// Number of points of this grid that are inside. They are counted row by row, from the crossings of the boundary with
// the row; points too near to it are located.
int count_inside(const SampledDomain& domain, const Survey& s, const PolygonLocator& locator, int n) {
  const Vec2 w = s.high - s.low;
  const auto at = [&](int k, double low, double width) { return low + (k + 0.5) / n * width; };
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(n));
  std::vector<char> doubtful(static_cast<std::size_t>(n), 0);
  for (const auto& [a, b] : domain.edges) {
    Vec2 p = domain.vertices[a], q = domain.vertices[b];
    if (p.y() > q.y()) std::swap(p, q);
    const int first = std::max(0, static_cast<int>((p.y() - s.low.y()) / w.y() * n) - 1);
    for (int j = first; j < n; ++j) {
      const double y = at(j, s.low.y(), w.y());
      if (y < p.y() - rounding_of::places * w.y()) continue;
      if (y > q.y() + rounding_of::places * w.y()) break;
      if (y < p.y() + rounding_of::places * w.y() || y > q.y() - rounding_of::places * w.y())
        doubtful[static_cast<std::size_t>(j)] = 1;
      else
        crossings[static_cast<std::size_t>(j)].push_back(p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x()));
    }
  }
  int count = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = at(i, s.low.x(), w.x()), y = at(j, s.low.y(), w.y());
      bool inside = false, close = doubtful[static_cast<std::size_t>(j)] != 0;
      for (const double crossing : crossings[static_cast<std::size_t>(j)]) {
        if (crossing < x) inside = !inside;
        close = close || std::abs(crossing - x) < rounding_of::places * w.x();
      }
      if (close) inside = locator.contains({x, y});
      count += inside ? 1 : 0;
    }
  return count;
}

// Relative change between two metrics; the eigenvalues must not be too small.
double change(Metric2 p, Metric2 q, double floor) {
  const auto root = [floor](Metric2 m) {
    return square_root(clamp_eigenvalues(m, floor, std::numeric_limits<double>::max()));
  };
  const Metric2 r = root(p), s = root(q), d = r + -1.0 * s;
  return std::sqrt(d.a * d.a + 2 * d.b * d.b + d.c * d.c) / std::min(r.a + r.c, s.a + s.c);
}

// Change of the field along u over change along v, from metrics on the regular inner grid.
double ratio_of_changes(std::span<const Metric2> m, double floor) {
  constexpr int n = inner_points;
  double u = shares::negligible, v = shares::negligible;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i + 1 < n; ++i) {
      u += change(m[n * j + i], m[n * j + i + 1], floor);
      v += change(m[n * i + j], m[n * (i + 1) + j], floor);
    }
  return u / v;
}

}  // namespace

Box2 box_of(const SampledDomain& domain) {
  if (domain.edges.empty()) throw DomainError("the parameter domain has no boundary");
  Box2 box{domain.vertices[domain.edges[0].first], domain.vertices[domain.edges[0].first]};
  for (const auto& [a, b] : domain.edges)
    for (const Vec2& p : {domain.vertices[a], domain.vertices[b]}) {
      box.low = box.low.cwiseMin(p);
      box.high = box.high.cwiseMax(p);
    }
  const Vec2 w = box.high - box.low;
  if (!(w.x() > 0) || !(w.y() > 0)) throw DomainError("the parameter domain has no area");
  return box;
}

double floor_from(std::vector<double> shortest, double longest) {
  std::sort(shortest.begin(), shortest.end());
  double usual = shortest[shortest.size() / 2];
  if (!(usual > 0)) usual = shortest.back();
  if (!(usual > 0)) usual = longest > 0 ? longest : 1;
  const double length = std::min(min_box_length, shares::negligible * usual);
  return length * length;
}

Metric2 in_box(Metric2 m, const Vec2& w) noexcept {
  return {m.a * w.x() * w.x(), m.b * w.x() * w.y(), m.c * w.y() * w.y()};
}

Survey survey(const SampledDomain& domain, const PolygonLocator& locator,
              const std::function<std::vector<Metric2>(std::span<const Vec2>)>& ask, bool square) {
  Survey s;
  const Box2 box = box_of(domain);
  s.low = box.low, s.high = box.high;
  std::vector<Vec2> uv;
  const std::size_t stride = std::max<std::size_t>(1, domain.edges.size() / max_border_points);
  for (std::size_t e = 0; e < domain.edges.size() && uv.size() < max_border_points; e += stride) {
    const int v = domain.edges[e].first;
    if (std::find(s.vertices.begin(), s.vertices.end(), v) != s.vertices.end()) continue;
    s.vertices.push_back(v);
    uv.push_back(domain.vertices[v]);
  }
  const std::vector<Vec2> inner = inner_grid(s, locator, inner_points);
  uv.insert(uv.end(), inner.begin(), inner.end());
  s.metrics = ask(uv);

  const Vec2 w = s.high - s.low;
  std::vector<double> shortest;
  double longest = 0, density = 0, along_u = 0, along_v = 0;
  for (Metric2& m : s.metrics) {
    m = in_box(m, w);
    const Eigen2 e = eigen(m);
    const double minor = std::max(e.minor, 0.0);
    shortest.push_back(std::sqrt(minor));
    longest = std::max(longest, std::sqrt(e.major));
    density += std::sqrt(e.major * minor);
    along_u += std::sqrt(std::max(m.a, 0.0));
    along_v += std::sqrt(std::max(m.c, 0.0));
  }
  s.floor = floor_from(std::move(shortest), longest);
  s.vertices_in_box = density / static_cast<double>(uv.size()) / area_per_vertex;
  if (along_u > 0 && along_v > 0) s.aspect = along_u / along_v;
  if (!square && inner.size() == inner_points * inner_points) {
    // Cells as long as the field allows, but not too far from the shape that exploration needs.
    const double ratio = ratio_of_changes(std::span(s.metrics).subspan(s.vertices.size()), s.floor);
    s.aspect *= std::clamp(ratio / s.aspect, 1 / max_stretch, max_stretch);
  }
  const double points = share_points * share_points;
  if (!std::isfinite(s.vertices_in_box) || !(s.aspect > 0) || !std::isfinite(s.aspect))
    throw DomainError("the parameter domain is too many sizes wide for floating-point numbers");
  s.share = (count_inside(domain, s, locator, share_points) + 1.0) / (points + 1);
  s.metrics.resize(s.vertices.size());
  return s;
}

}  // namespace carreau::detail
