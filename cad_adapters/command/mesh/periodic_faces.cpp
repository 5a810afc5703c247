// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/periodic_faces.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "base/failure.h"
#include "files/session_handle.h"

namespace command {

namespace {

using Numbers = std::vector<double>;
using Transform = std::array<double, 12>;

/// One of three ways to give a periodicity.
struct Periodic {
  std::optional<std::array<double, 3>> direction;  // the extent of the model is the period
  std::optional<Transform> map;
  std::int32_t slave = 0, master = 0;  // faces; 0: all that match
};

[[noreturn]] void reject_text(const std::string& text) {
  throw Failure("--periodic '" + text +
                "': x, y, z, a translation A,B,C, rotate:POINT:AXIS:DEGREES, mirror:POINT:NORMAL or a pair of faces SLAVE=MASTER is required.");
}

std::optional<Numbers> parse_numbers(std::string_view text) {
  Numbers numbers;
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

// Rodrigues' formula about an axis through a point.
Transform rotation(const Numbers& point, const Numbers& axis, double degrees) {
  const double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  const std::array<double, 3> a{axis[0] / length, axis[1] / length, axis[2] / length};
  // Multiples of 90 degrees exactly.
  const double turns = std::fmod(degrees, 360), angle = turns * std::numbers::pi / 180;
  const bool exact = std::fmod(turns, 90) == 0;
  const double c = exact ? std::round(std::cos(angle)) : std::cos(angle), s = exact ? std::round(std::sin(angle)) : std::sin(angle);
  const double cross[3][3] = {{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
  Transform map{};
  for (std::size_t i = 0; i < 3; ++i) {
    double turned = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      map[4 * i + k] = (i == k ? c : 0) + s * cross[i][k] + (1 - c) * a[i] * a[k];
      turned += map[4 * i + k] * point[k];
    }
    map[4 * i + 3] = point[i] - turned;
  }
  return map;
}

Periodic parse_rotation(const std::string& text) {
  const std::size_t first = text.find(':'), second = text.find(':', first + 1), third = text.find(':', second + 1);
  if (second == text.npos || third == text.npos) reject_text(text);
  const std::string_view whole = text;
  const auto point = parse_numbers(whole.substr(first + 1, second - first - 1)), axis = parse_numbers(whole.substr(second + 1, third - second - 1)),
             angle = parse_numbers(whole.substr(third + 1));
  if (!point || !axis || !angle || point->size() != 3 || axis->size() != 3 || angle->size() != 1) reject_text(text);
  if ((*axis)[0] == 0 && (*axis)[1] == 0 && (*axis)[2] == 0) reject_text(text);
  Periodic periodic;
  periodic.map = rotation(*point, *axis, angle->front());
  return periodic;
}

// The reflection in the plane through a point.
Periodic parse_mirror(const std::string& text) {
  const std::size_t first = text.find(':'), second = text.find(':', first + 1);
  if (second == text.npos) reject_text(text);
  const std::string_view whole = text;
  const auto point = parse_numbers(whole.substr(first + 1, second - first - 1)), normal = parse_numbers(whole.substr(second + 1));
  if (!point || !normal || point->size() != 3 || normal->size() != 3) reject_text(text);
  const Numbers &p = *point, &n = *normal;
  const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2], height = p[0] * n[0] + p[1] * n[1] + p[2] * n[2];
  if (!(square > 0)) reject_text(text);
  Periodic periodic;
  periodic.map.emplace();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) (*periodic.map)[4 * i + k] = (i == k ? 1 : 0) - 2 * n[i] * n[k] / square;
    (*periodic.map)[4 * i + 3] = 2 * height * n[i] / square;
  }
  return periodic;
}

Periodic parse_faces(const std::string& text, std::size_t sign) {
  Periodic periodic;
  const auto number = [&](std::size_t begin, std::size_t end, std::int32_t& value) {
    const auto [rest, error] = std::from_chars(text.data() + begin, text.data() + end, value);
    if (error != std::errc() || rest != text.data() + end || value < 1) reject_text(text);
  };
  number(0, sign, periodic.slave), number(sign + 1, text.size(), periodic.master);
  return periodic;
}

Periodic parse_periodic(const std::string& text) {
  Periodic periodic;
  for (const std::size_t axis : {0U, 1U, 2U})
    if (text == std::string(1, static_cast<char>('x' + axis))) {
      periodic.direction.emplace();
      (*periodic.direction)[axis] = 1;
      return periodic;
    }
  if (text.starts_with("rotate:")) return parse_rotation(text);
  if (text.starts_with("mirror:")) return parse_mirror(text);
  if (const std::size_t sign = text.find('='); sign != text.npos) return parse_faces(text, sign);
  const auto numbers = parse_numbers(text);
  if (!numbers || numbers->size() != 3) reject_text(text);
  if ((*numbers)[0] == 0 && (*numbers)[1] == 0 && (*numbers)[2] == 0) reject_text(text);
  periodic.map = Transform{1, 0, 0, (*numbers)[0], 0, 1, 0, (*numbers)[1], 0, 0, 1, (*numbers)[2]};
  return periodic;
}

}  // namespace

void check_periodic(const MeshOptions& options) {
  for (const std::string& each : options.periodic) (void)parse_periodic(each);
}

void set_periodic(carreau_session* session, const MeshOptions& options) {
  for (const std::string& each : options.periodic) {
    const Periodic given = parse_periodic(each);
    if (given.direction)
      require(session, carreau_model_add_period(session, given.direction->data()));
    else
      require(session, carreau_model_add_periodicity(session, &given.slave, &given.master, given.slave > 0 ? 1 : 0,
                                                     given.map ? given.map->data() : nullptr));
  }
}

std::string pairs_text(carreau_mesh* mesh) {
  std::int64_t pairs = 0, nodes = 0;
  require(mesh, carreau_mesh_periodic_count(mesh, &pairs, &nodes));
  const auto n = static_cast<std::size_t>(pairs);
  std::vector<std::int32_t> dimension(n), ref(2 * n), node(2 * static_cast<std::size_t>(nodes));
  std::vector<double> map(12 * n);
  std::vector<std::int64_t> count(n);
  require(mesh, carreau_mesh_periodic(mesh, pairs, nodes, dimension.data(), ref.data(), map.data(), count.data(), node.data()));
  std::string text = "# pairs of nodes, from 1: slave master; each block: dimension, slave, master, number of pairs, map 3 x 4\n";
  std::size_t next = 0;
  for (std::size_t i = 0; i < n; ++i) {
    text += "# " + std::to_string(dimension[i]) + " " + std::to_string(ref[2 * i]) + " " + std::to_string(ref[2 * i + 1]) + " " + std::to_string(count[i]);
    for (std::size_t k = 0; k < 12; ++k) {
      char number[32];
      std::snprintf(number, sizeof number, " %.17g", map[12 * i + k]);
      text += number;
    }
    text += "\n";
    for (std::int64_t k = 0; k < count[i]; ++k, next += 2) text += std::to_string(node[next] + 1) + " " + std::to_string(node[next + 1] + 1) + "\n";
  }
  return text;
}

}  // namespace command
