// SPDX-License-Identifier: BSD-3-Clause
#include "volume/volume_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <unordered_map>

#include "base/failure.h"

namespace command {
namespace {

constexpr double moved_tolerance = 1e-12;   // of the diagonal: engines print 16 digits
constexpr double volume_tolerance = 1e-10;  // of a solid's volume
constexpr double least_jacobian = 1e-3;     // of the straight element's, at its nodes: elements below are straightened

using Vector = Point;

double length(const Vector& p) { return std::sqrt(dot(p, p)); }

std::string text_of(const Point& p) {
  char text[100];
  std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g)", p[0], p[1], p[2]);
  return text;
}

/// 3 inradius / circumradius: 1 for a regular tetrahedron.
double shape_of(const std::array<Point, 4>& c) {
  const Vector a = minus(c[1], c[0]), b = minus(c[2], c[0]), d = minus(c[3], c[0]);
  const double six = triple(a, b, d);
  const double areas = length(cross(a, b)) + length(cross(b, d)) + length(cross(a, d)) + length(cross(minus(c[2], c[1]), minus(c[3], c[1])));
  Vector centre{};
  const Vector ab = cross(a, b), bd = cross(b, d), da = cross(d, a);
  for (std::size_t k = 0; k < 3; ++k) centre[k] = dot(d, d) * ab[k] + dot(a, a) * bd[k] + dot(b, b) * da[k];
  const double circumradius = length(centre) / (2 * std::abs(six));
  return 3 * (six / areas) / circumradius;
}

struct Corner3 {
  std::array<std::int32_t, 3> v;
  bool operator==(const Corner3&) const = default;
};
struct HashCorners {
  std::size_t operator()(const Corner3& c) const noexcept {
    std::size_t h = 0;
    for (const std::int32_t v : c.v) h = h * 1000003U + static_cast<std::size_t>(v);
    return h;
  }
};
Corner3 sorted(std::array<std::int32_t, 3> v) {
  std::sort(v.begin(), v.end());
  return {v};
}

/// Faces of a tetrahedron of positive volume, each with its normal outwards.
constexpr std::array<std::array<std::size_t, 3>, 4> outward{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
constexpr std::array<std::array<std::size_t, 2>, 6> edges_of{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// True if `order` is an even permutation of `triangle`.
bool same_turn(const std::array<std::int32_t, 3>& order, const std::array<std::int32_t, 3>& triangle) {
  for (std::size_t k = 0; k < 3; ++k)
    if (order[0] == triangle[k]) return order[1] == triangle[(k + 1) % 3];
  return false;
}

class Verification {
 public:
  explicit Verification(VolumeMesh& volume) : volume_(volume), surface_(volume.surface) {}

  void run() {
    place_vertices();
    add_volumes();
    compare_surface();
  }

 private:
  [[nodiscard]] std::string engine() const { return "The engine " + volume_.engine; }

  void place_vertices() {
    if (volume_.vertices.size() < surface_.vertices.size()) throw Failure(engine() + " left out vertices of the surface.");
    for (std::size_t v = 0; v < surface_.vertices.size(); ++v) {
      const double moved = length(minus(volume_.vertices[v], surface_.vertices[v]));
      if (!(moved <= moved_tolerance * (surface_.diagonal + length(minus(surface_.vertices[v], Point{})))))
        throw Failure(engine() + " moved the vertex at " + text_of(surface_.vertices[v]) + " of the surface.");
      volume_.vertices[v] = surface_.vertices[v];
    }
  }

  void add_volumes() {
    std::map<std::int32_t, double> sums;
    volume_.smallest_shape = volume_.tetrahedra.empty() ? 0 : 1;
    for (std::size_t i = 0; i < volume_.tetrahedra.size(); ++i) {
      auto& t = volume_.tetrahedra[i];
      const auto at = [&](std::size_t k) -> const Point& { return volume_.vertices[static_cast<std::size_t>(t[k])]; };
      double six = triple(minus(at(1), at(0)), minus(at(2), at(0)), minus(at(3), at(0)));
      if (six < 0) std::swap(t[2], t[3]), six = -six;  // engines differ in their order
      if (!(six > 0)) throw Failure(engine() + " made a tetrahedron without volume at " + text_of(at(0)) + ".");
      sums[volume_.solids[i]] += six / 6;
      volume_.smallest_shape = std::min(volume_.smallest_shape, shape_of({at(0), at(1), at(2), at(3)}));
    }
    for (const auto& [solid, sum] : sums)
      if (!surface_.volumes.contains(solid)) throw Failure(engine() + " filled a region " + std::to_string(solid) + ", which is no solid.");
    for (const auto& [solid, expected] : surface_.volumes) {
      const double sum = sums.contains(solid) ? sums.at(solid) : 0;
      if (std::abs(sum - expected) <= volume_tolerance * std::abs(expected)) continue;
      char text[200];
      std::snprintf(text, sizeof text, ": its tetrahedra have a volume of %.12g in place of %.12g.", sum, expected);
      throw Failure(engine() + " did not fill solid " + std::to_string(solid) + text);
    }
  }

  /// The solids beside each triangle must be the solids of the tetrahedra there, and no other triangle may part solids.
  void compare_surface() {
    std::unordered_map<Corner3, std::array<std::int32_t, 2>, HashCorners> found;
    std::unordered_map<Corner3, std::size_t, HashCorners> triangles;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) triangles.emplace(sorted(surface_.triangles[t]), t);
    std::unordered_map<Corner3, std::pair<int, std::int32_t>, HashCorners> inside;  // count and solid of faces that are not triangles
    for (std::size_t i = 0; i < volume_.tetrahedra.size(); ++i)
      for (const auto& face : outward) {
        const auto& t = volume_.tetrahedra[i];
        const std::array<std::int32_t, 3> corners{t[face[0]], t[face[1]], t[face[2]]};
        const Corner3 key = sorted(corners);
        const auto known = triangles.find(key);
        if (known == triangles.end()) {
          auto& [count, solid] = inside.emplace(key, std::pair{0, volume_.solids[i]}).first->second;
          if (++count == 2 && solid == volume_.solids[i]) inside.erase(key);
          continue;
        }
        auto& sides = found.emplace(key, std::array<std::int32_t, 2>{0, 0}).first->second;
        sides[same_turn(corners, surface_.triangles[known->second]) ? 0U : 1U] = volume_.solids[i];
      }
    if (!inside.empty()) {
      const auto& v = inside.begin()->first.v;
      throw Failure(engine() + " changed the surface: " + std::to_string(inside.size()) + " of its triangles are not of the surface, for example at " +
                    text_of(volume_.vertices[static_cast<std::size_t>(v[0])]) + ".");
    }
    std::size_t lost = 0, first = 0;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      const auto own = found.find(sorted(surface_.triangles[t]));
      if (own != found.end() && own->second == surface_.sides[t]) continue;
      if (lost++ == 0) first = t;
    }
    if (lost > 0)
      throw Failure(engine() + " lost " + std::to_string(lost) + " triangles of the surface, the first in face " + std::to_string(surface_.refs[first]) +
                    " at " + text_of(surface_.vertices[static_cast<std::size_t>(surface_.triangles[first][0])]) + ".");
  }

  VolumeMesh& volume_;
  SolidSurface& surface_;
};

/// Smallest Jacobian of a quadratic tetrahedron at its ten nodes, over six volumes of the straight one.
double jacobian_of(const std::array<Point, 10>& x) {
  const double straight = triple(minus(x[1], x[0]), minus(x[2], x[0]), minus(x[3], x[0]));
  double least = 1e300;
  std::array<std::array<double, 4>, 10> places{};
  for (std::size_t k = 0; k < 4; ++k) places[k][k] = 1;
  for (std::size_t e = 0; e < 6; ++e) places[4 + e][edges_of[e][0]] = places[4 + e][edges_of[e][1]] = .5;
  for (const auto& l : places) {
    // Derivatives by barycentric coordinates: corners (4 l - 1), nodes on edges 4 l of the other end.
    std::array<Vector, 4> by{};
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t c = 0; c < 3; ++c) by[k][c] += (4 * l[k] - 1) * x[k][c];
    for (std::size_t e = 0; e < 6; ++e)
      for (std::size_t c = 0; c < 3; ++c) {
        by[edges_of[e][0]][c] += 4 * l[edges_of[e][1]] * x[4 + e][c];
        by[edges_of[e][1]][c] += 4 * l[edges_of[e][0]] * x[4 + e][c];
      }
    least = std::min(least, triple(minus(by[1], by[0]), minus(by[2], by[0]), minus(by[3], by[0])) / straight);
  }
  return least;
}

}  // namespace

