// SPDX-License-Identifier: BSD-3-Clause
// A z-buffer for triangles of one colour with dark lines along their sides.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace command {

/// Linear light, 0 to 1: red, green, blue.
using Colour = std::array<float, 3>;

/// Eight-bit sRGB, three bytes a pixel, row by row from the upper left corner.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
};

struct Line {
  float width = 0;    ///< on this triangle's side, pixels; 0: no line
  float opacity = 0;  ///< 0 to 1
};

/// A triangle on the picture. Coordinates are in pixels; depth grows towards the eye.
struct ScreenTriangle {
  std::array<std::array<double, 3>, 3> corners;  ///< x, y, depth
  Colour colour{};
  std::array<Line, 3> lines{};  ///< line i is on the side opposite to corner i
  std::int32_t face = 0;        ///< its number in `faces` of draw()
  bool light_lines = false;     ///< on dark colours
};

/// Draws the triangles, nearest in front, over a white ground; every pixel is the mean of samples x samples points.
/// `faces`, which may be null: the face of each pixel's last point, row by row; 0: none.
Image draw(const std::vector<ScreenTriangle>& triangles, int width, int height, int samples,
           std::vector<std::int32_t>* faces = nullptr);

/// The byte of a display for linear light.
std::uint8_t to_srgb(double x);

}  // namespace command
