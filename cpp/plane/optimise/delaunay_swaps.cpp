// SPDX-License-Identifier: BSD-3-Clause
#include "plane/optimise/delaunay_swaps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "metric/field_length.h"
#include "plane/kernel/metric_delaunay.h"
#include "plane/kernel/thresholds.h"
#include "plane/optimise/inner_edges.h"
#include "support/rounding_of.h"
#include "support/work_sizes.h"

namespace carreau::plane {

namespace {

// Opposite angles, at c and d, that sum to more than pi: their sines are areas over lengths.
bool sum_exceeds_pi(double dot_c, double area_c, double dot_d, double area_d) noexcept {
  const double s = dot_c * area_d + dot_d * area_c, scale = std::abs(dot_c) * area_d + std::abs(dot_d) * area_c;
  return s < -rounding_of::places * scale;
}

// Uses Simpson's rule: on an edge of several units sizes may change manifold, for example beside a waist.
double squared_length_along(const PlaneWork& work, int u, int v) {
  const Vertex &U = work.mesh.vertices[u], &V = work.mesh.vertices[v];
  const Vec2 d = V.point() - U.point();
  const double sum =
      length(U.metric(), d) + 4 * length(work.field.at(0.5 * (U.point() + V.point())), d) + length(V.metric(), d);
  return sum * sum / 36;
}

// Cosines by the lengths of the edges. Long edges are swapped if that makes them shorter: over more than about two
// units straight lines are inaccurate.
bool wants_bent_swap(const PlaneWork& work, int a, int b, int c, int d) {
  const Shapes& shapes = work.shapes;
  const double ab = shapes.squared_length(a, b);
  if (ab > longest_bent2)
    return squared_length_along(work, c, d) < squared_length_along(work, a, b) * (1 - rounding_of::places);
  const Lengths abc{shapes.squared_length(b, c), shapes.squared_length(c, a), ab},
      abd{shapes.squared_length(b, d), shapes.squared_length(d, a), ab};
  return sum_exceeds_pi(abc.a + abc.b - ab, std::sqrt(abc.area2()), abd.a + abd.b - ab, std::sqrt(abd.area2()));
}

// Delaunay in the mean metric of the four vertices, or by lengths if the field bends.
bool wants_swap(const PlaneWork& work, int t, int i) {
  const Triangulation& mesh = work.mesh;
  const Triangle& A = mesh.triangles[t];
  const HalfEdge o = A.n[i];
  if (o == no_edge || (A.imposed >> i & 1) != 0) return false;
  const Triangle& B = mesh.triangles[o >> 2];
  const Vertex &c = mesh.vertices[A.v[i]], &a = mesh.vertices[A.v[next3[i]]], &b = mesh.vertices[A.v[prev3[i]]],
               &d = mesh.vertices[B.v[o & 3]];
  if (work.shapes.is_bent(A) || work.shapes.is_bent(B))
    return wants_bent_swap(work, A.v[next3[i]], A.v[prev3[i]], A.v[i], B.v[o & 3]) && mesh.can_swap(t, i);
  const Metric2 m = a.metric() + b.metric() + c.metric() + d.metric();
  const Vec2 ca = a.point() - c.point(), cb = b.point() - c.point(), da = a.point() - d.point(),
             db = b.point() - d.point();
  return sum_exceeds_pi(dot(m, ca, cb), cross(ca, cb), dot(m, da, db), cross(db, da)) && mesh.can_swap(t, i);
}

// Beside a fine border sizes may be longer than the width of a strip: long edges there are shorter than three units.
bool has_long_edge(const Triangulation& mesh, const Triangle& T) {
  double shortest2 = 1, longest2 = 0;
  for (int i = 0; i < 3; ++i) {
    const double l2 = mesh.squared_length(T.v[i], T.v[next3[i]]);
    shortest2 = std::min(shortest2, l2), longest2 = std::max(longest2, l2);
  }
  return longest2 > long_edge2 * shortest2;
}

// If hundreds of edges lean over dozens of units, the gain of one swap is less than the difference of neighbouring
// metrics, and angles in these do not determine the better diagonal. Lengths measured along the diagonals do. Their sum
// falls, so that there is an end. Starts with the triangles listed, and adds changed triangles.
void shorten_long_edges(PlaneWork& work, std::vector<std::int32_t>& triangles) {
  Triangulation& mesh = work.mesh;
  const auto length_along = [&](int p, int q) {
    return field_length([&](Vec2 at) { return work.field.at(at); }, mesh.at(p), mesh.at(q));
  };
  std::vector<HalfEdge> open;
  for (const std::int32_t t : triangles)
    for (int i = 0; i < 3; ++i) open.push_back(4 * t + i);
  const std::size_t listed = triangles.size();
  long measured = 0;
  while (!open.empty()) {
    const int t = open.back() >> 2, i = open.back() & 3;
    open.pop_back();
    const Triangle& A = mesh.triangles[t];
    if (A.n[i] == no_edge || mesh.is_imposed(t, i)) continue;
    const int u = A.n[i] >> 2, c = A.v[i], a = A.v[next3[i]], b = A.v[prev3[i]], d = mesh.triangles[u].v[A.n[i] & 3];
    if (!(mesh.squared_length(a, b) > long_edge2) || !mesh.can_swap(t, i)) continue;
    if (++measured % work_sizes::evaluations == 0) work.monitor.checkpoint();
    if (!(length_along(c, d) < (1 - rounding_of::places) * length_along(a, b))) continue;
    mesh.swap_edge(t, i);
    triangles.insert(triangles.end(), {t, u});
    open.insert(open.end(), {4 * t, 4 * t + 2, 4 * u, 4 * u + 1});
  }
  if (triangles.size() == listed) return;
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
}

}  // namespace

// In the frame the triangles of a strip lean, or are a few fans.
bool has_leaning_strips(const PlaneWork& work) {
  const Triangulation& mesh = work.mesh;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const Triangle& T = mesh.triangles[t];
    if (T.v[0] < 0) continue;
    const std::array<double, 3> sides{mesh.squared_length(T.v[1], T.v[2]), mesh.squared_length(T.v[2], T.v[0]), mesh.squared_length(T.v[0], T.v[1])};
    const double longest2 = std::max({sides[0], sides[1], sides[2]});
    if (!(longest2 > leaning_edge2) || Lengths{sides[0], sides[1], sides[2]}.area2() > 4 * sliver_height2 * longest2) continue;
    for (int i = 0; i < 3; ++i)
      if (sides[static_cast<std::size_t>(i)] > leaning_edge2 && wants_swap(work, t, i)) return true;
  }
  return false;
}

