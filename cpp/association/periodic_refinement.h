// SPDX-License-Identifier: BSD-3-Clause
// Refinement of periodic meshes: slaves stay images of their masters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "association/edge_marks.h"
#include "association/mesh_edges.h"
#include "curve/curve_model.h"
#include "curve/discrete_curve.h"
#include "mesh/surface_mesh.h"
#include "periodic/periodic_model.h"

namespace carreau::refining {

/// The local vertices that the division of a face has added.
struct AddedVertices {
  std::map<Key, std::int32_t> middles;    ///< by local edge
  std::vector<std::int32_t> centres = {};  ///< of quadrilaterals, in their order
};

/// Keeps references to the model and the mesh.
class PeriodicRefinement {
 public:
  /// The mesh has the links of its meshing, and its slaves have the elements of their masters in their order.
  PeriodicRefinement(const CurveModel& model, double diag, SurfaceMesh& mesh);

  [[nodiscard]] const PeriodicModel& model() const noexcept { return periodic_; }
  [[nodiscard]] bool is_slave(std::size_t face) const { return periodic_.pair_of_slave[face] >= 0; }

  /// Marks the images of marked edges. Returns whether marks were added. `curves`: of the mesh.
  bool spread(const std::vector<DiscreteCurve>& curves, EdgeMarks& marks) const;
  /// Called before the mesh is divided.
  void begin();
  /// Gives slaves the elements of their masters, which were divided and repaired, and the images of their vertices.
  void finish(const std::vector<AddedVertices>& added);

 private:
  [[nodiscard]] bool is_flipped(const FacePair& pair) const;

  const CurveModel& curve_model_;
  SurfaceMesh& mesh_;
  PeriodicModel periodic_;
  std::vector<std::vector<std::int32_t>> image_;  ///< by pair: local vertices of the slave by local vertices of the master
  std::vector<Vec3> before_;                      ///< places before the mesh was divided
};

}  // namespace carreau::refining
