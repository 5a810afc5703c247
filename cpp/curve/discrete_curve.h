// SPDX-License-Identifier: BSD-3-Clause
// One discretisation for each curve of space, carried into every parameter domain that holds it (HDR sec. 4.5.3).
#pragma once

#include <vector>

#include "curve/curve_model.h"
#include "curve/curve_sizes.h"

namespace carreau {

/// The vertices 0..n of a curve in the direction of its first use, and their images in each use's domain.
struct DiscreteCurve {
  int curve = 0;             ///< index in Topology::curves
  bool indivisible = false;  ///< one point of space: a single segment that is never split (HDR sec. 4.5.4)
  bool prescribed = false;   ///< its edges are given (FaceCurve::edges): they are never split or moved
  int owner = 0;             ///< the use on whose surface the vertices are; not 0 only where its edges are prescribed
  std::vector<double> r;     ///< fractions of the length in space, r.front() = 0, r.back() = 1
  std::vector<Vec3> xyz;     ///< on the owner's surface; the two ends are the corner points
  /// [use][vertex]: descending where the use is reversed.
  std::vector<std::vector<double>> t_of_use;
  std::vector<std::vector<Vec2>> uv_of_use;  ///< [use][vertex], exact values of curv0
  std::vector<double> size;                  ///< desired size at each vertex; at the ends the size of the corner points
  std::vector<double> physical;  ///< the physical part of it, which surfaces interpolate when the host does not answer
  SizeSamples sizes;             ///< along the curve
  /// Largest distance found between a vertex and its position on another use's surface, model length. Measured at all
  /// vertices of the uses in `refined`, at the ends and a few vertices of the others.
  double gap = 0;
  int gap_use = 0;            ///< the use that it was found in
  std::vector<char> refined;  ///< [use]: parameters were improved by refine_t because interpolation was not enough

  [[nodiscard]] int segments() const noexcept { return static_cast<int>(r.size()) - 1; }
};

/// Discretises one curve and carries it. A closed curve has at least three segments, a curve that is one point of
/// space exactly one. Throws the host's exceptions, LimitError.
DiscreteCurve discretise_curve(const CurveModel& model, int curve, SizeRules& rules, const CurveOptions& options = {});

/// Cuts segment k at `share` of its length in space, in every use: the new vertex is k + 1. Returns false, with no
/// change, when the curve is one point of space, its edges are prescribed, or the segment cannot be divided in
/// floating-point numbers.
bool split_segment(DiscreteCurve& discrete, int k, const CurveModel& model, double share = 0.5);

/// Moves the vertices inside a curve to other fractions of its length, ascending, strictly between 0 and 1, in every
/// use. A curve that is one point of space or whose edges are prescribed does not change.
void place_vertices(DiscreteCurve& discrete, const std::vector<double>& inside, const CurveModel& model);
/// The same at given parameters of the owner's use, also on curves whose edges are prescribed.
void place_vertices_at(DiscreteCurve& discrete, const std::vector<double>& inside, const std::vector<double>& t,
                       const CurveModel& model);

}  // namespace carreau
