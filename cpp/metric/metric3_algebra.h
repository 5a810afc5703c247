// SPDX-License-Identifier: BSD-3-Clause
// Decompositions, interpolation and intersection of metrics of space; ways to combine metrics.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "metric/metric2_algebra.h"
#include "metric/metric3.h"

namespace carreau {

/// M = sum of value[i] axis[i] axis[i]^T, values descending, axes orthonormal.
struct Eigen3 {
  std::array<double, 3> value{1, 1, 1};
  std::array<Vec3, 3> axis{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};
/// Any finite symmetric tensor. The values of a positive definite one are positive; errors are a few units in the last
/// place of the largest entry.
Eigen3 eigen(const Metric3& m) noexcept;
/// The tensor with this decomposition; axes need not be orthonormal.
Metric3 compose(const Eigen3& e) noexcept;

/// Finite, and the smallest eigenvalue is not lost in the rounding of the entries (condition below 1e15).
bool is_positive_definite(const Metric3& m) noexcept;
bool is_positive_definite(Metric2 m) noexcept;

/// The nearest tensor with eigenvalues in [low, high], same eigenvectors; a tensor within is returned as it is.
Metric3 clamp_eigenvalues(const Metric3& m, double low, double high) noexcept;
/// The symmetric S with S S = M; M positive semi-definite.
Metric3 square_root(const Metric3& m) noexcept;

/// Simultaneous reduction (RR-2818 sec. 4.3.2): p = sum of axis axis^T, q = sum of ratio[i] axis axis^T. The axes are
/// dual to the common conjugate directions; ratios descending.
struct Reduction3 {
  std::array<double, 3> ratio{1, 1, 1};
  std::array<Vec3, 3> axis{};
};
/// Both positive definite. Through triangular factors of both, so that no power of a condition is squared.
Reduction3 reduce(const Metric3& p, const Metric3& q) noexcept;

/// Largest and smallest ratio of lengths in `m` to lengths in `reference`. Both positive definite.
LengthRatios length_ratios(const Metric3& m, const Metric3& reference) noexcept;

/// As for plane metrics: sizes along the axes of the reduction follow the law (RR-2818 sec. 4.3.2). Exactly symmetric:
/// (p, q, t) is (q, p, 1 - t) whenever 1 - t is exact.
Metric3 interpolate(const Metric3& p, const Metric3& q, double t, MetricLaw law) noexcept;

/// The metric of the largest ellipsoid inside both unit balls (RR-2818 sec. 4.3.4). Does not depend on the order.
Metric3 intersection(const Metric3& p, const Metric3& q) noexcept;

/// An ellipsoid inside all unit balls, by intersections of two (RR-2818 sec. 4.3.4), the smallest ball first. It does
/// not depend on the order of the arguments, nor on rotations. From three metrics on, it is not the largest one in
/// general. Requires at least one metric.
Metric3 intersection(std::span<const Metric3> metrics);
Metric2 intersection(std::span<const Metric2> metrics);

/// Combinations of a prescribed metric with another that must not be exceeded (RR-2928 sec. 5.3).
enum class MetricCombination : int {
  scale = 0,         ///< the prescribed one keeps its shape and shrinks until it lies inside (eq. 57)
  intersection = 1,  ///< largest ellipsoid inside both
};
/// Positive definite both. The result is never larger than `prescribed` in any direction.
Metric3 combine(const Metric3& prescribed, const Metric3& bound, MetricCombination how) noexcept;
Metric2 combine(Metric2 prescribed, Metric2 bound, MetricCombination how) noexcept;

/// The metric with size h1 along `direction` (any length but zero) and h2 across it (HDR eq. 4.45). A tangent plane
/// that holds the direction has sizes h1 and h2.
Metric3 metric_of_sizes(const Vec3& direction, double h1, double h2) noexcept;

/// An orthonormal basis (e1, e2) of a tangent plane with su = p e1, sv = q e1 + r e2.
struct TangentFrame {
  Vec3 e1, e2;
  double p = 1, q = 0, r = 1;

  /// Empty if the parametrisation is degenerate: a derivative below 1e-12 of the other, or both parallel within 1e-10.
  static std::optional<TangentFrame> of(const Vec3& su, const Vec3& sv) noexcept;

  /// The restriction of a metric of space to the plane.
  [[nodiscard]] Metric2 restricted(const Metric3& m) const noexcept;
  /// The metric that one of the plane, in this basis, induces on the parameters (HDR eq. 4.66).
  [[nodiscard]] Metric2 induced(Metric2 tangent) const noexcept;
  /// Inverse of induced().
  [[nodiscard]] Metric2 of_parameters(Metric2 m) const noexcept;
  /// The metric of space that is `tangent` in the plane, with the given eigenvalue across it.
  [[nodiscard]] Metric3 in_space(Metric2 tangent, double across) const noexcept;
};

}  // namespace carreau
