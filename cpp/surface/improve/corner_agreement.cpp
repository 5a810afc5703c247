// SPDX-License-Identifier: BSD-3-Clause
#include "surface/improve/corner_agreement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/infinity.h"

namespace carreau {

KeptAgreement::KeptAgreement(const GeometricLimits& kept)
    : sine_(std::isfinite(kept.edge_angle_deg) ? std::sin(kept.edge_angle_deg * std::numbers::pi / 180) : infinity),
      least_cosine_(std::isfinite(kept.triangle_angle_deg) ? std::cos(kept.triangle_angle_deg * std::numbers::pi / 180) : -1),
      deviation_(kept.deviation) {}

bool KeptAgreement::leans(const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals) const noexcept {
  if (least_cosine_ < 0) return false;
  const Vec3 n = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double least = least_cosine_ * norm(n);
  for (const Vec3& normal : normals)
    if (dot(normal, normal) > 0 && dot(n, normal) < least) return true;
  return false;
}

double KeptAgreement::lean(const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals) const noexcept {
  if (least_cosine_ < 0) return 0;
  const Vec3 n = cross(corners[1] - corners[0], corners[2] - corners[0]);
  double cosine = 1;
  for (const Vec3& normal : normals)
    if (dot(normal, normal) > 0) cosine = std::min(cosine, dot(n, normal) / norm(n));
  if (!(cosine > 0)) return infinity;
  return std::sqrt(std::max(0., 1 - cosine * cosine) / (1 - least_cosine_ * least_cosine_));
}

double KeptAgreement::share(const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals) const noexcept {
  double angles = 0, offsets = 0, middle = 0;  // angles by their sines
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec3 e = corners[j] - corners[i];
    const double p = dot(e, normals[i]), q = -dot(e, normals[j]);
    angles = std::max(angles, std::max(std::abs(p), std::abs(q)) / norm(e));
    for (const double s : along_edge) offsets = std::max(offsets, std::abs(cubic_offset(s, p, q)));
    middle += p + q;
  }
  return std::max({angles / sine_, std::max(offsets, std::abs(middle) / 18) / deviation_, lean(corners, normals)});
}

}  // namespace carreau
