// How far a surface leaves an edge, by what is known at its ends.
#pragma once

#include <array>

namespace carreau {

/// Shares of an edge where its offsets are sampled: that of an arc is largest in its middle, that of an S at 0.21 and
/// 0.79.
inline constexpr std::array<double, 3> along_edge{0.21, 0.5, 0.79};

/// Offset, at the share s of an edge, of the cubic that leaves its ends as the surface does (cubic patches of Vlachos
/// et al.: "Curved PN triangles", 2001). `p`: height of the last end over the tangent plane of the first; `q`: of the
/// first over that of the last.
constexpr double cubic_offset(double s, double p, double q) noexcept { return s * (1 - s) * ((1 - s) * p + s * q); }

}  // namespace carreau
