// SPDX-License-Identifier: BSD-3-Clause
// The curves of a mesh with the parameters of their vertices.
#pragma once

#include <vector>

#include "curve/curve_model.h"
#include "curve/discrete_curve.h"
#include "curve/edge_accuracy.h"
#include "mesh/surface_mesh.h"

namespace carreau {

/// A curve between two corners, without vertices inside. `from`, `to`: the corners in space.
DiscreteCurve undivided_curve(const CurveModel& model, std::size_t curve, const Vec3& from, const Vec3& to);

/// The curves of a mesh by curve of the topology: the known parameters place the vertices in every use. Throws InvalidArgument with the
/// reference of a curve whose vertices have no parameters, and the exceptions of the geometry.
std::vector<DiscreteCurve> curves_of_mesh(const CurveModel& model, const SurfaceMesh& mesh, const std::vector<CurveParameters>& parameters);

/// The parameters of the vertices of these curves, by curve.
std::vector<CurveParameters> parameters_of_curves(const CurveModel& model, const std::vector<DiscreteCurve>& curves);

}  // namespace carreau
