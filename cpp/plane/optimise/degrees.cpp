// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/degrees.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plane/optimise/inner_edges.h"
#include "plane/thresholds.h"

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

void swap_to_degree_six(PlaneWork& work, Degrees& degrees) {
  Triangulation& mesh = work.mesh;
  for (int pass = 0; pass < degree_passes; ++pass) {
    bool any = false;
    for_inner_edges(mesh, work.monitor, [&](int t, int i) {
      const Triangle& A = mesh.triangles[t];
      const HalfEdge o = A.n[i];
      if (o == no_edge) return;
      const int c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = mesh.triangles[o >> 2].v[o & 3];
      // The sum of squares of the excesses changes by 2 (ec + ed - ea - eb) + 4.
      if (degrees.excess(c) + degrees.excess(d) - degrees.excess(a) - degrees.excess(b) + 2 >= 0 ||
          (A.imposed >> i & 1) != 0)
        return;
      if (work.shapes.quality(c, a, d) <= degree_swap_quality || work.shapes.quality(c, d, b) <= degree_swap_quality)
        return;
      mesh.swap_edge(t, i);
      --degrees.found[a], --degrees.found[b], ++degrees.found[c], ++degrees.found[d];
      any = true;
    });
    if (!any) break;
  }
}

}  // namespace carreau::plane
