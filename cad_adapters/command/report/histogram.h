// SPDX-License-Identifier: BSD-3-Clause
// How values are spread, as numbers and as a drawing.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "report/triangle_values.h"

namespace command {

constexpr int histogram_classes = 20;

struct Histogram {
  std::array<double, histogram_classes + 1> bounds{};  ///< ascending; the end classes hold values beyond them
  std::array<std::int64_t, histogram_classes> counts{};
  std::int64_t without = 0;  ///< elements that have no value
};

/// Classes of equal width between the ends of the scale, or of equal ratio on a logarithmic one. An element counts once,
/// also when it is two triangles.
Histogram histogram_of(const TriangleValues& values, const std::vector<std::uint8_t>& halves);

/// A drawing (SVG) in the colours of the scale, with a table of the same numbers that opens below it.
std::string html_of(const Histogram& histogram, const TriangleValues& values);

}  // namespace command
