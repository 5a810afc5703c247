// SPDX-License-Identifier: BSD-3-Clause
#include "plane_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "predicates/predicates.h"

namespace carreau::testing {

namespace {

using Defects = std::vector<std::string>;
using Edge = std::pair<int, int>;

std::string name(Edge e) { return std::to_string(e.first) + "-" + std::to_string(e.second); }

void check_vertices(const PlaneDomain& domain, const PlaneMesh& mesh, Defects& defects) {
  if (mesh.vertices.size() < domain.vertices.size()) {
    defects.push_back("imposed vertices are missing");
    return;
  }
  for (std::size_t v = 0; v < domain.vertices.size(); ++v)
    if (mesh.vertices[v] != domain.vertices[v]) defects.push_back("imposed vertex " + std::to_string(v) + " has moved");
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles)
    for (const int v : t) used[v] = 1;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v] == 0) defects.push_back("vertex " + std::to_string(v) + " is in no triangle");
}

// Components of the triangles, and of each vertex' triangles, joined through shared edges.
struct Joined {
  std::vector<int> root;
  explicit Joined(std::size_t n) : root(n) {
    for (std::size_t i = 0; i < n; ++i) root[i] = static_cast<int>(i);
  }
  int find(int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  }
  void join(int i, int j) { root[find(i)] = find(j); }
};

}  // namespace

