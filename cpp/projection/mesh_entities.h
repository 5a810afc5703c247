// SPDX-License-Identifier: BSD-3-Clause
// The entities of the model that nodes of a mesh lie on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "mesh/surface_mesh.h"

namespace carreau {

/// A point (dimension 0), curve (1) or face (2) of the model.
struct MeshEntity {
  std::int32_t dimension = 2;
  std::int32_t ref = 0;

  friend bool operator==(const MeshEntity&, const MeshEntity&) = default;
};

/// The entity of lowest dimension of each vertex, then of each node on an edge. `uv_face`: the face whose (u, v) a local node of a face has
/// (Session::uv_face).
std::vector<MeshEntity> entities_of_nodes(const SurfaceMesh& mesh, const std::function<std::size_t(std::size_t face, std::int32_t node)>& uv_face);

}  // namespace carreau
