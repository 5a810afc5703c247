// SPDX-License-Identifier: BSD-3-Clause
// Quadrilaterals made of the triangles of a whole mesh (RT-0232 sec. 7, HDR sec. 3.3.4).
#pragma once

#include "surface/elements/quadratic.h"
#include "surface/elements/work.h"

namespace carreau {

/// Joins triangles of each face two by two, mends what has few or many cells around, and smooths. With
/// has_quads_only(work.options.element) the mesh, which was made with sizes twice those asked for, is then cut: each
/// quadrilateral into four, each triangle into three, each edge of curves (work.curves too) in two at half its metric
/// length, once for all faces; sizes and spaces of the result are those of the cut mesh afterwards. Vertices lie on the
/// surface. Keeps vertex_size and curve_size up to date. The same for any number of threads. Throws what the host
/// throws, and Cancelled. The result: what is turned over somewhere even so, in (u, v) or in space, the edges of curves
/// (those of the result) and the lengths there that are too coarse for it. Without has_quads_only() there is none.
QuadraticReport make_quadrilaterals(const ElementWork& work);

/// What was made with sizes twice those asked for is made with the latter: sizes of faces, of their insides and of curves. Those of vertices
/// and of curve_size stay.
void halve_sizes(CompositeResult& result, std::vector<DiscreteCurve>& curves);

/// How many times as large as asked for sizes must be in the mesh that make_quadrilaterals() gets.
constexpr double enlargement_for(Element element) noexcept { return has_quads_only(element) ? 2 : 1; }

}  // namespace carreau
