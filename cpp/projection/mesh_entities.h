// SPDX-License-Identifier: BSD-3-Clause
// The entities of the model that nodes of a mesh lie on.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "curve/edge_accuracy.h"
#include "mesh/surface_mesh.h"

namespace carreau {

/// A point (dimension 0), curve (1) or face (2) of the model.
struct MeshEntity {
  std::int32_t dimension = 2;
  std::int32_t ref = 0;

  friend bool operator==(const MeshEntity&, const MeshEntity&) = default;
};

/// A vertex can leave one of its curves along the next one, where both meet smoothly: it lies on the first curve that has its parameter.
class NodesOfCurves {
 public:
  explicit NodesOfCurves(std::size_t nodes) : has_parameter_(nodes) {}
  /// Returns whether the node lies on a curve, which may replace the entity `now`. `t`: the node's parameter on it, NaN: none.
  [[nodiscard]] bool takes(std::size_t node, const MeshEntity& now, double t) {
    const bool is_first = std::isfinite(t) && !has_parameter_[node];
    if (is_first) has_parameter_[node] = true;
    return now.dimension == 2 || is_first;
  }

 private:
  std::vector<bool> has_parameter_;
};

/// The entity of lowest dimension of each vertex, then of each node on an edge. `uv_face`: the face whose (u, v) a local node of a face has
/// (Session::uv_face). `curves`: parameters of the vertices of curves of the mesh, where they are known.
std::vector<MeshEntity> entities_of_nodes(const SurfaceMesh& mesh, const std::function<std::size_t(std::size_t face, std::int32_t node)>& uv_face,
                                          std::span<const CurveParameters> curves);

}  // namespace carreau
