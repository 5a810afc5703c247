// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a mesh in parts that one process shows to others. Private to pipeline/parts.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "surface/result.h"

namespace carreau {

/// A triangle of the whole mesh.
struct TriangleOfFace {
  std::int32_t face = 0, local = 0;
  friend auto operator<=>(const TriangleOfFace&, const TriangleOfFace&) = default;
};

/// Packs vertices that are not on curves once, with their places, then the triangles.
std::string show_triangles(const SurfaceMesh& mesh, const MeshShares& shares, std::span<const TriangleOfFace> triangles);

/// A triangle that another process shows. Its numbers count in the whole mesh.
struct ShownTriangle {
  struct Corner {
    std::int64_t number = 0;
    std::int32_t ref = 0;
    Vec3 xyz;
  };
  TriangleOfFace which;
  std::array<Corner, 3> corners;
};

/// use(triangle) for each of show_triangles(). `mesh`: of this process, which has the vertices on curves. Throws Error for other bytes.
void for_shown_triangles(const std::string& bytes, const SurfaceMesh& mesh, const MeshShares& shares,
                         const std::function<void(const ShownTriangle&)>& use);

}  // namespace carreau
