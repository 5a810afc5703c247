// SPDX-License-Identifier: BSD-3-Clause
// Places of the surface over triangles whose corners are of several charts.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/remesh/base/charts.h"
#include "surface/remesh/bounds/spread_triangle.h"

namespace carreau {

/// The mesh before one that is independent of its patches, and a triangle of it for each local vertex.
struct SpreadAtlas {
  const Charts* charts = nullptr;
  std::span<const std::vector<std::int32_t>> feet;  ///< [face][local vertex]

  /// True if the normals over a triangle of the atlas and the normals of a face point to opposite sides.
  [[nodiscard]] bool is_turned(std::int32_t face, std::int32_t triangle) const;
};

/// Samples a triangle of the mesh whose corners are of several charts. Three evaluations.
SpreadTriangle spread_triangle(const SurfaceMesh& mesh, const SpreadAtlas& atlas, Cad& cad, std::size_t face, std::size_t triangle);

/// The surface over a place of a spread triangle.
struct SpreadSample {
  std::size_t triangle = 0;  ///< of the mesh, faces in order
  int side = -1;             ///< of the triangle; -1: inside
  int rank = 0;              ///< of the node on the side, or of the weights
  std::int32_t face = -1;    ///< index in SurfaceMesh::faces; -1: not found
  Vec2 uv;
  bool turned = false;  ///< the normal there points to the other side
  Vec3 flat;  ///< the place of the triangle itself
};

/// Samples of all spread triangles, faces ascending: at `nodes` of their sides, and inside with these barycentric weights.
std::vector<SpreadSample> spread_samples(const SurfaceMesh& mesh, const SpreadAtlas& atlas, Cad& cad,
                                         std::span<const double> nodes,
                                         std::span<const std::array<double, 3>> weights, Monitor& monitor);

}  // namespace carreau
