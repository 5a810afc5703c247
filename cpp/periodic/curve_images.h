// SPDX-License-Identifier: BSD-3-Clause
// Curves as images of other curves under a map of space.
#pragma once

#include <cmath>
#include <map>
#include <optional>

#include "curve/curve_model.h"
#include "model/isometry.h"

namespace carreau {

/// The point at fraction r of a curve's length goes to fraction shift + r of the image, or shift - r where it is
/// reversed; on closed curves to the fractional part of it.
struct CurveImage {
  int curve = -1;  ///< index in Topology::curves
  bool reversed = false;
  double shift = 0;  ///< of an open curve 0, or 1 where it is reversed

  [[nodiscard]] double at(double r) const noexcept { return reversed ? shift - r : shift + r; }
  /// The fraction of the curve whose image this is.
  [[nodiscard]] double back(double r) const noexcept { return reversed ? shift - r : r - shift; }
};

/// Fraction in [0, 1[ of a closed curve; fractions next to 0 and 1 become 0.
double wrapped(double r) noexcept;

/// The image of an image.
CurveImage composed(const CurveImage& first, const CurveImage& second) noexcept;
/// From the image `image.curve` back to curve `from`.
CurveImage inverse(int from, const CurveImage& image) noexcept;

/// A curve with a few of its points.
struct CurveShape {
  int curve = -1;
  bool degenerate = false, closed = false;
  double length = 0;
  Vec3 low{0, 0, 0}, high{0, 0, 0};  ///< box of its support
};
CurveShape shape_of(const CurveModel& model, int curve);

/// Point of a curve's support at fraction r of its length, in the direction of the first use.
Vec3 support_point(const CurveModel& model, int curve, double r);

/// The point of a curve closest to `target`, sought from fraction r of its length, in use `use` of the curve.
CurvePoint closest_on_curve(const CurveModel& model, int curve, std::size_t use, double r, const Vec3& target);

/// How the map carries curve `from` onto curve `to`; empty: it does not, within `gap` (model length).
std::optional<CurveImage> image_of(const CurveModel& model, const CurveShape& from, const CurveShape& to, const Isometry& map,
                                   double gap);

}  // namespace carreau
