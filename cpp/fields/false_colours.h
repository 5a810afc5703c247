// SPDX-License-Identifier: BSD-3-Clause
// Colours of previews, in linear light, as in EXR files.
#pragma once

#include <array>

namespace carreau {

/// Red, green, blue of linear light, 0 to 1.
using LinearColour = std::array<float, 3>;

/// From red at 0 over yellow and green to blue at 1, all light enough for dark lines; arguments outside are clamped.
LinearColour false_colour(double t) noexcept;

/// Place of a size in [low, high] on a logarithmic scale; 1/2 where the interval is (nearly) one value.
double place_of_size(double h, double low, double high) noexcept;

/// Colour of a missing value.
constexpr LinearColour colour_of_nothing{0.7F, 0.0F, 0.6F};

}  // namespace carreau
