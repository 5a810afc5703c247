// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/base/mirror_plane.h"

#include <charconv>
#include <cmath>

#include "base/failure.h"

namespace command {

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data() + begin, text.data() + end, value);
    if (error != std::errc() || rest != text.data() + end || !std::isfinite(value)) return {};
    numbers.push_back(value);
    begin = end + 1;
  }
  return numbers;
}

std::optional<MirrorPlane> parse_plane(std::string_view text) {
  MirrorPlane plane;
  if (text.size() == 1 && text[0] >= 'x' && text[0] <= 'z') {
    plane.normal[static_cast<std::size_t>(text[0] - 'x')] = 1;
    return plane;
  }
  const std::size_t colon = text.find(':');
  const bool through_origin = colon == std::string_view::npos;
  const auto point = parse_numbers(through_origin ? "0,0,0" : text.substr(0, colon));
  const auto normal = parse_numbers(through_origin ? text : text.substr(colon + 1));
  if (!point || !normal || point->size() != 3 || normal->size() != 3) return {};
  for (std::size_t i = 0; i < 3; ++i) plane.point[i] = (*point)[i], plane.normal[i] = (*normal)[i];
  if (!(std::hypot(plane.normal[0], plane.normal[1], plane.normal[2]) > 0)) return {};
  return plane;
}

std::vector<MirrorPlane> mirror_planes(const std::vector<std::string>& texts) {
  std::vector<MirrorPlane> planes;
  for (const std::string& text : texts) {
    const auto plane = parse_plane(text);
    if (!plane) throw Failure("--mirror '" + text + "': x, y, z, a normal A,B,C of a plane through the origin, or POINT:NORMAL is required.");
    planes.push_back(*plane);
  }
  return planes;
}

double height_over(const MirrorPlane& plane, double x, double y, double z) {
  const std::array<double, 3> way{x - plane.point[0], y - plane.point[1], z - plane.point[2]};
  const std::array<double, 3>& n = plane.normal;
  return (way[0] * n[0] + way[1] * n[1] + way[2] * n[2]) / std::hypot(n[0], n[1], n[2]);
}

}  // namespace command
