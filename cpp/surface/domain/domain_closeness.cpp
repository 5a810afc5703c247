// SPDX-License-Identifier: BSD-3-Clause
// Edges that are long compared with the distance to other edges (HDR sec. 3.3.2).
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "predicates/edge_grid.h"
#include "predicates/polygon_locator.h"
#include "predicates/predicates.h"
#include "support/shares.h"
#include "surface/domain/domain_check.h"
#include "surface/domain/domain_graph.h"
#include "surface/domain/thresholds.h"

namespace carreau {
namespace {

using namespace thresholds::domain;

/// Boundary and internal edges as chains without acute corners, measured by arc length in the metric. Ends of
/// degenerate edges are one point.
class Sides {
 public:
  Sides(const PlaneDomain& domain, const ControlSpace& metric);

  [[nodiscard]] double length_of(int edge) const { return length_[edge]; }
  [[nodiscard]] bool same_point(int v, int w) const { return point_[v] == point_[w]; }

  /// Returns whether an edge joins the vertices.
  [[nodiscard]] bool joined(int v, int w) const;
  /// Half-width of the band of `edge` for `vertex`, at distance d.
  [[nodiscard]] double band(int edge, int vertex, double d, double coef) const;

 private:
  struct End {
    int vertex = -1, edge = -1;  // the last edge before the end
  };
  struct Side {
    std::array<End, 2> end;
    double length = 0;
    bool closed = false;
  };

  void join_poles();
  [[nodiscard]] std::vector<char> blunt_vertices() const;
  void add_side(const Chain& chain);
  [[nodiscard]] Vec2 away_from(int vertex, int edge) const;
  [[nodiscard]] double sine_between(const End& p, const End& q) const;
  [[nodiscard]] double gap_along(const Side& side, double from, double to, double at) const;
  [[nodiscard]] double band_at_corners(int edge, const Side& other, double at, double d, double coef) const;

