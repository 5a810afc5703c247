// SPDX-License-Identifier: BSD-3-Clause
// Converts a scalar field on a mesh to the sizes or metrics of a better mesh (HDR sec. 3.4.3).
#pragma once

#include <vector>

#include "adapt/recovery.h"
#include "metric/metric3.h"

namespace carreau {

/// Source of the error estimate (HDR sec. 3.4.3 a.1, a.2, a.3).
enum class ErrorSource : int {
  hessian = 0,      ///< interpolation error of the field: 2/9 M h^2 (eq. 3.3)
  curvature = 1,    ///< angle between edges and tangent planes of the graph z = field (a.2)
  deformation = 2,  ///< distance from the graph's tangent planes (a.3)
};

/// Kind of prescription.
enum class ErrorShape : int {
  isotropic = 0,    ///< a size: circles in the mesh's plane
  graph = 1,        ///< circles in the tangent planes of the graph, ellipses in the mesh's plane
  anisotropic = 2,  ///< by both principal values: ellipses in the mesh's plane and on the graph
};

/// Method that finds derivatives from values at vertices.
enum class Recovery : int {
  fit = 0,         ///< quadratics through each vertex: recover_derivatives()
  projection = 1,  ///< the double L2 projection, of plane meshes: project_derivatives()
  quadric = 2,     ///< quadrics on the graph of a plane mesh (HDR sec. 3.4.3 a.2): quadric_derivatives()
};

struct EstimatorOptions {
  ErrorSource source = ErrorSource::hessian;
  ErrorShape shape = ErrorShape::isotropic;
  /// Hessian, deformation: largest error, in units of the field; with `relative`, over the field's absolute value.
  /// Curvature: largest angle between an edge and the tangent plane, degrees, below 90.
  double tolerance = 0.01;
  bool relative = false;  ///< Hessian and deformation
  /// Below this share of its largest absolute value, the field does not make a relative error larger.
  double relative_floor = 0.1;
  /// Bounds of sizes: in the mesh's plane for the Hessian, in the graph's tangent plane otherwise.
  double hmin = 0, hmax = 0;
  double ratio = 1000;  ///< largest ratio of the two sizes of a metric, at least 1
  Recovery recovery = Recovery::fit;
};

/// Sizes or metrics at the vertices of a mesh: ErrorShape selects one of them, the other is empty.
struct VertexPrescriptions {
  std::vector<double> sizes;
  /// In the direction normal to the mesh the size is the smaller of the two in its plane.
  std::vector<Metric3> metrics;
  std::size_t unreliable = 0;  ///< vertices with too few neighbours for second derivatives; they have hmax
};

/// Prescribes at each vertex of field's mesh. Throws InvalidArgument unless 0 < hmin <= hmax, tolerance > 0 and ratio
/// >= 1, and the exceptions of check_field. For `curvature`, `deformation` and `graph` the mesh is in the plane z = 0.
/// The result does not depend on the executor; `monitor` may be null.
VertexPrescriptions estimate(const ScalarField& field, const EstimatorOptions& options, const Executor& executor = {},
                             Monitor* monitor = nullptr);

/// For several fields on one mesh at once: the smallest of the sizes, or the intersection of the metrics in the mesh's
/// plane (RR-2818 sec. 4.3.4). `values` holds vertex by vertex one value of each field. Tolerance and floor apply to
/// each field separately. Throws InvalidArgument when values are no multiple of `fields`, and as above.
VertexPrescriptions estimate_all(std::span<const Vec3> vertices,
                                 std::span<const std::array<std::int32_t, 3>> triangles,
                                 std::span<const double> values, std::size_t fields, const EstimatorOptions& options,
                                 const Executor& executor = {}, Monitor* monitor = nullptr);

/// The largest estimated_error() of several fields on one mesh, as estimate_all() has them.
double estimated_error_of_all(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                              std::span<const double> values, std::size_t fields, const EstimatorOptions& options,
                              const Executor& executor = {}, Monitor* monitor = nullptr);

/// Prescribes by derivatives that are already known (an exact Hessian, project_derivatives()).
VertexPrescriptions estimate(const ScalarField& field, const std::vector<LocalDerivatives>& derivatives,
                             const EstimatorOptions& options, const Executor& executor = {}, Monitor* monitor = nullptr);

/// Estimates the largest error of the field on its mesh, in the unit of `tolerance`, from the derivatives at both ends of each edge d.
/// Hessian: 2/9 |d^T H d| (HDR eq. 3.3). Curvature: angle between the edge of the graph and the tangent plane. Deformation: distance of
/// the edge's other end from the tangent plane. Bounds of sizes do not count. Throws the exceptions of estimate().
double estimated_error(const ScalarField& field, const EstimatorOptions& options, const Executor& executor = {}, Monitor* monitor = nullptr);
double estimated_error(const ScalarField& field, const std::vector<LocalDerivatives>& derivatives, const EstimatorOptions& options);

}  // namespace carreau