std::vector<std::string> find_plane_defects(const PlaneDomain& domain, const PlaneMesh& mesh) {
  Defects defects;
  const auto n = static_cast<int>(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (const int v : t)
      if (v < 0 || v >= n) return {"a triangle has a vertex that does not exist"};
  check_vertices(domain, mesh, defects);
  if (!defects.empty()) return defects;

  long double area = 0;
  std::map<Edge, int> half_edges;  // directed edge -> triangle
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const Vec2 a = mesh.vertices[v[0]], b = mesh.vertices[v[1]], c = mesh.vertices[v[2]];
    if (orientation(a, b, c) <= 0) defects.push_back("triangle " + std::to_string(t) + " is not counterclockwise");
    area += (static_cast<long double>(b.x()) - a.x()) * (static_cast<long double>(c.y()) - a.y()) -
            (static_cast<long double>(b.y()) - a.y()) * (static_cast<long double>(c.x()) - a.x());
    for (int i = 0; i < 3; ++i)
      if (!half_edges.emplace(Edge{v[i], v[(i + 1) % 3]}, static_cast<int>(t)).second)
        defects.push_back("edge " + name({v[i], v[(i + 1) % 3]}) + " is in two triangles in the same direction");
  }

  std::set<Edge> boundary;
  long double polygon = 0, scale = 0;
  for (const PlaneEdge& e : domain.edges) {
    const bool left = half_edges.count({e.a, e.b}) != 0, right = half_edges.count({e.b, e.a}) != 0;
    if (e.kind == PlaneEdgeKind::internal) {
      if (!left || !right) defects.push_back("internal edge " + name({e.a, e.b}) + " is not there on both sides");
      continue;
    }
    boundary.insert({e.a, e.b});
    if (!left || right) defects.push_back("boundary edge " + name({e.a, e.b}) + " is missing or has two sides");
    const Vec2 a = domain.vertices[e.a], b = domain.vertices[e.b], o = domain.vertices[0];
    const long double p = (static_cast<long double>(a.x()) - o.x()) * (static_cast<long double>(b.y()) - o.y()),
                      q = (static_cast<long double>(a.y()) - o.y()) * (static_cast<long double>(b.x()) - o.x());
    polygon += p - q;
    scale += std::abs(p) + std::abs(q);
  }
  if (std::abs(area - polygon) > 1e-12L * scale) defects.push_back("the area is not that of the domain");

  Joined around(3 * mesh.triangles.size()), all(mesh.triangles.size());
  const auto corner = [&](int t, int v) {
    for (int i = 0; i < 3; ++i)
      if (mesh.triangles[t][i] == v) return 3 * t + i;
    return 3 * t;
  };
  std::size_t edges = 0;
  for (const auto& [e, t] : half_edges) {
    const auto other = half_edges.find({e.second, e.first});
    if (other == half_edges.end()) {
      ++edges;
      if (boundary.count(e) == 0) defects.push_back("edge " + name(e) + " has one side only");
      continue;
    }
    if (e.first < e.second) ++edges;
    all.join(t, other->second);
    around.join(corner(t, e.first), corner(other->second, e.first));
    around.join(corner(t, e.second), corner(other->second, e.second));
  }
  // Fans round each vertex: one inside, as many as boundary edges leave it otherwise.
  std::vector<int> fans(mesh.vertices.size(), 0), leaving(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      if (around.find(static_cast<int>(3 * t) + i) == static_cast<int>(3 * t) + i) ++fans[mesh.triangles[t][i]];
  for (const Edge& e : boundary) ++leaving[e.first];
  for (int v = 0; v < n; ++v)
    if (fans[v] != std::max(1, leaving[v])) defects.push_back("vertex " + std::to_string(v) + " is pinched");

  // Euler: triangles = 2 vertices - boundary edges - 2 (components - holes), counting a vertex once for each fan.
  std::size_t vertices = 0, components = 0;
  for (const int f : fans) vertices += static_cast<std::size_t>(f);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    components += all.find(static_cast<int>(t)) == static_cast<int>(t);
  std::map<int, int> next;  // loops of the boundary, split at pinched vertices, counted by Euler's number itself
  const auto euler = static_cast<long>(vertices) - static_cast<long>(edges) + static_cast<long>(mesh.triangles.size());
  if (euler > static_cast<long>(components)) defects.push_back("Euler's number is larger than that of discs");
  const long loops = 2 * static_cast<long>(components) - euler;  // sum over components of (2 - chi) = boundary loops
  if (loops < static_cast<long>(components)) defects.push_back("a component has no boundary");
  return defects;
}

PlaneQuality measure(const PlaneCase& c, const PlaneMesh& mesh) {
  PlaneQuality q;
  q.triangles = mesh.triangles.size();
  q.vertices = mesh.vertices.size();
  std::vector<Vec3> at(mesh.vertices.size());
  for (std::size_t v = 0; v < at.size(); ++v) at[v] = c.surface(mesh.vertices[v]);
  std::vector<int> degree(at.size(), 0);
  std::vector<double> quality;
  double sum_length = 0;
  std::size_t edges = 0, fitting = 0;
  q.shortest = 1e300;
  for (const auto& t : mesh.triangles) {
    double l2[3], largest = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec3 d = at[t[(i + 2) % 3]] - at[t[(i + 1) % 3]];
      l2[i] = dot(d, d);
      largest = std::max(largest, l2[i]);
      ++degree[t[i]];
    }
    bool flat = false;
    for (int i = 0; i < 3; ++i) {
      const double h = 0.5 * (c.size(mesh.vertices[t[(i + 1) % 3]]) + c.size(mesh.vertices[t[(i + 2) % 3]]));
      const double length = std::sqrt(l2[i]) / h;
      if (length < 1e-9) {
        flat = true;
        continue;
      }
      sum_length += length;
      ++edges;
      fitting += length >= std::sqrt(0.5) && length <= std::sqrt(2.0);
      q.shortest = std::min(q.shortest, length);
      q.longest = std::max(q.longest, length);
    }
    if (flat) continue;
    const double area = 0.5 * norm(cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]));
    quality.push_back(4 * std::sqrt(3.0) * area / (l2[0] + l2[1] + l2[2]));
  }
  std::sort(quality.begin(), quality.end());
  for (const double x : quality) q.mean += x / static_cast<double>(quality.size());
  q.worst = quality.front();
  q.p1 = quality[quality.size() / 100];
  q.mean_length = sum_length / static_cast<double>(edges);
  q.fitting = static_cast<double>(fitting) / static_cast<double>(edges);
  std::size_t free = 0, six = 0;
  for (std::size_t v = c.domain.vertices.size(); v < at.size(); ++v) {
    ++free;
    six += degree[v] == 6;
  }
  q.degree_six = free == 0 ? 1 : static_cast<double>(six) / static_cast<double>(free);
  return q;
}

std::string to_string(const PlaneQuality& q) {
  char text[256];
  std::snprintf(text, sizeof text,
                "nt %zu Q2 mean %.5f p1 %.4f worst %.4f | length mean %.4f fitting %.5f [%.3f %.3f] | degree 6 %.4f",
                q.triangles, q.mean, q.p1, q.worst, q.mean_length, q.fitting, q.shortest, q.longest, q.degree_six);
  return text;
}

}  // namespace carreau::testing
