// SPDX-License-Identifier: BSD-3-Clause
// Transfer of values at vertices to a new mesh, and interpolation errors of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "adapt/differences.h"
#include "adapt/scalar_field.h"
#include "mesh/surface_mesh.h"

namespace carreau {

struct TransferredField {
  std::vector<double> values;  ///< row by row of the new mesh, components together
  std::int64_t outside = 0;    ///< vertices beside the old mesh by more than 1/8 of an edge; the nearest value holds
  double farthest = 0;         ///< distance of the farthest one, parameter length (model length: see below)
};

/// Rows of a field that is given at all nodes of a mesh: vertices, then nodes on edges (SurfaceMesh::mid_vertices).
std::size_t node_count(const SurfaceMesh& mesh) noexcept;

/// Interpolates linearly, from vertices of `from` to vertices of `to`, two meshes of one model. Each vertex is looked
/// up in the parameter plane of a face that both meshes have, so sheets that touch in space are not mixed up. From
/// there it is looked up among the triangles around in space, because a parameter plane stretches without bound towards
/// a pole. In space alone when there is no such face. Exact for fields that are linear in a plane, of second order in
/// the length of edges on surfaces. Values at all nodes of `from` (node_count) give values at all nodes of `to`. On
/// elements of second order their shape functions interpolate: exact for quadratic fields on plane elements with
/// straight sides, and of third order on surfaces. Values at vertices alone give values at vertices alone, for all
/// elements.
/// The result does not depend on the executor; `monitor` may be null.
/// Throws InvalidArgument unless `values` holds `components` > 0 numbers for each vertex of `from`, or for each node,
/// or when `from` has no triangle.
TransferredField transfer_field(const SurfaceMesh& from, const SurfaceMesh& to, std::span<const double> values,
                                std::size_t components, const Executor& executor = {}, Monitor* monitor = nullptr);

/// Distance between a field and its linear interpolation on a mesh, in the field's unit.
struct InterpolationError {
  double largest = 0;        ///< at the centres of triangles and the middles of edges
  double largest_share = 0;  ///< there, over the field's absolute value, or over relative_floor of its largest value at nodes
  double rms = 0;      ///< root of the mean square over the area, by the middles of edges (exact to degree 2)
};
/// Throws the exceptions of check_field; InvalidArgument when the function returns a number that is not finite.
InterpolationError interpolation_error(const ScalarField& field, const FieldFunction& exact, double relative_floor = 0.1);
/// Error of a field on all nodes (node_count) of elements of second order, interpolated by their shape functions. It is evaluated at the
/// centres and at the middles of edges of a quarter of each. The root mean square is taken of the middles, over the straight triangles.
/// Throws InvalidArgument unless the mesh has elements, all of second order, and values fit, are finite and not too large.
InterpolationError interpolation_error(const SurfaceMesh& mesh, std::span<const double> values, const FieldFunction& exact,
                                       double relative_floor = 0.1);

}  // namespace carreau
