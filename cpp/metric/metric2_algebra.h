// SPDX-License-Identifier: BSD-3-Clause
// Decompositions, interpolation and intersection of plane metrics: functions that are not needed millions of times.
#pragma once

#include "metric/metric2.h"

namespace carreau {

/// a c - b^2 with an error of two units in the last place, however close to singular the tensor is.
double accurate_determinant(Metric2 m) noexcept;

/// M = major d d^T + minor n n^T with d = (cos, sin) and n = (-sin, cos).
struct Eigen2 {
  double major = 1, minor = 1;  ///< eigenvalues, major >= minor; minor >= 0 when the tensor is semi-definite
  Vec2 direction{1, 0};         ///< unit eigenvector of the major eigenvalue
};
/// Any finite symmetric tensor.
Eigen2 eigen(Metric2 m) noexcept;
/// The tensor with this decomposition.
Metric2 compose(const Eigen2& e) noexcept;

/// The nearest tensor with eigenvalues in [low, high], same eigenvectors; 0 <= low <= high. Any finite symmetric
/// tensor; a tensor within the bounds is returned as it is.
Metric2 clamp_eigenvalues(Metric2 m, double low, double high) noexcept;

/// The symmetric positive (semi-)definite S with S S = M: the metric's stretch, in units of lengths and not of their
/// squares. M positive semi-definite.
Metric2 square_root(Metric2 m) noexcept;
/// S S.
constexpr Metric2 square(Metric2 s) noexcept {
  return {s.a * s.a + s.b * s.b, s.b * (s.a + s.c), s.b * s.b + s.c * s.c};
}

/// Largest and smallest ratio of lengths in `m` to lengths in `reference` over all directions. Both positive definite.
struct LengthRatios {
  double smallest = 1, largest = 1;
};
LengthRatios length_ratios(Metric2 m, Metric2 reference) noexcept;
/// max over directions of |length in m / length in reference - 1|.
double length_error(Metric2 m, Metric2 reference) noexcept;

/// Laws for the sizes along the axes of the simultaneous reduction (RR-2818 sec. 4.3.2).
enum class MetricLaw : int { linear = 0, geometric = 1, sinusoidal = 2 };

/// Size at fraction t between 1 (t = 0) and h (t = 1).
double size_between(double h, double t, MetricLaw law) noexcept;

/// The metric at fraction t in [0, 1] between two positive definite ones (RR-2818 sec. 4.3.2). It is exact at both
/// ends, positive definite between, and turns and stretches with the coordinates. Symmetric: (p, q, t) is (q, p, 1 -
/// t).
Metric2 interpolate(Metric2 p, Metric2 q, double t, MetricLaw law) noexcept;

/// The metric of the largest ellipse inside both unit circles that has their common conjugate axes (RR-2818 sec.
/// 4.3.4): it makes no vector shorter than p or q does. Both positive definite.
Metric2 intersection(Metric2 p, Metric2 q) noexcept;

}  // namespace carreau
