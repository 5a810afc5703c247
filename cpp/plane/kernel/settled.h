// SPDX-License-Identifier: BSD-3-Clause
// Triangles that one test shows to be settled: passes over edges and triangles would leave them as they are. Nearly all
// triangles of a large mesh are settled. Private to plane.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "plane/kernel/plane_work.h"
#include "plane/kernel/thresholds.h"
#include "support/rounding_of.h"
#include "support/work_sizes.h"

namespace carreau::plane {

/// By triangle. An edge between two acute triangles is Delaunay in the mean metric of the four vertices. A good triangle
/// needs no repair, a fine one no local search.
struct Settled {
  static constexpr std::uint8_t acute = 1, good = 2, fine = 4;
  std::vector<std::uint8_t> of;

  [[nodiscard]] bool are_acute(int t, int u) const noexcept { return (of[t] & of[u] & acute) != 0; }
  [[nodiscard]] bool is_good(int t) const noexcept { return (of[t] & good) != 0; }
  [[nodiscard]] bool is_fine(int t) const noexcept { return (of[t] & fine) != 0; }
  void forget(int t) noexcept { of[t] = 0; }
  /// These, of `total` that there are now.
  void forget(std::span<const std::int32_t> triangles, std::size_t total) {
    of.resize(total, 0);
    for (const std::int32_t t : triangles) of[t] = 0;
  }
};

/// If the metrics M of the corners differ by at most alike_share of the least eigenvalue of their mean N, in spectral
/// norm, the metric of the fourth vertex beyond an edge of two such triangles differs from N by at most 2.5 times as
/// much. The mean of the four differs by at most an eighth of N: angles of cosine .2 remain acute. Squared
/// lengths in the mean of two corners are at least 1 - alike_share of the squared lengths in N.
inline std::uint8_t settled_state(const Vertex& P, const Vertex& Q, const Vertex& R) noexcept {
  // Two by two: of lists a compiler makes loops.
  const auto least = [](auto x, auto y, auto z) { return std::min(std::min(x, y), z); };
  const auto largest = [](auto x, auto y, auto z) { return std::max(std::max(x, y), z); };
  const float ra = largest(P.a, Q.a, R.a) - least(P.a, Q.a, R.a), rb = largest(P.b, Q.b, R.b) - least(P.b, Q.b, R.b),
              rc = largest(P.c, Q.c, R.c) - least(P.c, Q.c, R.c);
  const Metric2 m = P.metric() + Q.metric() + R.metric();
  const double det = determinant(m);
  // Eigenvalues of a tensor are at least its determinant over its trace.
  if (!(3 * static_cast<double>(std::max(ra, rc) + rb) * (m.a + m.c) <= alike_share * det)) return 0;
  const Vec2 u = Q.point() - P.point(), v = R.point() - P.point();
  const double uu = squared_length(m, u), vv = squared_length(m, v), uv = dot(m, u, v), ww = uu + vv - 2 * uv;
  const double longest2 = largest(uu, vv, ww), shortest2 = least(uu, vv, ww), sum = uu + vv + ww;
  // Cosine of the largest angle of a triangle whose edges need no test: more than the 0.125 that metrics may err by. [time only]
  const bool acute = cross(u, v) > 0 && least(uv, uu - uv, vv - uv) >= 0.2 * longest2;
  const double area2 = 12 * (uu * vv - uv * uv), sum2 = sum * sum;
  // Longer than crowded edges in the mean of any two similar metrics, and better than doubtful triangles, beyond rounding.
  const double uncrowded2 = (1 + rounding_of::sizes) * crowded_length2 / (1 - alike_share);
  const double sound = (1 + rounding_of::sizes) * doubtful_quality;
  const bool good = shortest2 > 3 * uncrowded2 && area2 > sound * sound * sum2;
  // If the metrics of its corners are similar, a triangle of this Q2 in their mean is no worse than searched_quality in the metric of its
  // middle. [0.9: all of 63 meshes stay; time only]
  const bool fine = area2 > 0.93 * 0.93 * sum2;
  if (!acute) return 0;
  return static_cast<std::uint8_t>(Settled::acute | (good ? Settled::good : 0) | (fine ? Settled::fine : 0));
}

/// In a field that bends no triangle is known to be settled.
inline void find_settled(const PlaneWork& work, Settled& settled) {
  const Triangulation& mesh = work.mesh;
  const std::size_t n = mesh.triangles.size();
  settled.of.assign(n, 0);
  if (!mesh.bends.empty()) return;
  for (std::size_t t = 0; t < n; ++t) {
    if (t % work_sizes::steps == 0) work.monitor.checkpoint();
    const Triangle& T = mesh.triangles[t];
    for (const std::int32_t v : mesh.triangles[std::min(t + work_sizes::prefetched, n - 1)].v) prefetch(&mesh.vertices[v]);
    settled.of[t] = settled_state(mesh.vertices[T.v[0]], mesh.vertices[T.v[1]], mesh.vertices[T.v[2]]);
  }
}

}  // namespace carreau::plane
