// SPDX-License-Identifier: BSD-3-Clause
// Sizes along a whole curve, sampled densely enough for interpolation between samples.
#pragma once

#include <vector>

#include "curve/curve_model.h"
#include "size/size_law.h"
#include "size/size_rules.h"

namespace carreau {

/// Which size holds at the two ends of a curve whose interior is answered. In RT-0232 sec. 6.2 sizes hold on curves
/// "hors extremites": the size of the end point and the curve's own may differ by a jump.
enum class EndSizes {
  of_curve,  ///< the curve's own sizes reach its ends: the end point has no influence on the spacing
  of_point,  ///< the size of the end point replaces the curve's at r = 0 and r = 1
};

struct SizeSamples;

struct CurveOptions {
  EndSizes ends = EndSizes::of_curve;
  /// Length of a sub-segment, unit edges (LSS, RT-0232 sec. 3.3): the smaller, the closer the samples of sizes.
  double lss = 0.5;
  /// Distance between two uses' images of a vertex, over its size, above which parameters are refined.
  double carry_tolerance = 1e-3;
  /// Known sizes: nothing is sampled, and these are also the sizes at the ends. Null: sample_sizes().
  const SizeSamples* known = nullptr;
};

/// Sizes at fractions r of a curve's length: r.front() = 0, r.back() = 1, ascending.
struct SizeSamples {
  std::vector<double> r;
  std::vector<double> h;         ///< min of physical and geometric
  std::vector<double> physical;  ///< +infinity when physical sizes are ignored
  SizeLaw law = SizeLaw::linear;

  [[nodiscard]] double size_at(double at) const noexcept;
  [[nodiscard]] double physical_at(double at) const noexcept;
};

/// Samples the sizes of a curve. Two samples and no callback when the size is constant. Two samples when no source
/// answers along the curve and curvature is ignored (the interpolation law is then exact). Otherwise intervals are
/// halved until each is at most 4 lss unit edges long and its ends differ by at most 15 %, or it is shorter than lss /
/// 2. If sizes come from curvature, they are also halved until the curve turns by at most 90 degrees in each. Throws
/// InvalidArgument unless lss is positive.
SizeSamples sample_sizes(const CurveModel& model, int curve, SizeRules& rules, const CurveOptions& options = {});

}  // namespace carreau
