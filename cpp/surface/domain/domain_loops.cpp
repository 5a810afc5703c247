// SPDX-License-Identifier: BSD-3-Clause
// Loops of a domain: whether they close, their orientation, and the parts outside.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "predicates/polygon_locator.h"
#include "predicates/predicates.h"
#include "support/error.h"
#include "surface/domain/domain_check.h"
#include "surface/domain/domain_graph.h"

namespace carreau {
namespace {

using Sentences = std::vector<std::string>;

std::string default_name(const PlaneEdge& edge) {
  if (edge.curve < 0) return "an edge";
  const std::string of_curve = "curve " + std::to_string(edge.curve + 1);
  return edge.segment < 0 ? "an edge of " + of_curve : "edge " + std::to_string(edge.segment + 1) + " of " + of_curve;
}

/// Collects sentences.
struct Report {
  const PlaneDomain& domain;
  const EdgeNamer& namer;
  Sentences sentences;

  [[nodiscard]] std::string name(int edge) const {
    return namer ? namer(domain.edges[edge]) : default_name(domain.edges[edge]);
  }
  [[nodiscard]] std::string place(int vertex) const { return name_of_place(domain.vertices[vertex]); }
  void add(std::string sentence) { sentences.push_back(std::move(sentence)); }
};

/// The boundary alone, with exact answers about its inside.
class Boundary {
 public:
  explicit Boundary(const PlaneDomain& domain) : inside_(domain.vertices, bounding_edges(domain)) {
    int count = 0;
    for (const PlaneEdge& e : domain.edges) rank_.push_back(bounds(e) ? count++ : -1);
  }
  [[nodiscard]] const PolygonLocator& inside() const { return inside_; }
  [[nodiscard]] bool inside_left_of(int edge) const { return inside_.inside_left_of(rank_[edge]); }

