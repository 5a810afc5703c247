// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/triangle_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/infinity.h"
#include "support/segment.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

using SearchBox = BoxTree::Box;

SearchBox box_of(const std::array<Vec3, 3>& corners) noexcept {
  SearchBox box;
  for (const Vec3& p : corners) box.add(p);
  return box;
}

double surface_of(const SearchBox& box) noexcept {
  const Vec3 d = box.high - box.low;
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

/// Boxes of a triangle at most, and the surface of a box in areas of its triangle from which on there are several. A
/// triangle of good shape has about six at most [time only].
constexpr int max_boxes = 16;
constexpr double large_box = 12;

/// Slices of equal length along the longest side.
int slices_of(const std::array<Vec3, 3>& c, const SearchBox& box) noexcept {
  const double area = 0.5 * norm(cross(c[1] - c[0], c[2] - c[0]));
  const double ratio = surface_of(box) / large_box;
  if (!(ratio > area)) return 1;
  return ratio < max_boxes * area ? static_cast<int>(std::ceil(ratio / area)) : max_boxes;
}

// Boxes of the slices; widened, since their corners are rounded.
void add_slices(const std::array<Vec3, 3>& corners, int slices, std::vector<SearchBox>& boxes) {
  constexpr double rounding = 1e-14;
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (norm(corners[(i + 1) % 3] - corners[i]) > norm(corners[(longest + 1) % 3] - corners[longest])) longest = i;
  const Vec3 &a = corners[longest], &b = corners[(longest + 1) % 3], &c = corners[(longest + 2) % 3];
  const double top = fraction_on_segment(c, a, b);
  const auto other = [&](double s) -> Vec3 {
    if (s <= top) return top > 0 ? lerp(a, c, s / top) : c;
    return lerp(c, b, (s - top) / (1 - top));
  };
  const Vec3 room = rounding * (a.cwiseAbs() + b.cwiseAbs() + c.cwiseAbs());
  for (int k = 0; k < slices; ++k) {
    const double from = static_cast<double>(k) / slices, to = k + 1 < slices ? (k + 1.0) / slices : 1;
    SearchBox box;
    for (const double s : {from, to}) box.add(lerp(a, b, s)), box.add(other(s));
    if (from <= top && top <= to) box.add(c);
    if (top <= 0 && k == 0) box.add(a);
    box.low -= room, box.high += room;
    boxes.push_back(box);
  }
}

// Between the planes of each pair of sides, widened by rounding.
bool meets(const SearchBox& box, const Vec3& p, const Vec3& q) noexcept {
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

// Sorts and drops repetitions from a rank on.
void each_once(std::vector<std::int32_t>& triangles, std::size_t first) {
  const auto from = triangles.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(from, triangles.end());
  triangles.erase(std::unique(from, triangles.end()), triangles.end());
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
  std::vector<SearchBox> boxes(triangles.size());
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
  std::vector<SearchBox> slices;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const int count = slices_of(corners_[k], boxes[k]);
    if (count == 1 && slices.empty()) continue;
    if (slices.empty()) {
      slices.assign(boxes.begin(), boxes.begin() + static_cast<std::ptrdiff_t>(k));
      for (std::size_t j = 0; j < k; ++j) triangle_.push_back(static_cast<std::int32_t>(j));
    }
    if (count == 1)
      slices.push_back(boxes[k]);
    else
      add_slices(corners_[k], count, slices);
    triangle_.resize(slices.size(), static_cast<std::int32_t>(k));
  }
  if (!triangle_.empty()) {
    boxes = std::move(slices);
    centres.clear();
    for (const SearchBox& box : boxes) centres.emplace_back(0.5 * (box.low + box.high));
  }
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
                        each_of(leaf, [&](std::int32_t t) { look_at(t, p, best); });
                      });
  best.distance = std::sqrt(best.distance);
  return best;
}

void TriangleSearch::beside_segment(Vec3 p, Vec3 q, std::vector<std::int32_t>& triangles) const {
  const std::size_t before = triangles.size();
  tree_.all_that_meet([&](const SearchBox& box) { return meets(box, p, q); },
                      [&](const BoxTree::Node& leaf) {
                        each_of(leaf, [&](std::int32_t t) { triangles.push_back(t); });
                      });
  if (!triangle_.empty()) each_once(triangles, before);
}

void TriangleSearch::beside_box(const Vec3& low, const Vec3& high, std::vector<std::int32_t>& triangles) const {
  const SearchBox asked{low, high};
  const std::size_t before = triangles.size();
  tree_.all_that_meet([&](const SearchBox& box) { return !box.is_apart(asked); },
                      [&](const BoxTree::Node& leaf) {
                        each_of(leaf, [&](std::int32_t t) {
                          if (!box_of(corners_[static_cast<std::size_t>(t)]).is_apart(asked)) triangles.push_back(t);
                        });
                      });
  if (!triangle_.empty()) each_once(triangles, before);
}

double TriangleSearch::longest_edge(std::int32_t triangle) const noexcept {
  const auto& c = corners_[static_cast<std::size_t>(triangle)];
  return std::max({norm(c[1] - c[0]), norm(c[2] - c[1]), norm(c[0] - c[2])});
}

}  // namespace carreau
