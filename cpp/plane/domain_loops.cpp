// Loops of a domain: do they close, which way are they turned, what lies outside.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "plane/domain_check.h"
#include "plane/domain_graph.h"
#include "predicates/polygon_locator.h"
#include "predicates/predicates.h"
#include "support/error.h"

namespace carreau {
namespace {

using Sentences = std::vector<std::string>;

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

std::vector<Chain> boundary_chains(const PlaneDomain& domain, const Incidence& incidence) {
  return chains_of(domain, incidence, std::vector<char>(domain.vertices.size(), 1));
}

bool has_odd_vertex(const PlaneDomain& domain, const Incidence& boundary) {
  for (int v = 0; v < static_cast<int>(domain.vertices.size()); ++v)
    if (boundary.at(v).size() % 2 != 0) return true;
  return false;
}

/// How the inside lies along a chain run from its first edge to its last: > 0 on the left, < 0 on the right. Weighted
/// by length: the sign is that of every edge unless the boundary crosses itself.
double side_of_inside(const PlaneDomain& domain, const Boundary& boundary, const Chain& chain, double extent) {
  double vote = 0;
  for (std::size_t i = 0; i < chain.edges.size(); ++i) {
    const PlaneEdge& e = domain.edges[chain.edges[i]];
    const Vec2 a = domain.vertices[e.a], b = domain.vertices[e.b];
    if (a == b) continue;
    const double share = std::hypot(a.x / extent - b.x / extent, a.y / extent - b.y / extent);
    const bool left = boundary.inside_left_of(chain.edges[i]) != (chain.against[i] != 0);
    vote += (left ? 1 : -1) * std::max(share, 1e-30);
  }
  return vote;
}

double extent_of(const PlaneDomain& domain) {
  double extent = 0;
  for (const Vec2 p : domain.vertices) extent = std::max({extent, std::abs(p.x), std::abs(p.y)});
  return extent > 0 ? extent : 1;
}

void report_invalid(const PlaneDomain& domain, Sentences& sentences) {
  try {
    require_sound(domain);
  } catch (const InvalidArgument& error) {
    sentences.emplace_back(error.what());
  }
}

void report_edges_without_length(const PlaneDomain& domain, Sentences& sentences) {
  for (int i = 0; i < static_cast<int>(domain.edges.size()); ++i) {
    const PlaneEdge& e = domain.edges[i];
    if (domain.vertices[e.a] == domain.vertices[e.b])
      sentences.push_back("the edge of " + name_of_edge(domain, i) + " at " + name_of_place(domain.vertices[e.a]) +
                          " has no length in the parameter plane");
  }
}

void report_odd_vertices(const PlaneDomain& domain, const Incidence& boundary, Sentences& sentences) {
  for (int v = 0; v < static_cast<int>(domain.vertices.size()); ++v) {
    const auto around = boundary.at(v);
    if (around.size() % 2 == 0) continue;
    const std::string count =
        around.size() == 1 ? "only one boundary edge" : std::to_string(around.size()) + " boundary edges";
    sentences.push_back("the boundary does not close: " + count + " (" + name_of_edge(domain, around[0]) + ") at " +
                        name_of_place(domain.vertices[v]));
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

void report_chain(const PlaneDomain& domain, const Boundary& boundary, const Chain& chain, Sentences& sentences) {
  const int first = chain.edges[0];
  const std::string where =
      name_of_edge(domain, first) + ", from " + name_of_place(domain.vertices[domain.edges[first].a]);
  if (chain.closed && is_flat(domain, chain)) {
    sentences.push_back("the loop through " + where + " has no area");
    return;
  }
  std::size_t wrong = 0;
  int first_wrong = -1;
  for (const int e : chain.edges) {
    if (boundary.inside_left_of(e)) continue;
    if (wrong++ == 0) first_wrong = e;
  }
  if (wrong == chain.edges.size())
    sentences.push_back("the boundary is turned the wrong way: along " + where +
                        ", the inside of the domain is on the right");
  else if (wrong > 0)
    sentences.push_back("the edge of " + name_of_edge(domain, first_wrong) + " from " +
                        name_of_place(domain.vertices[domain.edges[first_wrong].a]) +
                        " is turned against other edges of its loop, or the loop crosses itself");
}

/// One sentence a curve, for the first edge that is outside.
void report_internal_edges(const PlaneDomain& domain, const Boundary& boundary, Sentences& sentences) {
  std::set<int> told;
  for (int i = 0; i < static_cast<int>(domain.edges.size()); ++i) {
    const PlaneEdge& e = domain.edges[i];
    const Vec2 a = domain.vertices[e.a], b = domain.vertices[e.b];
    if (bounds(e) || boundary.inside().inside_along(a, b)) continue;
    if (e.curve >= 0 && !told.insert(e.curve).second) continue;
    sentences.push_back("the internal edge of " + name_of_edge(domain, i) + " from " + name_of_place(a) + " to " +
                        name_of_place(b) + " is not inside the domain");
  }
}

void report_points(const PlaneDomain& domain, const Boundary& boundary, Sentences& sentences) {
  const Incidence incidence(domain, Incidence::Which::all);
  std::vector<int> alone;
  for (int v = 0; v < static_cast<int>(domain.vertices.size()); ++v)
    if (incidence.at(v).empty()) alone.push_back(v);
  if (alone.empty()) return;
  std::vector<std::pair<int, int>> edges;
  for (const PlaneEdge& e : domain.edges) edges.emplace_back(e.a, e.b);
  const PolygonLocator all(domain.vertices, edges);
  std::map<std::pair<double, double>, int> seen;
  for (const int v : alone) {
    const Vec2 p = domain.vertices[v];
    const std::string name = "the imposed point at " + name_of_place(p);
    if (const int e = all.edge_through(p); e >= 0)
      sentences.push_back(name + " lies on the edge of " + name_of_edge(domain, e));
    else if (!boundary.inside().contains(p))
      sentences.push_back(name + " is outside the domain");
    else if (!seen.emplace(std::pair(p.x, p.y), v).second)
      sentences.push_back(name + " is imposed twice");
  }
}

}  // namespace

Sentences find_open_loops(const PlaneDomain& domain) {
  Sentences sentences;
  report_invalid(domain, sentences);
  if (!sentences.empty()) return sentences;
  report_edges_without_length(domain, sentences);
  if (std::none_of(domain.edges.begin(), domain.edges.end(), bounds))
    sentences.emplace_back("the domain has no boundary");
  report_odd_vertices(domain, Incidence(domain, Incidence::Which::bounding), sentences);
  return sentences;
}

Sentences find_loop_defects(const PlaneDomain& domain) {
  Sentences sentences = find_open_loops(domain);
  if (!sentences.empty()) return sentences;
  const Boundary boundary(domain);
  const Incidence incidence(domain, Incidence::Which::bounding);
  for (const Chain& chain : boundary_chains(domain, incidence)) report_chain(domain, boundary, chain, sentences);
  report_internal_edges(domain, boundary, sentences);
  report_points(domain, boundary, sentences);
  return sentences;
}

bool orient_loops(PlaneDomain& domain, int seed, bool left) {
  require_sound(domain);
  if (seed < 0 || seed >= static_cast<int>(domain.edges.size()) || !bounds(domain.edges[seed]))
    throw DomainError("the orientation is given by an edge that is not on the boundary");
  const Incidence incidence(domain, Incidence::Which::bounding);
  if (has_odd_vertex(domain, incidence)) return false;
  const Boundary boundary(domain);
  const double extent = extent_of(domain);
  std::vector<int> to_turn;
  for (const Chain& chain : boundary_chains(domain, incidence)) {
    const bool inside_left = side_of_inside(domain, boundary, chain, extent) > 0;
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
