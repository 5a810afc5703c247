// SPDX-License-Identifier: BSD-3-Clause
// Images of the vertices of a face.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cad/cad.h"
#include "support/vec.h"

namespace carreau {

/// Vertices of a face whose places are sought, with the images of another face's vertices.
struct ImageVertices {
  Cad& cad;
  int face = 0;               ///< reference
  std::vector<Vec3> target;   ///< images of the positions
  std::vector<Vec2> from_uv;  ///< parameters in the other face
  std::vector<char> known;    ///< the vertex has its place
};

/// The vertex that is farthest from its image.
struct MissedVertex {
  std::size_t vertex = 0;
  double distance = 0;
};

/// Fills `uv` and `xyz` of vertices that are not known with the closest points; images that lie on the surface within `exact`
/// (model length) are taken as they are. `triangles` lead from known vertices to their neighbours if no affine map
/// fits the parameters of both faces.
MissedVertex place_images(const ImageVertices& vertices, std::span<const std::array<std::int32_t, 3>> triangles, double exact,
                          std::vector<Vec2>& uv, std::vector<Vec3>& xyz);

}  // namespace carreau
