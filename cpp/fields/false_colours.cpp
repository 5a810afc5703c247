// SPDX-License-Identifier: BSD-3-Clause
#include "fields/false_colours.h"

#include <algorithm>
#include <cmath>

namespace carreau {

namespace {

// In the colours of a screen (sRGB), evenly spaced.
constexpr std::array<std::array<double, 3>, 6> stops{{{0.84, 0.24, 0.22},
                                                      {0.96, 0.56, 0.26},
                                                      {0.98, 0.86, 0.42},
                                                      {0.58, 0.82, 0.50},
                                                      {0.36, 0.71, 0.75},
                                                      {0.40, 0.52, 0.86}}};

double linear_light(double srgb) noexcept {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
}

}  // namespace

LinearColour false_colour(double t) noexcept {
  const double x = std::clamp(t, 0.0, 1.0) * (stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), stops.size() - 2);
  const double w = x - static_cast<double>(i);
  LinearColour colour{};
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = static_cast<float>(linear_light((1 - w) * stops[i][k] + w * stops[i + 1][k]));
  return colour;
}

double place_of_size(double h, double low, double high) noexcept {
  if (!(high > 1.001 * low)) return 0.5;
  return std::clamp(std::log(h / low) / std::log(high / low), 0.0, 1.0);
}

}  // namespace carreau
