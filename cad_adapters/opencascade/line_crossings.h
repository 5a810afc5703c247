// SPDX-License-Identifier: BSD-3-Clause
// Crossings of curves of a parameter plane with lines of constant u or v.
#pragma once

#include <Geom2d_Curve.hxx>
#include <gp_Pnt2d.hxx>
#include <vector>

namespace carreau_occ {

/// Points of a curve that follow it, both ends included: enough for each of its polynomials.
std::vector<gp_Pnt2d> sampled(const Handle(Geom2d_Curve) & curve, double first, double last);

/// Parameters of crossings, ascending and inside (first, last). The curve crosses the line, touches it at a sample, or
/// begins or ends to run along it, for more than `run`. On the line: within `near`. Ends of the curve on the line are
/// no crossings.
std::vector<double> crossings(const Handle(Geom2d_Curve) & curve, double first, double last, bool of_u, double at,
                              double near, double run);

}  // namespace carreau_occ
