// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/triangle_search.h"

#include <algorithm>
#include <cmath>

#include "support/infinity.h"
#include "support/segment.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

using Box = BoxTree::Box;

Box box_of(const std::array<Vec3, 3>& corners) noexcept {
  Box box;
  for (const Vec3& p : corners) box.add(p);
  return box;
}

// Between the planes of each pair of sides, widened by rounding.
bool meets(const Box& box, const Vec3& p, const Vec3& q) noexcept {
  constexpr double rounding = 1e-12;
  double from = 0, to = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = p[axis], d = q[axis] - a;
    const double slack = rounding * (std::abs(a) + std::abs(d));
    const double low = box.low[axis] - slack, high = box.high[axis] + slack;
    if (d == 0) {
      if (a < low || a > high) return false;
      continue;
    }
    const double s = (low - a) / d, t = (high - a) / d;
    from = std::max(from, std::min(s, t));
    to = std::min(to, std::max(s, t));
  }
  return from <= to;
}

/// Weights of the point of a triangle that is nearest to p.
std::array<double, 3> nearest_weights(const Vec3& p, const std::array<Vec3, 3>& corner) noexcept {
  const Vec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double area2 = dot(normal, normal);
  if (area2 > 0) {
    std::array<double, 3> w;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 from = corner[(i + 1) % 3], to = corner[(i + 2) % 3];
      w[i] = dot(cross(to - from, p - from), normal) / area2;
    }
    if (w[0] >= 0 && w[1] >= 0 && w[2] >= 0) {
      const double sum = w[0] + w[1] + w[2];
      return {w[0] / sum, w[1] / sum, w[2] / sum};
    }
  }
  std::array<double, 3> best{1, 0, 0};
  double least = infinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 from = corner[i], to = corner[(i + 1) % 3];
    const double t = fraction_on_segment(p, from, to);
    const Vec3 away = p - lerp(from, to, t);
    if (dot(away, away) >= least) continue;
    least = dot(away, away);
    best = {0, 0, 0};
    best[i] = 1 - t;
    best[(i + 1) % 3] = t;
  }
  return best;
}

}  // namespace

NearestOnMesh nearest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& corners) noexcept {
  const std::array<double, 3> w = nearest_weights(p, corners);
  const Vec3 point = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
  return {-1, w, point, norm(point - p)};
}

TriangleSearch::TriangleSearch(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                               Monitor* monitor, int threads)
    : corners_(triangles.size()) {
  constexpr std::size_t at_once = 16384;
  std::vector<Box> boxes(triangles.size());
  std::vector<Vec3> centres(triangles.size());
  Monitor silent;
  run_each(
      (triangles.size() + at_once - 1) / at_once, false, threads,
      [&](std::size_t part, Monitor&) {
        for (std::size_t k = part * at_once; k < std::min((part + 1) * at_once, triangles.size()); ++k) {
          auto& c = corners_[k];
          for (std::size_t i = 0; i < 3; ++i) c[i] = vertices[static_cast<std::size_t>(triangles[k][i])];
          boxes[k] = box_of(c);
          centres[k] = (1.0 / 3) * (c[0] + c[1] + c[2]);
        }
      },
      monitor != nullptr ? *monitor : silent);
  tree_ = BoxTree(boxes, centres, monitor, threads);
}

/// `distance` of best is squared here.
void TriangleSearch::look_at(std::int32_t triangle, Vec3 p, NearestOnMesh& best) const noexcept {
  const auto& c = corners_[static_cast<std::size_t>(triangle)];
  // The triangle's box costs less than the triangle.
  const auto beyond = [](double x, double a, double b, double d) {
    return std::max({std::min({a, b, d}) - x, x - std::max({a, b, d}), 0.0});
  };
  const double x = beyond(p.x(), c[0].x(), c[1].x(), c[2].x()), y = beyond(p.y(), c[0].y(), c[1].y(), c[2].y()),
               z = beyond(p.z(), c[0].z(), c[1].z(), c[2].z());
  if (x * x + y * y + z * z > best.distance) return;
  const std::array<double, 3> w = nearest_weights(p, c);
  const Vec3 point = w[0] * c[0] + w[1] * c[1] + w[2] * c[2];
  const double squared = dot(point - p, point - p);
  if (squared > best.distance || (squared == best.distance && triangle >= best.triangle)) return;
  best = {triangle, w, point, squared};
}

NearestOnMesh TriangleSearch::nearest(const Vec3& p, std::int32_t guess) const noexcept {
  NearestOnMesh best;
  look_at(guess >= 0 && static_cast<std::size_t>(guess) < corners_.size() ? guess : 0, p, best);
  tree_.nearest_first([&](std::int32_t n) { return tree_.node(static_cast<std::size_t>(n)).box.squared_distance(p); },
                      [&](double squared) { return !(squared > best.distance); },
                      [&](const BoxTree::Node& leaf) {
                        for (const std::int32_t t : tree_.things(leaf)) look_at(t, p, best);
                      });
  best.distance = std::sqrt(best.distance);
  return best;
}

void TriangleSearch::beside_segment(Vec3 p, Vec3 q, std::vector<std::int32_t>& triangles) const {
  tree_.all_that_meet([&](const Box& box) { return meets(box, p, q); },
                      [&](const BoxTree::Node& leaf) {
                        const auto things = tree_.things(leaf);
                        triangles.insert(triangles.end(), things.begin(), things.end());
                      });
}

void TriangleSearch::beside_box(const Vec3& low, const Vec3& high, std::vector<std::int32_t>& triangles) const {
  const Box asked{low, high};
  tree_.all_that_meet([&](const Box& box) { return !box.is_apart(asked); },
                      [&](const BoxTree::Node& leaf) {
                        for (const std::int32_t t : tree_.things(leaf))
                          if (!box_of(corners_[static_cast<std::size_t>(t)]).is_apart(asked)) triangles.push_back(t);
                      });
}

double TriangleSearch::longest_edge(std::int32_t triangle) const noexcept {
  const auto& c = corners_[static_cast<std::size_t>(triangle)];
  return std::max({norm(c[1] - c[0]), norm(c[2] - c[1]), norm(c[0] - c[2])});
}

}  // namespace carreau
