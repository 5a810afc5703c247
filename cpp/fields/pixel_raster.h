// SPDX-License-Identifier: BSD-3-Clause
// Pixels of a grid over the parameter plane: in a domain, in triangles, and on lines.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "support/segment.h"

namespace carreau {

/// Pixels over a box of the parameter plane: columns from low.x to high.x, rows from high.y down to low.y.
struct PixelGrid {
  Vec2 low, high;
  int width = 1, height = 1;

  [[nodiscard]] Vec2 pixel() const noexcept { return {(high.x() - low.x()) / width, (high.y() - low.y()) / height}; }
  /// Coordinates of the centres of a column and of a row.
  [[nodiscard]] double u(int column) const noexcept { return low.x() + (column + 0.5) * pixel().x(); }
  [[nodiscard]] double v(int row) const noexcept { return high.y() - (row + 0.5) * pixel().y(); }
  [[nodiscard]] Vec2 centre(int column, int row) const noexcept { return {u(column), v(row)}; }
  /// Position in pixels: the centre of (column, row) is at (column, row).
  [[nodiscard]] Vec2 in_pixels(const Vec2& uv) const noexcept {
    return {(uv.x() - low.x()) / pixel().x() - 0.5, (high.y() - uv.y()) / pixel().y() - 0.5};
  }
  /// First column whose centre is at or right of u, `width` if no column is.
  [[nodiscard]] int first_column(double u) const noexcept;
};

/// Items that span some rows, found by row: lists for each band of 16 rows.
class RowBands {
 public:
  static constexpr int band_rows = 16;
  /// rows[i]: first and last row of item i; rows outside the image are allowed, and so is last < first (no row).
  RowBands(std::span<const std::pair<int, int>> rows, int height);
  /// Items of the band that holds a row, ascending.
  [[nodiscard]] std::span<const std::uint32_t> around(int row) const noexcept {
    const auto band = static_cast<std::size_t>(row / band_rows);
    return std::span(items_).subspan(start_[band], start_[band + 1] - start_[band]);
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> items_;
};

/// Line segments of the parameter plane.
struct PlaneSegments {
  std::vector<Vec2> vertices;
  std::vector<std::pair<int, int>> segments;
};

/// The inside of closed loops, by the parity of crossings. A pixel is inside when its centre is; a centre on an edge
/// counts for the side on its right (above a horizontal one), as in TriangleRaster. Keeps a copy of its arguments;
/// calls are safe from several threads.
class DomainRaster {
 public:
  DomainRaster(PlaneSegments loops, const PixelGrid& grid);
  /// 1 inside, 0 outside, for each pixel of rows [first, first + rows), row by row.
  void mask(int first, int rows, std::span<std::uint8_t> out) const;

 private:
  PlaneSegments loops_;
  PixelGrid grid_;
  RowBands bands_;
};

/// The triangles of a plane mesh. If they tile a domain without overlap, each pixel of the domain belongs to exactly
/// one. Keeps references to its arguments; calls are safe from several threads.
class TriangleRaster {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  TriangleRaster(std::span<const Vec2> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                 const PixelGrid& grid);
  /// Index of the triangle that holds the centre of each pixel of rows [first, first + rows), or none.
  void triangles(int first, int rows, std::span<std::uint32_t> out) const;

 private:
  std::span<const Vec2> vertices_;
  std::span<const std::array<std::int32_t, 3>> triangles_;
  PixelGrid grid_;
  RowBands bands_;
};

/// Lines of a width in pixels, smoothed. Keeps a copy of its arguments; calls are safe from several threads.
class LineRaster {
 public:
  LineRaster(PlaneSegments lines, double width, const PixelGrid& grid);
  /// Share of each pixel of rows [first, first + rows) that lines cover, 0 to 1, approximately.
  void coverage(int first, int rows, std::span<float> out) const;

 private:
  PlaneSegments lines_;
  double reach_;  // half of the width, and half a pixel over which it fades
  PixelGrid grid_;
  RowBands bands_;
};

}  // namespace carreau
