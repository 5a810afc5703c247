// Interpolation of a size between two points.
#pragma once

namespace carreau {

/// Laws of interpolation of sizes between two points (hinterpol_flag, RT-0232 sec. 3.3).
enum class SizeLaw : int { linear = 0, geometric = 1, sinusoidal = 2 };

/// h at fraction r in [0, 1] between h1 and h2 > 0 (RR-2818 sec. 5.4, HDR eq. 2.11-2.12).
double interpolate_size(SizeLaw law, double h1, double h2, double r) noexcept;

}  // namespace carreau
