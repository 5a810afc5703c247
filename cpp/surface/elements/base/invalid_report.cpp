// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/base/invalid_report.h"

#include <algorithm>

#include "support/error.h"
#include "support/infinity.h"

namespace carreau {

std::vector<EdgeSizes::Source> finer_sides(const SurfaceMesh& mesh, const FaceMesh& face, const Cell& cell, const std::vector<double>& size, Element element) {
  const int n = corner_count(cell.kind);
  const auto vertex = [&](int k) { return face.vertex[cell.nodes[k % n]]; };
  const auto at = [&](int k) -> const Vec3& { return mesh.vertices[vertex(k)]; };
  double longest = 0, least = infinity;
  for (int k = 0; k < n; ++k) {
    longest = std::max(longest, norm(at(k + 1) - at(k)));
    if (const double h = size[vertex(k)]; h > 0) least = std::min(least, h);
  }
  const double wanted = std::min(longest, least) * (has_quads_only(element) ? 1 : 0.5);
  std::vector<EdgeSizes::Source> sides;
  for (int k = 0; k < n; ++k) sides.push_back({at(k), at(k + 1), wanted});
  return sides;
}

std::string mark_invalid(FaceMesh& face, const Vec2& uv, std::size_t count) {
  const std::string what = Where{.face = face.shown_ref(), .uv = uv}.prefix() + std::to_string(count) +
                           (count == 1 ? " element has" : " elements have") + " a Jacobian that is not positive everywhere";
  face.status = FaceStatus::mended;
  face.why += (face.why.empty() ? "" : "; ") + what;
  return what;
}

}  // namespace carreau
