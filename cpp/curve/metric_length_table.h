// SPDX-License-Identifier: BSD-3-Clause
// Lengths along a curve in a variable metric, and the points found on the way (RR-2818 sec. 4.4-4.6).
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace carreau {

/// The gradation of a curve: points whose abscissa s (usual length) and metric abscissa l are both known. Between two
/// of them the speed dl/ds is linear, so that l is a quadratic of s. k + 1 points, k intervals.
struct MetricLengthTable {
  std::vector<double> s, l;         ///< k + 1 each; s strictly ascending, l ascending from 0
  std::vector<double> first, last;  ///< speeds at the start and the end of each interval, k each

  /// Length of the curve in the metric.
  [[nodiscard]] double length() const noexcept { return l.back(); }
  /// Metric abscissa at usual abscissa `at` (clamped).
  [[nodiscard]] double metric_abscissa(double at) const noexcept;
};

/// sqrt(T^t M T) at abscissa s of a piece, T the unit tangent there: finite and >= 0.
using PieceSpeed = std::function<double(std::size_t piece, double s)>;

/// Trapezoids, halved until all are at most `lss` unit edges long and halving once more changes the length by less than
/// 0.002. (RR-2818 sec. 4.4 has the first condition only.) The speed may jump between pieces: piece i runs from
/// breaks[i] to breaks[i + 1] (strictly ascending). Each value of the speed is evaluated once a piece. Throws
/// InvalidArgument when breaks or lss mean nothing or a speed is negative or not finite, LimitError beyond 20 million
/// edges.
MetricLengthTable measure_curve(const PieceSpeed& speed, std::span<const double> breaks, double lss);

/// The n + 1 usual abscissae that cut a curve into n >= 1 edges of equal metric length (RR-2818 sec. 4.6). They are
/// found between the points of the gradation without another evaluation.
std::vector<double> split_equally(const MetricLengthTable& gradation, int n);

}  // namespace carreau
