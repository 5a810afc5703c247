// SPDX-License-Identifier: BSD-3-Clause
// Estimates for a field that can be evaluated anywhere in the plane, not only at the vertices of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "adapt/estimators.h"

namespace carreau {

/// The field at points of space.
using FieldFunction = std::function<void(std::span<const Vec3> points, std::span<double> values)>;

/// Gradient and Hessian in the plane z = 0 by central differences of second order, with the step of each point. Throws
/// InvalidArgument when the function returns a number that is not finite.
std::vector<LocalDerivatives> difference_derivatives(std::span<const Vec3> points, std::span<const double> steps,
                                                     const FieldFunction& exact);

/// Prescribes at each vertex of a mesh of the plane z = 0 by derivatives of the field itself. Steps are 1e-4 of the mesh's diagonal, or a
/// quarter of the shortest edge at the vertex if this is shorter. Each edge is measured in the metrics at its middle and at its ends. If
/// the middle's length is more than twice the ends' length, the ends missed a front, and are intersected with the metric of the middle.
/// Threads and processes share the estimate; the calling thread evaluates `exact` at all points. Throws the exceptions of estimate().
VertexPrescriptions estimate_function(std::span<const Vec3> vertices,
                                      std::span<const std::array<std::int32_t, 3>> triangles,
                                      const FieldFunction& exact, const EstimatorOptions& options, const Executor& executor = {},
                                      Monitor* monitor = nullptr);

/// estimated_error() by derivatives of the field itself, with these steps.
double estimated_error(const ScalarField& field, const FieldFunction& exact, const EstimatorOptions& options);

/// Returns a function whose values the processes share: each evaluates its own `exact` at some of the points, and all receive all values.
/// Each process also evaluates some compared points: InvalidModel names the rank if its values differ from the values of rank 0. For a
/// single process it is `exact` itself. References only. All processes call it together.
FieldFunction shared_function(const FieldFunction& exact, const Executor& executor, Monitor& monitor);

}  // namespace carreau
