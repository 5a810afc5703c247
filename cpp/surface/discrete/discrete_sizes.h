// SPDX-License-Identifier: BSD-3-Clause
// Sizes of meshes of surfaces given as triangles.
#pragma once

#include <vector>

#include "geometry/discrete/discrete_cad.h"
#include "geometry/discrete/refinement.h"
#include "surface/options.h"

namespace carreau {

/// What size rules ask for at vertices of a mesh of the surface. A size that differs by direction counts as its least.
class DiscreteSizes {
 public:
  /// Keeps references. `cad`: the surface itself, or what asks it.
  DiscreteSizes(const Model& model, Cad& cad, const discrete::DiscreteCad& surface, const CompositeOptions& options);

  /// At each vertex, with the gradation of the options over the edges of the mesh.
  [[nodiscard]] std::vector<double> at_vertices(const discrete::RefinedMesh& mesh, Monitor& monitor) const;

 private:
  void prescribe(const discrete::RefinedMesh& mesh, std::vector<double>& size, Monitor& monitor) const;
  void bend(const discrete::RefinedMesh& mesh, std::vector<double>& size) const;

  const Model& model_;
  Cad& cad_;
  const discrete::DiscreteCad& surface_;
  const CompositeOptions& options_;
  std::vector<double> radius_;  // by corner of the surface's triangles: smallest radius of curvature
};

/// The largest sizes that are no larger and grow along edges by `slope` at most.
void grade_over_edges(const std::vector<Vec3>& vertices, const std::vector<std::array<std::int32_t, 3>>& triangles,
                      double slope, std::vector<double>& size);

}  // namespace carreau
