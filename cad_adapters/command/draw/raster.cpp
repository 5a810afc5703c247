// SPDX-License-Identifier: BSD-3-Clause
#include "draw/raster.h"

#include <algorithm>
#include <cmath>

namespace command {
namespace {

constexpr Colour dark_line{0.012f, 0.016f, 0.03f}, light_line{0.42f, 0.44f, 0.48f};

/// Some rows of the picture at the resolution of the samples.
struct Band {
  int width = 0, first = 0, rows = 0;  ///< in samples
  std::vector<float> depth;
  std::vector<Colour> colour;
  std::vector<std::int32_t> face;  // empty: not required
};

/// The ground: white, very slightly grey towards the bottom.
Colour ground(double t) {
  const auto grey = static_cast<float>(1 - 0.10 * t * t);
  return {grey, grey, std::min(1.0f, grey * 1.005f)};
}

/// Signed value, linear in (x, y), that is the distance to side i in pixels: 0 on the side, positive inside.
struct Side {
  double a, b, c, height;
};

/// False when the triangle is seen exactly from its edge.
bool sides_of(const ScreenTriangle& t, std::array<Side, 3>& sides) {
  const auto& p = t.corners;
  const double area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
  if (!(std::abs(area) > 1e-12)) return false;
  for (int i = 0; i < 3; ++i) {
    const auto& q = p[(i + 1) % 3];
    const auto& r = p[(i + 2) % 3];
    const double length = std::hypot(r[0] - q[0], r[1] - q[1]), sign = area > 0 ? 1 : -1;
    const double a = -sign * (r[1] - q[1]) / length, b = sign * (r[0] - q[0]) / length;
    sides[i] = {a, b, -(a * q[0] + b * q[1]), std::abs(area) / length};
  }
  return true;
}

Colour with_lines(const ScreenTriangle& t, const std::array<double, 3>& distance) {
  float opacity = 0;
  for (int i = 0; i < 3; ++i)
    if (distance[i] < t.lines[i].width) opacity = std::max(opacity, t.lines[i].opacity);
  Colour colour = t.colour;
  const Colour& line = t.light_lines ? light_line : dark_line;
  for (int i = 0; i < 3; ++i) colour[i] += opacity * (line[i] - colour[i]);
  return colour;
}

void draw_triangle(const ScreenTriangle& t, double step, Band& band) {
  const auto& p = t.corners;
  std::array<Side, 3> sides;
  if (!sides_of(t, sides)) return;
  const auto [left, right] = std::minmax({p[0][0], p[1][0], p[2][0]});
  const auto [top, bottom] = std::minmax({p[0][1], p[1][1], p[2][1]});
  // Sample k of a row lies at (k + 1/2) step.
  const auto sample = [step](double x) { return static_cast<int>(std::floor(x / step - 0.5)); };
  const int i0 = std::max(sample(left), 0), i1 = std::min(sample(right) + 1, band.width - 1);
  const int j0 = std::max(sample(top), band.first), j1 = std::min(sample(bottom) + 1, band.first + band.rows - 1);
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i) {
      const double x = (i + 0.5) * step, y = (j + 0.5) * step;
      std::array<double, 3> distance;
      for (int k = 0; k < 3; ++k) distance[k] = sides[k].a * x + sides[k].b * y + sides[k].c;
      // A hair outside still counts, so that no gap opens between neighbours.
      if (std::min({distance[0], distance[1], distance[2]}) < -1e-6) continue;
      double depth = 0;
      for (int k = 0; k < 3; ++k) depth += p[k][2] * distance[k] / sides[k].height;
      const std::size_t at = static_cast<std::size_t>(j - band.first) * band.width + i;
      if (static_cast<float>(depth) <= band.depth[at]) continue;
      band.depth[at] = static_cast<float>(depth);
      band.colour[at] = with_lines(t, distance);
      if (!band.face.empty()) band.face[at] = t.face;
    }
}

}  // namespace

std::uint8_t to_srgb(double x) {
  x = std::clamp(x, 0.0, 1.0);
  const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

Image draw(const std::vector<ScreenTriangle>& triangles, int width, int height, int samples,
           std::vector<std::int32_t>* faces) {
  Image image{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height)};
  // A band of rows at a time: memory does not grow with the height of the picture.
  const int rows = std::clamp(4'000'000 / (width * samples * samples), 1, height);
  for (int row = 0; row < height; row += rows) {
    const int count = std::min(rows, height - row);
    Band band{width * samples, row * samples, count * samples, {}, {}, {}};
    band.depth.assign(static_cast<std::size_t>(band.width) * band.rows, -1);
    band.colour.resize(band.depth.size());
    if (faces != nullptr) band.face.resize(band.depth.size());
    for (int j = 0; j < band.rows; ++j)
      std::fill_n(band.colour.begin() + static_cast<std::ptrdiff_t>(j) * band.width, band.width,
                  ground((band.first + j + 0.5) / samples / height));
    for (const ScreenTriangle& t : triangles) draw_triangle(t, 1.0 / samples, band);
    for (int y = 0; y < count && faces != nullptr; ++y)
      for (int x = 0; x < width; ++x)
        faces->push_back(
            band.face[static_cast<std::size_t>(samples - 1 + y * samples) * band.width + x * samples + samples - 1]);
    for (int y = 0; y < count; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) {
          double sum = 0;
          for (int j = 0; j < samples; ++j)
            for (int i = 0; i < samples; ++i)
              sum += band.colour[static_cast<std::size_t>(j + y * samples) * band.width + x * samples + i][c];
          image.bytes[(static_cast<std::size_t>(row + y) * width + x) * 3 + c] = to_srgb(sum / (samples * samples));
        }
  }
  return image;
}

}  // namespace command
