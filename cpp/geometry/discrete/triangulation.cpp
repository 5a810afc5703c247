// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/triangulation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "geometry/discrete/flat_triangles.h"
#include "model/bucket_sort.h"
#include "model/union_find.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau::discrete {

namespace {

struct SideOf {
  Edge edge{};
  std::int32_t triangle = -1;
  int side = 0;
  friend auto operator<=>(const SideOf&, const SideOf&) = default;
};

/// A triangle by its vertices, in either direction.
struct Known {
  std::array<std::int32_t, 3> sorted{};
  std::int32_t triangle = -1;
  friend auto operator<=>(const Known&, const Known&) = default;
};


}  // namespace

Triangulation::Triangulation(const FlatMesh& input, bool join) {
  std::vector<std::int32_t> number;
  take_vertices(input, join, number);
  take_triangles(input, number);
  drop_repeated();
  for (const auto& e : input.edges)
    if (const Edge known = edge_of(number[index(e[0])], number[index(e[1])]); known[0] != known[1])
      marked.push_back(known);
  drop_flat();
  if (triangles.empty()) throw InvalidArgument("the surface has no triangle");
  drop_unused(input);
  link();
  turn();
  std::ranges::sort(marked);
  marked.erase(std::unique(marked.begin(), marked.end()), marked.end());
  std::erase_if(marked, [&](const Edge& e) { return !std::ranges::binary_search(edges, e); });
  count(input);
}

std::string Triangulation::place(std::int32_t vertex) const {
  const Vec3& p = at(vertex);
  return "(" + format_number(p.x()) + ", " + format_number(p.y()) + ", " + format_number(p.z()) + ")";
}

void Triangulation::take_vertices(const FlatMesh& input, bool join, std::vector<std::int32_t>& number) {
  const std::size_t n = input.vertices.size();
  for (std::size_t v = 0; v < n; ++v)
    if (!is_finite(input.vertices[v]))
      throw InvalidArgument("vertex " + std::to_string(v) + " (from 0) has a coordinate that is not finite");
  number.resize(n);
  std::iota(number.begin(), number.end(), 0);
  vertices = input.vertices;
  if (!join) return;
  std::vector<std::int32_t> order = number;
  const auto key = [&](std::int32_t v) {
    const Vec3& p = input.vertices[index(v)];
    return std::tuple(p.x(), p.y(), p.z());
  };
  std::ranges::sort(order,
                    [&](std::int32_t v, std::int32_t w) { return std::tuple(key(v), v) < std::tuple(key(w), w); });
  for (std::size_t k = 1; k < n; ++k)
    if (key(order[k]) == key(order[k - 1])) number[index(order[k])] = number[index(order[k - 1])];
}

void Triangulation::take_triangles(const FlatMesh& input, const std::vector<std::int32_t>& number) {
  for (std::size_t t = 0; t < input.triangles.size(); ++t) {
    std::array<std::int32_t, 3> c{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t v = input.triangles[t][k];
      if (v < 0 || index(v) >= number.size())
        throw InvalidArgument("triangle " + std::to_string(t) + " (from 0) names vertex " + std::to_string(v) + " of " +
                              std::to_string(number.size()));
      c[k] = number[index(v)];
    }
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) {
      if (findings.flat_triangles++ == 0)
        findings.sentences.push_back("triangle " + std::to_string(t) + " (from 0) at " + place(std::ranges::min(c)) +
                                     " has two corners at one place: dropped");
      continue;
    }
    triangles.push_back(c);
    refs.push_back(input.triangle_refs.empty() ? 0 : input.triangle_refs[t]);
    origin.push_back(static_cast<std::int32_t>(t));
  }
}

void Triangulation::drop_repeated() {
  std::vector<Known> known;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    known.push_back({triangles[t], static_cast<std::int32_t>(t)});
    std::ranges::sort(known.back().sorted);
  }
  bucket_sort(known, vertices.size(), [](const Known& k) { return k.sorted[0]; });
  std::vector<char> dropped(triangles.size(), 0);
  for (std::size_t k = 1; k < known.size(); ++k)
    if (known[k].sorted == known[k - 1].sorted) {
      const auto [t, before] = std::pair(index(known[k].triangle), index(known[k - 1].triangle));
      dropped[t] = 1;
      if (findings.repeated_triangles++ == 0)
        findings.sentences.push_back("triangle " + std::to_string(origin[t]) + " (from 0) at " +
                                     place(known[k].sorted[0]) + " has the vertices of triangle " +
                                     std::to_string(origin[before]) + ": dropped");
    }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (dropped[t] != 0) continue;
    triangles[kept] = triangles[t], refs[kept] = refs[t], origin[kept] = origin[t];
    ++kept;
  }
  triangles.resize(kept), refs.resize(kept), origin.resize(kept);
}

