// SPDX-License-Identifier: BSD-3-Clause
#include "plane/kernel/metric_delaunay.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "plane/kernel/thresholds.h"
#include "support/rounding_of.h"
#include "support/work_sizes.h"

namespace carreau::plane {

namespace {

// The largest cotangent of an angle: the smallest angle lies between the two longest sides.
double sharpness(const Triangulation& mesh, int p, int q, int r) noexcept {
  const Vertex &P = mesh.vertices[p], &Q = mesh.vertices[q], &R = mesh.vertices[r];
  const Metric2 m = P.metric() + Q.metric() + R.metric();
  const Vec2 pq = Q.point() - P.point(), qr = R.point() - Q.point(), rp = P.point() - R.point();
  const double at_p = -dot(m, pq, rp), at_q = -dot(m, qr, pq), at_r = -dot(m, rp, qr);
  return std::max({at_p, at_q, at_r}) / (std::sqrt(std::max(determinant(m), 1e-300)) * cross(pq, -1.0 * rp));
}

bool wants_swap(const Triangulation& mesh, int t, int i) noexcept {
  const Triangle& A = mesh.triangles[t];
  if (A.n[i] == no_edge || mesh.is_imposed(t, i)) return false;
  const int c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = mesh.triangles[A.n[i] >> 2].v[A.n[i] & 3];
  if (!mesh.can_swap(t, i)) return false;
  const double now = std::max(sharpness(mesh, c, a, b), sharpness(mesh, d, b, a));
  const double then = std::max(sharpness(mesh, c, a, d), sharpness(mesh, c, d, b));
  return then * (1 + rounding_of::places) < now;
}

}  // namespace

void make_delaunay_in_metric(Triangulation& mesh, std::span<const std::int32_t> start, Monitor& monitor) {
  std::vector<HalfEdge> open;
  for (const std::int32_t t : start)
    for (int i = 0; i < 3; ++i) open.push_back(4 * t + i);
  long swaps = 0;
  while (!open.empty()) {
    const HalfEdge he = open.back();
    open.pop_back();
    const int t = he >> 2, i = he & 3;
    if (!wants_swap(mesh, t, i)) continue;
    if (++swaps % work_sizes::searches == 0) monitor.checkpoint();
    const int u = mesh.triangles[t].n[i] >> 2;
    mesh.swap_edge(t, i);
    for (const HalfEdge outer : {4 * t, 4 * t + 2, 4 * u, 4 * u + 1}) open.push_back(outer);
  }
}

}  // namespace carreau::plane
