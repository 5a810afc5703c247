// SPDX-License-Identifier: BSD-3-Clause
// Reports of elements that stay invalid, and the sizes that are requested for them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gradation/edge_sizes.h"
#include "mesh/surface_mesh.h"
#include "surface/options.h"

namespace carreau {

/// Returns the sides of an element of a face. Their size is half of the longest side, or of the least prescribed size (`size`: at the vertices
/// of the mesh), the whole of it if all elements are cut, since sizes describe the mesh that is cut.
std::vector<EdgeSizes::Source> finer_sides(const SurfaceMesh& mesh, const FaceMesh& face, const Cell& cell, const std::vector<double>& size, Element element);

/// Gives the face the status `mended`, and adds the returned sentence to its reasons.
std::string mark_invalid(FaceMesh& face, const Vec2& uv, std::size_t count);

}  // namespace carreau
