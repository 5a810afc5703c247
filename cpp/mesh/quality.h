// SPDX-License-Identifier: BSD-3-Clause
// Shape and size measures.
#pragma once

#include <cstddef>
#include <numbers>
#include <span>

#include "mesh/flat_mesh.h"
#include "mesh/triangle_lists.h"

namespace carreau {

/// 2 sqrt(3) inradius / longest edge (HDR eq. 1.5); 1 for an equilateral triangle, 0 for a flat one.
double quality_q1(const Vec3& a, const Vec3& b, const Vec3& c) noexcept;
/// 4 sqrt(3) area / sum of squared edges (HDR eq. 1.6); 0 if all corners are one. Inline: searches call it a hundred
/// times a vertex.
inline double quality_q2(const Vec3& a, const Vec3& b, const Vec3& c, double twice_area) noexcept {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double squares = dot(ab, ab) + dot(bc, bc) + dot(ca, ca);
  return squares > 0 ? 2 * std::numbers::sqrt3 * twice_area / squares : 0;
}
inline double quality_q2(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  return quality_q2(a, b, c, norm(cross(b - a, c - a)));
}
/// A triangle of no more than this Q2 has no area: it is a flat one with rounding errors.
inline constexpr double flat_quality = 1e-12;

struct Distribution {
  double mean = 0, min = 0, p1 = 0, max = 0;  ///< p1: first percentile
};

/// The distribution of any list, which it reorders; zeros when empty.
Distribution distribution_of(std::span<double> values);

struct QualitySummary {
  std::size_t vertices = 0, triangles = 0, edges = 0, open_edges = 0;
  Distribution q1, q2;
  double angle_min_deg = 0, angle_max_deg = 0, area = 0;
  double edge_min = 0, edge_mean = 0, edge_max = 0;
  double side_sum = 0;  ///< of the lengths of all sides of triangles
  double degree6 = 0;  ///< share of interior vertices of degree 6
};
QualitySummary summarise_quality(const FlatMesh& mesh, int threads = 1);
/// Summarises triangles without a copy. No figure depends on the number of threads.
QualitySummary summarise_quality(const TriangleLists& mesh, int threads);
/// Its two parts: the figures that need no edges, and the figures of edges, added to the first.
QualitySummary summarise_shapes(const TriangleLists& mesh, int threads);
inline QualitySummary summarise_shapes(const FlatMesh& mesh, int threads) {
  return summarise_shapes(TriangleLists(mesh), threads);
}
void summarise_edges(const TriangleLists& mesh, int threads, QualitySummary& summary);

}  // namespace carreau
