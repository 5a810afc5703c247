// SPDX-License-Identifier: BSD-3-Clause
#include "surface/discrete/curvature_tensors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "metric/metric2_algebra.h"
#include "model/union_find.h"
#include "surface/remesh/base/tangent_metrics.h"

namespace carreau {

namespace {

std::size_t corner_index(std::int32_t t, int k) noexcept {
  return 3 * static_cast<std::size_t>(t) + static_cast<std::size_t>(k % 3);
}

Metric3 outer(const Vec3& p, const Vec3& q, PlaneCurvature k) noexcept {
  const Vec3 kp = k.a * p + k.b * q, kq = k.b * p + k.c * q;
  return {p.x() * kp.x() + q.x() * kq.x(), p.x() * kp.y() + q.x() * kq.y(), p.x() * kp.z() + q.x() * kq.z(),
          p.y() * kp.y() + q.y() * kq.y(), p.y() * kp.z() + q.y() * kq.z(), p.z() * kp.z() + q.z() * kq.z()};
}

void add(Metric3& sum, double w, const Metric3& m) noexcept {
  sum.xx += w * m.xx, sum.xy += w * m.xy, sum.xz += w * m.xz, sum.yy += w * m.yy, sum.yz += w * m.yz,
      sum.zz += w * m.zz;
}

/// The tensor of one triangle, in a basis of its plane.
struct OfTriangle {
  Vec3 p, q, n;
  PlaneCurvature k;

  OfTriangle(const discrete::DiscreteSurface& surface, std::int32_t t) : n(surface.mesh().normal(t)) {
    const discrete::Triangulation& mesh = surface.mesh();
    const auto edge = [&](int i) -> Vec3 { return mesh.at(mesh.corner(t, i + 1)) - mesh.at(mesh.corner(t, i)); };
    p = edge(0) / norm(edge(0));
    q = cross(n, p);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double most = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec3 d = edge(i), turn = surface.normal(t, i + 1) - surface.normal(t, i);
      const double x = dot(d, p), y = dot(d, q), a = dot(turn, p), b = dot(turn, q);
      sum(0, 0) += x * x, sum(0, 1) += x * y, sum(1, 1) += x * x + y * y, sum(2, 2) += y * y;
      right(0) += x * a, right(1) += y * a + x * b, right(2) += y * b;
      most = std::max(most, norm(turn) / norm(d));
    }
    sum(1, 0) = sum(1, 2) = sum(2, 1) = sum(0, 1);
    const Eigen::Vector3d found = sum.ldlt().solve(right);
    k = {found(0), found(1), found(2)};
    const Eigen2 e = eigen(k);
    const double size = std::max(std::abs(e.major), std::abs(e.minor));
    if (!std::isfinite(size))
      k = {0, 0, 0};
    else if (size > most)
      k = (most / size) * k;
  }

  /// Turned into the plane of another normal.
  [[nodiscard]] Metric3 in_plane_of(const Vec3& normal) const noexcept {
    const double w = 1 + dot(n, normal);
    if (!(w > 0)) return outer(p, q, k);
    const auto turned = [&](const Vec3& e) -> Vec3 { return e - (dot(e, normal) / w) * (n + normal); };
    return outer(turned(p), turned(q), k);
  }
};

}  // namespace

CurvatureTensors::CurvatureTensors(const discrete::DiscreteSurface& surface) {
  const discrete::Triangulation& mesh = surface.mesh();
  const auto n = static_cast<std::int32_t>(surface.triangles());
  UnionFind sectors = discrete::sectors_of(mesh, surface.lines().sharp);
  constexpr Metric3 zero{0, 0, 0, 0, 0, 0};
  std::vector<double> weight(3 * surface.triangles(), 0);
  std::vector<Metric3> sum(weight.size(), zero);
  for (std::int32_t t = 0; t < n; ++t) {
    const OfTriangle here(surface, t);
    for (int i = 0; i < 3; ++i) {
      const std::size_t sector = sectors.find(corner_index(t, i));
      const double w = mesh.angle(t, i);
      weight[sector] += w;
      add(sum[sector], w, here.in_plane_of(surface.normal(t, i)));
    }
  }
  tensor_.assign(weight.size(), zero);
  for (std::size_t c = 0; c < tensor_.size(); ++c) {
    const std::size_t sector = sectors.find(c);
    if (weight[sector] > 0) add(tensor_[c], 1 / weight[sector], sum[sector]);
  }
}

PlaneCurvature CurvatureTensors::at(std::int32_t triangle, const Vec2& uv, const Vec3& p, const Vec3& q) const {
  Metric3 k{0, 0, 0, 0, 0, 0};
  const std::array<double, 3> weights{1 - uv.x() - uv.y(), uv.x(), uv.y()};
  for (int i = 0; i < 3; ++i) add(k, weights[static_cast<std::size_t>(i)], tensor_[corner_index(triangle, i)]);
  return gram(k, p, q);
}

}  // namespace carreau
