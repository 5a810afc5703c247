// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/crossings/outline.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "predicates/predicates.h"

namespace carreau {

namespace {

// Pairs of edges that are compared, for each edge. [time only]
constexpr std::size_t max_pairs_per_edge = 256;

bool is_before(const Vec2& p, const Vec2& q) noexcept { return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y()); }

// True if two edges on one line that meet at b lie on both sides of it.
bool is_between(const Vec2& a, const Vec2& b, const Vec2& c) noexcept { return is_before(a, b) == is_before(b, c); }

// More than the end of one that is the beginning of the other. Their boxes meet.
bool conflict(const OutlineEdge& e, const OutlineEdge& f) noexcept {
  if (e.from == f.to && e.to == f.from) return true;
  if (e.to == f.from) return orientation(e.p, e.q, f.q) == 0 && !is_between(e.p, e.q, f.q);
  if (f.to == e.from) return orientation(f.p, f.q, e.q) == 0 && !is_between(f.p, f.q, e.q);
  if (orientation(e.p, e.q, f.p) * orientation(e.p, e.q, f.q) > 0) return false;
  return orientation(f.p, f.q, e.p) * orientation(f.p, f.q, e.q) <= 0;
}

/// The edges in the order of their beginnings along the axis in which the whole is longer; both axes as if it were x.
struct Spans {
  std::vector<double> low, high, below, above;

  explicit Spans(std::span<const OutlineEdge> edges) {
    Vec2 least = edges.front().p, most = least;
    for (const OutlineEdge& e : edges) least = least.cwiseMin(e.p), most = most.cwiseMax(e.p);
    const int x = most.x() - least.x() >= most.y() - least.y() ? 0 : 1, y = 1 - x;
    for (std::vector<double>* each : {&low, &high, &below, &above}) each->reserve(edges.size());
    for (const OutlineEdge& e : edges) {
      low.push_back(std::min(e.p[x], e.q[x])), high.push_back(std::max(e.p[x], e.q[x]));
      below.push_back(std::min(e.p[y], e.q[y])), above.push_back(std::max(e.p[y], e.q[y]));
    }
  }
};

bool are_simple(std::span<const OutlineEdge> edges) {
  const Spans spans(edges);
  std::vector<std::size_t> order(edges.size()), active;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return spans.low[a] < spans.low[b] || (spans.low[a] == spans.low[b] && a < b);
  });
  std::size_t pairs = 0;
  for (const std::size_t k : order) {
    std::erase_if(active, [&](std::size_t a) { return spans.high[a] < spans.low[k]; });
    pairs += active.size();
    if (pairs > max_pairs_per_edge * edges.size()) return false;
    for (const std::size_t a : active)
      if (spans.below[a] <= spans.above[k] && spans.below[k] <= spans.above[a] && conflict(edges[a], edges[k]))
        return false;
    active.push_back(k);
  }
  return true;
}

// The edge that follows each edge on its line; -1: none.
std::vector<std::int32_t> followers(std::span<const OutlineEdge> edges) {
  std::vector<std::int32_t> next;
  next.reserve(edges.size());
  for (const OutlineEdge& e : edges) {
    const auto found = std::lower_bound(edges.begin(), edges.end(), e.to,
                                        [](const OutlineEdge& f, std::int32_t v) { return f.from < v; });
    next.push_back(found != edges.end() && found->from == e.to ? static_cast<std::int32_t>(found - edges.begin()) : -1);
  }
  return next;
}

// Number of turns of simple lines counterclockwise: by the corner that comes first along the axes, which is convex; -1:
// some line is not closed.
int counterclockwise_lines(std::span<const OutlineEdge> edges) {
  const std::vector<std::int32_t> next = followers(edges);
  std::vector<char> seen(edges.size(), 0);
  int count = 0;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (seen[start] != 0) continue;
    std::size_t first = start, k = start;
    do {
      seen[k] = 1;
      if (next[k] < 0) return -1;
      if (is_before(edges[k].q, edges[first].q)) first = k;
      k = static_cast<std::size_t>(next[k]);
    } while (seen[k] == 0);
    if (k != start) return -1;
    if (orientation(edges[first].p, edges[first].q, edges[static_cast<std::size_t>(next[first])].q) > 0) ++count;
  }
  return count;
}

}  // namespace

std::vector<std::int32_t> pinched_vertices(std::vector<OutlineEdge>& edges) {
  std::sort(edges.begin(), edges.end(), [](const OutlineEdge& e, const OutlineEdge& f) {
    return e.from < f.from || (e.from == f.from && e.to < f.to);
  });
  std::vector<std::int32_t> pinched;
  for (std::size_t k = 1; k < edges.size(); ++k)
    if (edges[k].from == edges[k - 1].from && (pinched.empty() || pinched.back() != edges[k].from))
      pinched.push_back(edges[k].from);
  return pinched;
}

bool goes_round_once(std::span<const OutlineEdge> edges) {
  return !edges.empty() && are_simple(edges) && counterclockwise_lines(edges) == 1;
}

}  // namespace carreau
