// SPDX-License-Identifier: BSD-3-Clause
// Distances of triangles from the surface, computed from data at their corners.
#pragma once

#include <array>

#include "size/size_rules.h"
#include "support/vec.h"

namespace carreau {

/// Shares of an edge where its offsets are sampled. The offset of an arc is largest in its middle, the offset of an S
/// at 0.21 and 0.79.
inline constexpr std::array<double, 3> along_edge{0.21, 0.5, 0.79};

/// Offset, at the share s of an edge, of the cubic that leaves both ends in the tangent planes of the surface. Source:
/// cubic patches of Vlachos et al., "Curved PN triangles", 2001. `p`: height of the last end over the tangent plane of
/// the first; `q`: height of the first end over the tangent plane of the last.
constexpr double cubic_offset(double s, double p, double q) noexcept { return s * (1 - s) * ((1 - s) * p + s * q); }

/// The limits of angles and distances between a mesh and its surface.
class KeptAgreement {
 public:
  explicit KeptAgreement(const GeometricLimits& kept);

  /// The largest angle or offset of a triangle as a share of the limit; up to 1 the triangle is within; infinity: it is turned
  /// over though its plane has a limit. Uses the cubics
  /// of its edges, and the middle of the patch that they bound: the mean of the six offsets of their control points.
  /// `normals`: of the surface at the corners, of unit length, or zero where it has none.
  [[nodiscard]] double share(const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals) const noexcept;
  /// Sine of the angle that is kept between an edge and the tangent planes at its ends; infinity: any.
  [[nodiscard]] double sine() const noexcept { return sine_; }
  /// True if the plane of a triangle makes a larger angle than is kept with a tangent plane at its corners.
  [[nodiscard]] bool leans(const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals) const noexcept;

 private:
  /// The sine of the largest angle of the plane with a tangent plane, as a share of the limit's; 0 if any angle is allowed.
  [[nodiscard]] double lean(const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals) const noexcept;

  double sine_, least_cosine_, deviation_;
};

}  // namespace carreau