  const PlaneDomain& domain_;
  const ControlSpace& metric_;
  DomainIncidence incidence_;
  std::vector<double> length_;
  std::vector<int> point_;  // representative of the vertices that are one point in space
  std::vector<Side> sides_;
  std::vector<int> side_of_;   // by edge
  std::vector<double> start_;  // by edge: arc length of the end that comes first along its side
  std::vector<char> against_;  // by edge: runs from b to a along its side
};

Sides::Sides(const PlaneDomain& domain, const ControlSpace& metric)
    : domain_(domain),
      metric_(metric),
      incidence_(domain, DomainIncidence::Which::all),
      point_(domain.vertices.size()),
      side_of_(domain.edges.size()),
      start_(domain.edges.size()),
      against_(domain.edges.size()) {
  for (const PlaneEdge& e : domain.edges) {
    const Vec2 a = domain.vertices[e.a], b = domain.vertices[e.b];
    length_.push_back(length(metric.at(lerp(a, b, 0.5)), b - a));
  }
  join_poles();
  for (const Chain& chain : chains_of(domain, incidence_, blunt_vertices())) add_side(chain);
}

void Sides::join_poles() {
  std::iota(point_.begin(), point_.end(), 0);
  const auto root = [&](int v) {
    while (point_[v] != v) v = point_[v] = point_[point_[v]];
    return v;
  };
  for (const PlaneEdge& e : domain_.edges)
    if (e.kind == PlaneEdgeKind::degenerate) point_[std::max(root(e.a), root(e.b))] = std::min(root(e.a), root(e.b));
  for (int v = 0; v < static_cast<int>(point_.size()); ++v) point_[v] = root(v);
}

bool Sides::joined(int v, int w) const {
  const auto around = incidence_.at(v);
  return std::any_of(around.begin(), around.end(),
                     [&](int e) { return domain_.edges[e].a == w || domain_.edges[e].b == w; });
}

Vec2 Sides::away_from(int vertex, int edge) const {
  const PlaneEdge& e = domain_.edges[edge];
  return domain_.vertices[e.a == vertex ? e.b : e.a] - domain_.vertices[vertex];
}

std::vector<char> Sides::blunt_vertices() const {
  std::vector<char> blunt(domain_.vertices.size(), 0);
  for (int v = 0; v < static_cast<int>(blunt.size()); ++v) {
    const auto around = incidence_.at(v);
    if (around.size() != 2) continue;
    const bool pole = std::any_of(around.begin(), around.end(),
                                  [&](int e) { return domain_.edges[e].kind == PlaneEdgeKind::degenerate; });
    if (pole) continue;
    const double cosine = dot(metric_.at(domain_.vertices[v]), away_from(v, around[0]), away_from(v, around[1]));
    blunt[v] = cosine <= 0 ? 1 : 0;
  }
  return blunt;
}

void Sides::add_side(const Chain& chain) {
  Side side;
  side.closed = chain.closed;
  for (std::size_t i = 0; i < chain.edges.size(); ++i) {
    const int edge = chain.edges[i];
    side_of_[edge] = static_cast<int>(sides_.size());
    start_[edge] = side.length;
    against_[edge] = chain.against[i];
    side.length += length_[edge];
  }
  const PlaneEdge &first = domain_.edges[chain.edges.front()], &last = domain_.edges[chain.edges.back()];
  side.end[0] = {chain.against.front() != 0 ? first.b : first.a, chain.edges.front()};
  side.end[1] = {chain.against.back() != 0 ? last.a : last.b, chain.edges.back()};
  sides_.push_back(side);
}

/// Sine of the angle between the sides that end at p and q, which are one point; 1 when it is not acute.
double Sides::sine_between(const End& p, const End& q) const {
  const double pl = length_[p.edge], ql = length_[q.edge];
  if (p.vertex != q.vertex) {
    // At a pole angles in (u, v) have no meaning: it takes the angle between the directions to the far ends.
    const Vec2 a = domain_.vertices[p.vertex] + away_from(p.vertex, p.edge);
    const Vec2 b = domain_.vertices[q.vertex] + away_from(q.vertex, q.edge);
    return std::min(1.0, length(metric_.at(lerp(a, b, 0.5)), b - a) / std::max(pl, ql));
  }
  const Metric2 m = metric_.at(domain_.vertices[p.vertex]);
  const Vec2 u = away_from(p.vertex, p.edge), v = away_from(q.vertex, q.edge);
  if (dot(m, u, v) <= 0) return 1;
  return std::min(1.0, std::abs(cross(u, v)) * std::sqrt(determinant(m)) / (length(m, u) * length(m, v)));
}

/// Arc length from `at` to the nearer end of the piece from - to of a side.
double Sides::gap_along(const Side& side, double from, double to, double at) const {
  const double direct = at <= from ? from - at : at - to;
  if (!side.closed) return direct;
  const double around = at <= from ? at + side.length - to : from + side.length - at;
  return std::min(direct, around);
}

/// The band of an edge for a vertex at arc length `at` of a side that may meet the edge's side at a corner.
double Sides::band_at_corners(int edge, const Side& other, double at, double d, double coef) const {
  const Side& own = sides_[side_of_[edge]];
  const double size = length_[edge], inner = std::min(coef, max_among_neighbours);
  double band = coef * size;
  if (own.closed || other.closed) return band;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const End &p = own.end[i], &q = other.end[j];
      if (!same_point(p.vertex, q.vertex) || (p.vertex == q.vertex && p.edge == q.edge)) continue;
      const double of_edge = i == 0 ? start_[edge] : own.length - start_[edge] - size;
      const double of_vertex = j == 0 ? at : other.length - at;
      if (of_vertex <= 0) continue;  // the corner itself, which is on the edge's own side too
      const double sine = sine_between(p, q);
      if (d >= shares::reserve * std::max(of_edge, of_vertex) * sine) band = std::min(band, inner * size * sine);
    }
  return band;
}

double Sides::band(int edge, int vertex, double d, double coef) const {
  const Side& own = sides_[side_of_[edge]];
  double band = coef * length_[edge];
  for (const int f : incidence_.at(vertex)) {
    const PlaneEdge& e = domain_.edges[f];
    if (e.kind == PlaneEdgeKind::degenerate) continue;
    const bool comes_first = (e.a == vertex) != (against_[f] != 0);
    const double at = comes_first ? start_[f] : start_[f] + length_[f];
    if (side_of_[f] == side_of_[edge] &&
        gap_along(own, start_[edge], start_[edge] + length_[edge], at) <= longest_detour * d)
      band = std::min(band, max_among_neighbours * length_[edge]);
    band = std::min(band, band_at_corners(edge, sides_[side_of_[f]], at, d, coef));
  }
  return band;
}

class ClosenessCheck {
 public:
  ClosenessCheck(const PlaneDomain& domain, const ControlSpace& metric, double coef, bool up_to_corners)
      : domain_(domain),
        metric_(metric),
        coef_(coef),
        up_to_corners_(up_to_corners),
        sides_(domain, metric),
        inside_(domain.vertices, bounding_edges(domain)),
        grid_(domain.vertices, points_of(domain)) {}

