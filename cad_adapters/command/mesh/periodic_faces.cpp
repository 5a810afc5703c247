// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/periodic_faces.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "base/failure.h"
#include "files/periodic_pairs.h"
#include "files/session_handle.h"
#include "inputs/base/mirror_plane.h"

namespace command {

namespace {

using Numbers = std::vector<double>;
using Transform = std::array<double, 12>;

constexpr int faces_listed = 10;  // in a message

std::string number_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

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

Transform reflection(const MirrorPlane& plane) {
  const std::array<double, 3>&p = plane.point, &n = plane.normal;
  const double square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2], height = p[0] * n[0] + p[1] * n[1] + p[2] * n[2];
  Transform map{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) map[4 * i + k] = (i == k ? 1 : 0) - 2 * n[i] * n[k] / square;
    map[4 * i + 3] = 2 * height * n[i] / square;
  }
  return map;
}

Periodic parse_mirror(const std::string& text) {
  const auto plane = parse_plane(std::string_view(text).substr(text.find(':') + 1));
  if (!plane) reject_text(text);
  Periodic periodic;
  periodic.map = reflection(*plane);
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

// Signed heights of the curves of a face over a plane.
std::array<double, 2> heights_of(const CadInput& input, std::int32_t face, const MirrorPlane& plane) {
  constexpr int places = 8;
  double low = 0, high = 0;
  const auto curves = static_cast<std::int32_t>(input.curves(face).size());
  for (std::int32_t ic = 1; ic <= curves; ++ic)
    for (int i = 0; i <= places; ++i) {
      double u = 0, v = 0;
      Place place;
      if (!input.on_curve(face, ic, static_cast<double>(i) / places, u, v) || !input.locate(face, u, v, place)) continue;
      const double height = height_over(plane, place.x, place.y, place.z);
      low = std::min(low, height), high = std::max(high, height);
    }
  return {low, high};
}

// CAD files were cut and completed when they were read; other geometries must have both halves.
void require_halves(const CadInput& input, const MirrorPlane& plane) {
  constexpr double share = 1e-6;  // of the diagonal
  const double near = share * input.diagonal();
  double low = 0, high = 0;
  for (const std::int32_t face : input.face_numbers()) {
    const auto [below, above] = heights_of(input, face, plane);
    if (below < -near && above > near)
      throw Failure("--mirror: face " + std::to_string(face) + " lies across the plane, from " + number_text(below) + " to " + number_text(above) +
                    " over it. Only faces of CAD files are cut: the geometry must give its two halves as faces.");
    low = std::min(low, below), high = std::max(high, above);
  }
  if ((low >= -near) != (high <= near))
    throw Failure("--mirror: the geometry lies on one side of the plane. Only CAD files get their other half: the geometry must give both halves.");
}

using Faces = std::map<std::int32_t, Transform>;

Transform product(const Transform& a, const Transform& b) {
  Transform c{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t m = 0; m < 3; ++m) c[4 * i + k] += a[4 * i + m] * b[4 * m + k];
    c[4 * i + 3] += a[4 * i + 3];
  }
  return c;
}

bool is_near(const Transform& a, const Transform& b, double diagonal) {
  constexpr double turn = 1e-6, share = 1e-3;
  for (std::size_t i = 0; i < 12; ++i)
    if (std::abs(a[i] - b[i]) > (i % 4 == 3 ? share * diagonal : turn)) return false;
  return true;
}

}  // namespace

void require_mirrored(carreau_mesh* mesh, const MeshOptions& options, const CadInput& input, const std::vector<FaceResult>& faces) {
  const std::vector<MirrorPlane> planes = mirror_planes(options.cad.mirror);
  if (planes.empty()) return;
  const Transform identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  std::map<std::int32_t, Faces> classes;  // by master: its images, with their maps
  std::map<std::int32_t, std::int32_t> master_of;
  const PeriodicPairs pairs = pairs_of(mesh);
  for (std::size_t i = 0; i < pairs.dimension.size(); ++i) {
    if (pairs.dimension[i] != 2) continue;
    const std::int32_t slave = pairs.ref[2 * i], master = pairs.ref[2 * i + 1];
    classes[master].emplace(master, identity);
    std::copy_n(pairs.map.begin() + static_cast<std::ptrdiff_t>(12 * i), 12, classes[master][slave].begin());
    master_of[slave] = master_of[master] = master;
  }
  std::string without;
  int count = 0;
  for (const FaceResult& face : faces) {
    if (face.triangles == 0) continue;  // failed, with its own sentence
    for (const MirrorPlane& plane : planes) {
      const auto master = master_of.find(face.ref);
      bool found = false;
      if (master != master_of.end()) {
        const Faces& all = classes.at(master->second);
        const Transform image = product(reflection(plane), all.at(face.ref));
        for (const auto& [other, map] : all) found = found || is_near(image, map, input.diagonal());
      }
      if (found) continue;
      if (++count <= faces_listed) without += (count > 1 ? ", " : "") + std::to_string(face.ref);
      break;
    }
  }
  if (count == 0) return;
  throw Failure("--mirror: the body is not symmetric about the plane. " + std::to_string(count) + (count == 1 ? " face has" : " faces have") +
                " no mirror image: " + without + (count > faces_listed ? ", ..." : "") + ".");
}

void check_periodic(const MeshOptions& options) {
  for (const std::string& each : options.periodic) (void)parse_periodic(each);
  (void)mirror_planes(options.cad.mirror);
}

void set_periodic(carreau_session* session, const MeshOptions& options, const CadInput& input) {
  for (const MirrorPlane& plane : mirror_planes(options.cad.mirror)) {
    require_halves(input, plane);
    require(session, carreau_model_add_periodicity(session, nullptr, nullptr, 0, reflection(plane).data()));
  }
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
  const auto [dimension, ref, map, count, node] = pairs_of(mesh);
  const std::size_t n = dimension.size();
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
