// SPDX-License-Identifier: BSD-3-Clause
#include "plane/division/coarse_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "plane/kernel/thresholds.h"

namespace carreau::plane {

namespace {

/// Edges in a row, each with whether it is passed from its end b to its end a.
struct Link {
  int edge;
  bool backwards;
};

class Chains {
 public:
  Chains(const PlaneDomain& domain, const ControlSpace& metric, double length)
      : domain_(domain),
        metric_(metric),
        length_(length),
        at_(domain.vertices.size(), {-1, -1}),
        kept_(domain.vertices.size(), 0),
        passed_(domain.edges.size(), 0),
        coarse_(domain.vertices.size(), -1) {}

  CoarseDomain run() {
    find_kept();
    for (std::size_t v = 0; v < kept_.size(); ++v)
      if (kept_[v] != 0) number(static_cast<int>(v));
    result_.first = {0};
    for (std::size_t e = 0; e < domain_.edges.size(); ++e)
      if (passed_[e] == 0) add_chain(static_cast<int>(e));
    return std::move(result_);
  }

 private:
  void find_kept() {
    std::vector<int> degree(domain_.vertices.size(), 0);
    for (std::size_t e = 0; e < domain_.edges.size(); ++e) {
      const PlaneEdge& edge = domain_.edges[e];
      for (const int v : {edge.a, edge.b}) {
        if (degree[v] < 2) at_[v][degree[v]] = static_cast<int>(e);
        ++degree[v];
        if (edge.kind == PlaneEdgeKind::degenerate) kept_[v] = 1;
      }
    }
    for (std::size_t v = 0; v < kept_.size(); ++v) {
      if (degree[v] != 2 || domain_.edges[at_[v][0]].kind != domain_.edges[at_[v][1]].kind ||
          turn(static_cast<int>(v)) > max_coarse_turn)
        kept_[v] = 1;
    }
  }

  [[nodiscard]] int other_end(int edge, int v) const {
    return domain_.edges[edge].a == v ? domain_.edges[edge].b : domain_.edges[edge].a;
  }
  [[nodiscard]] int other_edge(int edge, int v) const { return at_[v][0] == edge ? at_[v][1] : at_[v][0]; }

  // Radians in the metric between the two edges at v.
  [[nodiscard]] double turn(int v) const {
    const Vec2 p = domain_.vertices[v];
    const Vec2 in = p - domain_.vertices[other_end(at_[v][0], v)], out = domain_.vertices[other_end(at_[v][1], v)] - p;
    const Metric2 m = metric_.at(p);
    return std::abs(std::atan2(std::sqrt(std::max(determinant(m), 0.0)) * cross(in, out), dot(m, in, out)));
  }

  int number(int v) {
    if (coarse_[v] < 0) {
      coarse_[v] = static_cast<int>(result_.fine.size());
      result_.fine.push_back(v);
      result_.domain.vertices.push_back(domain_.vertices[v]);
    }
    return coarse_[v];
  }

  // From the kept vertex before `edge`, if there is one, to the next one.
  void add_chain(int edge) {
    int start = domain_.edges[edge].a, first = edge;
    while (kept_[start] == 0) {
      const int before = other_edge(first, start);
      if (before == edge) break;  // a loop without a kept vertex
      start = other_end(before, start);
      first = before;
    }
    chain_.clear();
    int v = start;
    for (int e = first;;) {
      passed_[e] = 1;
      chain_.push_back({e, domain_.edges[e].a != v});
      v = other_end(e, v);
      if (kept_[v] != 0 || v == start) break;
      e = other_edge(e, v);
    }
    cut_chain(start, v);
  }

  // Cuts into edges with equal shares of the possible length and of the turns.
  void cut_chain(int start, int end) {
    std::vector<double> upto;  // shares, by link
    double sum = 0;
    int v = start;
    for (const Link& link : chain_) {
      const int w = other_end(link.edge, v);
      const Vec2 p = domain_.vertices[v], q = domain_.vertices[w];
      sum += carreau::length(metric_.at(0.5 * (p + q)), q - p) / length_;
      upto.push_back(sum);
      if (w != end || kept_[w] == 0) sum += turn(w) / max_coarse_turn;
      v = w;
    }
    const bool closed = start == end;
    const double pieces = std::max(std::ceil(upto.back()), closed ? 3.0 : 1.0), share = upto.back() / pieces;
    double next = share;
    int a = start;
    v = start;
    for (std::size_t k = 0; k < chain_.size(); ++k) {
      const Link& link = chain_[k];
      v = other_end(link.edge, v);
      result_.edges.push_back(link.edge);
      const bool last = k + 1 == chain_.size();
      // Continues if the end of the next link is nearer to the edge's intended end.
      if (!last && 0.5 * (upto[k] + upto[k + 1]) < next) continue;
      PlaneEdge coarse = domain_.edges[link.edge];
      coarse.a = number(a), coarse.b = number(v);
      result_.domain.edges.push_back(coarse);
      result_.first.push_back(static_cast<int>(result_.edges.size()));
      a = v;
      while (next <= upto[k] + 0.5 * share) next += share;
    }
  }

  const PlaneDomain& domain_;
  const ControlSpace& metric_;
  double length_;
  std::vector<std::array<int, 2>> at_;  // the first two edges at a vertex
  std::vector<char> kept_, passed_;
  std::vector<int> coarse_;  // numbers of vertices
  std::vector<Link> chain_;
  CoarseDomain result_;
};

}  // namespace

CoarseDomain make_coarse(const PlaneDomain& domain, const ControlSpace& metric, double length) {
  return Chains(domain, metric, length).run();
}

}  // namespace carreau::plane
