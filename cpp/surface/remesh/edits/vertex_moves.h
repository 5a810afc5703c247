// SPDX-License-Identifier: BSD-3-Clause
// Moves of free vertices towards places where the triangles around would be equilateral and of the prescribed size.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/remesh/base/cross_patch_mesh.h"

namespace carreau {

/// Keeps buffers for the surroundings of a vertex.
class VertexMover {
 public:
  /// `least`: share of the size; shorter moves do not count.
  VertexMover(CrossPatchMesh& mesh, double least) : mesh_(mesh), least_(least) {}

  /// Moves a free vertex where shapes around gain, no more lengths are out of range and the surface agrees.
  bool move(std::int32_t v);

 private:
  /// The side of a triangle around opposite the vertex, and the sizes at its ends.
  struct Side {
    Vec3 a, b;
    double squared, h_a, h_b;
  };
  void look_around(std::int32_t v);
  [[nodiscard]] Vec3 ideal_place(const Vec3& from) const;
  [[nodiscard]] Vec3 ideal_place_by_direction(std::int32_t v) const;
  [[nodiscard]] TriangleShapes shapes(const Vec3& at) const;
  [[nodiscard]] int out_of_range(const Vec3& at, double h) const;
  bool try_place(std::int32_t v, const SurfacePlace& to, const TriangleShapes& before, int out);
  bool put_if_agrees(std::int32_t v, const SurfacePlace& to, const WantedSize& there);

  CrossPatchMesh& mesh_;
  double least_;
  std::vector<Side> sides_;
};

}  // namespace carreau
