// SPDX-License-Identifier: BSD-3-Clause
// The triangles of an atlas as they are in space.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/remesh/base/charts.h"
#include "surface/remesh/base/sharp_edges.h"

namespace carreau {

/// Keeps references.
struct FlatAtlas {
  FlatAtlas(const Charts& atlas, const SurfaceMesh& of, const VertexJets& jets);

  const Charts& charts;
  const SurfaceMesh& mesh;
  std::vector<Vec3> normal;                 ///< of triangles, unit; zero where flat
  std::vector<Vec3> centre;                 ///< of triangles
  std::vector<double> area;                 ///< of triangles, twice
  std::vector<std::array<Vec3, 3>> corner;  ///< normals of the surface at the corners of triangles, unit

  [[nodiscard]] std::int32_t triangles() const noexcept { return static_cast<std::int32_t>(normal.size()); }
  [[nodiscard]] const Charts::Triangle& at(std::int32_t t) const { return charts.triangles()[t]; }
  [[nodiscard]] const Vec3& xyz(std::int32_t v) const { return mesh.vertices[v]; }
  /// The place in space of a point `f` on its flat triangle.
  [[nodiscard]] Vec3 flat(const Foot& f) const;
};

}  // namespace carreau
