// SPDX-License-Identifier: BSD-3-Clause
#include "pieces.h"

#include <cmath>
#include <numbers>
#include <set>

#include "mesh/quality.h"
#include "plane/plane_mesher.h"
#include "predicates/predicates.h"

namespace carreau::testing {

using namespace variable;

Piece meshed(const std::vector<std::vector<Vec2>>& loops, const std::function<double(Vec2)>& h) {
  PlaneDomain domain;
  SampledDomain sampled;
  for (const auto& loop : loops) {
    const int first = static_cast<int>(domain.vertices.size()), n = static_cast<int>(loop.size());
    domain.vertices.insert(domain.vertices.end(), loop.begin(), loop.end());
    for (int i = 0; i < n; ++i) {
      domain.edges.push_back({.a = first + i, .b = first + (i + 1) % n});
      sampled.edges.emplace_back(first + i, first + (i + 1) % n);
    }
  }
  sampled.vertices = domain.vertices;
  const auto sampler = [&](std::span<const Vec2> places, std::span<Metric2> metrics) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double size = h(places[i]);
      metrics[i] = {1 / (size * size), 0, 1 / (size * size)};
    }
  };
  Monitor monitor;
  PlaneMesh mesh = mesh_plane(domain, ControlSpace::build(sampled, sampler, {}, monitor), {}, monitor);
  return {std::move(mesh.vertices), std::move(mesh.triangles)};
}

std::vector<Vec2> circle(Vec2 centre, double radius, int n) {
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    points.emplace_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
  }
  return points;
}

std::vector<Vec2> polygon(const std::vector<Vec2>& corners, double h) {
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 a = corners[k], b = corners[(k + 1) % corners.size()];
    const int n = std::max(1, static_cast<int>(std::ceil(norm(b - a) / h)));
    for (int i = 0; i < n; ++i) points.push_back(lerp(a, b, double(i) / n));
  }
  return points;
}

Piece disc(Vec2 centre, double radius, double h) {
  return meshed({circle(centre, radius, static_cast<int>(std::lround(2 * std::numbers::pi * radius / h)))},
                [h](Vec2) { return h; });
}

RemeshInput input_of(Piece piece, double h_min, double h_max) {
  RemeshInput input;
  input.piece = std::move(piece);
  input.h_min = h_min, input.h_max = h_max;
  return input;
}

namespace {

using Pair = std::array<std::int32_t, 2>;

std::vector<std::string> boundary_defects(const RemeshResult& result) {
  std::vector<std::string> defects;
  std::set<Pair> sides;
  for (const auto& t : result.piece.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (!sides.insert({t[k], t[(k + 1) % 3]}).second) defects.emplace_back("two triangles run the same way");
  std::set<Pair> open;
  for (const auto& [a, b] : sides)
    if (!sides.contains({b, a})) open.insert({a, b});
  if (open != std::set<Pair>(result.edges.begin(), result.edges.end()))
    defects.emplace_back("the edges are not those of the boundary");
  std::vector<int> degree(result.piece.vertices.size(), 0);
  for (const auto& [a, b] : open) ++degree[static_cast<std::size_t>(a)], ++degree[static_cast<std::size_t>(b)];
  for (std::size_t v = 0; v < degree.size(); ++v) {
    if (degree[v] > 2) defects.push_back("vertex " + std::to_string(v) + " is multiple");
    if ((degree[v] > 0) != (result.vertex_kinds[v] != Kind::inside)) defects.emplace_back("a kind is wrong");
  }
  return defects;
}

}  // namespace

std::vector<std::string> find_defects(const RemeshInput& input, const RemeshResult& result) {
  std::vector<std::string> defects = boundary_defects(result);
  const auto& p = result.piece.vertices;
  for (const auto& t : result.piece.triangles)
    if (orientation(p[static_cast<std::size_t>(t[0])], p[static_cast<std::size_t>(t[1])],
                    p[static_cast<std::size_t>(t[2])]) <= 0)
      defects.emplace_back("a triangle is turned over");
  const Tools tools(input.tools);
  for (std::size_t v = 0; v < p.size() && !tools.empty(); ++v) {
    const ToolPlace place = tools.nearest(p[v]);
    const double depth = place.in_solid ? place.distance : 0;
    if (depth > 1e-9 * input.h_min)
      defects.push_back("vertex " + std::to_string(v) + " is " + std::to_string(depth) + " deep in a tool");
    if (result.vertex_kinds[v] >= Kind::bound && place.distance > 1e-3 * input.h_min)
      defects.push_back("bound vertex " + std::to_string(v) + " is " + std::to_string(place.distance) +
                        " from its tool");
  }
  if (parts_of(adjacency_of(result.piece)).first != result.parts) defects.emplace_back("parts are wrong");
  return defects;
}

PieceQuality quality_of(const Piece& piece, const std::function<double(Vec2)>& size) {
  PieceQuality quality;
  const std::vector<Vec3> p = in_space(piece.vertices);
  std::set<Pair> edges;
  for (const auto& t : piece.triangles) {
    const double q = quality_q2(p[static_cast<std::size_t>(t[0])], p[static_cast<std::size_t>(t[1])],
                                p[static_cast<std::size_t>(t[2])]);
    quality.q2_mean += q / static_cast<double>(piece.triangles.size());
    quality.q2_worst = std::min(quality.q2_worst, q);
    for (std::size_t k = 0; k < 3; ++k) edges.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  }
  std::size_t fitting = 0;
  for (const auto& [a, b] : edges) {
    const Vec2 q = piece.vertices[static_cast<std::size_t>(a)], r = piece.vertices[static_cast<std::size_t>(b)];
    const double length = norm(r - q) / size((q + r) / 2);
    fitting += length >= std::numbers::sqrt2 / 2 && length <= std::numbers::sqrt2 ? 1 : 0;
  }
  quality.in_range = static_cast<double>(fitting) / static_cast<double>(edges.size());
  return quality;
}

}  // namespace carreau::testing
