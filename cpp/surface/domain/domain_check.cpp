// SPDX-License-Identifier: BSD-3-Clause
#include "surface/domain/domain_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/error.h"
#include "surface/domain/domain_graph.h"

namespace carreau {
namespace {

double uv_length(const PlaneDomain& domain, const PlaneEdge& e) noexcept {
  const Vec2 a = domain.vertices[e.a], b = domain.vertices[e.b];
  return std::hypot(0.5 * a.x() - 0.5 * b.x(), 0.5 * a.y() - 0.5 * b.y());  // halves: no overflow
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
  std::vector<double> size;
  for (const PlaneEdge& e : domain.edges) {
    const Vec2 a = domain.vertices[e.a], b = domain.vertices[e.b];
    size.push_back(length(metric.at(lerp(a, b, 0.5)), b - a));
  }
  return edges_to_split_for_balance(domain, size, ratio, 1);
}

std::vector<int> edges_to_split_for_balance(const PlaneDomain& domain, std::span<const double> size, double ratio, int reach) {
  if (!(ratio >= 2)) throw InvalidArgument("the ratio of the lengths of adjacent edges must be 2 or more");
  require_sound(domain);
  // A chain that is exactly geometric must not depend on rounding.
  const double limit = ratio * (1 + 1e-9);
  std::vector<char> split(domain.edges.size(), 0);
  const DomainIncidence incidence(domain, DomainIncidence::Which::all);
  // Calls use(f) for the edges that follow edge i at its end v.
  const auto for_next = [&](int i, int v, const auto& use) {
    const PlaneEdge& e = domain.edges[i];
    const auto around = incidence.at(v);
    const auto count = static_cast<std::size_t>(
        std::count_if(around.begin(), around.end(), [&](int f) { return bounds(domain.edges[f]) == bounds(e); }));
    for (const int j : around)
      if (j != i && domain.edges[j].kind != PlaneEdgeKind::degenerate && follow_each_other(e, domain.edges[j], count)) use(j);
  };
  for (int i = 0; i < static_cast<int>(domain.edges.size()); ++i) {
    const PlaneEdge& e = domain.edges[i];
    if (e.kind == PlaneEdgeKind::degenerate) continue;
    const auto compare = [&](int j) {
      if (size[j] > 0 && size[i] > limit * size[j]) split[i] = 1;
    };
    for (const int v : {e.a, e.b})
      for_next(i, v, [&](int j) {
        compare(j);
        if (reach < 2) return;
        const PlaneEdge& f = domain.edges[j];
        for_next(j, f.a == v ? f.b : f.a, compare);
      });
  }
  return flagged(split);
}

}  // namespace carreau
