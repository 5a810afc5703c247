// SPDX-License-Identifier: BSD-3-Clause
#include "size/attractors.h"

#include <algorithm>
#include <cmath>

#include "size/thresholds.h"
#include "support/error.h"
#include "support/format.h"
#include "support/infinity.h"

namespace carreau {
namespace {

using namespace thresholds::size;
using Row = std::array<std::int32_t, 3>;

void check_attractor(const Attractor& a) {
  for (const auto& [length, word] : {std::pair{a.size, "size"}, {a.surrounding, "surrounding size"}, {a.reach, "reach"}})
    if (!(length > 0) || !std::isfinite(length))
      throw InvalidArgument(std::string("the attractor: the ") + word + " must be positive; it is " + format_number(length));
  if (a.surrounding < a.size)
    throw InvalidArgument("the attractor: the size " + format_number(a.size) + " is above the surrounding size " +
                          format_number(a.surrounding));
  if (a.elements.empty()) throw InvalidArgument("the attractor has no element");
  for (std::size_t v = 0; v < a.vertices.size(); ++v)
    if (!a.vertices[v].allFinite())
      throw InvalidArgument("the attractor: vertex " + std::to_string(v) + " (from 0) is not finite");
  for (std::size_t i = 0; i < a.elements.size(); ++i)
    for (const std::int32_t v : a.elements[i])
      if (v < 0 || static_cast<std::size_t>(v) >= a.vertices.size())
        throw InvalidArgument("the attractor: element " + std::to_string(i) + " (from 0) names vertex " + std::to_string(v) +
                              ", but there are " + std::to_string(a.vertices.size()));
}

std::array<Vec3, 3> corners_of(const Attractor& a, const Row& element) {
  const auto corner = [&](std::size_t k) { return a.vertices[static_cast<std::size_t>(element[k])]; };
  return {corner(0), corner(1), corner(2)};
}

/// Divisions of the sides of an element into pieces of at most `spacing`.
int divisions(const std::array<Vec3, 3>& c, double spacing) {
  const double longest = std::max({norm(c[1] - c[0]), norm(c[2] - c[1]), norm(c[0] - c[2])});
  return static_cast<int>(std::clamp(std::ceil(longest / spacing), 1.0, static_cast<double>(max_attractor_places)));
}

/// Number of places of an element with so many divisions.
double place_count(const Row& element, int n) {
  if (element[1] == element[0] && element[2] == element[0]) return 1;
  return element[2] == element[1] ? n + 1.0 : 0.5 * (n + 1.0) * (n + 2.0);
}

/// The largest number of places below the bound, with a spacing that doubles.
double spacing_of(const Attractor& a) {
  double spacing = 0.5 * a.reach;
  if (a.elements.size() > max_attractor_places) return infinity;
  for (;; spacing *= 2) {
    double count = 0;
    bool undivided = true;
    for (const Row& element : a.elements) {
      const int n = divisions(corners_of(a, element), spacing);
      undivided = undivided && n == 1;
      count += place_count(element, n);
    }
    if (count <= static_cast<double>(max_attractor_places) || undivided) return spacing;
  }
}

void add_places(const Attractor& a, std::vector<SteepPlace>& places) {
  if (a.surrounding <= steep_ratio * a.size) return;
  const double spacing = spacing_of(a);
  if (!std::isfinite(spacing)) {  // the corners of some elements
    const std::size_t step = a.elements.size() / max_attractor_places + 1;
    for (std::size_t i = 0; i < a.elements.size(); i += step) places.push_back({corners_of(a, a.elements[i])[0], 0.5 * a.reach});
    return;
  }
  for (const Row& element : a.elements) {
    const std::array<Vec3, 3> c = corners_of(a, element);
    const int n = divisions(c, spacing);
    const bool is_point = element[1] == element[0] && element[2] == element[0], is_edge = element[2] == element[1];
    for (int i = 0; i <= (is_point ? 0 : n); ++i)
      for (int j = 0; j <= (is_edge ? 0 : n - i); ++j)
        places.push_back({c[0] + (static_cast<double>(i) / n) * (c[1] - c[0]) + (static_cast<double>(j) / n) * (c[2] - c[0]),
                          0.5 * a.reach});
  }
}

}  // namespace

void Attractors::add(const Attractor& attractor) {
  check_attractor(attractor);
  std::vector<Simplex> simplices;
  Known known{.box = {}, .search = {}, .size = attractor.size, .surrounding = attractor.surrounding, .reach = attractor.reach};
  for (const Row& e : attractor.elements) {
    simplices.push_back({.vertex = {e[0], e[1], e[2], -1}, .corners = e[2] == e[1] ? 2 : 3});
    for (const Vec3& corner : corners_of(attractor, e)) known.box.add(corner);
  }
  known.search = SimplexSearch(attractor.vertices, simplices);
  known_.push_back(std::move(known));
  add_places(attractor, steep_);
}

Prescription Attractors::at(const Vec3& p) const noexcept {
  double smallest = infinity;
  for (const Known& a : known_) {
    if (a.size >= smallest || a.box.squared_distance(p) >= a.reach * a.reach) continue;
    const double share = a.search.nearest(p).distance / a.reach;
    if (share < 1) smallest = std::min(smallest, a.size + share * (a.surrounding - a.size));
  }
  return std::isfinite(smallest) ? Prescription::of_size(smallest) : Prescription{};
}

Prescription Attractors::on_surface(int /*face*/, Vec2 /*uv*/, Vec3 xyz) { return at(xyz); }
Prescription Attractors::on_curve(int /*face*/, int /*ic*/, double /*t*/, Vec2 /*uv*/, Vec3 xyz) { return at(xyz); }
Prescription Attractors::at_point(int /*point*/, Vec3 xyz) { return at(xyz); }

}  // namespace carreau
