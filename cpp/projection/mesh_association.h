// SPDX-License-Identifier: BSD-3-Clause
// The places of a mesh's nodes on its geometry, for files.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "curve/edge_accuracy.h"
#include "projection/mesh_entities.h"

namespace carreau {

/// The entities that nodes lie on, and their parameters there. References are the references that results show. Nodes number the vertices of
/// the flat mesh.
struct MeshAssociation {
  struct OnPoint {
    std::int32_t node = 0, ref = 0;
  };
  struct OnCurve {
    std::int32_t node = 0, ref = 0;
    double t = 0;
  };
  struct OnFace {
    std::int32_t node = 0, ref = 0;
    Vec2 uv{0, 0};
  };
  std::vector<MeshEntity> entities;  ///< of lowest dimension, by node
  /// Ascending by node and reference. A node has a record on each curve and face around it: at seams and poles of a face several, one for each
  /// (u, v); at the ends of a closed curve two.
  std::vector<OnPoint> points;
  std::vector<OnCurve> curves;
  std::vector<OnFace> faces;
  std::vector<Vec2> cell_uv;             ///< (u, v) of each node of each element, element by element; may be empty
  std::vector<std::int32_t> cell_faces;  ///< for cross-patch meshes: the face of each (u, v); else empty

  /// The parameters of a node on its curve (1) or face (2); a span of `dimension` numbers, empty: not known.
  [[nodiscard]] std::span<const double> parameters(int dimension, std::int32_t node, std::int32_t ref) const;
  /// Sorts the records and removes repetitions.
  void sort();
};

/// The association of a mesh. `curves`: parameters of vertices by curve; `mid_t`: by curve, the parameters of the nodes of its edges, or empty.
/// `shown_point`: the reference that results show for a point; `uv_face`: Session::uv_face.
MeshAssociation associate(const SurfaceMesh& mesh, std::span<const CurveParameters> curves, std::span<const std::vector<double>> mid_t,
                          const std::function<std::int32_t(std::int32_t)>& shown_point,
                          const std::function<std::size_t(std::size_t face, std::int32_t node)>& uv_face);

}  // namespace carreau