void Triangulation::drop_flat() {
  const std::vector<std::int32_t> dropped = drop_flat_triangles(vertices, {triangles, refs, origin}, marked);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (const auto& [a, b, c] = triangles[t]; is_flat(vertices, triangles[t]))
      throw InvalidArgument("triangle " + std::to_string(origin[t]) + " (from 0) with corners at " + place(a) + ", " +
                            place(b) + " and " + place(c) +
                            " has no area: it cannot be dropped without a hole. Remove it first");
  if (dropped.empty()) return;
  findings.flat_triangles += static_cast<std::int64_t>(dropped.size());
  const std::int32_t first = std::ranges::min(dropped);
  findings.sentences.push_back(std::to_string(dropped.size()) + " triangles have no area, the first is triangle " +
                               std::to_string(first) + " (from 0): dropped, and their longest sides are divided");
  drop_repeated();
}

void Triangulation::drop_unused(const FlatMesh& input) {
  std::vector<std::int32_t> rank(vertices.size(), -1);
  for (const auto& t : triangles)
    for (const std::int32_t v : t) rank[index(v)] = 0;
  std::int32_t n = 0;
  for (std::size_t v = 0; v < rank.size(); ++v)
    if (rank[v] == 0) {
      vertices[index(n)] = vertices[v];
      vertex_refs.push_back(input.vertex_refs.empty() ? 0 : input.vertex_refs[v]);
      rank[v] = n++;
    }
  vertices.resize(index(n));
  for (auto& t : triangles)
    for (std::int32_t& v : t) v = rank[index(v)];
  std::erase_if(marked, [&](const Edge& e) { return rank[index(e[0])] < 0 || rank[index(e[1])] < 0; });
  for (Edge& e : marked) e = edge_of(rank[index(e[0])], rank[index(e[1])]);
}

void Triangulation::link() {
  std::vector<SideOf> all;
  all.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto triangle = static_cast<std::int32_t>(t);
      all.push_back({edge_of(corner(triangle, i), corner(triangle, i + 1)), triangle, i});
    }
  bucket_sort(all, vertices.size(), [](const SideOf& s) { return s.edge[0]; });
  edge_.resize(all.size());
  for (const SideOf& s : all) {
    if (edges.empty() || edges.back() != s.edge) {
      edges.push_back(s.edge);
      start_.push_back(static_cast<std::int32_t>(sides_.size()));
    }
    sides_.push_back({s.triangle, s.side});
    edge_[3 * index(s.triangle) + static_cast<std::size_t>(s.side)] = static_cast<std::int32_t>(edges.size()) - 1;
  }
  start_.push_back(static_cast<std::int32_t>(sides_.size()));
}

std::span<const Side> Triangulation::sides(std::int32_t edge) const {
  return std::span(sides_).subspan(index(start_[index(edge)]), index(start_[index(edge) + 1] - start_[index(edge)]));
}

Side Triangulation::beyond(std::int32_t triangle, int side) const {
  const auto both = sides(edge(triangle, side));
  if (both.size() != 2) return {-1, 0};
  const Side& other = both[0].triangle == triangle && both[0].side == side ? both[1] : both[0];
  return corner(other.triangle, other.side) == corner(triangle, side + 1) ? other : Side{-1, 0};
}

std::int32_t Triangulation::find_edge(std::int32_t v, std::int32_t w) const {
  const auto found = std::ranges::lower_bound(edges, edge_of(v, w));
  return found != edges.end() && *found == edge_of(v, w) ? static_cast<std::int32_t>(found - edges.begin()) : -1;
}

