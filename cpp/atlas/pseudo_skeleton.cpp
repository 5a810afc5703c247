// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/pseudo_skeleton.h"

#include <algorithm>

#include "predicates/predicates.h"

namespace carreau::atlas {
namespace {

bool in_triangle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
  return orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
}

/// Cosine of the smallest angle, negated: larger is better.
double roundness(const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto cosine = [](const Vec2& at, const Vec2& p, const Vec2& q) {
    return dot(p - at, q - at) / (norm(p - at) * norm(q - at));
  };
  return -std::max({cosine(a, b, c), cosine(b, c, a), cosine(c, a, b)});
}

/// An ear that can be cut from the remaining vertices.
bool is_ear(const Polygon& polygon, const std::vector<std::size_t>& left, std::size_t k) {
  const std::size_t n = left.size();
  const std::size_t before = left[previous_of(k, n)], tip = left[k], after = left[next_of(k, n)];
  const Vec2 &a = polygon[before], &b = polygon[tip], &c = polygon[after];
  if (orientation(a, b, c) <= 0) return false;
  return std::none_of(left.begin(), left.end(), [&](std::size_t v) {
    return v != before && v != tip && v != after && in_triangle(a, b, c, polygon[v]);
  });
}

Vec2 barycentre(const Polygon& p, const std::array<std::size_t, 3>& t) { return (p[t[0]] + p[t[1]] + p[t[2]]) / 3; }

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulate(const Polygon& polygon) {
  std::vector<std::size_t> left(polygon.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  std::vector<std::array<std::size_t, 3>> triangles;
  constexpr double unknown = 2, no_ear = -2;  // outside of the range of roundness
  std::vector<double> score(left.size(), unknown);
  while (left.size() >= 3) {
    const std::size_t n = left.size();
    std::size_t best = n;
    for (std::size_t k = 0; k < n; ++k) {
      if (score[k] == unknown)
        score[k] = is_ear(polygon, left, k)
                       ? roundness(polygon[left[previous_of(k, n)]], polygon[left[k]], polygon[left[next_of(k, n)]])
                       : no_ear;
      if (score[k] != no_ear && (best == n || score[k] > score[best])) best = k;
    }
    if (best == n) break;  // the remaining polygon has no area
    triangles.push_back({left[previous_of(best, n)], left[best], left[next_of(best, n)]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    score.erase(score.begin() + static_cast<std::ptrdiff_t>(best));
    if (left.size() < 3) break;
    // A vertex that was no ear may have become one: its triangle may contain one vertex less.
    for (double& s : score)
      if (s == no_ear) s = unknown;
    score[best % score.size()] = score[previous_of(best % score.size(), score.size())] = unknown;
  }
  return triangles;
}

PseudoSkeleton pseudo_skeleton(const Polygon& polygon) {
  PseudoSkeleton skeleton;
  skeleton.triangles = triangulate(polygon);
  const std::size_t n = polygon.size();
  skeleton.facing.assign(n, Vec2(0, 0));
  for (const auto& t : skeleton.triangles) {
    std::vector<std::size_t> diagonals;  // by their first corner
    for (std::size_t k = 0; k < 3; ++k)
      if (next_of(t[k], n) != t[(k + 1) % 3]) diagonals.push_back(k);
    const auto middle = [&](std::size_t k) -> Vec2 { return (polygon[t[k]] + polygon[t[(k + 1) % 3]]) / 2; };
    const Vec2 centre = barycentre(polygon, t);
    if (diagonals.size() == 1) {
      skeleton.edges.emplace_back(middle(diagonals[0]), centre);
      skeleton.ears.push_back(t[(diagonals[0] + 2) % 3]);
    }
    for (std::size_t k = 0; k + 1 < diagonals.size(); ++k)
      for (std::size_t l = k + 1; l < diagonals.size(); ++l)
        skeleton.edges.emplace_back(middle(diagonals[k]), middle(diagonals[l]));
    for (std::size_t k = 0; k < 3; ++k)
      if (next_of(t[k], n) == t[(k + 1) % 3])
        skeleton.facing[t[k]] =
            diagonals.size() == 2 ? Vec2((middle(diagonals[0]) + middle(diagonals[1])) / 2) : centre;
  }
  std::sort(skeleton.ears.begin(), skeleton.ears.end());
  return skeleton;
}

}  // namespace carreau::atlas
