// SPDX-License-Identifier: BSD-3-Clause
// Parametric remeshing of one chart in its plane.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "surface/remesh/planes/borders.h"
#include "surface/remesh/planes/chart_plane.h"

namespace carreau {

struct ChartMesh {
  std::vector<std::int32_t> border;                    ///< vertices of the mesh to come, which come first
  std::vector<Vec2> inner;                             ///< the vertices that follow
  std::vector<Foot> feet;                              ///< of these
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< of the chart's own numbers
};

struct ChartInput {
  const FlatAtlas& atlas;
  const ChartPlane& plane;
  std::span<const BorderChain* const> chains;  ///< of its border
  std::span<const std::int32_t> triangles;     ///< of the atlas
  std::span<const double> size;                ///< by vertex of the atlas
  std::int32_t chart = 0;
  std::span<const Vec3> xyz;  ///< of vertices of the mesh to come on borders
  std::int64_t max_triangles = 0;
};

/// Throws DomainError where the borders cross in the plane.
void check_borders(const ChartInput& input, Monitor& monitor);

/// Throws the exceptions of the plane mesher. Returns nothing if the projection is folded.
std::optional<ChartMesh> mesh_chart(const ChartInput& input, Monitor& monitor);

}  // namespace carreau
