// SPDX-License-Identifier: BSD-3-Clause
// Directions in which squares are to lie: tangent to the boundary, smooth inside.
#pragma once

#include <complex>
#include <vector>

#include "metric/metric2.h"
#include "plane/kernel/triangulation.h"
#include "support/monitor.h"

namespace carreau::plane {

/// Directions of the plane as complex numbers of an orthonormal frame of a metric (its Cholesky factor).
struct MetricFrame {
  double p, q, r;
  explicit MetricFrame(Metric2 m) noexcept;
  [[nodiscard]] std::complex<double> to_frame(const Vec2& d) const noexcept {
    return {p * d.x() + q * d.y(), r * d.y()};
  }
  [[nodiscard]] Vec2 from_frame(std::complex<double> z) const noexcept {
    const double y = z.imag() / r;
    return {(z.real() - q * y) / p, y};
  }
};

/// A unit cross at each vertex of a triangulation, as the fourth power of one of its arms in the frame of the vertex.
/// Parallel along an edge are crosses that make the same angle with it at both ends, in the metrics there.
class CrossField {
 public:
  /// The field of a mesh that has metrics at its vertices. Crosses at imposed edges are tangent to them; inside their
  /// squared differences along edges have the least sum. Keeps a reference to the mesh.
  CrossField(const Triangulation& mesh, Monitor& monitor);
  /// One arm of the cross at p, a unit vector of the frame of `at_p`. `triangle`: a triangle of the mesh near p; it
  /// becomes the triangle that holds p, if known.
  [[nodiscard]] std::complex<double> arm(const Vec2& p, const MetricFrame& at_p, int& triangle) const;

 private:
  const Triangulation& mesh_;
  std::vector<MetricFrame> frames_;  // by vertex, like
  std::vector<std::complex<double>> cross_;
};

}  // namespace carreau::plane
