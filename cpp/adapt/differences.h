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

/// Prescribes at each vertex of a mesh of the plane z = 0 by derivatives of the field itself: steps are 1e-4 of the
/// mesh's diagonal, or a quarter of the shortest edge at the vertex where that is shorter. Where an edge is more than
/// twice as long in the metric of its middle as in those of its ends, they do not see what is between them, and take
/// the metric of the middle too (intersection). The crew shares the estimate; `exact` is asked from the calling thread for
/// all points. Throws what estimate() throws.
VertexPrescriptions estimate_function(std::span<const Vec3> vertices,
                                      std::span<const std::array<std::int32_t, 3>> triangles,
                                      const FieldFunction& exact, const EstimatorOptions& options, const Crew& crew = {},
                                      Monitor* monitor = nullptr);

/// The function whose values the processes of a team share: each asks its own for some of the points, and all get all. At
/// some points each asks its own, too: InvalidModel names the rank whose values are others than those of rank 0. Without a
/// team it is `exact` itself. References only. All processes call it together.
FieldFunction shared_function(const FieldFunction& exact, const Crew& crew, Monitor& monitor);

}  // namespace carreau
