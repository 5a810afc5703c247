// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/find_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "periodic/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::periodic;

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 sum(0, 0, 0);
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

Vec3 unit_of(const Vec3& v) { return v / norm(v); }

/// Rows of an orthonormal frame: along p - o, then towards q in their plane, then across.
std::array<Vec3, 3> frame_of(const Vec3& o, const Vec3& p, const Vec3& q) {
  const Vec3 x = unit_of(p - o);
  const Vec3 z = unit_of(cross(x, q - o));
  return {x, cross(z, x), z};
}

// Carries the frame at `o` to the frame at `to`; `side` -1 turns the third axis.
Isometry between(const std::array<Vec3, 3>& from, const Vec3& o, const std::array<Vec3, 3>& to, const Vec3& image, double side) {
  Isometry map;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      map.row[i][k] = to[0][i] * from[0][k] + to[1][i] * from[1][k] + side * to[2][i] * from[2][k];
  map.shift = image - map.turn(o);
  return map;
}

// Three points of the list that span a large triangle.
std::array<std::size_t, 3> far_apart(const std::vector<Vec3>& points) {
  std::array<std::size_t, 3> chosen{0, 0, 0};
  double most = -1;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = i + 1; k < points.size(); ++k)
      if (const double d = norm(points[k] - points[i]); d > most) most = d, chosen[0] = i, chosen[1] = k;
  most = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double area = norm(cross(points[chosen[1]] - points[chosen[0]], points[i] - points[chosen[0]]));
    if (area > most) most = area, chosen[2] = i;
  }
  return chosen;
}

double trace_of(const Isometry& map) { return map.row[0][0] + map.row[1][1] + map.row[2][2]; }

// All maps that carry the three points to points of `to`; without a third point off the line of two there is none.
std::vector<Isometry> candidates(const std::vector<Vec3>& from, const std::vector<Vec3>& to, double gap) {
  std::vector<Isometry> maps;
  const auto [a, b, c] = far_apart(from);
  const Vec3 o = from[a], p = from[b], q = from[c];
  const double op = norm(p - o), oq = norm(q - o), pq = norm(q - p);
  if (!(norm(cross(p - o, q - o)) > gap * op)) return maps;
  const std::array<Vec3, 3> frame = frame_of(o, p, q);
  const auto far_from = [gap](double x, double y) { return std::abs(x - y) > 2 * gap; };
  for (const Vec3& image : to)
    for (const Vec3& second : to) {
      if (far_from(norm(second - image), op)) continue;
      for (const Vec3& third : to) {
        if (far_from(norm(third - image), oq) || far_from(norm(third - second), pq)) continue;
        const std::array<Vec3, 3> there = frame_of(image, second, third);
        for (const double side : {1., -1.}) maps.push_back(between(frame, o, there, image, side));
      }
    }
  std::stable_sort(maps.begin(), maps.end(), [](const Isometry& x, const Isometry& y) {
    if (x.reflects() != y.reflects()) return y.reflects();
    return trace_of(x) > trace_of(y);
  });
  return maps;
}

}  // namespace

std::optional<Isometry> find_map(const std::vector<Vec3>& from, const std::vector<Vec3>& to, double gap,
                                 const std::function<bool(const Isometry&)>& accepted) {
  if (from.empty() || to.empty()) return {};
  Isometry translation;
  translation.shift = mean_of(to) - mean_of(from);
  if (accepted(translation)) return translation;
  // All triples of corners of larger faces would take too long. [time only]
  if (from.size() > 24 || to.size() != from.size()) return {};
  for (const Isometry& map : candidates(from, to, gap))
    if (accepted(map)) return map;
  return {};
}

}  // namespace carreau
