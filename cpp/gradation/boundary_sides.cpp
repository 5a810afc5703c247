// SPDX-License-Identifier: BSD-3-Clause
#include "gradation/boundary_sides.h"

#include <algorithm>

#include "gradation/thresholds.h"
#include "model/union_find.h"

namespace carreau {

namespace {

using thresholds::gradation::straight_on;

bool goes_straight_on(const Vec3& before, const Vec3& at, const Vec3& after) noexcept {
  const Vec3 p = at - before, q = after - at;
  return dot(p, q) > straight_on * norm(p) * norm(q);
}

}  // namespace

BoundarySides::BoundarySides(const GradationGraph& graph, const std::vector<std::uint8_t>& on_boundary) {
  for (std::size_t t = 0; t < graph.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = graph.triangles[t][i], b = graph.triangles[t][(i + 1) % 3];
      if ((on_boundary[t] >> i & 1) != 0) edges_.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  number(graph);
}

void BoundarySides::number(const GradationGraph& graph) {
  first_.assign(graph.places.size() + 1, 0);
  for (const auto& edge : edges_)
    for (const int place : edge) ++first_[place + 1];
  for (std::size_t p = 0; p < graph.places.size(); ++p) first_[p + 1] += first_[p];
  at_place_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t e = 0; e < edges_.size(); ++e)
    for (const int place : edges_[e]) at_place_[next[place]++] = static_cast<int>(e);

  UnionFind sides(edges_.size());
  const auto other_end = [&](int edge, int place) {
    const auto& e = edges_[edge];
    return graph.xyz[graph.places[e[0] == place ? e[1] : e[0]].vertex];
  };
  for (int p = 0; p < static_cast<int>(graph.places.size()); ++p)
    if (const auto edges = at_place(p);
        edges.size() == 2 &&
        goes_straight_on(other_end(edges[0], p), graph.xyz[graph.places[p].vertex], other_end(edges[1], p)))
      sides.merge(static_cast<std::size_t>(edges[0]), static_cast<std::size_t>(edges[1]));
  for (std::size_t e = 0; e < edges_.size(); ++e) side_.push_back(static_cast<int>(sides.find(e)));
  for (int& edge : at_place_) edge = side_[edge];
  at_vertex_.resize(graph.xyz.size());
  for (int p = 0; p < static_cast<int>(graph.places.size()); ++p) {
    std::vector<int>& all = at_vertex_[graph.places[p].vertex];
    all.insert(all.end(), at_place(p).begin(), at_place(p).end());
  }
}

std::span<const int> BoundarySides::at_place(int place) const noexcept {
  return {at_place_.data() + first_[place], first_[place + 1] - first_[place]};
}

std::span<const int> BoundarySides::of_edge(int a, int b) const noexcept {
  const std::array<int, 2> edge{std::min(a, b), std::max(a, b)};
  return {&side_[std::lower_bound(edges_.begin(), edges_.end(), edge) - edges_.begin()], 1};
}

}  // namespace carreau
