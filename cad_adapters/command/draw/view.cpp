// SPDX-License-Identifier: BSD-3-Clause
#include "draw/view.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "files/mesh_file.h"

namespace command {
namespace {

Point direction_of(const std::string& text) {
  static constexpr struct {
    const char* name;
    Point direction;
  } names[] = {{"iso", {1, -2, 1}},  {"front", {0, -1, 0}}, {"back", {0, 1, 0}},   {"left", {-1, 0, 0}},
               {"right", {1, 0, 0}}, {"top", {0, 0, 1}},    {"bottom", {0, 0, -1}}};
  for (const auto& [name, direction] : names)
    if (text == name) return direction;
  Point d{};
  int end = 0;
  const int found = std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &d[0], &d[1], &d[2], &end);
  const double length = std::hypot(d[0], d[1], d[2]);
  if (found != 3 || static_cast<std::size_t>(end) != text.size() || !(length > 0) || !std::isfinite(length))
    throw Failure("The view '" + text +
                  "' is neither iso, front, back, left, right, top, bottom nor a direction x,y,z other than 0,0,0.");
  return d;
}

}  // namespace

View view_from(const std::string& text) {
  View view;
  view.toward = unit(direction_of(text));
  const bool along_z = std::abs(view.toward[2]) > 1 - 1e-9;
  const Point up = along_z ? Point{0, 1, 0} : Point{0, 0, 1};
  view.right = unit(cross(up, view.toward));
  view.up = cross(view.toward, view.right);
  return view;
}

Projection::Projection(const View& view, const std::vector<Point>& points, double x0, double y0, double width,
                       double height)
    : view_(view) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const Point& p : points)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  double radius = 0;
  for (int i = 0; i < 3; ++i) centre_[i] = (low[i] + high[i]) / 2;
  for (int i = 0; i < 3; ++i) radius = std::hypot(radius, high[i] - centre_[i]);
  distance_ = radius > 0 ? 6 * radius : 1;  // mild perspective

  double left = infinity, right = -infinity, bottom = infinity, top = -infinity;
  for (const Point& p : points) {
    const Point c = in_camera(p);
    const double x = c[0] / (distance_ - c[2]), y = c[1] / (distance_ - c[2]);
    left = std::min(left, x), right = std::max(right, x);
    bottom = std::min(bottom, y), top = std::max(top, y);
  }
  constexpr double used = 0.92;
  const double w = std::max(right - left, 1e-12), h = std::max(top - bottom, 1e-12);
  scale_ = used * std::min(width / w, height / h);
  x_ = x0 + width / 2 - scale_ * (left + right) / 2;
  y_ = y0 + height / 2 + scale_ * (bottom + top) / 2;
}

Point Projection::in_camera(const Point& p) const {
  const Point d{p[0] - centre_[0], p[1] - centre_[1], p[2] - centre_[2]};
  return {dot(d, view_.right), dot(d, view_.up), dot(d, view_.toward)};
}

Point Projection::ahead(const Point& p, double length) const {
  Point place = (*this)(p);
  place[2] = 1 / std::max(distance_ - in_camera(p)[2] - length, 1e-3 * distance_);
  return place;
}

Point Projection::operator()(const Point& p) const {
  const Point c = in_camera(p);
  const double w = 1 / (distance_ - c[2]);
  return {x_ + scale_ * c[0] * w, y_ - scale_ * c[1] * w, w};
}

}  // namespace command
