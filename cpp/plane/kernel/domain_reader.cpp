// SPDX-License-Identifier: BSD-3-Clause
#include "plane/kernel/domain_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "plane/kernel/thresholds.h"
#include "support/error.h"

namespace carreau::plane {

namespace {

double scale_for(double low, double high, const Vec2& where) {
  // Halves, because the difference of two numbers may overflow.
  const double half = 0.5 * high - 0.5 * low;
  if (!(half > 0)) throw_at(where, "the domain has no area: all its vertices lie on one line of constant u or v");
  const int exponent = std::ilogb(half) + 1;
  // Below, coordinates inside would lose their last bits to underflow; above 2^1020 the box overflows. [boundary_test, tiny and huge
  // coordinates]
  if (exponent < -900 || exponent > 1020)
    throw_at(where, "the domain is too small or too large for double precision numbers");
  return std::ldexp(1.0, -exponent);
}

}  // namespace

void throw_at(const Vec2& uv, const std::string& sentence) {
  Where where;
  where.uv = uv;
  throw DomainError(where, sentence);
}

std::string name_of(const PlaneEdge& edge) {
  const std::string ends = "vertices " + std::to_string(edge.a) + " and " + std::to_string(edge.b);
  if (edge.curve < 0) return "the edge between " + ends;
  return "edge " + std::to_string(edge.segment + 1) + " of curve " + std::to_string(edge.curve + 1) + " (" + ends + ")";
}

std::string name_of_edge_between(const PlaneDomain& domain, int u, int v) {
  for (const PlaneEdge& edge : domain.edges)
    if ((edge.a == u && edge.b == v) || (edge.a == v && edge.b == u)) return name_of(edge);
  return "an imposed edge";
}

void check_domain(const PlaneDomain& domain) {
  const std::size_t count = domain.vertices.size();
  if (count < 3) throw DomainError("the domain has fewer than three vertices");
  if (count > INT32_MAX / 16) throw LimitError("the boundary has too many vertices");
  for (std::size_t v = 0; v < count; ++v)
    if (!is_finite(domain.vertices[v]))
      throw DomainError("vertex " + std::to_string(v) + " of the domain is not finite");
  std::vector<int> balance(count, 0);
  bool any = false;
  for (const PlaneEdge& edge : domain.edges) {
    const auto n = static_cast<int>(count);
    if (edge.a < 0 || edge.b < 0 || edge.a >= n || edge.b >= n)
      throw DomainError(name_of(edge) + " has an end that does not exist");
    if (edge.a == edge.b) throw_at(domain.vertices[edge.a], name_of(edge) + " ends where it starts");
    if (edge.kind == PlaneEdgeKind::internal) continue;
    ++balance[edge.a];
    --balance[edge.b];
    any = true;
  }
  if (!any) throw DomainError("the domain has no boundary");
  for (std::size_t v = 0; v < count; ++v)
    if (balance[v] != 0)
      throw_at(domain.vertices[v], "the boundary does not close at vertex " + std::to_string(v) + ": " +
                                       (balance[v] > 0 ? "more" : "fewer") + " edges leave it than arrive");
}

Frame frame_of(const PlaneDomain& domain) {
  Vec2 low = domain.vertices[0], high = low;
  for (const Vec2& p : domain.vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Frame frame;
  frame.scale = {scale_for(low.x(), high.x(), low), scale_for(low.y(), high.y(), low)};
  frame.unscale = {1 / frame.scale.x(), 1 / frame.scale.y()};
  return frame;
}

std::vector<int> order_along_edges(const PlaneDomain& domain) {
  const std::size_t count = domain.vertices.size();
  std::vector<int> first(count + 1, 0), leaving(domain.edges.size());
  for (const PlaneEdge& edge : domain.edges) ++first[edge.a + 1];
  for (std::size_t v = 0; v < count; ++v) first[v + 1] += first[v];
  std::vector<int> at = first;
  for (std::size_t e = 0; e < domain.edges.size(); ++e) leaving[at[domain.edges[e].a]++] = static_cast<int>(e);

  std::vector<int> order;
  order.reserve(count);
  std::vector<char> listed(count, 0);
  at = first;
  const auto list = [&](int v) {
    if (listed[v] != 0) return;
    listed[v] = 1;
    order.push_back(v);
  };
  for (const PlaneEdge& edge : domain.edges)
    for (int v = edge.a; at[v] < first[v + 1];) {
      list(v);
      v = domain.edges[leaving[at[v]++]].b;
      list(v);
    }
  for (std::size_t v = 0; v < count; ++v) list(static_cast<int>(v));
  return order;
}

}  // namespace carreau::plane
