// SPDX-License-Identifier: BSD-3-Clause
// One discretisation for each class of curves, carried by the maps.
#pragma once

#include <vector>

#include "curve/discrete_curve.h"
#include "periodic/periodic_model.h"

namespace carreau {

/// Gives all members of a class the least of their sizes at corresponding places. `sizes`: by curve.
void share_sizes(const PeriodicModel& periodic, const CurveModel& model, std::vector<SizeSamples>& sizes);

/// Cuts the root of each class like the member whose edges are prescribed, or by its own sizes, with vertices where closed
/// members begin, symmetric if it turns; then carries its vertices onto the other members. Throws InvalidModel: members
/// with different prescribed edges.
void share_vertices(const PeriodicModel& periodic, const CurveModel& model, std::vector<DiscreteCurve>& curves);

/// Carries the vertices of the root of each class, as it is, onto the other members.
void carry_vertices(const PeriodicModel& periodic, const CurveModel& model, std::vector<DiscreteCurve>& curves);

/// Gives all members of each class the vertices that any of them has. Returns the curves that have changed, ascending.
std::vector<int> complete_classes(const PeriodicModel& periodic, const CurveModel& model, std::vector<DiscreteCurve>& curves);

/// The vertex of `to` that is the image of vertex k; -1: there is none.
int vertex_image(const DiscreteCurve& from, const DiscreteCurve& to, const CurveImage& image, bool closed, int k);

}  // namespace carreau
