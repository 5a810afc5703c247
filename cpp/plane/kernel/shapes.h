// SPDX-License-Identifier: BSD-3-Clause
// Measures of a triangulation's edges and triangles: in mean tensors of the vertices; if the field bends, from lengths
// in the tensors halfway, and in charts.
#pragma once

#include <cstddef>
#include <cstdint>

#include "plane/kernel/frame.h"
#include "plane/kernel/triangulation.h"

namespace carreau::plane {

/// A triangle in the chart about its centroid.
struct ChartedTriangle {
  Chart chart;
  Vec2 a, b, c;

  /// `curved` false: the chart is the tensor alone.
  ChartedTriangle(const Field& field, Vec2 p, Vec2 q, Vec2 r, bool curved) noexcept
      : chart(field.chart((1.0 / 3) * (p + q + r), curved)), a(chart.at(p)), b(chart.at(q)), c(chart.at(r)) {}
};

/// Squared lengths of the edges of a triangle, and its area and shape (Heron). No plane triangle may have these
/// lengths; then its area is 0.
struct Lengths {
  double a, b, c;

  /// 16 times the squared area.
  [[nodiscard]] double area2() const noexcept {
    const double sum = a + b + c, h = sum * sum - 2 * (a * a + b * b + c * c);
    return h > 0 ? h : 0;
  }
  /// Q2 (HDR eq. 1.6).
  [[nodiscard]] double quality() const noexcept;
  /// Squared circumradius; may be infinite.
  [[nodiscard]] double radius2() const noexcept { return a * b * c / area2(); }
};

enum class Sizes : std::uint8_t {
  even,    ///< much the same over a triangle
  graded,  ///< change over many triangles, but rarely by much
  rough,   ///< change by much, or there are too few triangles: no lattice
};

class Shapes {
 public:
  Shapes(Triangulation& mesh, const Field& field) noexcept : mesh_(mesh), field_(field) {}

  /// Evaluates the field's metric at a vertex.
  void set_metric(int v) const noexcept;

  [[nodiscard]] bool is_bent(const Triangle& T) const noexcept { return mesh_.is_bent(T.v[0], T.v[1], T.v[2]); }
  [[nodiscard]] ChartedTriangle charted(const Triangle& T) const noexcept {
    const bool curved = !mesh_.is_kinked(T.v[0], T.v[1]) && !mesh_.is_kinked(T.v[1], T.v[2]);
    return {field_, mesh_.at(T.v[0]), mesh_.at(T.v[1]), mesh_.at(T.v[2]), curved};
  }
  /// Squared length of an edge: the tensor halfway is accurate to third order, as a chart is.
  [[nodiscard]] double squared_length(int u, int v) const noexcept {
    if (!mesh_.is_bent(u, v)) return mesh_.squared_length(u, v);
    return carreau::squared_length(field_.at(0.5 * (mesh_.at(u) + mesh_.at(v))), mesh_.at(u) - mesh_.at(v));
  }
  [[nodiscard]] Lengths lengths(int p, int q, int r) const noexcept {
    return {squared_length(q, r), squared_length(r, p), squared_length(p, q)};
  }
  /// Squared circumradius.
  [[nodiscard]] double squared_radius(int t) const noexcept;
  /// Largest over smallest determinant of the tensors at the vertices: 1.3 is 7 % of the size, 4 is 40 %.
  [[nodiscard]] double change(int t) const noexcept;
  /// Classifies the change of sizes over a sample of the triangles. `whole`: number of triangles of the mesh, if this is
  /// a part of it.
  [[nodiscard]] Sizes classify(std::size_t whole = 0) const noexcept;
  /// Q2 (HDR eq. 1.6); 0 unless counterclockwise (exactly).
  [[nodiscard]] double quality(int p, int q, int r) const noexcept;
  /// Q2 in the tensor at the centroid: if sizes or the parametrisation change much over a triangle, the metric of its
  /// middle gives its shape in space. Uses the lengths of bent triangles. 0 unless counterclockwise (exactly).
  [[nodiscard]] double quality_at_centroid(int p, int q, int r) const;

 private:
  [[nodiscard]] Lengths integrated_lengths(int p, int q, int r) const;

  Triangulation& mesh_;
  const Field& field_;
};

}  // namespace carreau::plane
