// SPDX-License-Identifier: BSD-3-Clause
// Reports of elements that stay invalid, and the sizes that are requested for them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gradation/edge_sizes.h"
#include "mesh/surface_mesh.h"
#include "surface/options.h"

namespace carreau {

/// Returns the sides of an element between `corners`, with half of the longest side, or of `size`, as the size (the whole of it where
/// all elements are cut, since sizes describe the mesh that is cut).
std::vector<EdgeSizes::Source> finer_sides(std::span<const Vec3> corners, double size, Element element);
/// Sides of an element of a face, with its least prescribed size (`size`: at the vertices of the mesh).
std::vector<EdgeSizes::Source> finer_sides(const SurfaceMesh& mesh, const FaceMesh& face, const Cell& cell, const std::vector<double>& size, Element element);

/// Gives the face the status `mended`, and adds the returned sentence to its reasons.
std::string mark_invalid(FaceMesh& face, const Vec2& uv, std::size_t count);

}  // namespace carreau
