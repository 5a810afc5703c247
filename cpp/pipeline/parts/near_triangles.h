// SPDX-License-Identifier: BSD-3-Clause
// Triangles of this process, and triangles of others that may cross them. Private to pipeline/parts.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "pipeline/base/run.h"
#include "pipeline/parts/shown_triangles.h"

namespace carreau {

/// In the order of the whole mesh.
struct NearTriangles {
  std::vector<Vec3> vertices;  ///< vertices of this process first
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<char> own;                            ///< by triangle: 1: it is kept here
  std::vector<std::int32_t> first;                  ///< by face, and one more: its first triangle
  std::map<int, std::vector<std::int32_t>> locals;  ///< of faces that others keep: which of their triangles these are

  [[nodiscard]] TriangleOfFace origin(std::int32_t triangle) const;
};

/// One of two processes searches for crossings between them: it receives each triangle of the other that may cross its own. All
/// processes call it.
NearTriangles near_triangles(const CompositeRun& run);

}  // namespace carreau
