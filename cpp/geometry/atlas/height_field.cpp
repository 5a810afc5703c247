// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/height_field.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <set>

#include "geometry/atlas/thresholds.h"
#include "support/angles.h"
#include "support/shares.h"

namespace carreau::atlas {
namespace {

const Vec3& vertex(const Covering& covering, std::int32_t v) {
  return covering.surface().vertices[static_cast<std::size_t>(v)];
}

std::vector<Height> heights_of_region(const Covering& covering, const Chart& chart) {
  std::vector<Height> points;
  for (const auto* list : {&chart.members, &chart.around})
    for (const std::int32_t v : *list) {
      const Vec3& p = vertex(covering, v);
      const Vec2 q = chart.frame.project(p);
      points.push_back({{q.x(), q.y(), chart.frame.height(p)}});
    }
  return points;
}

Vec3 area_around(const Covering& covering, std::int32_t v) {
  const auto& fan = covering.fans().around(v);
  Vec3 area(0, 0, 0);
  for (std::size_t k = 0; k < fan.size(); ++k)
    area += area_vector(covering.surface(), v, fan[k], fan[(k + 1) % fan.size()]);
  return area;
}

}  // namespace

HeightField fit_heights(std::span<const Height> points, int degree) {
  HeightField field;
  field.degree = degree;
  double reach = 0;
  for (const Height& p : points) reach = std::max(reach, std::hypot(p.at.x(), p.at.y()));
  if (reach > 0) field.unit = reach;
  const auto n = static_cast<Eigen::Index>(HeightField::terms(degree));
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n), row(n);
  for (const Height& p : points) {
    const double x = p.at.x() / field.unit, y = p.at.y() / field.unit;
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j)
        row(static_cast<Eigen::Index>(HeightField::rank(i, j))) = std::pow(x, i) * std::pow(y, j);
    for (Eigen::Index i = 0; i < n; ++i) {
      right(i) += p.weight * row(i) * p.at.z();
      for (Eigen::Index j = 0; j < n; ++j) normal(i, j) += p.weight * row(i) * row(j);
    }
  }
  // Small beside the sums of squares, which are of the order of 1, and large beside their rounding.
  constexpr double ridge = 1e-9;
  for (Eigen::Index i = 0; i < n; ++i) normal(i, i) += ridge;
  const Eigen::VectorXd solution = normal.ldlt().solve(right);
  field.coefficient.assign(solution.data(), solution.data() + n);
  return field;
}

HeightField coarse_heights(const Covering& covering, const Chart& chart) {
  return fit_heights(heights_of_region(covering, chart), 2);
}

HeightField fine_heights(const Covering& covering, const Chart& chart) {
  std::vector<Height> points = heights_of_region(covering, chart);
  const std::set<std::int32_t> border(chart.around.begin(), chart.around.end());
  std::set<std::int32_t> beyond;
  for (const std::int32_t v : chart.around)
    for (const std::int32_t w : covering.fans().around(v)) {
      if (border.count(w) > 0 || std::binary_search(chart.members.begin(), chart.members.end(), w)) continue;
      const Vec3 area = area_around(covering, w);
      if (dot(area, chart.frame.normal) > angles::cosine_of_60 * norm(area)) beyond.insert(w);
    }
  for (const std::int32_t v : beyond) {
    const Vec2 q = chart.frame.project(vertex(covering, v));
    points.push_back({{q.x(), q.y(), chart.frame.height(vertex(covering, v))}, shares::notable});
  }
  int degree = thresholds::max_degree;
  while (degree > 2 && static_cast<double>(points.size()) <
                           thresholds::points_per_term * static_cast<double>(HeightField::terms(degree)))
    --degree;
  return fit_heights(points, degree);
}

}  // namespace carreau::atlas
