// SPDX-License-Identifier: BSD-3-Clause
// PNG files of 8-bit sRGB, written block by block.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace carreau {

/// Rows [first, first + rows) of an image, row by row from the upper one. Each pixel has red, green and blue, linear
/// light from 0 to 1 (beyond: clamped), over the ground.
using PngRows = std::function<void(int first, int rows, std::span<std::array<float, 3>>)>;

/// The whole file (PNG specification, ISO/IEC 15948). `rows` is called in order. Throws InvalidArgument for numbers
/// below 1 or above 65536.
std::string png_bytes(int width, int height, const PngRows& rows);

/// The byte that a display shows for linear light (IEC 61966-2-1).
std::uint8_t srgb_byte(double linear) noexcept;

}  // namespace carreau
