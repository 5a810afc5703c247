// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/height_field.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace carreau::atlas {

HeightField fit_heights(std::span<const Vec3> points) {
  constexpr int n = 6;
  HeightField field;
  double reach = 0;
  for (const Vec3& p : points) reach = std::max(reach, std::hypot(p.x(), p.y()));
  if (reach > 0) field.unit = reach;
  Eigen::Matrix<double, n, n> normal = Eigen::Matrix<double, n, n>::Zero();
  Eigen::Matrix<double, n, 1> right = Eigen::Matrix<double, n, 1>::Zero();
  for (const Vec3& p : points) {
    const double x = p.x() / field.unit, y = p.y() / field.unit;
    const double row[n] = {1, x, y, x * x, x * y, y * y};
    for (int i = 0; i < n; ++i) {
      right(i) += row[i] * p.z();
      for (int j = 0; j < n; ++j) normal(i, j) += row[i] * row[j];
    }
  }
  // Small beside the sums of squares, which are of the order of 1, and large beside their rounding.
  constexpr double ridge = 1e-9;
  for (int i = 0; i < n; ++i) normal(i, i) += ridge;
  const Eigen::Matrix<double, n, 1> solution = normal.ldlt().solve(right);
  for (int i = 0; i < n; ++i) field.coefficient[static_cast<std::size_t>(i)] = solution(i);
  return field;
}

HeightField fit_heights(const Triangulation& surface, const Chart& chart) {
  std::vector<Vec3> points;
  for (const auto* list : {&chart.members, &chart.around})
    for (const std::int32_t v : *list) {
      const Vec3& p = surface.vertices[static_cast<std::size_t>(v)];
      const Vec2 q = chart.frame.project(p);
      points.emplace_back(q.x(), q.y(), chart.frame.height(p));
    }
  return fit_heights(points);
}

}  // namespace carreau::atlas
