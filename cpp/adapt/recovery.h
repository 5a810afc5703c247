// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of a field that is known at the vertices of a mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "adapt/scalar_field.h"
#include "metric/metric2.h"
#include "support/ranks/executor.h"

namespace carreau {

/// Plane of the derivatives at a vertex: e1, e2 and the normal (of either sense) are orthonormal. On meshes of the
/// plane z = 0 they are the axes x, y, z.
struct VertexFrame {
  Vec3 e1{1, 0, 0}, e2{0, 1, 0}, normal{0, 0, 1};
  [[nodiscard]] Vec2 in_plane(const Vec3& d) const noexcept { return {dot(d, e1), dot(d, e2)}; }
};

/// Value, gradient and Hessian of the field at a vertex, in the coordinates of `frame`.
struct LocalDerivatives {
  VertexFrame frame;
  Vec2 gradient;
  Metric2 hessian{0, 0, 0};  ///< symmetric, of any sign
  bool reliable = true;      ///< false: too few neighbours for a Hessian; it is zero
};

/// Quadratic polynomials through each vertex that fit its neighbours by least squares, with larger weights for nearer
/// ones. The neighbours are two rings, or three if two do not determine the polynomial (at the boundary). Exact on
/// quadratics. On smooth fields the gradient has an error of order 2, the Hessian of order 1 (2 where neighbours lie
/// symmetrically). The plane of a vertex is normal to the mean of its triangles' normals weighted by area. The result
/// does not depend on the executor. Throws the exceptions of check_field, and Cancelled soon after a stop of `monitor`,
/// which may be null.
std::vector<LocalDerivatives> recover_derivatives(const ScalarField& field, const Executor& executor = {},
                                                  Monitor* monitor = nullptr);

/// The integral of each triangle's gradient, averaged over the triangles of a vertex by area, twice: the double L2
/// projection with lumped masses. Smoother than the fit; of order 1 on meshes that are nearly regular, biased on the
/// boundary. Plane meshes only (the frame is (x, y)).
std::vector<LocalDerivatives> project_derivatives(const ScalarField& field);

/// Derivatives from the graph z = field (HDR sec. 3.4.3 a.2). The gradient is the slope of the mean of the unit normals of
/// adjacent triangles, weighted by their angles (the paper leaves the weights open). The Hessian belongs to the quadric
/// that is centred at the vertex, normal to that mean, and nearest to the neighbours. On steep fronts its curvatures
/// are nearer to the graph's than the curvatures of a polynomial; on irregular meshes they do not converge. Plane meshes only (the frame is (x, y)).
std::vector<LocalDerivatives> quadric_derivatives(const ScalarField& field);

}  // namespace carreau
