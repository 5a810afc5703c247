// SPDX-License-Identifier: BSD-3-Clause
// Colours of values, in pictures and reports.
#pragma once

#include <array>
#include <string>

namespace command {

/// Viridis (S. van der Walt, N. Smith, E. Firing; matplotlib, CC0). Equal steps of a value look equally large, also
/// without colours on paper and for people who cannot distinguish red and green. 17 stops at equal distances, 0xRRGGBB.
inline constexpr std::array<int, 17> scale_stops{0x440154, 0x48186a, 0x472d7b, 0x424086, 0x3b528b, 0x33638d,
                                                 0x2c728e, 0x26828e, 0x21918c, 0x1fa088, 0x28ae80, 0x3fbc73,
                                                 0x5ec962, 0x84d44b, 0xaddc30, 0xd8e219, 0xfde725};

/// 0xRRGGBB at a share of the scale, 0 to 1 (clamped): linear between stops, as the viewer of reports has it.
int scale_rgb(double share);

/// "#rrggbb".
std::string hex_text(int rgb);

}  // namespace command