  [[nodiscard]] bool is_too_long(int edge) const;

 private:
  /// Each vertex as an edge without length.
  static std::vector<std::pair<int, int>> points_of(const PlaneDomain& domain) {
    std::vector<std::pair<int, int>> points;
    for (int v = 0; v < static_cast<int>(domain.vertices.size()); ++v) points.emplace_back(v, v);
    return points;
  }
  [[nodiscard]] bool sees(const PlaneEdge& e, int vertex, double w) const;
  [[nodiscard]] bool is_near(int edge, int vertex, Metric2 m) const;

  const PlaneDomain& domain_;
  const ControlSpace& metric_;
  double coef_;
  bool up_to_corners_;
  Sides sides_;
  PolygonLocator inside_;
  EdgeGrid grid_;
};

/// Returns whether the domain lies between the vertex and the nearest point of the edge (w: 0 the end a, 1 the end b).
/// Parts that are close behind the boundary are not meshed.
bool ClosenessCheck::sees(const PlaneEdge& e, int vertex, double w) const {
  const Vec2 a = domain_.vertices[e.a], b = domain_.vertices[e.b], p = domain_.vertices[vertex];
  if (w > 0 && w < 1) return !bounds(e) || orientation(a, b, p) > 0;
  const int end = w > 0 ? e.b : e.a;
  // On a straight side the next vertex is exactly on the side; rounding may put it on the left or on the right.
  return sides_.joined(end, vertex) || inside_.inside_along(domain_.vertices[end], p);
}

/// Returns whether the vertex is in the Hausdorff band {p: d(p, A) <= delta} of edge A (HDR eq. 2.23).
bool ClosenessCheck::is_near(int edge, int vertex, Metric2 m) const {
  const PlaneEdge& e = domain_.edges[edge];
  if (sides_.same_point(vertex, e.a) || sides_.same_point(vertex, e.b)) return false;
  const Vec2 a = domain_.vertices[e.a], b = domain_.vertices[e.b], p = domain_.vertices[vertex];
  const double w = std::clamp(dot(m, p - a, b - a) / squared_length(m, b - a), 0.0, 1.0);
  const double d = length(m, p - lerp(a, b, w));
  const double coef = coefficient_of_width(coef_, d);
  return coef > 0 && d <= coef * sides_.length_of(edge) &&
         (up_to_corners_ || d <= sides_.band(edge, vertex, d, coef)) && sees(e, vertex, w);
}

bool ClosenessCheck::is_too_long(int edge) const {
  const PlaneEdge& e = domain_.edges[edge];
  if (e.kind == PlaneEdgeKind::degenerate) return false;
  const Vec2 a = domain_.vertices[e.a], b = domain_.vertices[e.b];
  const Metric2 m = metric_.at(lerp(a, b, 0.5));
  const double delta = coef_ * sides_.length_of(edge), det = determinant(m);
  if (!(delta > 0) || !(det > 0)) return false;
  // Half-axes of the box about the ellipse of radius delta.
  const Vec2 reach{delta * std::sqrt(m.c / det), delta * std::sqrt(m.a / det)};
  const int left = grid_.column_of(std::min(a.x(), b.x()) - reach.x()),
            right = grid_.column_of(std::max(a.x(), b.x()) + reach.x());
  const int bottom = grid_.row_of(std::min(a.y(), b.y()) - reach.y()),
            top = grid_.row_of(std::max(a.y(), b.y()) + reach.y());
  for (int row = bottom; row <= top; ++row)
    for (int column = left; column <= right; ++column)
      for (const int vertex : grid_.edges_in(column, row))
        if (is_near(edge, vertex, m)) return true;
  return false;
}

}  // namespace

double coefficient_of_width(double coef, double width) {
  if (width < narrowest_share) return 0;
  if (coef >= min_wanted_coefficient) return coef;
  return std::min(coef, std::max(min_coefficient, coef * width / thin_width));
}

std::vector<int> edges_to_split_for_closeness(const PlaneDomain& domain, const ControlSpace& metric, double coef,
                                              bool up_to_corners) {
  require_sound(domain);
  std::vector<int> split;
  if (!(coef > 0)) return split;
  const ClosenessCheck check(domain, metric, coef, up_to_corners);
  for (int e = 0; e < static_cast<int>(domain.edges.size()); ++e)
    if (check.is_too_long(e)) split.push_back(e);
  return split;
}

}  // namespace carreau
