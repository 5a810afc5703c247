// SPDX-License-Identifier: BSD-3-Clause
// The metric field of one parameter domain, sampled once and then evaluated without callbacks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "control_space/sample_gradation.h"
#include "metric/chart.h"
#include "metric/metric2.h"
#include "support/monitor.h"
#include "support/ranks/packet.h"

namespace carreau {

/// Gives the true metric at points of the domain. It must be finite; a semi-definite metric (a degenerate side) is
/// clamped. Called in batches of at most 4096 points, never for a point outside the domain given to the builder.
using MetricSampler = std::function<void(std::span<const Vec2> uv, std::span<Metric2> metric)>;

/// Sampler of metrics and first derivatives of the surface, for lengths and directions in space.
using SurfaceSampler =
    std::function<void(std::span<const Vec2> uv, std::span<Metric2> metric, std::span<SurfaceTangents> tangents)>;

struct ControlSpaceOptions {
  /// Largest relative error of a length, where the space is checked and the cells are not much smaller than the mesh.
  double tolerance = 0.01;
  /// Samples for each vertex of the mesh to come, where errors are smaller than edges can show. From some thousand
  /// vertices on fewer are taken.
  double samples_per_vertex = 1.5;
  /// Samples as if the mesh were small, and the tolerance also holds in cells smaller than its edges. Gradation needs
  /// this, because it bounds every kink.
  bool thorough = false;
  std::size_t min_samples = 60;       ///< approximate
  std::size_t max_samples = 200'000;  ///< a bound; values below 200 count as 200
  /// Points of the domain where the field has hidden details: around them cells are split down to half an edge of the
  /// mesh, whatever prediction gives.
  std::span<const Vec2> probe_points = {};
};

/// The closed parameter domain in which sampling is allowed: discretised loops, any orientation.
struct SampledDomain {
  std::vector<Vec2> vertices;
  std::vector<std::pair<int, int>> edges;  ///< boundary only
};

/// Control space of RR-2928 sec. 2: the square root of the metric, piecewise biquadratic on a balanced quadtree over
/// the domain's box. Continuous, symmetric positive definite. Copies and calls of at() are safe from several threads.
class ControlSpace {
 public:
  /// Samples `sampler` inside `domain` and refines where prediction and sample disagree. Deterministic. Throws
  /// DomainError when the domain has no area, the exceptions of the sampler, and Cancelled.
  static ControlSpace build(const SampledDomain& domain, const MetricSampler& sampler,
                            const ControlSpaceOptions& options, Monitor& monitor);
  /// Shrinks sizes until none grows by more than `slope` times the distance in space from one sample to the next ones.
  /// The sizes are isotropic, or, `directed`, each is taken along the line that joins the samples.
  static ControlSpace build_graded(const SampledDomain& domain, const SurfaceSampler& sampler, double slope,
                                   bool directed, const ControlSpaceOptions& options, Monitor& monitor);
  /// The same metric everywhere.
  static ControlSpace constant(Metric2 metric);

  /// Metric at (u, v). Points outside the box take the value of its nearest point.
  [[nodiscard]] Metric2 at(const Vec2& uv) const noexcept {
    const auto [leaf, s, t] = place(uv);
    const Leaf& l = *leaf;
    // Columns of coefficients: powers of s; rows: powers of t.
    double root[3];
    for (int k = 0; k < 3; ++k)
      root[k] = ((l.c[8][k] * s + l.c[7][k]) * s + l.c[6][k]) * (t * t) +
                ((l.c[5][k] * s + l.c[4][k]) * s + l.c[3][k]) * t + ((l.c[2][k] * s + l.c[1][k]) * s + l.c[0][k]);
    return {unit_.a * (root[0] * root[0] + root[1] * root[1]), unit_.b * (root[1] * (root[0] + root[2])),
            unit_.c * (root[1] * root[1] + root[2] * root[2])};
  }

