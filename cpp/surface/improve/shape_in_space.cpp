// SPDX-License-Identifier: BSD-3-Clause
#include "surface/improve/shape_in_space.h"

#include <algorithm>

#include "mesh/shape_levels.h"
#include "surface/improve/bad_region.h"
#include "surface/improve/smoothing.h"
#include "surface/improve/swaps.h"
#include "surface/improve/thresholds.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

std::optional<std::vector<std::int32_t>> swap_poor_edges(const PatchInput& input, PatchMesh& mesh, Monitor& monitor) {
  if (!input.isotropic) return {};
  std::vector<std::int32_t> bad = triangles_below(mesh.plane, mesh.xyz, shape_level::good, input.executor, monitor);
  std::vector<std::int32_t> poor;
  for (const std::int32_t t : bad)
    if (is_below(shape_level::poor, mesh.plane.triangles[t], mesh.xyz)) poor.push_back(t);
  if (poor.empty()) return bad;
  const BadRegion region(input.domain->plane, mesh.plane, mesh.xyz, std::move(poor), input.executor.threads, monitor);
  swap_in_space(region, input.domain->plane, mesh.plane, mesh.xyz, monitor);
  return {};
}

void shape_in_space(const PatchInput& input, Cad& cad, const SizeRules& rules, PatchMesh& mesh,
                    std::optional<std::vector<std::int32_t>> bad, Monitor& monitor) {
  if (!input.isotropic) return;
  if (!bad) bad = triangles_below(mesh.plane, mesh.xyz, shape_level::good, input.executor, monitor);
  const BadRegion region(input.domain->plane, mesh.plane, mesh.xyz, std::move(*bad), input.executor.threads, monitor);
  if (region.triangles().empty()) return;
  std::vector<std::int32_t> moved;
  constexpr int max_rounds = 4;  // swaps and moves make room for each other
  for (int round = 0; round < max_rounds; ++round) {
    const std::vector<std::int32_t> now = smooth_in_space(region, input.domain->plane, input.ref, cad, mesh, monitor);
    moved.insert(moved.end(), now.begin(), now.end());
    if (now.empty() || !swap_in_space(region, input.domain->plane, mesh.plane, mesh.xyz, monitor)) break;
  }
  std::sort(moved.begin(), moved.end());
  moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
  std::vector<Vec2> uv;
  for (const std::int32_t v : moved) uv.push_back(mesh.plane.vertices[v]);
  const std::vector<double> sizes = prescribed_sizes(input, cad, rules, uv, monitor);
  for (std::size_t k = 0; k < moved.size(); ++k) mesh.size[moved[k]] = sizes[k];
}

}  // namespace carreau
