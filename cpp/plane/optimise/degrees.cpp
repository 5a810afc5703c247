// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/degrees.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/shape_levels.h"
#include "plane/kernel/star.h"
#include "plane/kernel/thresholds.h"
#include "plane/optimise/inner_edges.h"

namespace carreau::plane {

Degrees count_degrees(const PlaneWork& work) {
  const Triangulation& mesh = work.mesh;
  const int fixed = work.fixed;
  Degrees degrees;
  degrees.found.assign(mesh.vertices.size(), 0);
  degrees.wanted.assign(mesh.vertices.size(), 6);
  std::vector<float> angle(fixed, 0);
  std::vector<std::uint8_t> open(fixed, 0);
  for (const Triangle& T : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const int v = T.v[i];
      if (degrees.found[v] < 255) ++degrees.found[v];
      if (T.n[i] == no_edge) open[T.v[next3[i]]] = open[T.v[prev3[i]]] = 1;
      if (v >= fixed) continue;
      const Vec2 p = mesh.at(v), u = mesh.at(T.v[next3[i]]) - p, w = mesh.at(T.v[prev3[i]]) - p;
      const Metric2 m = mesh.vertices[v].metric();
      angle[v] += static_cast<float>(std::atan2(std::sqrt(std::max(determinant(m), 0.0)) * cross(u, w), dot(m, u, w)));
    }
  for (int v = 0; v < fixed; ++v)
    if (open[v] != 0)
      degrees.wanted[v] = static_cast<std::uint8_t>(std::max(1.0, std::floor(angle[v] / (std::numbers::pi / 3) + 0.5)));
  return degrees;
}

namespace {

// True if the diagonal of c a d b, edge i of t, is to be swapped.
bool wants_swap(const PlaneWork& work, const Degrees& degrees, int t, int i) {
  const Triangle& A = work.mesh.triangles[t];
  const HalfEdge o = A.n[i];
  if (o == no_edge) return false;
  const int c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = work.mesh.triangles[o >> 2].v[o & 3];
  // The sum of squares of the excesses changes by 2 (ec + ed - ea - eb) + 4.
  return degrees.excess(c) + degrees.excess(d) - degrees.excess(a) - degrees.excess(b) + 2 < 0 &&
         (A.imposed >> i & 1) == 0 && work.shapes.quality(c, a, d) > shape_level::poor &&
         work.shapes.quality(c, d, b) > shape_level::poor;
}

// Marks of triangles, as bits.
constexpr std::uint8_t uneven = 1;   // only an edge between two of these may be swapped
constexpr std::uint8_t changed = 2;  // since the pass began: other edges would be rejected again

// Marks the triangles whose edges depend on the degree of v: the triangles around it, and their outer neighbours.
void mark_around(const Triangulation& mesh, int v, std::uint8_t bits, std::vector<std::uint8_t>& marks) {
  const auto mark = [&](int t) { marks[t] = static_cast<std::uint8_t>(marks[t] | bits); };
  for_each_around(mesh, v, [&](int t) {
    mark(t);
    const HalfEdge beyond = mesh.triangles[t].n[mesh.corner_of(t, v)];
    if (beyond != no_edge) mark(beyond >> 2);
  });
}

// A swap needs an excess at an end, or a lack beyond. If the corners of one triangle have neither, it takes a lack of
// three at the fourth vertex.
std::vector<std::uint8_t> mark_uneven(const Triangulation& mesh, const Degrees& degrees) {
  std::vector<std::uint8_t> marks(mesh.triangles.size());
  for (std::size_t t = 0; t < marks.size(); ++t) {
    const std::int32_t* const v = mesh.triangles[t].v;
    const bool even = (degrees.excess(v[0]) | degrees.excess(v[1]) | degrees.excess(v[2])) == 0;
    marks[t] = even ? 0 : uneven;
  }
  for (int v = 0; v < static_cast<int>(mesh.vertices.size()); ++v)
    if (degrees.excess(v) <= -3 && mesh.vertices[v].triangle >= 0) mark_around(mesh, v, uneven, marks);
  return marks;
}

}  // namespace

void swap_to_degree_six(PlaneWork& work, Degrees& degrees) {
  Triangulation& mesh = work.mesh;
  std::vector<std::uint8_t> marks = mark_uneven(mesh, degrees);
  for (int pass = 0; pass < degree_passes; ++pass) {
    const std::uint8_t wanted = pass == 0 ? uneven : uneven | changed;
    const auto calls_for = [&](int t, int u) { return (marks[t] & wanted) == wanted && (marks[u] & uneven) != 0; };
    bool any = false;
    for_calling_edges(mesh, work.monitor, calls_for, [&](int t, int i) {
      const HalfEdge o = mesh.triangles[t].n[i];
      if ((marks[t] & wanted) != wanted || !wants_swap(work, degrees, t, i)) return false;
      const Triangle A = mesh.triangles[t];
      const std::int32_t ends[4] = {A.v[i], A.v[next3[i]], A.v[prev3[i]], mesh.triangles[o >> 2].v[o & 3]};
      mesh.swap_edge(t, i);
      ++degrees.found[ends[0]], --degrees.found[ends[1]], --degrees.found[ends[2]], ++degrees.found[ends[3]];
      for (const std::int32_t v : ends) mark_around(mesh, v, uneven | changed, marks);
      any = true;
      return true;
    });
    if (!any) break;
  }
}

}  // namespace carreau::plane
