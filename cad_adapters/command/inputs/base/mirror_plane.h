// SPDX-License-Identifier: BSD-3-Clause
// The planes of --mirror.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace command {

struct MirrorPlane {
  std::array<double, 3> point{}, normal{};  ///< the normal has a length
};

/// "1,2.5,-3" as numbers. Empty: a word is no finite number.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

/// "x", "y", "z" or "A,B,C" through the origin, or "POINT:NORMAL". Empty: no such plane.
std::optional<MirrorPlane> parse_plane(std::string_view text);

/// Planes of --mirror. Throws Failure.
std::vector<MirrorPlane> mirror_planes(const std::vector<std::string>& texts);

/// Signed distance of a point from the plane.
double height_over(const MirrorPlane& plane, double x, double y, double z);

}  // namespace command
