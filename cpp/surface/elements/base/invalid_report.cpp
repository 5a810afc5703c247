// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/base/invalid_report.h"

#include <algorithm>
#include <array>

#include "support/error.h"
#include "support/infinity.h"

namespace carreau {

std::vector<EdgeSizes::Source> finer_sides(std::span<const Vec3> corners, double size, Element element) {
  double longest = 0;
  const auto next = [&](std::size_t k) -> const Vec3& { return corners[(k + 1) % corners.size()]; };
  for (std::size_t k = 0; k < corners.size(); ++k) longest = std::max(longest, norm(next(k) - corners[k]));
  const double wanted = std::min(longest, size) * (has_quads_only(element) ? 1 : 0.5);
  std::vector<EdgeSizes::Source> sides;
  for (std::size_t k = 0; k < corners.size(); ++k) sides.push_back({corners[k], next(k), wanted});
  return sides;
}

std::vector<EdgeSizes::Source> finer_sides(const SurfaceMesh& mesh, const FaceMesh& face, const Cell& cell, const std::vector<double>& size, Element element) {
  std::array<Vec3, 4> corners;
  const auto n = static_cast<std::size_t>(corner_count(cell.kind));
  double least = infinity;
  for (std::size_t k = 0; k < n; ++k) {
    const std::int32_t v = face.vertex[cell.nodes[k]];
    corners[k] = mesh.vertices[v];
    if (const double h = size[v]; h > 0) least = std::min(least, h);
  }
  return finer_sides({corners.data(), n}, least, element);
}

std::string mark_invalid(FaceMesh& face, const Vec2& uv, std::size_t count) {
  const std::string what = Where{.face = face.shown_ref(), .uv = uv}.prefix() + std::to_string(count) +
                           (count == 1 ? " element has" : " elements have") + " a Jacobian that is not positive everywhere";
  face.status = FaceStatus::mended;
  face.why += (face.why.empty() ? "" : "; ") + what;
  return what;
}

}  // namespace carreau
