// SPDX-License-Identifier: BSD-3-Clause
#include "draw/colour_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace command {

std::string hex_text(int rgb) {
  char text[16];
  std::snprintf(text, sizeof text, "#%06x", static_cast<unsigned>(rgb & 0xffffff));
  return text;
}

int scale_rgb(double share) {
  const double x = std::clamp(share, 0.0, 1.0) * (scale_stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), scale_stops.size() - 2);
  const double t = x - static_cast<double>(i);
  int rgb = 0;
  for (const int shift : {16, 8, 0}) {
    const double a = scale_stops[i] >> shift & 255, b = scale_stops[i + 1] >> shift & 255;
    rgb |= static_cast<int>(std::lround(a + t * (b - a))) << shift;
  }
  return rgb;
}

}  // namespace command
