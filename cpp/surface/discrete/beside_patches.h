// SPDX-License-Identifier: BSD-3-Clause
// Meshes of patches and of triangles in one session.
#pragma once

#include <memory>

#include "geometry/discrete/discrete_cad.h"
#include "model/geometries.h"
#include "surface/options.h"
#include "surface/result.h"
#include "surface/supports.h"

namespace carreau {

/// Share of the progress of a run over patches and triangles.
inline constexpr double share_of_patches = 0.5;

/// The two parts of a mesh of patches and triangles, each by itself. Both have all faces; faces of the other kind have no triangles.
struct PartResults {
  CompositeResult patches, triangles;
  CompositeOptions triangle_options;
  [[nodiscard]] bool is_of_triangles(std::size_t face) const {
    return triangles.mesh.faces[face].status != FaceStatus::not_meshed;
  }
  [[nodiscard]] const CompositeResult& of(std::size_t face) const { return is_of_triangles(face) ? triangles : patches; }
};

/// Leaves out faces that are given by triangles: patches are meshed first.
void leave_out_triangles(Model& model);

/// Diagonal of the box of both.
double diagonal_with(const ModelSupports& supports, const discrete::DiscreteCad& triangles);

/// Meshes the faces of the model that are given by triangles: see mesh_discrete().
std::shared_ptr<const PartResults> mesh_beside(CompositeResult patches, const Model& model,
                                               const discrete::DiscreteCad& triangles, Cad& cad,
                                               CompositeOptions options, Monitor& monitor);

/// Joins two meshes that share nothing: first `patches`, then `triangles`, whose curves and corners are numbered behind
/// the references `largest`. Faces are in the order of `patches`. Atlas, spaces and graded field stay in the parts.
CompositeResult beside_each_other(const CompositeResult& patches, const CompositeResult& triangles,
                                  const LargestReferences& largest);

}  // namespace carreau