Settled swap_to_delaunay(PlaneWork& work) {
  Triangulation& mesh = work.mesh;
  Settled settled;
  find_settled(work, settled);
  std::vector<std::int32_t> changed, next;
  const auto swap = [&](int t, int i, std::vector<std::int32_t>& both) {
    const int u = mesh.triangles[t].n[i] >> 2;
    both.push_back(t), both.push_back(u);
    settled.forget(t), settled.forget(u);
    mesh.swap_edge(t, i);
  };
  for_calling_edges(
      mesh, work.monitor, [&](int t, int u) { return !settled.are_acute(t, u); },
      [&](int t, int i) {
        const HalfEdge o = mesh.triangles[t].n[i];
        if (o == no_edge || settled.are_acute(t, o >> 2) || !wants_swap(work, t, i)) return false;
        swap(t, i, changed);
        return true;
      });
  // A bounded number of passes: in a metric that varies swaps can run in circles. Then both triangles of each
  // swap come back, and the list doubles with each pass.
  const std::size_t most = 2 * mesh.triangles.size();
  for (int pass = 0; pass < delaunay_passes && !changed.empty() && changed.size() <= most; ++pass) {
    work.monitor.checkpoint();
    next.clear();
    for (const std::int32_t t : changed)
      for (int i = 0; i < 3; ++i) {
        if (!wants_swap(work, t, i)) continue;
        swap(t, i, next);
        break;
      }
    changed.swap(next);
  }
  // The two sides of a long strip that are fans of hundreds of triangles in the frame take as many passes.
  // If no edge is long, swaps run in circles between equally good triangles.
  if (!mesh.bends.empty()) return settled;
  std::erase_if(changed, [&](std::int32_t t) { return !has_long_edge(mesh, mesh.triangles[t]); });
  if (changed.empty()) return settled;
  shorten_long_edges(work, changed);
  make_delaunay_in_metric(mesh, changed, work.monitor);
  settled.of.assign(mesh.triangles.size(), 0);
  return settled;
}

}  // namespace carreau::plane