// Turns triangles over edges with two triangles, breadth first; then each shell follows its majority.
void Triangulation::turn() {
  std::vector<char> turned(triangles.size(), 0);
  shell.assign(triangles.size(), -1);
  std::vector<std::int32_t> todo;
  for (std::size_t first = 0; first < triangles.size(); ++first) {
    if (shell[first] >= 0) continue;
    const auto number = static_cast<std::int32_t>(findings.shells++);
    shell[first] = number;
    todo.assign(1, static_cast<std::int32_t>(first));
    std::int64_t against = 0;
    for (std::size_t k = 0; k < todo.size(); ++k) {
      const std::int32_t t = todo[k];
      against += turned[index(t)];
      for (int i = 0; i < 3; ++i) {
        const auto both = sides(edge(t, i));
        if (both.size() != 2) continue;
        const Side& other = both[0].triangle == t && both[0].side == i ? both[1] : both[0];
        const bool same_way = corner(other.triangle, other.side) == corner(t, i);
        const char wanted = static_cast<char>((turned[index(t)] != 0) != same_way);
        if (shell[index(other.triangle)] < 0) {
          shell[index(other.triangle)] = number;
          turned[index(other.triangle)] = wanted;
          todo.push_back(other.triangle);
        }
      }
    }
    if (2 * against > static_cast<std::int64_t>(todo.size()))
      for (const std::int32_t t : todo) turned[index(t)] = static_cast<char>(turned[index(t)] == 0);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (turned[t] == 0) continue;
    if (findings.turned_triangles++ == 0)
      findings.sentences.push_back("triangle " + std::to_string(origin[t]) + " (from 0) at " + place(triangles[t][0]) +
                                   " ran against its neighbours: turned");
    std::swap(triangles[t][1], triangles[t][2]);
    std::swap(edge_[3 * t], edge_[3 * t + 2]);  // a b c -> a c b: ab is the last side, ca the first one
  }
  for (Side& s : sides_)
    if (turned[index(s.triangle)] != 0) s.side = 2 - s.side;
}

void Triangulation::count(const FlatMesh& input) {
  findings.unused_vertices = static_cast<std::int64_t>(input.vertices.size() - vertices.size());
  findings.euler_number = static_cast<std::int64_t>(vertices.size()) - static_cast<std::int64_t>(edges.size()) +
                          static_cast<std::int64_t>(triangles.size());
  std::int32_t border = -1, many = -1, one_sided = -1;
  UnionFind corners(3 * triangles.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto here = static_cast<std::int32_t>(e);
    const auto all = sides(here);
    if (all.size() == 1 && findings.border_edges++ == 0) border = here;
    if (all.size() > 2 && findings.manifold_breaks++ == 0) many = here;
    if (all.size() == 2 && corner(all[0].triangle, all[0].side) == corner(all[1].triangle, all[1].side) &&
        findings.one_sided_edges++ == 0)
      one_sided = here;
    for (std::size_t k = 1; k < all.size(); ++k)
      for (const std::int32_t v : edges[e]) {
        const auto rank = [&](const Side& s) {
          const auto& t = triangles[index(s.triangle)];
          return 3 * index(s.triangle) + static_cast<std::size_t>(std::ranges::find(t, v) - t.begin());
        };
        corners.merge(rank(all[0]), rank(all[k]));
      }
  }
  std::vector<char> fans(vertices.size(), 0);
  std::int32_t pinched = -1;
  for (std::size_t c = 0; c < 3 * triangles.size(); ++c)
    if (corners.find(c) == c) {
      const std::int32_t v = triangles[c / 3][c % 3];
      if (++fans[index(v)] == 2 && findings.pinched_vertices++ == 0) pinched = v;
      fans[index(v)] = std::min<char>(fans[index(v)], 3);
    }
  const auto tell = [&](std::int32_t e, const std::string& what, std::int64_t n) {
    if (e >= 0)
      findings.sentences.push_back(std::to_string(n) + what + ", the first from " + place(edges[index(e)][0]) + " to " +
                                   place(edges[index(e)][1]));
  };
  tell(many, " edges have three triangles or more", findings.manifold_breaks);
  tell(one_sided, " edges have no orientation on which both triangles agree", findings.one_sided_edges);
  tell(border, " edges have one triangle: borders", findings.border_edges);
  if (pinched >= 0)
    findings.sentences.push_back(std::to_string(findings.pinched_vertices) +
                                 " vertices join triangles that share no edge, the first at " + place(pinched));
}

Vec3 Triangulation::normal(std::int32_t triangle) const {
  const auto& [a, b, c] = triangles[index(triangle)];
  const Vec3 n = cross(at(b) - at(a), at(c) - at(a));
  return n / norm(n);
}

double Triangulation::angle(std::int32_t triangle, int k) const {
  const Vec3 p = at(corner(triangle, k + 1)) - at(corner(triangle, k)),
             q = at(corner(triangle, k + 2)) - at(corner(triangle, k));
  return std::atan2(norm(cross(p, q)), dot(p, q));
}

double Triangulation::bend(std::int32_t edge) const {
  constexpr double half_turn = 180;
  const auto both = sides(edge);
  if (both.size() != 2 || beyond(both[0].triangle, both[0].side).triangle < 0) return half_turn;
  const Vec3 n = normal(both[0].triangle), m = normal(both[1].triangle);
  return std::atan2(norm(cross(n, m)), dot(n, m)) * half_turn / std::numbers::pi;
}

double Triangulation::diagonal() const {
  Vec3 low = vertices.front(), high = low;
  for (const Vec3& p : vertices) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return norm(high - low);
}

}  // namespace carreau::discrete
