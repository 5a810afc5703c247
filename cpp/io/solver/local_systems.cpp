// SPDX-License-Identifier: BSD-3-Clause
#include "io/solver/local_systems.h"

#include <cmath>
#include <numbers>
#include <string>

namespace carreau {

void LocalSystems::add(std::int64_t number, const LocalSystem& system) {
  if (!systems_.emplace(number, Known{.system = system}).second)
    in_.fail(system.at, "system of coordinates " + std::to_string(number) + " comes twice");
}

Vec3 LocalSystems::in_basic(std::int64_t node) {
  const LocalPoint& point = points_.at(node);
  return placed(point.coordinates, point.system < 0 ? default_ : point.system, point.at);
}

Vec3 LocalSystems::placed(const Vec3& c, std::int64_t number, const char* at) {
  if (number == 0) return c;
  const Frame& frame = frame_of(number, at);
  constexpr double degree = std::numbers::pi / 180;
  Vec3 local = c;
  const char kind = systems_.at(number).system.kind;
  if (kind == 'C') local = {c[0] * std::cos(c[1] * degree), c[0] * std::sin(c[1] * degree), c[2]};
  if (kind == 'S')
    local = {c[0] * std::sin(c[1] * degree) * std::cos(c[2] * degree),
             c[0] * std::sin(c[1] * degree) * std::sin(c[2] * degree), c[0] * std::cos(c[1] * degree)};
  return frame.origin + local[0] * frame.x + local[1] * frame.y + local[2] * frame.z;
}

const LocalSystems::Frame& LocalSystems::frame_of(std::int64_t number, const char* at) {
  const std::string name = "system of coordinates " + std::to_string(number);
  const auto found = systems_.find(number);
  if (found == systems_.end()) in_.fail(at, name + " is named, and the file does not have it");
  Known& known = found->second;
  if (known.frame) return *known.frame;
  const LocalSystem& system = known.system;
  if (known.open) in_.fail(system.at, name + " is given in terms of itself");
  constexpr int max_depth = 1000;  // of the calls of this function
  if (++depth_ > max_depth) in_.fail(system.at, name + " is given in terms of more than 1000 others");
  known.open = true;
  std::array<Vec3, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!system.by_nodes) {
      p[k] = placed(system.points[k], system.reference, system.at);
    } else if (points_.contains(system.nodes[k])) {
      p[k] = in_basic(system.nodes[k]);
    } else {
      in_.fail(system.at, "node " + std::to_string(system.nodes[k]) + " is named, and the file does not have it");
    }
  }
  Frame frame{.origin = p[0], .x = {}, .y = {}, .z = p[1] - p[0]};
  frame.y = cross(frame.z, Vec3(p[2] - p[0]));
  const double length = norm(frame.z), height = norm(frame.y);
  if (!(length > 0) || !(height > 0)) in_.fail(system.at, name + " has no axes: its three points lie on a line");
  frame.z /= length, frame.y /= height;
  frame.x = cross(frame.y, frame.z);
  known.open = false;
  --depth_;
  return known.frame.emplace(frame);
}

}  // namespace carreau
