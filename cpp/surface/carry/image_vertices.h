// SPDX-License-Identifier: BSD-3-Clause
// Images of the vertices inside a face.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cad/cad.h"
#include "model/isometry.h"
#include "support/vec.h"

namespace carreau {

/// The vertices of a mesh whose images are sought on another face. Vertices behind the imposed ones keep their numbers.
struct ImageVertices {
  Cad& cad;
  int face = 0;  ///< reference of the image's face
  const Isometry& map;
  const std::vector<Vec3>& from;     ///< positions
  const std::vector<Vec2>& from_uv;  ///< parameters in the master
  const std::vector<int>& imposed;   ///< images of the first vertices, whose places are known
};

/// The vertex inside that is farthest from its image.
struct MissedVertex {
  std::size_t vertex = 0;
  double distance = 0;
};

/// Fills `uv` and `xyz` behind the imposed vertices with closest points. `triangles`: of the images; they lead from known
/// vertices to their neighbours if the parameters of both faces differ by no affine map.
MissedVertex place_images(const ImageVertices& vertices, std::span<const std::array<std::int32_t, 3>> triangles, std::vector<Vec2>& uv,
                          std::vector<Vec3>& xyz);

}  // namespace carreau
