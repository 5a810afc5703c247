// SPDX-License-Identifier: BSD-3-Clause
#include "surface/domain/domain_graph.h"

#include <algorithm>

#include "predicates/predicates.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

void require_sound(const PlaneDomain& domain) {
  const int n = static_cast<int>(domain.vertices.size());
  for (int v = 0; v < n; ++v)
    if (!is_finite(domain.vertices[v]))
      throw InvalidArgument("vertex " + std::to_string(v) + " of a parameter domain is not finite");
  for (const PlaneEdge& e : domain.edges)
    if (e.a < 0 || e.a >= n || e.b < 0 || e.b >= n)
      throw InvalidArgument("an edge of a parameter domain joins vertices " + std::to_string(e.a) + " and " +
                            std::to_string(e.b) + " of " + std::to_string(n));
}

std::string name_of_place(const Vec2& uv) {
  std::string name = "(u, v) = (";
  append_number(name, uv.x());
  name += ", ";
  append_number(name, uv.y());
  return name + ")";
}

std::vector<std::pair<int, int>> bounding_edges(const PlaneDomain& domain) {
  std::vector<std::pair<int, int>> edges;
  for (const PlaneEdge& e : domain.edges)
    if (bounds(e)) edges.emplace_back(e.a, e.b);
  return edges;
}

int turn_about_mean(const PlaneDomain& domain, std::span<const std::pair<int, int>> edges) {
  if (edges.empty()) return 0;
  Vec2 mean{0, 0};
  for (const auto& [a, b] : edges) mean += domain.vertices[a] / static_cast<double>(edges.size());
  const int turn = orientation(mean, domain.vertices[edges[0].first], domain.vertices[edges[0].second]);
  int crossings = 0;  // of the line along u through the mean: two a turn
  for (const auto& [a, b] : edges) {
    const Vec2 &p = domain.vertices[a], &q = domain.vertices[b];
    if (orientation(mean, p, q) != turn) return 0;
    crossings += (p.y() <= mean.y()) != (q.y() <= mean.y()) ? 1 : 0;
  }
  return crossings == 2 ? turn : 0;
}

bool is_star(const PlaneDomain& domain) {
  if (domain.edges.size() != domain.vertices.size()) return false;
  constexpr char begun = 1, ended = 2;
  std::vector<char> at(domain.vertices.size(), 0);
  for (const PlaneEdge& e : domain.edges) {
    if (!bounds(e) || (at[e.a] & begun) != 0 || (at[e.b] & ended) != 0) return false;
    at[e.a] |= begun, at[e.b] |= ended;
  }
  return turn_about_mean(domain, bounding_edges(domain)) > 0;
}

DomainIncidence::DomainIncidence(const PlaneDomain& domain, Which which) {
  const auto counts = [&](const PlaneEdge& e) { return which == Which::all || bounds(e); };
  first_.assign(domain.vertices.size() + 1, 0);
  for (const PlaneEdge& e : domain.edges)
    if (counts(e)) ++first_[e.a + 1], ++first_[e.b + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  edge_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int i = 0; i < static_cast<int>(domain.edges.size()); ++i) {
    const PlaneEdge& e = domain.edges[i];
    if (counts(e)) edge_[next[e.a]++] = i, edge_[next[e.b]++] = i;
  }
}

namespace {

class ChainFinder {
 public:
  ChainFinder(const PlaneDomain& domain, const DomainIncidence& incidence, const std::vector<char>& passes)
      : domain_(domain), incidence_(incidence), passes_(passes), used_(domain.edges.size(), 0) {}

  std::vector<Chain> run() {
    std::vector<Chain> chains;
    const int n = static_cast<int>(domain_.vertices.size());
    for (int v = 0; v < n; ++v)  // open ones first, from their ends
      if (!goes_on(v))
        for (const int e : incidence_.at(v))
          if (used_[e] == 0) chains.push_back(follow(e, v));
    for (int v = 0; v < n; ++v)
      for (const int e : incidence_.at(v))
        if (used_[e] == 0) {
          chains.push_back(follow(e, domain_.edges[e].a));
          chains.back().closed = true;
        }
    return chains;
  }

 private:
  [[nodiscard]] bool goes_on(int v) const { return incidence_.at(v).size() == 2 && passes_[v] != 0; }

  Chain follow(int edge, int from) {
    Chain chain;
    while (true) {
      used_[edge] = 1;
      const PlaneEdge& e = domain_.edges[edge];
      chain.edges.push_back(edge);
      chain.against.push_back(e.a != from ? 1 : 0);
      from = e.a != from ? e.a : e.b;
      if (!goes_on(from)) return chain;
      const auto around = incidence_.at(from);
      edge = around[0] == edge ? around[1] : around[0];
      if (used_[edge] != 0) return chain;
    }
  }

  const PlaneDomain& domain_;
  const DomainIncidence& incidence_;
  const std::vector<char>& passes_;
  std::vector<char> used_;
};

}  // namespace

std::vector<Chain> chains_of(const PlaneDomain& domain, const DomainIncidence& incidence, const std::vector<char>& passes) {
  return ChainFinder(domain, incidence, passes).run();
}

}  // namespace carreau
