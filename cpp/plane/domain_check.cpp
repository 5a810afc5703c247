#include "plane/domain_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "plane/domain_graph.h"
#include "predicates/edge_grid.h"
#include "predicates/predicates.h"
#include "support/error.h"

namespace carreau {
namespace {

bool comes_before(Vec2 p, Vec2 q) noexcept { return p.x < q.x || (p.x == q.x && p.y < q.y); }

/// Is p, which is on the line through a and b, between them or at one of them?
bool within_span(Vec2 a, Vec2 b, Vec2 p) noexcept {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// Where a - b and c - d cross properly, to rounding and without overflow.
Vec2 crossing_point(Vec2 a, Vec2 b, Vec2 c, Vec2 d) noexcept {
  const double scale = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y), std::abs(c.x),
                                 std::abs(c.y), std::abs(d.x), std::abs(d.y)});
  const auto scaled = [&](Vec2 p) { return Vec2{p.x / scale, p.y / scale}; };
  const Vec2 e = scaled(d) - scaled(c), p = scaled(a) - scaled(c), q = scaled(b) - scaled(c);
  const double left = std::abs(cross(e, p)), right = std::abs(cross(e, q));
  const double w = left + right > 0 ? left / (left + right) : 0.5;
  return lerp(a, b, w);
}

/// A common point of the closed segments, if there is one.
std::optional<Vec2> common_point(Vec2 a, Vec2 b, Vec2 c, Vec2 d) noexcept {
  const int of_c = orientation(a, b, c), of_d = orientation(a, b, d);
  if (of_c == 0 && within_span(a, b, c)) return c;
  if (of_d == 0 && within_span(a, b, d)) return d;
  const int of_a = orientation(c, d, a), of_b = orientation(c, d, b);
  if (of_a == 0 && within_span(c, d, a)) return a;
  if (of_b == 0 && within_span(c, d, b)) return b;
  if (of_c * of_d < 0 && of_a * of_b < 0) return crossing_point(a, b, c, d);
  return std::nullopt;
}

/// For edges p - q and p - r: where they meet besides p.
std::optional<Vec2> overlap_beyond(Vec2 p, Vec2 q, Vec2 r) noexcept {
  if (q == p || r == p) return p;
  if (orientation(p, q, r) != 0 || comes_before(p, q) != comes_before(p, r)) return std::nullopt;
  return within_span(p, q, r) ? r : q;
}

std::optional<Vec2> conflict_between(const PlaneDomain& domain, const PlaneEdge& e, const PlaneEdge& f) noexcept {
  const auto at = [&](int vertex) { return domain.vertices[vertex]; };
  const Vec2 a = at(e.a), b = at(e.b), c = at(f.a), d = at(f.b);
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
    return std::nullopt;
  if ((e.a == f.a && e.b == f.b) || (e.a == f.b && e.b == f.a)) return lerp(a, b, 0.5);
  if (e.a == f.a) return overlap_beyond(a, b, d);
  if (e.a == f.b) return overlap_beyond(a, b, c);
  if (e.b == f.a) return overlap_beyond(b, a, d);
  if (e.b == f.b) return overlap_beyond(b, a, c);
  return common_point(a, b, c, d);
}

EdgeGrid grid_of(const PlaneDomain& domain) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(domain.edges.size());
  for (const PlaneEdge& e : domain.edges) edges.emplace_back(e.a, e.b);
  return EdgeGrid(domain.vertices, edges);
}

bool pair_precedes(const EdgeConflict& p, const EdgeConflict& q) noexcept {
  return std::pair(p.first, p.second) < std::pair(q.first, q.second);
}

void keep_one_of_each_pair(std::vector<EdgeConflict>& conflicts) {
  std::sort(conflicts.begin(), conflicts.end(), pair_precedes);
  const auto same = [](const EdgeConflict& p, const EdgeConflict& q) {
    return p.first == q.first && p.second == q.second;
  };
  conflicts.erase(std::unique(conflicts.begin(), conflicts.end(), same), conflicts.end());
}

