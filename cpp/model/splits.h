// SPDX-License-Identifier: BSD-3-Clause
// Cuts of curves that let gluing find all common parts (HDR sec. 4.5.1).
#pragma once

#include <span>
#include <vector>

#include "model/topology.h"

namespace carreau {

/// An end of a curve of another face lies on a curve, away from its ends.
struct CurveSplit {
  std::size_t face = 0, curve = 0;  ///< indices of the curve that is to be cut
  double arc = 0;                   ///< usual length along its trace, from its start
  Vec3 end;                         ///< the end that lies there
  double gap = 0;                   ///< distance of the end from the trace
};

/// For each face, curve and arc: ends within eps of a curve, measured to its trace; the curve may be farther from the
/// end by the trace's deviation. Ends that are one (merged within eps) cut a curve once, at their nearest. A curve is
/// never cut within eps of its own ends. Internal curves cut and are cut like boundaries. Only curves_to_glue() are cut
/// and cut others. Throws InvalidArgument when traces are missing.
std::vector<CurveSplit> find_splits(const Model& model, const CurveTraces& traces, double eps);

/// The model with curves cut; if it has references, parts behind the first, and points between, get new ones: `t[i]`
/// strictly inside the host's interval, ascending for one curve.
struct CurveCut {
  std::size_t face = 0, curve = 0;
  double a = 0, b = 1;    ///< the curve's interval
  std::vector<double> t;  ///< one or more
};
Model cut_curves(const Model& model, std::span<const CurveCut> cuts);

}  // namespace carreau