void verify(VolumeMesh& volume) { Verification(volume).run(); }

void make_quadratic(VolumeMesh& volume) {
  std::map<std::array<std::int32_t, 2>, std::int32_t> nodes;
  std::map<std::int32_t, std::array<std::int32_t, 2>> curved;  // edges by their nodes
  const auto node_of = [&](std::int32_t a, std::int32_t b) {
    const std::array<std::int32_t, 2> edge{std::min(a, b), std::max(a, b)};
    const auto [at, fresh] = nodes.emplace(edge, static_cast<std::int32_t>(volume.vertices.size()));
    if (!fresh) return at->second;
    const auto given = volume.surface.mids.find(edge);
    if (given != volume.surface.mids.end()) curved[at->second] = edge;
    const Point &p = volume.vertices[static_cast<std::size_t>(a)], &q = volume.vertices[static_cast<std::size_t>(b)];
    const Point middle{.5 * (p[0] + q[0]), .5 * (p[1] + q[1]), .5 * (p[2] + q[2])};
    volume.vertices.push_back(given != volume.surface.mids.end() ? given->second : middle);
    return at->second;
  };
  for (const auto& t : volume.surface.triangles) volume.triangle_mids.push_back({node_of(t[0], t[1]), node_of(t[1], t[2]), node_of(t[2], t[0])});
  for (const auto& t : volume.tetrahedra) {
    auto& mids = volume.tetrahedron_mids.emplace_back();
    for (std::size_t e = 0; e < 6; ++e) mids[e] = node_of(t[edges_of[e][0]], t[edges_of[e][1]]);
  }
  // Straight elements are valid, so that the loop ends.
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < volume.tetrahedra.size(); ++i) {
      std::array<Point, 10> x;
      for (std::size_t k = 0; k < 4; ++k) x[k] = volume.vertices[static_cast<std::size_t>(volume.tetrahedra[i][k])];
      for (std::size_t e = 0; e < 6; ++e) x[4 + e] = volume.vertices[static_cast<std::size_t>(volume.tetrahedron_mids[i][e])];
      if (jacobian_of(x) > least_jacobian) continue;
      for (const std::int32_t node : volume.tetrahedron_mids[i]) {
        const auto edge = curved.find(node);
        if (edge == curved.end()) continue;
        const Point &p = volume.vertices[static_cast<std::size_t>(edge->second[0])], &q = volume.vertices[static_cast<std::size_t>(edge->second[1])];
        volume.vertices[static_cast<std::size_t>(node)] = {.5 * (p[0] + q[0]), .5 * (p[1] + q[1]), .5 * (p[2] + q[2])};
        curved.erase(edge);
        ++volume.straightened, again = true;
      }
    }
  }
}

}  // namespace command
