// SPDX-License-Identifier: BSD-3-Clause
// Edges that meet where they should not (HDR sec. 3.3.1).
#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <optional>
#include <set>
#include <utility>

#include "predicates/edge_grid.h"
#include "predicates/predicates.h"
#include "surface/domain/domain_check.h"
#include "surface/domain/domain_graph.h"

namespace carreau {
namespace {

bool comes_before(const Vec2& p, const Vec2& q) noexcept { return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y()); }

/// Returns whether p, which is on the line through a and b, lies in the closed segment.
bool within_span(const Vec2& a, const Vec2& b, const Vec2& p) noexcept {
  return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) && std::min(a.y(), b.y()) <= p.y() &&
         p.y() <= std::max(a.y(), b.y());
}

/// The point where a - b and c - d cross properly, to rounding and without overflow.
Vec2 crossing_point(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept {
  const double scale = std::max({std::abs(a.x()), std::abs(a.y()), std::abs(b.x()), std::abs(b.y()), std::abs(c.x()),
                                 std::abs(c.y()), std::abs(d.x()), std::abs(d.y())});
  const auto scaled = [&](Vec2 p) { return Vec2{p.x() / scale, p.y() / scale}; };
  const Vec2 e = scaled(d) - scaled(c), p = scaled(a) - scaled(c), q = scaled(b) - scaled(c);
  const double left = std::abs(cross(e, p)), right = std::abs(cross(e, q));
  const double w = left + right > 0 ? left / (left + right) : 0.5;
  return lerp(a, b, w);
}

/// A common point of the closed segments, if any.
std::optional<Vec2> common_point(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept {
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
std::optional<Vec2> overlap_beyond(const Vec2& p, const Vec2& q, const Vec2& r) noexcept {
  if (q == p || r == p) return p;
  if (orientation(p, q, r) != 0 || comes_before(p, q) != comes_before(p, r)) return std::nullopt;
  return within_span(p, q, r) ? r : q;
}

std::optional<Vec2> conflict_between(const PlaneDomain& domain, const PlaneEdge& e, const PlaneEdge& f) noexcept {
  const auto at = [&](int vertex) { return domain.vertices[vertex]; };
  const Vec2 a = at(e.a), b = at(e.b), c = at(f.a), d = at(f.b);
  if (std::max(a.x(), b.x()) < std::min(c.x(), d.x()) || std::max(c.x(), d.x()) < std::min(a.x(), b.x()) ||
      std::max(a.y(), b.y()) < std::min(c.y(), d.y()) || std::max(c.y(), d.y()) < std::min(a.y(), b.y()))
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

/// Sweep by M. Shamos and D. Hoey, "Geometric intersection problems" (1976). A slightly inclined line moves to the
/// right, so that vertices come in the order of x, then y. The order of the edges along it is right until the first
/// conflict, whose two edges are neighbours before. Needs no crossing point, so every step is exact.
class Sweep {
 public:
  explicit Sweep(const PlaneDomain& domain)
      : domain_(domain),
        incidence_(domain, DomainIncidence::Which::all),
        order_(Below{this}, &nodes_),
        place_(domain.edges.size()) {
    ends_.reserve(domain.edges.size());
    for (const PlaneEdge& e : domain.edges) {
      const Vec2 a = domain.vertices[e.a], b = domain.vertices[e.b];
      // An edge without length comes and goes at one of its ends.
      ends_.emplace_back(comes_before(b, a) ? e.b : e.a, comes_before(a, b) ? e.b : e.a);
    }
  }

  std::optional<EdgeConflict> run() {
    const std::vector<int> events = sorted_vertices();
    for (std::size_t i = 0; i < events.size() && !found_; ++i) {
      if (i > 0 && domain_.vertices[events[i - 1]] == domain_.vertices[events[i]])
        for (const int e : incidence_.at(events[i - 1]))
          for (const int f : incidence_.at(events[i])) test(e, f);
      pass(events[i]);
    }
    return found_;
  }

 private:
  struct Below {
    const Sweep* sweep;
    bool operator()(int e, int f) const { return e != f && sweep->height(e, f) > 0; }
  };

  [[nodiscard]] Vec2 low(int e) const { return domain_.vertices[ends_[e].first]; }
  [[nodiscard]] Vec2 high(int e) const { return domain_.vertices[ends_[e].second]; }

  /// 1 when f is above e where the line meets both, -1 below, 0 when they overlap.
  [[nodiscard]] int height(int e, int f) const {
    if (comes_before(low(f), low(e))) return -height_of_later(f, e);
    return height_of_later(e, f);
  }
  [[nodiscard]] int height_of_later(int e, int f) const {
    const int start = orientation(low(e), high(e), low(f));
    return start != 0 ? start : orientation(low(e), high(e), high(f));
  }

  [[nodiscard]] std::vector<int> sorted_vertices() const {
    std::vector<int> vertices;
    for (int v = 0; v < static_cast<int>(domain_.vertices.size()); ++v)
      if (!incidence_.at(v).empty()) vertices.push_back(v);
    std::stable_sort(vertices.begin(), vertices.end(),
                     [&](int v, int w) { return comes_before(domain_.vertices[v], domain_.vertices[w]); });
    return vertices;
  }

  void test(int e, int f) {
    if (found_ || e == f) return;
    if (const auto where = conflict_between(domain_, domain_.edges[e], domain_.edges[f]))
      found_ = EdgeConflict{std::min(e, f), std::max(e, f), *where};
  }

  void pass(int vertex) {
    for (const int e : incidence_.at(vertex))
      if (ends_[e].second == vertex && ends_[e].first != vertex && !found_) remove(e);
    for (const int e : incidence_.at(vertex))
      if (ends_[e].first == vertex && !found_) insert(e);
  }

  void insert(int e) {
    const auto [place, fresh] = order_.insert(e);
    if (!fresh) {
      found_ = EdgeConflict{std::min(*place, e), std::max(*place, e), low(e)};
      return;
    }
    place_[e] = place;
    if (place != order_.begin()) test(*std::prev(place), e);
    if (std::next(place) != order_.end()) test(*std::next(place), e);
    if (ends_[e].first == ends_[e].second) order_.erase(place);
  }

  void remove(int e) {
    const auto next = order_.erase(place_[e]);
    if (next != order_.begin() && next != order_.end()) test(*std::prev(next), *next);
  }

  const PlaneDomain& domain_;
  DomainIncidence incidence_;
  std::vector<std::pair<int, int>> ends_;  // of each edge, in the order of the sweep
  std::pmr::monotonic_buffer_resource nodes_;  // each edge comes once
  std::pmr::set<int, Below> order_;  // of the edges that meet the line, upwards
  std::vector<std::pmr::set<int, Below>::iterator> place_;
  std::optional<EdgeConflict> found_;
};

/// All pairs of all cells, at most `max_tests` of them.
std::vector<EdgeConflict> search_cells(const PlaneDomain& domain, const EdgeGrid& grid, double max_tests) {
  const std::size_t most = 4 * domain.edges.size();
  std::vector<EdgeConflict> conflicts;
  double tests = 0;
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column) {
      const auto edges = grid.edges_in(column, row);  // increasing
      for (std::size_t i = 0; i < edges.size(); ++i) {
        tests += static_cast<double>(edges.size() - i);
        if (tests > max_tests) return conflicts;
        for (std::size_t j = i + 1; j < edges.size(); ++j) {
          const auto where = conflict_between(domain, domain.edges[edges[i]], domain.edges[edges[j]]);
          if (!where) continue;
          conflicts.push_back({edges[i], edges[j], *where});
          if (conflicts.size() <= 2 * most) continue;
          keep_one_of_each_pair(conflicts);
          if (conflicts.size() > most) return conflicts;
        }
      }
    }
  return conflicts;
}

double count_pairs(const EdgeGrid& grid) {
  double pairs = 0;
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column) {
      const double k = static_cast<double>(grid.edges_in(column, row).size());
      pairs += 0.5 * k * (k + 1);
    }
  return pairs;
}

}  // namespace

std::optional<EdgeConflict> find_a_crossing(const PlaneDomain& domain) {
  require_sound(domain);
  if (is_star(domain)) return {};
  return Sweep(domain).run();
}

std::vector<EdgeConflict> find_crossings(const PlaneDomain& domain) {
  require_sound(domain);
  if (is_star(domain)) return {};
  const EdgeGrid grid = grid_of(domain);
  const double n = static_cast<double>(domain.edges.size());
  // Long edges that run close together in a slanting direction crowd the cells. The sweep handles them, but finds one
  // pair only.
  const double usual = 200 * n + 1e6, most = 3 * usual;
  std::optional<EdgeConflict> first;
  if (count_pairs(grid) > usual) {
    first = Sweep(domain).run();
    if (!first) return {};
  }
  std::vector<EdgeConflict> conflicts = search_cells(domain, grid, most);
  if (first) conflicts.push_back(*first);
  keep_one_of_each_pair(conflicts);
  return conflicts;
}

}  // namespace carreau
