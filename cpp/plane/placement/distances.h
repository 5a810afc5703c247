// The distances that govern where points go, in unit lengths. Private to plane/.
#pragma once

namespace carreau::plane {

inline constexpr double done_radius = 0.70;  ///< circumradius of a triangle that is small enough (equilateral: 0.577)
inline constexpr double layer_distance = 0.75;     ///< least distance of a point of a layer to other vertices
inline constexpr double imposed_height = 0.40;     ///< least height over an imposed edge
inline constexpr double degenerate_height = 0.70;  ///< least distance to a degenerate edge as a whole
inline constexpr double leftover_radius = 0.87;    ///< circumradius that asks for one more point

}  // namespace carreau::plane
