// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals made of the triangles of a whole mesh (RT-0232 sec. 7, HDR sec. 3.3.4).
#pragma once

#include "surface/elements/second_order/quadratic.h"
#include "surface/elements/base/work.h"

namespace carreau {

class KnownQuads;

/// Joins triangles of each face two by two, improves vertices with few or many cells around, and smooths. With
/// has_quads_only(work.options.element) the mesh was made with twice the prescribed sizes. It is then cut: each
/// quadrilateral into four, each triangle into three. Edges of curves (work.curves too) are cut in two at half their
/// metric length, once for all faces. Sizes and spaces of the result belong to the cut mesh. Vertices lie on the
/// surface. Keeps vertex_size and curve_size up to date. The same for any number of threads. Throws the exceptions of
/// the host, and Cancelled. Returns the elements that are still turned over, in (u, v) or in space. Adds the edges of
/// curves in the result and the lengths there that are too coarse. Without has_quads_only() the report is empty. `known`: cells
/// of faces in an earlier round, which the run replaces; null: none.
QuadraticReport make_quadrilaterals(const ElementWork& work, KnownQuads* known = nullptr);

/// Halves the sizes of faces, of their insides and of curves, for a mesh that was made with twice the prescribed sizes. Sizes of vertices
/// and curve_size stay.
void halve_sizes(CompositeResult& result, std::vector<DiscreteCurve>& curves);

/// The factor between the sizes of the mesh that make_quadrilaterals() gets and the prescribed sizes.
constexpr double enlargement_for(Element element) noexcept { return has_quads_only(element) ? 2 : 1; }

}  // namespace carreau
