// SPDX-License-Identifier: BSD-3-Clause
#include "report/triangle_values.h"
#include "check/triangle_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "draw/drawn_elements.h"
#include "draw/scene.h"
#include "files/session_handle.h"

namespace command {
namespace {

using Corners = std::array<std::int32_t, 3>;

/// A logarithmic scale shows so much of the values below the largest one; below are rounding errors of flat faces.
constexpr double shown_share = 1e-4;

/// Ends of a scale that shows the values; a range without width is widened.
void fit_scale(TriangleValues& values) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const double x : values.values)
    if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
  if (!(high > 0)) low = 0, high = 1;
  if (values.scale == Scale::logarithmic) low = std::max(low, shown_share * high);
  if (values.scale == Scale::linear) low = 0;
  if (!(low < high * (1 - 1e-9))) low = high / 2, high *= 2;
  values.low = low, values.high = high;
}

std::array<Point, 8> quad_of(const MeshArrays& mesh, std::size_t t) {
  const auto &first = mesh.triangles[t], &second = mesh.triangles[t + 1];
  return {mesh.vertices[first[0]], mesh.vertices[first[1]], mesh.vertices[first[2]], mesh.vertices[second[2]]};
}

TriangleValues of_session(carreau_session* session, std::int32_t kind, std::size_t triangles, TriangleValues values) {
  values.values.resize(triangles);
  require(session,
          carreau_delivered_values(session, kind, static_cast<std::int64_t>(triangles), values.values.data()));
  fit_scale(values);
  return values;
}

}  // namespace

std::vector<std::uint8_t> halves_of(const MeshArrays& mesh) {
  std::vector<std::uint8_t> halves(mesh.triangles.size(), 0);
  std::set<Corners> first;
  for (const Element& element : mesh.elements)
    if (element.corners() == 4) first.insert({element.nodes[0], element.nodes[1], element.nodes[2]});
  for (std::size_t t = 0; t + 1 < halves.size() && !first.empty(); ++t)
    if (halves[t] == 0 && first.contains(mesh.triangles[t])) halves[t] = 1, halves[t + 1] = 2;
  return halves;
}

std::vector<TriangleValues> shape_values(const MeshArrays& mesh, const std::vector<std::uint8_t>& halves) {
  TriangleValues quality{.key = "quality", .title = "Shape quality", .unit = "",
      .help = "Q2 of a triangle: 4 √3 area over the sum of its squared sides, 1 when it is equilateral, 0 when it is flat. "
              "For a quadrilateral: 1 when it is square."};
  TriangleValues size{.key = "size", .title = "Size", .unit = "model length",
      .help = "Side of the equilateral triangle of the same area.", .scale = Scale::logarithmic};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [i, j, k] = mesh.triangles[t];
    const Point &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    quality.values.push_back(halves[t] == 0   ? shape_quality(a, b, c)
                             : halves[t] == 1 ? shape_of_quad(quad_of(mesh, t))
                                              : quality.values.back());
    size.values.push_back(size_of(a, b, c));
  }
  fit_scale(size);
  return {std::move(quality), std::move(size)};
}

std::vector<TriangleValues> surface_values(carreau_session* session, std::size_t triangles) {
  return {of_session(session, CARREAU_MEASURE_A0, triangles,
                     {.key = "a0", .title = "Deviation A0", .unit = "model length",
                      .help = "Largest distance of the surface from its triangle, at sample points.", .scale = Scale::logarithmic}),
          of_session(session, CARREAU_MEASURE_A1, triangles,
                     {.key = "a1", .title = "Angle A1", .unit = "degrees",
                      .help = "Largest angle between the normal of a triangle and normals of the surface above it."})};
}

}  // namespace command
