#include "mesh/triangle_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "support/infinity.h"
#include "support/segment.h"

namespace carreau {

namespace {

constexpr std::int32_t leaf_size = 4;
constexpr std::int64_t moved_between_checks = 1 << 16;

double& coordinate(Vec3& p, int axis) noexcept { return axis == 0 ? p.x() : axis == 1 ? p.y() : p.z(); }
double coordinate(const Vec3& p, int axis) noexcept { return axis == 0 ? p.x() : axis == 1 ? p.y() : p.z(); }

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

struct TriangleSearch::Builder {
  TriangleSearch& tree;
  std::vector<Vec3> centre;

  void enclose(Box& box) const {
    box.low = {infinity, infinity, infinity};
    box.high = {-infinity, -infinity, -infinity};
    for (std::int32_t k = box.first; k < box.first + box.count; ++k)
      for (const Vec3& p : tree.corners_[static_cast<std::size_t>(tree.order_[static_cast<std::size_t>(k)])])
        for (int axis = 0; axis < 3; ++axis) {
          coordinate(box.low, axis) = std::min(coordinate(box.low, axis), coordinate(p, axis));
          coordinate(box.high, axis) = std::max(coordinate(box.high, axis), coordinate(p, axis));
        }
  }

  /// Halves a leaf at the median of the centres along the longest side of its box.
  void split(std::size_t b) {
    const Box box = tree.boxes_[b];
    const Vec3 size = box.high - box.low;
    const int axis = size.x() >= size.y() && size.x() >= size.z() ? 0 : size.y() >= size.z() ? 1 : 2;
    const auto begin = tree.order_.begin() + box.first;
    const std::int32_t half = box.count / 2;
    std::nth_element(begin, begin + half, begin + box.count, [&](std::int32_t s, std::int32_t t) {
      const double x = coordinate(centre[static_cast<std::size_t>(s)], axis);
      const double y = coordinate(centre[static_cast<std::size_t>(t)], axis);
      return x != y ? x < y : s < t;
    });
    Box left, right;
    left.first = box.first, left.count = half;
    right.first = box.first + half, right.count = box.count - half;
    enclose(left);
    enclose(right);
    tree.boxes_[b].first = static_cast<std::int32_t>(tree.boxes_.size());
    tree.boxes_[b].count = 0;
    tree.boxes_.push_back(left);
    tree.boxes_.push_back(right);
  }
};

TriangleSearch::TriangleSearch(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                               Monitor* monitor) {
  if (triangles.empty()) return;
  Builder builder{*this, {}};
  for (const auto& t : triangles) {
    corners_.push_back({vertices[static_cast<std::size_t>(t[0])], vertices[static_cast<std::size_t>(t[1])],
                        vertices[static_cast<std::size_t>(t[2])]});
    const auto& c = corners_.back();
    builder.centre.push_back((1.0 / 3) * (c[0] + c[1] + c[2]));
  }
  order_.resize(corners_.size());
  std::iota(order_.begin(), order_.end(), 0);
  Box root;
  root.count = static_cast<std::int32_t>(order_.size());
  builder.enclose(root);
  boxes_.push_back(root);
  std::int64_t moved = 0, checked = 0;
  for (std::size_t b = 0; b < boxes_.size(); ++b) {
    if (monitor != nullptr && moved > checked) {
      monitor->checkpoint();
      checked = moved + moved_between_checks;
    }
    moved += boxes_[b].count;
    if (boxes_[b].count > leaf_size) builder.split(b);
  }
}

double TriangleSearch::squared_distance(const Box& box, const Vec3& p) noexcept {
  const auto beyond = [](double low, double x, double high) { return std::max({low - x, x - high, 0.0}); };
  const double x = beyond(box.low.x(), p.x(), box.high.x()), y = beyond(box.low.y(), p.y(), box.high.y()),
               z = beyond(box.low.z(), p.z(), box.high.z());
  return x * x + y * y + z * z;
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
  // The depth is the logarithm of the number of triangles: 64 pairs are more than memory can hold.
  struct Todo {
    std::int32_t box;
    double squared;
  };
  std::array<Todo, 128> todo;
  std::size_t size = 0;
  todo[size++] = {0, squared_distance(boxes_[0], p)};
  while (size > 0) {
    const Todo next = todo[--size];
    if (next.squared > best.distance) continue;
    const Box& box = boxes_[static_cast<std::size_t>(next.box)];
    if (box.count > 0) {
      for (std::int32_t k = 0; k < box.count; ++k) look_at(order_[static_cast<std::size_t>(box.first + k)], p, best);
      continue;
    }
    Todo near{box.first, squared_distance(boxes_[static_cast<std::size_t>(box.first)], p)};
    Todo far{box.first + 1, squared_distance(boxes_[static_cast<std::size_t>(box.first) + 1], p)};
    if (far.squared < near.squared) std::swap(near, far);
    todo[size++] = far;
    todo[size++] = near;
  }
  best.distance = std::sqrt(best.distance);
  return best;
}

// Between the planes of each pair of sides, widened by rounding.
bool TriangleSearch::meets(const Box& box, const Vec3& p, const Vec3& q) noexcept {
  double from = 0, to = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = coordinate(p, axis), d = coordinate(q, axis) - a;
    const double slack = 1e-12 * (std::abs(a) + std::abs(d));
    const double low = coordinate(box.low, axis) - slack, high = coordinate(box.high, axis) + slack;
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

void TriangleSearch::beside_segment(Vec3 p, Vec3 q, std::vector<std::int32_t>& triangles) const {
  if (boxes_.empty()) return;
  std::array<std::int32_t, 128> todo;  // as in nearest()
  std::size_t size = 0;
  todo[size++] = 0;
  while (size > 0) {
    const Box& box = boxes_[static_cast<std::size_t>(todo[--size])];
    if (!meets(box, p, q)) continue;
    if (box.count > 0) {
      const auto first = order_.begin() + box.first;
      triangles.insert(triangles.end(), first, first + box.count);
      continue;
    }
    todo[size++] = box.first + 1;
    todo[size++] = box.first;
  }
}

void TriangleSearch::beside_box(const Vec3& low, const Vec3& high, std::vector<std::int32_t>& triangles) const {
  if (boxes_.empty()) return;
  const auto apart = [&](const Vec3& l, const Vec3& h) {
    return l.x() > high.x() || h.x() < low.x() || l.y() > high.y() || h.y() < low.y() || l.z() > high.z() ||
           h.z() < low.z();
  };
  std::array<std::int32_t, 128> todo;  // as in nearest()
  std::size_t size = 0;
  todo[size++] = 0;
  while (size > 0) {
    const Box& box = boxes_[static_cast<std::size_t>(todo[--size])];
    if (apart(box.low, box.high)) continue;
    for (std::int32_t k = 0; k < box.count; ++k) {
      const std::int32_t triangle = order_[static_cast<std::size_t>(box.first + k)];
      const auto& [a, b, c] = corners_[static_cast<std::size_t>(triangle)];
      const Vec3 l{std::min({a.x(), b.x(), c.x()}), std::min({a.y(), b.y(), c.y()}), std::min({a.z(), b.z(), c.z()})};
      const Vec3 h{std::max({a.x(), b.x(), c.x()}), std::max({a.y(), b.y(), c.y()}), std::max({a.z(), b.z(), c.z()})};
      if (!apart(l, h)) triangles.push_back(triangle);
    }
    if (box.count > 0) continue;
    todo[size++] = box.first + 1;
    todo[size++] = box.first;
  }
}

double TriangleSearch::longest_edge(std::int32_t triangle) const noexcept {
  const auto& c = corners_[static_cast<std::size_t>(triangle)];
  return std::max({norm(c[1] - c[0]), norm(c[2] - c[1]), norm(c[0] - c[2])});
}

}  // namespace carreau
