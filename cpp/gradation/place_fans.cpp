// SPDX-License-Identifier: BSD-3-Clause
#include "gradation/place_fans.h"

#include <cmath>
#include <cstddef>

#include "gradation/thresholds.h"
#include "support/angles.h"

namespace carreau::detail {

using namespace thresholds::gradation;

Vec3 roll(const Vec3& v, const Vec3& n, const Vec3& m) noexcept { return v - (dot(v, m) / (1 + dot(n, m))) * (n + m); }

PlaceFans::PlaceFans(const GradationGraph& graph)
    : graph_(graph), first_(graph.xyz.size(), -1), next_(graph.places.size(), -1), inward_(graph.places.size()) {
  for (std::size_t p = graph.places.size(); p-- > 0;) {
    const int v = graph.places[p].vertex;
    next_[p] = first_[v];
    first_[v] = static_cast<int>(p);
  }
  for (const auto& t : graph.triangles)
    for (int i = 0; i < 3; ++i)
      for (int k = 1; k < 3; ++k) {
        const Vec3 e = graph.xyz[graph.places[t[(i + k) % 3]].vertex] - graph.xyz[graph.places[t[i]].vertex];
        const double l = norm(e);
        if (l > 0) inward_[t[i]] = inward_[t[i]] + (1 / l) * e;
      }
  start_.assign(graph.places.size() + 1, 0);
  for (const auto& t : graph.triangles)
    for (const int p : t) ++start_[p + 1];
  for (std::size_t p = 0; p < graph.places.size(); ++p) start_[p + 1] += start_[p];
  others_.resize(3 * graph.triangles.size());
  std::vector<int> fill(start_.begin(), start_.end() - 1);
  for (const auto& t : graph.triangles)
    for (int i = 0; i < 3; ++i) others_[fill[t[i]]++] = {t[(i + 1) % 3], t[(i + 2) % 3]};
}

bool PlaceFans::carry(int from, int to, Vec3& v) const noexcept {
  if (from == to || dot(v, v) == 0) return true;
  if (from < 0) return false;
  const Vec3 n = graph_.places[from].normal, m = graph_.places[to].normal;
  const int second = next_[first_[graph_.places[to].vertex]];
  const bool two = second >= 0 && next_[second] < 0;
  if (!two) {
    if (std::abs(dot(n, m)) < angles::cosine_of_26) return false;
    v = roll(v, n, dot(n, m) < 0 ? -1 * m : m);
    return true;
  }
  // Unfolded, the two sides lie on opposite sides of the curve.
  const Vec3 inside = inward_[from] - dot(inward_[from], n) * n, into = inward_[to];
  for (const double side : {1., -1.}) {
    const Vec3 k = side * m;
    if (dot(n, k) < min_unfolded || dot(roll(inside, n, k), into) >= 0) continue;
    v = roll(v, n, k);
    return true;
  }
  return false;
}

}  // namespace carreau::detail
