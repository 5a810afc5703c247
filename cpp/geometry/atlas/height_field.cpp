// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/atlas/height_field.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/atlas/thresholds.h"
#include "support/rounding_of.h"

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

Frame frame_along(const Vec3& area, const Vec3& origin) {
  Frame frame;
  frame.origin = origin;
  if (norm(area) > 0) frame.normal = area / norm(area);
  int axis = 0;
  frame.normal.cwiseAbs().minCoeff(&axis);
  Vec3 along(0, 0, 0);
  along[axis] = 1;
  frame.u = cross(along, frame.normal);
  frame.u /= norm(frame.u);
  frame.v = cross(frame.normal, frame.u);
  return frame;
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

LocalHeights local_heights(const Covering& covering, std::int32_t centre) {
  LocalHeights local;
  const Vec3 area = area_around(covering, centre);
  local.frame = frame_along(area, vertex(covering, centre));
  const auto& fan = covering.fans().around(centre);
  // Second moments of the fan: distances are in units of its edges.
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const std::int32_t w : fan) {
    const Vec2 q = local.frame.project(vertex(covering, w));
    moments += q * q.transpose() / static_cast<double>(fan.size());
  }
  moments += rounding_of::places * moments.trace() * Eigen::Matrix2d::Identity();
  Eigen::Matrix2d form = moments.inverse();
  const auto square = [&](const Vec2& q) { return q.dot(form * q); };
  double farthest = 0;
  for (const std::int32_t w : fan) farthest = std::max(farthest, square(local.frame.project(vertex(covering, w))));
  form /= farthest;
  std::set<std::int32_t> seen{centre};
  std::vector<std::int32_t> front{centre};
  std::vector<Height> points{{Vec3(0, 0, 0), 1}};
  for (int ring = 1; ring <= thresholds::rings; ++ring) {
    std::vector<std::int32_t> next;
    for (const std::int32_t v : front)
      for (const std::int32_t w : covering.fans().around(v)) {
        if (!seen.insert(w).second) continue;
        const Vec3 other = area_around(covering, w);
        if (!(dot(other, local.frame.normal) > thresholds::min_cosine * norm(other))) continue;
        next.push_back(w);
        const Vec2 q = local.frame.project(vertex(covering, w));
        const double near = 1 + square(q);
        points.push_back({{q.x(), q.y(), local.frame.height(vertex(covering, w))}, 1 / (near * near * near)});
      }
    front = std::move(next);
  }
  int degree = thresholds::max_degree;
  while (degree > 2 && static_cast<double>(points.size()) <
                           thresholds::points_per_term * static_cast<double>(HeightField::terms(degree)))
    --degree;
  local.field = fit_heights(points, degree);
  form /= thresholds::bump_radius * thresholds::bump_radius;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(form);
  local.form = {form(0, 0), 2 * form(0, 1), form(1, 1), axes.eigenvalues()[1]};
  local.reach = 1 / std::sqrt(axes.eigenvalues()[0]);
  return local;
}

}  // namespace carreau::atlas