double uv_length(const PlaneDomain& domain, const PlaneEdge& e) noexcept {
  const Vec2 a = domain.vertices[e.a], b = domain.vertices[e.b];
  return std::hypot(0.5 * a.x - 0.5 * b.x, 0.5 * a.y - 0.5 * b.y);  // halves: no overflow
}

std::vector<int> flagged(const std::vector<char>& flags) {
  std::vector<int> indices;
  for (int i = 0; i < static_cast<int>(flags.size()); ++i)
    if (flags[i] != 0) indices.push_back(i);
  return indices;
}

bool follow_each_other(const PlaneEdge& e, const PlaneEdge& f, std::size_t edges_of_their_kind) noexcept {
  if (bounds(e) != bounds(f)) return false;
  return edges_of_their_kind == 2 || (e.curve >= 0 && e.curve == f.curve && std::abs(e.segment - f.segment) == 1);
}

}  // namespace

std::vector<EdgeConflict> find_crossings(const PlaneDomain& domain) {
  require_sound(domain);
  const EdgeGrid grid = grid_of(domain);
  const std::size_t most = 4 * domain.edges.size();
  std::vector<EdgeConflict> conflicts;
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column) {
      const auto edges = grid.edges_in(column, row);  // increasing
      for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = i + 1; j < edges.size(); ++j) {
          const auto where = conflict_between(domain, domain.edges[edges[i]], domain.edges[edges[j]]);
          if (!where) continue;
          conflicts.push_back({edges[i], edges[j], *where});
          if (conflicts.size() <= 2 * most) continue;
          keep_one_of_each_pair(conflicts);
          if (conflicts.size() > most) return conflicts;
        }
    }
  keep_one_of_each_pair(conflicts);
  return conflicts;
}

std::vector<int> edges_to_split_for_crossings(const PlaneDomain& domain) {
  std::vector<char> split(domain.edges.size(), 0);
  for (const EdgeConflict& conflict : find_crossings(domain)) {
    const PlaneEdge &e = domain.edges[conflict.first], &f = domain.edges[conflict.second];
    const bool e_stays = e.kind == PlaneEdgeKind::degenerate, f_stays = f.kind == PlaneEdgeKind::degenerate;
    const bool same_ends = std::minmax(e.a, e.b) == std::minmax(f.a, f.b);
    const bool e_longer = uv_length(domain, e) >= uv_length(domain, f);
    if (!e_stays && (same_ends || e_longer || f_stays)) split[conflict.first] = 1;
    if (!f_stays && (same_ends || !e_longer || e_stays)) split[conflict.second] = 1;
  }
  return flagged(split);
}

std::vector<int> edges_to_split_for_balance(const PlaneDomain& domain, const ControlSpace& metric, double ratio) {
  if (!(ratio >= 2)) throw InvalidArgument("the ratio of the lengths of adjacent edges must be 2 or more");
  require_sound(domain);
  // A chain that is exactly geometric must not depend on rounding.
  const double limit = ratio * (1 + 1e-9);
  std::vector<double> size;
  for (const PlaneEdge& e : domain.edges) {
    const Vec2 a = domain.vertices[e.a], b = domain.vertices[e.b];
    size.push_back(length(metric.at(lerp(a, b, 0.5)), b - a));
  }
  std::vector<char> split(domain.edges.size(), 0);
  const Incidence incidence(domain, Incidence::Which::all);
  for (int v = 0; v < static_cast<int>(domain.vertices.size()); ++v) {
    const auto around = incidence.at(v);
    const auto kind_count = [&](const PlaneEdge& e) {
      return static_cast<std::size_t>(
          std::count_if(around.begin(), around.end(), [&](int f) { return bounds(domain.edges[f]) == bounds(e); }));
    };
    for (const int i : around) {
      const PlaneEdge& e = domain.edges[i];
      if (e.kind == PlaneEdgeKind::degenerate) continue;
      const std::size_t count = kind_count(e);
      for (const int j : around) {
        const PlaneEdge& f = domain.edges[j];
        if (i == j || f.kind == PlaneEdgeKind::degenerate || !follow_each_other(e, f, count)) continue;
        if (size[j] > 0 && size[i] > limit * size[j]) split[i] = 1;
      }
    }
  }
  return flagged(split);
}

}  // namespace carreau