 private:
  PolygonLocator inside_;
  std::vector<int> rank_;  // of each edge of the domain among the bounding ones
};

std::vector<Chain> boundary_chains(const PlaneDomain& domain, const DomainIncidence& incidence) {
  return chains_of(domain, incidence, std::vector<char>(domain.vertices.size(), 1));
}

bool has_odd_vertex(const PlaneDomain& domain, const DomainIncidence& boundary) {
  for (int v = 0; v < static_cast<int>(domain.vertices.size()); ++v)
    if (boundary.at(v).size() % 2 != 0) return true;
  return false;
}

/// How the inside lies along a chain run from its first edge to its last: > 0 on the left, < 0 on the right. Weighted
/// by length: all edges have this sign unless the boundary crosses itself.
double side_of_inside(const PlaneDomain& domain, const Boundary& boundary, const Chain& chain, double extent) {
  double vote = 0;
  for (std::size_t i = 0; i < chain.edges.size(); ++i) {
    const PlaneEdge& e = domain.edges[chain.edges[i]];
    const Vec2 a = domain.vertices[e.a], b = domain.vertices[e.b];
    if (a == b) continue;
    const double share = std::hypot(a.x() / extent - b.x() / extent, a.y() / extent - b.y() / extent);
    const bool left = boundary.inside_left_of(chain.edges[i]) != (chain.against[i] != 0);
    vote += (left ? 1 : -1) * std::max(share, 1e-30);
  }
  return vote;
}

/// Returns the sign of side_of_inside() if one chain is the boundary and certainly does not meet itself; otherwise 0.
int side_of_star(const PlaneDomain& domain, std::span<const Chain> chains) {
  if (chains.size() != 1 || !chains[0].closed) return 0;
  std::vector<std::pair<int, int>> edges;
  for (std::size_t i = 0; i < chains[0].edges.size(); ++i) {
    const PlaneEdge& e = domain.edges[chains[0].edges[i]];
    edges.push_back(chains[0].against[i] != 0 ? std::pair(e.b, e.a) : std::pair(e.a, e.b));
  }
  return turn_about_mean(domain, edges);
}

double extent_of(const PlaneDomain& domain) {
  double extent = 0;
  for (const Vec2& p : domain.vertices) extent = std::max({extent, std::abs(p.x()), std::abs(p.y())});
  return extent > 0 ? extent : 1;
}

void report_invalid(Report& report) {
  try {
    require_sound(report.domain);
  } catch (const InvalidArgument& error) {
    report.add(error.what());
  }
}

void report_edges_without_length(Report& report) {
  for (int i = 0; i < static_cast<int>(report.domain.edges.size()); ++i) {
    const PlaneEdge& e = report.domain.edges[i];
    if (report.domain.vertices[e.a] == report.domain.vertices[e.b])
      report.add(report.name(i) + ", at " + report.place(e.a) + ", has no length in the parameter plane");
  }
}

void report_odd_vertices(const DomainIncidence& boundary, Report& report) {
  for (int v = 0; v < static_cast<int>(report.domain.vertices.size()); ++v) {
    const auto around = boundary.at(v);
    if (around.size() % 2 == 0) continue;
    const std::string others =
        around.size() == 1 ? " alone" : " and " + std::to_string(around.size() - 1) + " other boundary edges";
    report.add("the boundary does not close: " + report.name(around[0]) + others + " at " + report.place(v));
  }
}

/// Chain whose vertices are all on one line.
bool is_flat(const PlaneDomain& domain, const Chain& chain) {
  const PlaneEdge& first = domain.edges[chain.edges[0]];
  const Vec2 a = domain.vertices[first.a], b = domain.vertices[first.b];
  return std::all_of(chain.edges.begin(), chain.edges.end(), [&](int e) {
    return orientation(a, b, domain.vertices[domain.edges[e].a]) == 0 &&
           orientation(a, b, domain.vertices[domain.edges[e].b]) == 0;
  });
}

void report_chain(const Boundary& boundary, const Chain& chain, Report& report) {
  const auto from = [&](int e) { return report.name(e) + ", from " + report.place(report.domain.edges[e].a) + ","; };
  if (chain.closed && is_flat(report.domain, chain)) {
    report.add("the loop through " + from(chain.edges[0]) + " has no area");
    return;
  }
  std::size_t wrong = 0;
  int first_wrong = -1;
  for (const int e : chain.edges) {
    if (boundary.inside_left_of(e)) continue;
    if (wrong++ == 0) first_wrong = e;
  }
  if (wrong == chain.edges.size())
    report.add("the boundary is turned the wrong way: along " + from(chain.edges[0]) +
               " the inside of the domain is on the right");
  else if (wrong > 0)
    report.add(from(first_wrong) + " is turned against other edges of its loop, or the loop crosses itself");
}

/// One sentence a curve, for the first edge that is outside.
void report_internal_edges(const Boundary& boundary, Report& report) {
  std::set<int> told;
  for (int i = 0; i < static_cast<int>(report.domain.edges.size()); ++i) {
    const PlaneEdge& e = report.domain.edges[i];
    if (bounds(e) || boundary.inside().inside_along(report.domain.vertices[e.a], report.domain.vertices[e.b])) continue;
    if (e.curve >= 0 && !told.insert(e.curve).second) continue;
    report.add(report.name(i) + ", internal, from " + report.place(e.a) + " to " + report.place(e.b) +
               ", is not inside the domain");
  }
}

void report_points(const Boundary& boundary, Report& report) {
  const PlaneDomain& domain = report.domain;
  const DomainIncidence incidence(domain, DomainIncidence::Which::all);
  std::vector<int> alone;
  for (int v = 0; v < static_cast<int>(domain.vertices.size()); ++v)
    if (incidence.at(v).empty()) alone.push_back(v);
  if (alone.empty()) return;
  std::vector<std::pair<int, int>> edges;
  for (const PlaneEdge& e : domain.edges) edges.emplace_back(e.a, e.b);
  const PolygonLocator all(domain.vertices, edges);
  std::set<std::pair<double, double>> seen;
  for (const int v : alone) {
    const Vec2 p = domain.vertices[v];
    const std::string point = "the imposed point at " + report.place(v);
    if (const int e = all.edge_through(p); e >= 0)
      report.add(point + " lies on " + report.name(e));
    else if (!boundary.inside().contains(p))
      report.add(point + " is outside the domain");
    else if (!seen.emplace(p.x(), p.y()).second)
      report.add(point + " is imposed twice");
  }
}

}  // namespace

Sentences find_open_loops(const PlaneDomain& domain, const EdgeNamer& name) {
  Report report{domain, name, {}};
  report_invalid(report);
  if (!report.sentences.empty()) return report.sentences;
  report_edges_without_length(report);
  if (std::none_of(domain.edges.begin(), domain.edges.end(), bounds)) report.add("the domain has no boundary");
  report_odd_vertices(DomainIncidence(domain, DomainIncidence::Which::bounding), report);
  return report.sentences;
}

Sentences find_loop_defects(const PlaneDomain& domain, const EdgeNamer& name) {
  Report report{domain, name, find_open_loops(domain, name)};
  if (!report.sentences.empty() || is_star(domain)) return report.sentences;
  const Boundary boundary(domain);
  const DomainIncidence incidence(domain, DomainIncidence::Which::bounding);
  for (const Chain& chain : boundary_chains(domain, incidence)) report_chain(boundary, chain, report);
  report_internal_edges(boundary, report);
  report_points(boundary, report);
  return report.sentences;
}

bool orient_loops(PlaneDomain& domain, int seed, bool left) {
  require_sound(domain);
  if (seed < 0 || seed >= static_cast<int>(domain.edges.size()) || !bounds(domain.edges[seed]))
    throw DomainError("the orientation is given by an edge that is not on the boundary");
  const DomainIncidence incidence(domain, DomainIncidence::Which::bounding);
  if (has_odd_vertex(domain, incidence)) return false;
  const std::vector<Chain> chains = boundary_chains(domain, incidence);
  const int side = side_of_star(domain, chains);
  std::optional<Boundary> boundary;
  if (side == 0) boundary.emplace(domain);
  const double extent = extent_of(domain);
  std::vector<int> to_turn;
  for (const Chain& chain : chains) {
    const bool inside_left = boundary ? side_of_inside(domain, *boundary, chain, extent) > 0 : side > 0;
    for (std::size_t i = 0; i < chain.edges.size(); ++i) {
      const bool edge_has_left = inside_left != (chain.against[i] != 0);
      if (chain.edges[i] == seed && edge_has_left != left) return false;
      if (!edge_has_left) to_turn.push_back(chain.edges[i]);
    }
  }
  for (const int e : to_turn) std::swap(domain.edges[e].a, domain.edges[e].b);
  return true;
}

}  // namespace carreau