  /// True if at() returns the same bits everywhere.
  [[nodiscard]] bool is_constant() const noexcept;
  /// Also returns its derivatives, which jump between leaves by at most the tolerance.
  [[nodiscard]] MetricSlopes slopes_at(const Vec2& uv) const noexcept;
  /// Largest bend of shapes (metric/chart.h) at the middle of a leaf.
  [[nodiscard]] double largest_bend() const noexcept;

  /// Multiplies all lengths by `factor`.
  void scale_lengths(double factor) noexcept;

  /// Number of triangles of unit edges that the domain holds: integral of sqrt(det M) over sqrt(3) / 4.
  [[nodiscard]] double measure() const noexcept { return measure_; }
  /// Regions where a mesh, whose `count` vertices are given by `vertex`, has too few vertices. They are squares of
  /// leaves that hold some vertices of a unit mesh but less than a quarter of them in this mesh. The smallest of nested
  /// squares is returned. Each as the centres of its leaves, where sizes are smallest first; some may lie outside of
  /// the domain.
  [[nodiscard]] std::vector<std::vector<Vec2>> undersampled_regions(
      std::size_t count, const std::function<Vec2(std::size_t)>& vertex) const;

  /// Points at which the sampler was called.
  [[nodiscard]] std::size_t samples() const noexcept { return samples_; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return leaves_.capacity() * sizeof(Leaf) + measures_.capacity() * sizeof(double) +
           table_.capacity() * sizeof(std::int32_t) + children_.capacity() * sizeof(children_[0]);
  }

  /// Writes a space as bytes for another process, and reads it back. Reading throws Error for bytes that are not a
  /// space.
  void put(PacketWriter& packet) const;
  static ControlSpace from(PacketReader& packet);

 private:
  friend class ControlSpaceWriter;
  class UndersampledSearch;

  /// S(s, t) = sum of c[3 m + n] s^n t^m for (s, t) in [-1, 1]^2, about the centre (x, y) in units of the table.
  struct Leaf {
    double x = 0, y = 0, scale = 1;
    std::array<std::array<double, 3>, 9> c{{{1, 0, 1}}};
  };

  [[nodiscard]] MetricSlopes slopes_in(const Leaf& leaf, double s, double t) const noexcept;
  static double within(double x, double last) noexcept { return x > 0 ? (x < last ? x : last) : 0; }
  struct Place {
    const Leaf* leaf;
    double s, t;
  };
  [[nodiscard]] Place place(const Vec2& uv) const noexcept {
    const double x = within((uv.x() - low_.x()) * scale_.x(), last_.x()),
                 y = within((uv.y() - low_.y()) * scale_.y(), last_.y());
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    std::int32_t cell = table_[static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i)];
    if (cell < 0) cell = descend(cell, x - i, y - j);
    const Leaf& l = leaves_[static_cast<std::size_t>(cell)];
    return {&l, (x - l.x) * l.scale, (y - l.y) * l.scale};
  }
  [[nodiscard]] std::int32_t descend(std::int32_t cell, double fx, double fy) const noexcept {
    do {
      fx += fx, fy += fy;
      const int right = fx >= 1 ? 1 : 0, upper = fy >= 1 ? 1 : 0;
      fx -= right, fy -= upper;
      cell = children_[static_cast<std::size_t>(~cell)][static_cast<std::size_t>(2 * upper + right)];
    } while (cell < 0);
    return cell;
  }

  Vec2 low_{}, scale_{0, 0}, last_{0, 0};
  std::size_t columns_ = 1;
  Metric2 unit_{1, 1, 1};                  ///< from units of the roots to units of the parameters
  std::vector<std::int32_t> table_ = {0};  ///< a leaf, or ~index of children_
  std::vector<std::array<std::int32_t, 4>> children_;
  std::vector<Leaf> leaves_ = {Leaf{}};
  std::vector<double> measures_ = {0};  // of the leaves: their shares of measure_
  double measure_ = 0;
  std::size_t samples_ = 0;
};

}  // namespace carreau
