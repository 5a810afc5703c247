// SPDX-License-Identifier: BSD-3-Clause
#include "fields/pixel_raster.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "support/infinity.h"

namespace carreau {

namespace {

// Rows that a range of v may touch, one more at each side for rounding.
std::pair<int, int> rows_between(const PixelGrid& grid, double v_low, double v_high, double margin) {
  const double dv = grid.pixel().y();
  if (!(dv > 0)) return {0, -1};
  const auto row = [&](double v) { return std::clamp((grid.high.y() - v) / dv - 0.5, -4.0, grid.height + 4.0); };
  return {static_cast<int>(std::floor(row(v_high) - margin)) - 1, static_cast<int>(std::ceil(row(v_low) + margin)) + 1};
}

std::vector<std::pair<int, int>> rows_of(const PlaneSegments& lines, const PixelGrid& grid, double margin) {
  std::vector<std::pair<int, int>> rows;
  rows.reserve(lines.segments.size());
  for (const auto& [a, b] : lines.segments) {
    const double p = lines.vertices[static_cast<std::size_t>(a)].y(),
                 q = lines.vertices[static_cast<std::size_t>(b)].y();
    rows.push_back(rows_between(grid, std::min(p, q), std::max(p, q), margin));
  }
  return rows;
}

std::vector<std::pair<int, int>> rows_of(std::span<const Vec2> vertices,
                                         std::span<const std::array<std::int32_t, 3>> triangles,
                                         const PixelGrid& grid) {
  std::vector<std::pair<int, int>> rows;
  rows.reserve(triangles.size());
  for (const auto& t : triangles) {
    const auto [low, high] = std::minmax({vertices[t[0]].y(), vertices[t[1]].y(), vertices[t[2]].y()});
    rows.push_back(rows_between(grid, low, high, 0));
  }
  return rows;
}

// The crossing of an edge with the line of a row. It is half-open, so that one of two edges that meet on the line
// crosses it. The same number for both directions of the edge: neighbours share their pixels without gap or overlap.
std::optional<double> crossing(const Vec2& p, const Vec2& q, double v) noexcept {
  if (q.y() < p.y()) return crossing(q, p, v);
  if (!(p.y() <= v && v < q.y())) return {};
  return p.x() + (v - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
}

}  // namespace

int PixelGrid::first_column(double u_wanted) const noexcept {
  const double guess = (u_wanted - low.x()) / pixel().x() - 0.5;
  int column = static_cast<int>(std::clamp(std::ceil(guess), 0.0, static_cast<double>(width)));
  while (column > 0 && u(column - 1) >= u_wanted) --column;
  while (column < width && u(column) < u_wanted) ++column;
  return column;
}

RowBands::RowBands(std::span<const std::pair<int, int>> rows, int height) {
  const int bands = (height + band_rows - 1) / band_rows;
  const auto bands_of = [&](std::pair<int, int> range) {
    const int first = std::max(range.first, 0), last = std::min(range.second, height - 1);
    return std::pair{first / band_rows, first <= last ? last / band_rows : -1};
  };
  start_.assign(static_cast<std::size_t>(bands) + 1, 0);
  for (const auto& range : rows) {
    const auto [first, last] = bands_of(range);
    for (int band = first; band <= last; ++band) ++start_[static_cast<std::size_t>(band) + 1];
  }
  for (std::size_t band = 1; band < start_.size(); ++band) start_[band] += start_[band - 1];
  items_.resize(start_.back());
  std::vector<std::size_t> next = start_;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto [first, last] = bands_of(rows[i]);
    for (int band = first; band <= last; ++band)
      items_[next[static_cast<std::size_t>(band)]++] = static_cast<std::uint32_t>(i);
  }
}

DomainRaster::DomainRaster(PlaneSegments loops, const PixelGrid& grid)
    : loops_(std::move(loops)), grid_(grid), bands_(rows_of(loops_, grid, 0), grid.height) {}

void DomainRaster::mask(int first, int rows, std::span<std::uint8_t> out) const {
  std::fill(out.begin(), out.end(), std::uint8_t{0});
  std::vector<double> crossings;
  for (int row = first; row < first + rows; ++row) {
    crossings.clear();
    const double v = grid_.v(row);
    for (const std::uint32_t i : bands_.around(row)) {
      const auto& [a, b] = loops_.segments[i];
      if (const auto u =
              crossing(loops_.vertices[static_cast<std::size_t>(a)], loops_.vertices[static_cast<std::size_t>(b)], v))
        crossings.push_back(*u);
    }
    std::sort(crossings.begin(), crossings.end());
    const auto pixels = out.subspan(static_cast<std::size_t>(row - first) * static_cast<std::size_t>(grid_.width),
                                    static_cast<std::size_t>(grid_.width));
    for (std::size_t k = 1; k < crossings.size(); k += 2) {
      const int from = grid_.first_column(crossings[k - 1]), to = grid_.first_column(crossings[k]);
      std::fill(pixels.begin() + from, pixels.begin() + to, std::uint8_t{1});
    }
  }
}

TriangleRaster::TriangleRaster(std::span<const Vec2> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                               const PixelGrid& grid)
    : vertices_(vertices),
      triangles_(triangles),
      grid_(grid),
      bands_(rows_of(vertices, triangles, grid), grid.height) {}

void TriangleRaster::triangles(int first, int rows, std::span<std::uint32_t> out) const {
  std::fill(out.begin(), out.end(), none);
  for (int row = first; row < first + rows; ++row) {
    const double v = grid_.v(row);
    const auto pixels = out.begin() + static_cast<std::ptrdiff_t>(row - first) * grid_.width;
    for (const std::uint32_t t : bands_.around(row)) {
      const std::array<std::int32_t, 3>& c = triangles_[t];
      double from = infinity, to = -from;
      for (int i = 0; i < 3; ++i)
        if (const auto u = crossing(vertices_[c[i]], vertices_[c[(i + 1) % 3]], v))
          from = std::min(from, *u), to = std::max(to, *u);
      if (from < to) std::fill(pixels + grid_.first_column(from), pixels + grid_.first_column(to), t);
    }
  }
}

LineRaster::LineRaster(PlaneSegments lines, double width, const PixelGrid& grid)
    : lines_(std::move(lines)),
      reach_(width / 2 + 0.5),
      grid_(grid),
      bands_(rows_of(lines_, grid, width / 2 + 0.5), grid.height) {}

void LineRaster::coverage(int first, int rows, std::span<float> out) const {
  std::fill(out.begin(), out.end(), 0.0F);
  for (int row = first; row < first + rows; ++row) {
    const auto pixels = out.begin() + static_cast<std::ptrdiff_t>(row - first) * grid_.width;
    for (const std::uint32_t i : bands_.around(row)) {
      const Vec2 a = grid_.in_pixels(lines_.vertices[static_cast<std::size_t>(lines_.segments[i].first)]);
      const Vec2 b = grid_.in_pixels(lines_.vertices[static_cast<std::size_t>(lines_.segments[i].second)]);
      // The part of the segment that can be within reach of this row.
      double from = 0, to = 1;
      if (const double rise = b.y() - a.y(); rise != 0) {
        const double s = (row - reach_ - a.y()) / rise, t = (row + reach_ - a.y()) / rise;
        from = std::max(from, std::min(s, t)), to = std::min(to, std::max(s, t));
      } else if (std::abs(a.y() - row) > reach_) {
        continue;
      }
      if (from > to) continue;
      const auto [left, right] = std::minmax({lerp(a, b, from).x(), lerp(a, b, to).x()});
      const double last = grid_.width - 1.0;
      if (!(right + reach_ >= 0 && left - reach_ <= last)) continue;  // also for infinite and NaN values
      const int begin = static_cast<int>(std::max(std::ceil(left - reach_), 0.0));
      const int end = static_cast<int>(std::min(std::floor(right + reach_), last));
      for (int column = begin; column <= end; ++column) {
        const double d = distance_to_segment({static_cast<double>(column), static_cast<double>(row)}, a, b);
        pixels[column] = std::max(pixels[column], static_cast<float>(std::clamp(reach_ - d, 0.0, 1.0)));
      }
    }
  }
}

}  // namespace carreau
