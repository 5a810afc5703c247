// SPDX-License-Identifier: BSD-3-Clause
// A chart seen along its axis: its plane, and which triangle is where.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "metric/metric2.h"
#include "surface/remesh/planes/flat_atlas.h"

namespace carreau {

/// Keeps a reference to the atlas. Safe from several threads once made.
class ChartPlane {
 public:
  /// `triangles`: of the chart, ascending; `size`: of a cell of the raster, about; `slits`: it has both sides of some
  /// sharp line.
  ChartPlane(const FlatAtlas& atlas, const Vec3& axis, std::span<const std::int32_t> triangles, double size,
             bool slits);

  [[nodiscard]] Vec2 project(const Vec3& p) const { return {dot(p - origin_, first_), dot(p - origin_, second_)}; }
  /// Returns the place on the triangles near p; on the border of the region if p is beyond it. Returns nothing if the
  /// projection is folded. `roughly`: if a barrier is in the way the result lies on it.
  [[nodiscard]] std::optional<Foot> find(const Vec2& p, bool roughly = false) const;
  /// The metric of unit lengths in space, by the normals of the surface.
  [[nodiscard]] Metric2 metric(const Foot& at) const;
  /// The least cosine between the axis and normals at corners of the triangles of the chart.
  [[nodiscard]] double min_cosine() const noexcept { return least_; }

 private:
  void enclose(std::span<const std::int32_t> triangles);
  void fill(std::int32_t t);
  void spread();
  [[nodiscard]] bool is_shown(std::int32_t t) const;
  [[nodiscard]] std::optional<Foot> foot_in(std::int32_t t, std::array<double, 3> w) const;
  [[nodiscard]] double outside(std::int32_t t, const Vec2& p) const;
  struct Found {
    std::int32_t triangle;
    double outside;
  };
  [[nodiscard]] std::int32_t straight_to(const Vec2& p, std::int32_t first) const;
  [[nodiscard]] Found find_anywhere(const Vec2& p, Found best) const;
  [[nodiscard]] Found find_around(std::int32_t first, const Vec2& p) const;
  [[nodiscard]] std::array<Vec2, 3> corners(std::int32_t t) const;
  [[nodiscard]] std::size_t cell(int i, int j) const {
    return static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i);
  }

  const FlatAtlas& atlas_;
  Vec3 axis_, origin_, first_, second_;
  double least_ = 1;
  bool slits_;
  Vec2 low_;
  double step_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::int32_t> raster_;  // a triangle near each cell
  std::vector<std::int32_t> shown_;   // triangles of the chart, and some beyond
};

}  // namespace carreau
